#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_release.sh PROJECT
# Checks that `sh tests/release.sh --check` accepts a tree that is ready for a release, and refuses other trees. The
# test makes its own repository from a copy of the project, with a later version than that of the project. If there is
# no git, the test is skipped (exit status 77).
set -eu
command -v git >/dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tar -C "$1" -cf - CMakeLists.txt README.md docs/changelog.md docs/install.md include bindings/python \
  tests/release.sh tests/setup.sh tests/layout | tar -C "$folder" -xf -
cd "$folder"

# The user's settings of git, and a repository that contains this folder, must have no effect.
unset GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_NOSYSTEM=1 PYTHONDONTWRITEBYTECODE=1
export GIT_AUTHOR_NAME=t GIT_AUTHOR_EMAIL=t@t.invalid GIT_COMMITTER_NAME=t GIT_COMMITTER_EMAIL=t@t.invalid
git init -q .
printf 'build/\n__pycache__/\n' >.gitignore

commit() {
  git add -A && git commit -q -m "$1"
}

# set_version MAJOR MINOR PATCH SOVERSION [DATE] writes the version in all places that a release changes.
set_version() {
  sed -i -e "s/\(BAUM_VERSION_MAJOR\) *[0-9]*/\1 $1/" -e "s/\(BAUM_VERSION_MINOR\) *[0-9]*/\1 $2/" \
    -e "s/\(BAUM_VERSION_PATCH\) *[0-9]*/\1 $3/" -e "s/\(BAUM_VERSION \) *\"[^\"]*\"/\1 \"$1.$2.$3\"/" include/baum/version.h
  sed -i "s/baum-[0-9]*[.][0-9]*[.][0-9]*-/baum-$1.$2.$3-/" README.md
  sed -i "s/find_package(baum [0-9.]*/find_package(baum $1.$2/" docs/install.md
  sed -i "s/^set(BAUM_SOVERSION .*/set(BAUM_SOVERSION $4)/" CMakeLists.txt
  sed -i "s/libbaum[.]so[.][0-9]*/libbaum.so.$4/" bindings/python/baum/_lib.py
  awk -v heading="## $1.$2.$3, ${5:-2026-01-31}" '/^## / && !done { $0 = heading; done = 1 } { print }' docs/changelog.md >new
  mv new docs/changelog.md
  python3 bindings/python/tools/generate_abi.py
}

accepted() {
  sh tests/release.sh --check >said || { echo "refused: $1"; cat said; exit 1; }
}

# refused WHY WHAT checks that the tree is refused, and that WHAT is the only check that fails. WHY is printed.
refused() {
  if sh tests/release.sh --check >said; then
    echo "accepted: $1"
    exit 1
  fi
  [ "$(grep -c '^FAILED' said)" -eq 1 ] && grep -q "^FAILED  .*$2" said || { echo "wrong reason: $1"; cat said; exit 1; }
}

echo said >>.gitignore
set_version 7 1 0 3
commit "ready"
accepted "the first release"
echo >>README.md
refused "a change that is not committed" "working tree"
git checkout -q README.md
set_version 7 1 0 3 "not yet released"
commit "without a date"
refused "no date" "changelog"
set_version 7 1 0 3
commit "dated"
git tag v7.1.0
refused "a second release of this version" "no tag"

set_version 7 1 1 3
commit "a correction"
accepted "a correction"
echo '# edited' >>bindings/python/baum/_abi.py
commit "an edited file"
refused "a generated file that was edited" "generated files"
git checkout -q HEAD~1 -- bindings/python/baum/_abi.py
sed -i 's/BAUM_VERSION_PATCH 1/BAUM_VERSION_PATCH 2/' include/baum/version.h
commit "two versions"
refused "versions that differ" "one place"

# If the value of an enum constant changes, compiled programs break.
sed -i 's/X(BAUM_WARNED, 10,/X(BAUM_WARNED, 11,/' include/baum/status.h
for version in "7 1 2 3" "7 2 0 4" "8 0 0 3"; do
  # shellcheck disable=SC2086
  set_version $version
  commit "a break in $version"
  refused "a break in $version" "soname"
done
set_version 8 0 0 4
commit "a break with a new soname"
accepted "a break with a new soname and major version"
echo "releases are accepted and refused as they should be"
