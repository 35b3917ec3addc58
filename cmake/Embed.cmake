# SPDX-License-Identifier: BSD-3-Clause
# usage: cmake -D FILE=page.html -D NAME=baum_i_page -D OUTPUT=page.c -P Embed.cmake
# Writes C code that contains the bytes of a file, followed by a zero byte.
file(READ "${FILE}" bytes HEX)
string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE "${OUTPUT}" "extern const unsigned char ${NAME}[];\nconst unsigned char ${NAME}[] = {\n${bytes}0};\n")
