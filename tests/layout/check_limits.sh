#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_limits.sh LIZARD FOLDER...
# Checks the limits: a function may have at most 80 lines, 8 parameters and complexity 12, and a
# file at most 600 lines.
set -eu
lizard=$1
shift

failures=0
# With -w, lizard prints only functions that exceed a limit, and fails if there are any.
"$lizard" -l cpp -w -L 80 -a 8 -C 12 "$@" || failures=1
long=$(find "$@" -name '*.[ch]' -exec awk 'END { if (NR > 600) print FILENAME ": " NR " lines" }' {} \;)
if [ -n "$long" ]; then
  echo "$long"
  failures=1
fi
exit "$failures"
