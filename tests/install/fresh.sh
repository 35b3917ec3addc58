#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: fresh.sh RELEASE ROOT CLONE COMMAND...
# Must be run as root. Makes a bare Debian RELEASE (bookworm, trixie) in the folder ROOT, and runs
# the COMMANDs there, in CLONE, which is a clone of the project. It uses the mirror, proxy and
# certificates that apt and pip use on this machine. At the end, ROOT is removed. If a command
# fails, ROOT remains, but nothing is mounted in it.
set -eu
release=$1
root=$2
clone=$3
shift 3

. "$clone/tests/install/root.sh"

begun=$(date +%s)
make_root "$root" "$release"
cp -R "$clone" "$root/root/baum"
made=$(date +%s)
echo "a bare Debian $release after $((made - begun)) s"

for command in "$@"; do
  begun=$(date +%s)
  inside "$root" /root/baum sh -c "$command"
  echo "$command: ok after $(($(date +%s) - begun)) s"
done
rm -rf "$root"
