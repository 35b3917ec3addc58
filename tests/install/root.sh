# SPDX-License-Identifier: BSD-3-Clause
# Functions that make a bare Debian in a folder and use it as root. The scripts fresh.sh and
# wheels.sh source this file.

# This prefix runs a command with its own namespaces for mounts and processes. These mounts and
# processes end together with the command.
apart="unshare --mount --pid --fork --kill-child"

# make_root ROOT RELEASE [OPTION OF debootstrap...] makes the bare system. It uses the mirror, proxy
# and certificates that apt and pip use on this machine.
make_root() {
  root=$1
  release=$2
  shift 2
  mirror=$(apt-get indextargets --format '$(REPO_URI)' "Label: Debian" | head -n 1)
  [ -n "$mirror" ] || { echo "apt has no mirror of Debian here: add one to /etc/apt"; return 1; }
  rm -rf "$root"
  mkdir -p "$root"
  $apart debootstrap --variant=minbase "$@" "$release" "$root" "$mirror" >"$root.log" 2>&1 || {
    tail -n 20 "$root.log"
    return 1
  }
  # The commands in the documents use sudo, and apt asks for confirmation. Here sudo only runs the
  # command, and apt assumes yes.
  mkdir -p "$root/usr/local/bin" "$root/etc/apt/apt.conf.d"
  printf '#!/bin/sh\nexec "$@"\n' >"$root/usr/local/bin/sudo"
  chmod +x "$root/usr/local/bin/sudo"
  echo 'APT::Get::Assume-Yes "true";' >"$root/etc/apt/apt.conf.d/80yes"
  apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$root/etc/apt/apt.conf.d/90here" || true
  # If the package ca-certificates is installed later, it adds the certificates in this folder to
  # the bundle.
  mkdir -p "$root/usr/local/share/ca-certificates"
  cp -R /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates" 2>/dev/null || true
  for file in /etc/resolv.conf /etc/pip.conf /etc/ssl/certs/ca-certificates.crt "${PIP_CERT:-}"; do
    [ ! -f "$file" ] || install -D -m 644 "$file" "$root$file"
  done
}

# inside ROOT FOLDER COMMAND... runs a command in the bare system. Of the environment variables, the
# command receives only those that say where packages are.
inside() {
  root=$1
  folder=$2
  shift 2
  set -- PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root "$@"
  for name in http_proxy https_proxy no_proxy PIP_INDEX_URL PIP_CERT; do
    eval "value=\${$name:-}"
    [ -z "$value" ] || set -- "$name=$value" "$@"
  done
  $apart --mount-proc="$root/proc" chroot "$root" env -i --chdir="$folder" "$@"
}
