# SPDX-License-Identifier: BSD-3-Clause
# Functions for tests/run.sh, tests/release.sh and examples/run.sh, which source this file in the top folder of the
# project. The functions install packages that a fresh Debian 12 lacks, as root or by sudo, and build in build/.

jobs=$(nproc)
build_packages="gcc libc6-dev cmake ninja-build pkg-config libsundials-dev libsuitesparse-dev
  libgsl-dev libcmocka-dev python3 python3-venv"
venv=build/venv
venv_packages="numpy matplotlib pandas pandas-stubs lizard mypy==2.4.1
  pyright[nodejs]==1.1.414 ruff==0.17.6"

heading() {
  printf '\n==== %s\n' "$*"
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# need_packages NAME... installs those of the named packages that are missing.
need_packages() {
  command -v dpkg-query >/dev/null || { echo "this system is not Debian; please install: $*"; return 0; }
  missing=
  for package in "$@"; do
    dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed$' ||
      missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  heading "installing$missing"
  quietly as_root apt-get update -q
  # shellcheck disable=SC2086
  quietly as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends $missing
}

# Makes a virtual environment with the packages that tests and examples import. It uses Debian's Python if there is one.
need_venv() {
  [ "$(cat "$venv/installed" 2>/dev/null)" = "$venv_packages" ] && return
  heading "Python environment with $venv_packages"
  python=/usr/bin/python3
  [ -x "$python" ] || python=python3
  "$python" -m venv --clear "$venv"
  # shellcheck disable=SC2086
  "$venv/bin/python" -m pip install --quiet $venv_packages
  echo "$venv_packages" >"$venv/installed"
}

# quietly COMMAND... runs the command, and shows its output only if it fails.
quietly() {
  mkdir -p build
  "$@" >build/last.log 2>&1 || { cat build/last.log; echo "failed: $*"; return 1; }
}

# build PRESET FOLDER [CMAKE ARGUMENT...] configures and builds in build/FOLDER.
build() {
  preset=$1
  folder=build/$2
  shift 2
  echo "building $folder $*"
  quietly cmake --preset "$preset" -B "$folder" "-DPython3_EXECUTABLE=$PWD/$venv/bin/python" \
    --no-warn-unused-cli "$@"
  quietly cmake --build "$folder"
}
