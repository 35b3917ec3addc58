#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_headers.sh C_COMPILER INCLUDE
# Checks that every public header compiles if it is included alone, once or twice, in C11 and in
# C++17. The environment variable CXX names the C++ compiler (default: c++).
set -eu
cc=$1
include=$2
cxx=${CXX:-c++}
command -v "$cxx" >/dev/null || { echo "no C++ compiler: set CXX"; exit 1; }
strict="-Wall -Wextra -Wpedantic -Wshadow -Wundef -Werror -fsyntax-only"

failures=0
for header in "$include"/baum/*.h; do
  name=baum/$(basename "$header")
  unit="#include <$name>
#include <$name>
extern int baum_check_headers;"
  for compiler in "$cc -x c -std=c11 -Wstrict-prototypes" "$cxx -x c++ -std=c++17"; do
    # shellcheck disable=SC2086
    if ! echo "$unit" | $compiler $strict -I"$include" -; then
      echo "$name: does not compile alone with $compiler"
      failures=$((failures + 1))
    fi
  done
done
echo "$failures failures"
[ "$failures" -eq 0 ]
