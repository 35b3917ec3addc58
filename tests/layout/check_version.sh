#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_version.sh VERSION SOVERSION PROJECT
# Checks that the version is the same everywhere. It is defined in include/baum/version.h. The build and generate_abi.py
# read it there. The Python package takes it from _abi.py, and the documents must not name another version. The Python
# package finds the library by its soname, which must also agree.
set -eu
version=$1
soversion=$2
cd "$3"
failures=0

# same WHAT FOUND WANTED reports WHAT if FOUND differs from WANTED.
same() {
  [ "$2" = "$3" ] && return
  echo "$1 has $2, must have $3"
  failures=$((failures + 1))
}

header=include/baum/version.h
same "the text in $header" "$(sed -n 's/^#define BAUM_VERSION  *"\([^"]*\)".*/\1/p' $header)" "$version"
same "the numbers in $header" "$(sed -n 's/^#define BAUM_VERSION_[A-Z]*  *\([0-9]*\).*/\1/p' $header | paste -s -d .)" "$version"
same bindings/python/baum/_abi.py "$(sed -n 's/^VERSION = "\(.*\)"/\1/p' bindings/python/baum/_abi.py)" "$version"
same "section project of bindings/python/pyproject.toml" \
  "$(sed -n '/^\[project\]/,/^\[/p' bindings/python/pyproject.toml | grep -E '^(version|dynamic) *=')" 'dynamic = ["version"]'
same "the first heading of docs/changelog.md" "$(sed -n 's/^## \([0-9.]*\),.*/\1/p' docs/changelog.md | head -n 1)" "$version"
same "the package in README.md" "$(grep -oE 'baum-[0-9]+[.][0-9.]+' README.md | sort -u)" "baum-$version"
same "find_package() in docs/install.md" "$(grep -oE 'find_package\(baum [0-9.]+' docs/install.md | sort -u)" "find_package(baum ${version%.*}"
same bindings/python/baum/_lib.py "$(grep -oE 'libbaum[.]so[.][0-9]+' bindings/python/baum/_lib.py)" "libbaum.so.$soversion"
echo "version $version, soname libbaum.so.$soversion, $failures differences"
[ "$failures" -eq 0 ]
