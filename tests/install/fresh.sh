#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: fresh.sh RELEASE ROOT CLONE COMMAND...
# As root: makes a bare Debian RELEASE (bookworm, trixie) in ROOT and runs the COMMANDs there, in the clone CLONE of the
# project. Uses the mirror, proxy and certificates that apt and pip use here. Removes ROOT at the end; after a failure
# it stays, without mounts.
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
