#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_docs.sh HEADERS
# Every public function has a comment of its own, and one that returns a status says which, unless
# the comment of its file does ("Every call returns ...").
set -eu

awk '
  function fail(why) { printf "%s:%d: %s\n", FILENAME, FNR, why; failures++ }

  FNR == 1 { comment = ""; inside = 0; returns = 0 }
  /^[ \t]*\/\*\*/ { comment = ""; inside = 1 }
  inside {
    comment = comment $0 "\n"
    if (comment ~ /@file/ && /Every call returns/) returns = 1
    if (/\*\//) inside = 0
    next
  }
  /^[ \t]*#/ { comment = ""; next }
  /BAUM_(CATALOG_)?API/ {
    functions++
    if (comment == "") fail("no /** comment before: " $0)
    else if (/BAUM_(CATALOG_)?API[ \t]+baum_status/ && !returns && comment !~ /@return|@copydoc|@copydetails/)
      fail("no @return in the comment before: " $0)
  }
  !/^[ \t]*$/ { comment = "" }

  END {
    printf "%d public functions read, %d without their documentation\n", functions, failures
    exit failures > 0 || functions == 0
  }' "$1"/*.h
