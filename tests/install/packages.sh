#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: packages.sh FOLDER
# Must be run as root, on a system that may be changed, in the top folder of the project. It
# installs the Debian packages in FOLDER, runs the README's first program in Python, builds programs
# in C, and removes the packages.
set -eu
folder=$(cd "$1" && pwd)
project=$PWD
export DEBIAN_FRONTEND=noninteractive

install() {
  apt-get install -q -y --no-install-recommends "$@" >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }
}

apt-get update -q >/dev/null
install "$folder"/libbaum0_*.deb "$folder"/python3-baum_*.deb
echo "compiler: $(command -v cc || echo none)"
awk '/^```python/ { inside = 1; next } /^```/ && inside { exit } inside' README.md >/tmp/first.py
cd /tmp
python3 first.py
python3 -c 'import importlib.metadata, baum; assert importlib.metadata.version("baum") == baum.__version__'

install gcc libc6-dev cmake ninja-build pkg-config "$folder"/libbaum-dev_*.deb
sh "$project/tests/install/check.sh" /usr "$project"

apt-get purge -q -y libbaum-dev python3-baum libbaum0 >/dev/null
left=$(find /usr /etc /var/lib/dpkg/info -name '*baum*' -not -path "$project/*")
[ -z "$left" ] || { echo "these files are left: $left"; exit 1; }
echo "the packages are removed"
