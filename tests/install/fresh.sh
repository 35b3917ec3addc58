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

mirror=$(apt-get indextargets --format '$(REPO_URI)' "Release: $release" | head -n 1)
[ -n "$mirror" ] || { echo "apt has no source for Debian $release here: add one to /etc/apt"; exit 1; }

# Mounts and processes are in separate namespaces and end with these.
apart="unshare --mount --pid --fork --kill-child"

rm -rf "$root"
mkdir -p "$root"
begun=$(date +%s)
$apart debootstrap --variant=minbase "$release" "$root" "$mirror" >"$root.log" 2>&1 || {
  tail -n 20 "$root.log"
  exit 1
}
apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$root/etc/apt/apt.conf.d/90here" || true
# If the package ca-certificates is installed later, it also adds this folder's certificates to the bundle.
mkdir -p "$root/usr/local/share/ca-certificates"
cp -R /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates" 2>/dev/null || true
for file in /etc/resolv.conf /etc/pip.conf /etc/ssl/certs/ca-certificates.crt "${PIP_CERT:-}"; do
  [ ! -f "$file" ] || install -D -m 644 "$file" "$root$file"
done
cp -R "$clone" "$root/root/baum"
made=$(date +%s)
echo "a bare Debian $release after $((made - begun)) s"

# inside COMMAND...: run it in the bare system, with only those environment variables that locate the packages.
inside() {
  set -- PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root "$@"
  for name in http_proxy https_proxy no_proxy PIP_INDEX_URL PIP_CERT; do
    eval "value=\${$name:-}"
    [ -z "$value" ] || set -- "$name=$value" "$@"
  done
  $apart --mount-proc="$root/proc" chroot "$root" env -i --chdir=/root/baum "$@"
}

inside sh examples/run.sh
examples=$(date +%s)
echo "examples/run.sh after $((examples - made)) s"
inside sh tests/run.sh "$@"
echo "tests/run.sh after $(($(date +%s) - examples)) s"
rm -rf "$root"
