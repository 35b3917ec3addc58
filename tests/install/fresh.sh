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

mirror=$(apt-get indextargets --format '$(REPO_URI)' "Release: bookworm" | head -n 1)
[ -n "$mirror" ] || { echo "apt has no source for Debian bookworm here: add one to /etc/apt"; exit 1; }

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

for command in "$@"; do
  begun=$(date +%s)
  inside sh -c "$command"
  echo "$command: ok after $(($(date +%s) - begun)) s"
done
rm -rf "$root"
