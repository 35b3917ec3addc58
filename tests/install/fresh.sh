#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: fresh.sh ROOT CLONE [STAGE...]
# As root: makes a bare Debian 12 in ROOT and runs the two commands of the README there, on the clone CLONE of the
# project, with the STAGEs of tests/run.sh. Uses the mirror, proxy and certificates that apt and pip use here. Removes
# ROOT at the end; after a failure it stays, without mounts.
set -eu
root=$1
clone=$2
shift 2
release=bookworm

. "$clone/tests/install/root.sh"

begun=$(date +%s)
make_root "$root" "$release"
cp -R "$clone" "$root/root/baum"
made=$(date +%s)
echo "a bare Debian $release after $((made - begun)) s"

inside "$root" /root/baum sh examples/run.sh
examples=$(date +%s)
echo "examples/run.sh after $((examples - made)) s"
inside "$root" /root/baum sh tests/run.sh "$@"
echo "tests/run.sh after $(($(date +%s) - examples)) s"
rm -rf "$root"
