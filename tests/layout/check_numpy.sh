#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_numpy.sh PROJECT CMAKE CTEST GENERATOR
# Checks a build with a Python that has no NumPy. It must omit the tests that need NumPy, and
# explain how to enable them.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# a Python that does not see installed packages
printf '#!/bin/sh\nexec python3 -I -S "$@"\n' >"$scratch/python3"
chmod +x "$scratch/python3"
"$2" -S "$1" -B "$scratch/build" -G "$4" -DPython3_EXECUTABLE="$scratch/python3" -DBAUM_EXAMPLES=OFF >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }
grep "Tests of Python are omitted.*$scratch/python3 has no NumPy. Install" "$scratch/log" ||
  { echo "no message about NumPy"; exit 1; }
if "$3" --test-dir "$scratch/build" -N -L python | grep 'Test *#'; then
  echo "these tests need NumPy"
  exit 1
fi
