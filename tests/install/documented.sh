# SPDX-License-Identifier: BSD-3-Clause
# Functions that follow the instructions of the documents, as users do. check.sh, readme.sh and
# wheels.sh source this file.

# first_block FILE LANGUAGE prints the first code block in LANGUAGE of the document FILE.
first_block() {
  awk -v fence="\`\`\`$2" '$0 == fence { inside = 1; next } /^```/ && inside { exit } inside' "$1"
}

# documented FILE HEADING N prints the N-th block of shell commands under the heading HEADING.
documented() {
  awk -v heading="## $2" -v wanted="$3" '
    /^## / { here = $0 == heading }
    /^```/ { inside = here && $0 == "```sh" && ++n == wanted; next }
    inside' "$1"
}

# follow FILE HEADING N prints the commands of the N-th block under the heading and runs them.
follow() {
  documented "$1" "$2" "$3" >commands.sh
  [ -s commands.sh ] || { echo "$1 has no command block $3 under \"$2\""; return 1; }
  sed 's/^/$ /' commands.sh
  sh -e commands.sh >commands.log 2>&1 || { cat commands.log; return 1; }
}
