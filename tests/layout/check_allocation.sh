#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_allocation.sh SOURCE
# Checks that every public function is tested in exactly one of two files. One file is for functions
# that allocate memory; it makes their allocations fail one after the other. The other file is for
# functions that allocate nothing. The functions of elements are in both files, through the table in
# tests/support/every_element_kinds.c.
set -eu
cd "$1"
with=tests/api/test_calls_losing_memory.c
without=tests/api/test_calls_without_memory.c

kinds=$(sed -n 's/^  KIND([a-z]*, \([a-z_]*\),.*/\1/p' tests/support/every_element_kinds.c)
[ -n "$kinds" ] || { echo "no kinds of elements read"; exit 1; }
by_table=$(for kind in $kinds; do
  printf 'baum_mechanism_add_%s\nbaum_mechanism_set_%s\nbaum_mechanism_get_%s\nbaum_%s_def_init\n' \
    "$kind" "$kind" "$kind" "$kind"
done)
listed=$({
  sed -n 's/^ *\(ROW\|WORKS\)(\(baum_[a-z_0-9]*\)[,)].*/\2/p' "$with"
  sed -n 's/^ *X(\(baum_[a-z_0-9]*\),.*/\1/p' "$without"
  echo "$by_table"
} | sort)
# Joins declarations that extend over several lines.
functions=$(cat include/baum/*.h | awk '
  /^BAUM_(CATALOG_)?API/ { text = ""; inside = 1 }
  inside { text = text " " $0 }
  inside && /\(/ { sub(/\(.*/, "", text); sub(/.*[ *]/, "", text); print text; inside = 0 }' | sort -u)
[ -n "$functions" ] || { echo "no public functions read"; exit 1; }

failures=0
# complain WHY NAMES prints the names, unless there are none.
complain() {
  [ -z "$2" ] && return
  printf '%s:\n%s\n' "$1" "$2"
  failures=$((failures + 1))
}

complain "in neither $with nor $without" "$(echo "$functions" | grep -vxF "$listed" || true)"
complain "in more than one place" "$(echo "$listed" | uniq -d)"
complain "no public function" "$(echo "$listed" | grep -vxF "$functions" || true)"
echo "$(echo "$functions" | wc -l) public functions read, $failures failures"
[ "$failures" -eq 0 ]
