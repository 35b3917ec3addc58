# SPDX-License-Identifier: BSD-3-Clause
# Functions of readme.sh and wheels.sh, which source this file: what the documents tell users to do.

# first_block FILE LANGUAGE: the first block of a document in a language.
first_block() {
  awk -v fence="\`\`\`$2" '$0 == fence { inside = 1; next } /^```/ && inside { exit } inside' "$1"
}

# documented FILE HEADING N: the N-th block of shell commands under a heading.
documented() {
  awk -v heading="## $2" -v wanted="$3" '
    /^## / { here = $0 == heading }
    /^```/ { inside = here && $0 == "```sh" && ++n == wanted; next }
    inside' "$1"
}

# follow FILE HEADING N: show and run these commands.
follow() {
  documented "$1" "$2" "$3" >commands.sh
  [ -s commands.sh ] || { echo "$1 has no commands $3 under \"$2\""; return 1; }
  sed 's/^/$ /' commands.sh
  sh -e commands.sh >commands.log 2>&1 || { cat commands.log; return 1; }
}
