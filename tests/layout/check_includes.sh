#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_includes.sh PROJECT
# Checks includes. A layer may include only lower layers. The headers of another library may be
# included only in the backend files for that library. Public headers may include only public
# headers and those of the C library.
set -eu
cd "$1"

find src include -name '*.[ch]' | sort | xargs awk '
  function fail(why) { printf "%s:%d: %s\n", FILENAME, FNR, why; failures++ }

  # Says which headers of other libraries each backend file may include.
  function foreign_allowed(file, header) {
    if (header ~ /^klu\.h$/) return file ~ /^src\/linear\/sparse_lu\.c$/
    if (header == "colamd.h") return file == "src/linear/qr.c"
    if (header ~ /^(cvode|ida|nvector|sundials|sunmatrix|sunlinsol|sunnonlinsol)\//)
      return file ~ /^src\/integrate\/(cvode(_[a-z]+)?|ida(_[a-z]+)?|sundials_(common|driver|klu))\.[ch]$/
    if (header ~ /^(fcntl|io|pthread|unistd|windows|sys\/stat)\.h$/) return file == "src/base/platform.c"
    if (header == "cpuid.h") return file == "src/base/hot.c"
    if (header == "immintrin.h") return file == "src/base/four.h"
    return 0
  }

  BEGIN {
    below["base"] = ""
    below["linear"] = "base"
    below["mechanism"] = "base"
    below["stabilization"] = "base"
    below["dynamics"] = "linear mechanism base"
    below["integrate"] = "dynamics stabilization linear mechanism base"
    below["simulate"] = "integrate " below["integrate"]
    below["draw"] = "simulate " below["simulate"]
    below["study"] = "draw " below["draw"]
    below["scene"] = "mechanism base"
    below["fmu"] = "scene mechanism base"
    below["catalog"] = "" # it includes only public headers, as users do
    n = split("assert complex ctype errno fenv float inttypes limits locale math setjmp signal " \
              "stdalign stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string " \
              "tgmath threads time", names, " ")
    for (i = 1; i <= n; i++) c_library[names[i] ".h"] = 1
  }

  /^[ \t]*#[ \t]*include/ {
    includes++
    header = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", header)
    quoted = header ~ /^"/
    if (header !~ /^("[^"]+"|<[^>]+>)/) { fail("an include that names no file: " $0); next }
    sub(/^["<]/, "", header)
    sub(/[">].*$/, "", header)

    split(FILENAME, part, "/")
    if (!quoted) {
      if (header in c_library || header ~ /^baum\/[a-z_]+\.h$/) next
      if (!foreign_allowed(FILENAME, header))
        fail("<" header "> of another library may be included only in its backend files")
      next
    }
    if (part[1] == "include") { fail("a public header includes private \"" header "\""); next }
    if (header !~ /\.h$/) { fail("\"" header "\" is not a header"); next }
    layer = part[2]
    split(header, target, "/")
    if (!(layer in below)) { fail("layer " layer " is not in the list"); next }
    if (!(target[1] in below)) {
      fail("\"" header "\": write the path from src, as in \"mechanism/mechanism.h\"")
      next
    }
    if (layer == "mechanism" && part[3] ~ /^(general|planar|spatial)$/) {
      if (header == "mechanism/mechanism.h")
        fail("an element includes the whole mechanism; model.h and identify.h are for elements")
      split("planar spatial", rooms, " ")
      for (r in rooms)
        if (part[3] != rooms[r] && header ~ ("^mechanism/" rooms[r] "/"))
          fail(part[3] " must not include " rooms[r] " (\"" header "\")")
    }
    if (target[1] != layer && (" " below[layer] " ") !~ (" " target[1] " "))
      fail(layer " must not include " target[1] " (\"" header "\")")
  }

  END {
    printf "%d includes read, %d violate the order of layers\n", includes, failures
    exit failures > 0 || includes == 0
  }'
