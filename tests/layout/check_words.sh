#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_words.sh PROJECT
# Checks that the terms of the field are used everywhere, and that comments and docstrings are not
# wider than the formatter's limit.
set -eu
cd "$1"
columns=100
failures=0

# banned WORD INSTEAD reports a banned word. It finds only whole words, and not parts of identifiers
# with underscores.
banned() {
  found=$(grep -rnwEI --include='*.[ch]' --include='*.py' --include='*.md' --include='*.gp' -e "$1" \
    README.md docs include src bindings/python/baum examples tests --exclude-dir=corpus) || return 0
  echo "$found"
  echo "say \"$2\" instead"
  failures=$((failures + 1))
}

banned 'sentences?' message
banned 'drawn poses?' 'design configuration'
banned 'singular poses?' 'singular configuration'
banned 'freedoms' 'degrees of freedom'
banned 'immobile' fixed
banned 'passages?' crossing
banned 'without a word' silently
banned 'hold hardly' ill-conditioned
banned 'anew' 'again, or restart'
banned 'dearer' 'more expensive'
banned 'left out' omitted
banned 'the drawing' 'the picture, or the design configuration'
banned 'full nodes?' 'general node'

wide=$(find include src examples tests bindings/python \( -name '*.[ch]' -o -path 'examples/*.py' \
  -o -path 'bindings/python/*.py' \) -exec awk -v n=$columns \
  'length > n { print FILENAME ":" FNR ": " length " columns" }' {} +)
[ -z "$wide" ] || { echo "$wide"; failures=$((failures + 1)); }
[ "$failures" -eq 0 ]
