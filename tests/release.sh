#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: sh tests/release.sh [--check]
#
# Makes the files of a release. The script checks the sources and runs every stage of tests/run.sh.
# Then it copies the packages and their SHA-256 digests into build/dist. This takes hours. If a
# stage fails, the next call continues with this stage, as long as the commit is the same. At the
# end, the script prints the commands that publish the release, but does not run them. With --check,
# the script only checks the sources, which takes a few seconds.
set -eu
cd "$(dirname "$0")/.."
. tests/setup.sh

text=$(sed -n 's/^#define BAUM_VERSION  *"\([^"]*\)".*/\1/p' include/baum/version.h)
tag=v$text
out=build/dist
failures=0

# check WHAT COMMAND... runs the command and reports the result. A failed check does not end the script, so that all
# failures are reported.
check() {
  what=$1
  shift
  if said=$("$@" 2>&1); then
    echo "ok      $what"
  else
    echo "FAILED  $what"
    [ -z "$said" ] || echo "$said" | sed 's/^/        /'
    failures=$((failures + 1))
  fi
}

tree_is_clean() {
  changed=$(git status --porcelain)
  echo "$changed"
  [ -z "$changed" ]
}

tag_is_new() {
  ! git rev-parse --quiet --verify "refs/tags/$tag" >/dev/null
}

# The first heading of the changelog must be "## VERSION, DATE", and at least one entry must follow it.
changelog_is_dated() {
  heading=$(grep -m 1 '^## ' docs/changelog.md)
  day=${heading#"## $text, "}
  echo "its first heading is \"$heading\", must be \"## $text, YYYY-MM-DD\" followed by entries"
  [ "$(date -d "$day" +%F 2>/dev/null)" = "$day" ] &&
    awk '/^## / { if (++n == 2) exit } n == 1 && /^- / { found = 1 } END { exit !found }' docs/changelog.md
}

version_has_one_place() {
  sh tests/layout/check_version.sh "$text" "$(soname <CMakeLists.txt)" .
}

soname() {
  sed -n 's/^set(BAUM_SOVERSION \([0-9]*\))/\1/p'
}

# Prints the tag of the previous release. Tags are sorted by version. Prints nothing if this is the first release.
last_tag() {
  { git tag --list 'v[0-9]*' && echo "$tag"; } | sort -V |
    awk -v tag="$tag" '$0 == tag { print last; exit } { last = $0 }'
}

# Prints the part of a version that must change if compiled programs break. This is the major version. Before version
# 1.0, it is the major and the minor version.
breaking_part() {
  case $1 in
    v0.*) echo "${1%.*}" ;;
    *) echo "${1%%.*}" ;;
  esac
}

# A change that breaks compiled programs requires another soname and another major version. Before version 1.0, it
# requires another minor version instead.
soname_counts_breaks() {
  last=$(last_tag)
  [ -n "$last" ] || return 0
  mkdir -p "$out"
  git show "$last:bindings/python/baum/_abi.py" >"$out/last_abi.py"
  python3 bindings/python/tools/compare_abi.py "$out/last_abi.py" bindings/python/baum/_abi.py && return
  echo "since $last: raise BAUM_SOVERSION in CMakeLists.txt and the major version (before 1.0, the minor version)"
  [ "$(soname <CMakeLists.txt)" -gt "$(git show "$last:CMakeLists.txt" | soname)" ] &&
    [ "$(breaking_part "$last")" != "$(breaking_part "$tag")" ]
}

check "the working tree is clean" tree_is_clean
check "there is no tag $tag yet" tag_is_new
check "docs/changelog.md has entries and a date for $text" changelog_is_dated
check "the version is defined in one place and agrees everywhere" version_has_one_place
check "generated files of the Python package are up to date" python3 bindings/python/tools/generate_abi.py --check
check "the soname changes if compiled programs break" soname_counts_breaks
[ "$failures" -eq 0 ] || exit 1
[ "${1:-}" != --check ] || exit 0

commit=$(git rev-parse HEAD)
passed=$out/passed-$commit
mkdir -p "$out"
touch "$passed"
for stage in $(sh tests/run.sh --list); do
  grep -qx "$stage" "$passed" && continue
  # The folder build/wheels/out may contain only packages of this commit.
  [ "$stage" != wheels ] || rm -rf build/wheels/out
  sh tests/run.sh "$stage"
  echo "$stage" >>"$passed"
done

heading "files of $tag"
tree_is_clean
. /etc/os-release
rm -rf "$out/files"
mkdir -p "$out/files/$ID$VERSION_ID"
cp build/wheels/out/* "$out/files"
cp build/debian/*.deb "$out/files/$ID$VERSION_ID"
(cd "$out/files" && find . -type f ! -name SHA256SUMS | sort | xargs sha256sum >SHA256SUMS && cat SHA256SUMS)
echo "To publish: git tag -a $tag -m 'baum $text' && git push origin $tag, and upload $out/files."
