#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_tutorial.sh PROJECT PROGRAM...
# Checks that README.md and docs/tutorial.md show code that is compiled. README.md must contain
# examples/first.c. Every ```c and ```py block must consist of consecutive lines of a file in
# examples/. Every ```text block must consist of consecutive lines that a PROGRAM prints. (Blocks of
# ```python are programs, which a test of the Python package executes.)
set -eu
project=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/sources" "$scratch/prints"
failures=0

fail() {
  echo "$*"
  failures=$((failures + 1))
}

# holds FILE BLOCK tells whether FILE contains the lines of BLOCK, one after the other.
holds() {
  awk -v RS='\001' 'NR == FNR { text = "\n" $0; next }
    { found = index(text, "\n" $0) > 0 }
    END { exit !found }' "$1" "$2"
}

# check DOCUMENT LANGUAGE FOLDER checks every code block in LANGUAGE of the DOCUMENT. Some file in
# the FOLDER must contain the block.
check() {
  blocks=$scratch/$(basename "$1").$2
  mkdir "$blocks"
  awk -v fence="$(printf '\140\140\140')" -v language="$2" -v folder="$blocks" '
    inside && $0 == fence { inside = 0; close(file) }
    inside { print > file }
    $0 == fence language { inside = 1; file = folder "/" NR }' "$1"
  count=0
  for block in "$blocks"/*; do
    [ -e "$block" ] || continue
    held=
    for file in "$3"/*; do
      if holds "$file" "$block"; then held=$file; fi
    done
    [ -n "$held" ] || fail "$1, the block after line $(basename "$block"): no file in $(basename "$3") contains it"
    count=$((count + 1))
  done
  echo "$1: $count blocks of $2"
  [ "$count" -gt 0 ] || fail "$1 has no block of $2"
}

cp "$project"/examples/*.[ch] "$project"/examples/*.py "$scratch/sources"
for program in "$@"; do
  "$program" >"$scratch/prints/$(basename "$program")" 2>&1 || fail "$program: exit code $?"
done
cd "$project"
holds README.md examples/first.c || fail "README.md does not contain examples/first.c unchanged"
for document in README.md docs/tutorial.md; do
  check "$document" c "$scratch/sources"
  check "$document" text "$scratch/prints"
done
check docs/tutorial.md py "$scratch/sources"
[ "$failures" -eq 0 ]
