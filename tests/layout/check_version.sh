#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_version.sh VERSION PROJECT
# Checks that the build, the header and the Python package have the same version.
set -eu
version=$1
cd "$2"

header=$(sed -n 's/^#define BAUM_VERSION  *"\([^"]*\)".*/\1/p' include/baum/version.h)
numbers=$(sed -n 's/^#define BAUM_VERSION_\(MAJOR\|MINOR\|PATCH\)  *\([0-9]*\).*/\2/p' \
  include/baum/version.h | paste -s -d .)
python=$version
if [ -e bindings/python/pyproject.toml ]; then
  python=$(sed -n 's/^version *= *"\([^"]*\)".*/\1/p' bindings/python/pyproject.toml)
fi
echo "build $version, header $header and $numbers, Python $python"
[ "$header" = "$version" ] && [ "$numbers" = "$version" ] && [ "$python" = "$version" ]
