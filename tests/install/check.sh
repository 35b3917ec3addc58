#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check.sh PREFIX PROJECT
# Checks an installed baum. Programs must build with it by CMake and by a plain command line, with
# shared and with static libraries. CMake must refuse another version. No installed file may contain
# the path of the build.
set -eu
prefix=$1
project=$2
source=$project/tests/install
build=$project/build/install-consumer
rm -rf "$build"
mkdir -p "$build"

fail() {
  echo "$*"
  exit 1
}

echo "find_package(baum)"
cmake -S "$source" -B "$build/cmake" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >"$build/log" 2>&1 ||
  { cat "$build/log"; exit 1; }
cmake --build "$build/cmake" >"$build/log" 2>&1 || { cat "$build/log"; exit 1; }
"$build/cmake/consumer"
"$build/cmake/consumer_static"
"$build/cmake/catalog"
"$build/cmake/catalog_static"
readelf -d "$build/cmake/consumer" | grep -q 'NEEDED.*\[libbaum\.so\.0\]' || fail "no soname libbaum.so.0"
if readelf -d "$build/cmake/consumer_static" | grep 'NEEDED.*libbaum'; then
  fail "the static program loads the shared library"
fi

for wrong in 0.2 1.0 0.1.99; do
  echo "find_package(baum $wrong) is refused"
  if cmake -S "$source" -B "$build/wrong-$wrong" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -DWANTED="$wrong" >"$build/log" 2>&1; then
    fail "version $wrong was accepted"
  fi
  grep -q "considered but not accepted" "$build/log" || { cat "$build/log"; exit 1; }
done

pc=$(dirname "$(find "$prefix" -name baum.pc)")
libraries=$(dirname "$pc")
export PKG_CONFIG_PATH="$pc"
cc=${CC:-cc}
echo "pkg-config baum: $(pkg-config --libs baum)"
# shellcheck disable=SC2046
"$cc" -std=c11 "$source/consumer.c" -o "$build/shared" $(pkg-config --cflags --libs baum)
LD_LIBRARY_PATH=$libraries "$build/shared"
# shellcheck disable=SC2046
"$cc" -std=c11 "$source/catalog.c" -o "$build/catalog" $(pkg-config --cflags --libs baum_catalog)
LD_LIBRARY_PATH=$libraries "$build/catalog"
echo "pkg-config --static baum: $(pkg-config --static --libs baum)"
# shellcheck disable=SC2046
"$cc" -std=c11 "$source/consumer.c" -o "$build/static" \
  $(pkg-config --static --cflags --libs baum | sed 's/-lbaum/-l:libbaum.a/')
"$build/static"

# Runs the commands of docs/install.md, which expect the library in ~/baum, with the first program
# of README.md.
echo "the commands of docs/install.md for programs"
. "$source/documented.sh"
page=$project/docs/install.md
mkdir -p "$build/by_hand/home"
ln -s "$(cd "$prefix" && pwd)" "$build/by_hand/home/baum"
(
  cd "$build/by_hand"
  export HOME="$PWD/home" CMAKE_GENERATOR=Ninja # make need not be installed
  unset PKG_CONFIG_PATH
  first_block "$project/README.md" c >program.c
  first_block "$project/README.md" text >expected.txt
  first_block "$page" cmake >CMakeLists.txt
  check_program() {
    "$1" >printed.txt
    diff expected.txt printed.txt
  }
  follow "$page" "The C library" 4
  check_program ./program
  rm program
  eval "$(documented "$page" "The C library" 3)"
  follow "$page" "The C library" 5
  check_program ./program
  check_program ./program_static
  follow "$page" "The C library" 6
  check_program build/program
)

# link OUT ARGUMENT... links every_backend.c with the static libraries and runs it.
link() {
  out=$1
  shift
  # shellcheck disable=SC2046
  "$cc" -std=c11 "$source/every_backend.c" -o "$out" \
    $(pkg-config --static --cflags --libs baum_catalog | sed 's/-lbaum\(_catalog\)\{0,1\} /-l:libbaum\1.a /g') "$@"
  "$out"
}

echo "every backend, with the static libraries of baum"
link "$build/every_backend"
if readelf -d "$build/every_backend" | grep 'NEEDED.*libbaum'; then
  fail "the static program loads the shared library"
fi

case $(pkg-config --static --libs baum) in
  *-lmpi*) echo "every backend, with static libraries only: skipped, MPI needs libraries that it does not name" ;;
  *) echo "every backend, with static libraries only"; link "$build/all_static" -static ;;
esac

# Makes a program of the C blocks in the first chapter of docs/tutorial.md. Functions are copied
# unchanged, and statements become the body of main.
echo "the tutorial's program, as it is printed"
awk -v main="$build/main" '
  /^## / { chapter++ }
  chapter == 1 && /^```/ { inside = $0 == "```c"; first = 1; next }
  chapter == 1 && inside { if (first) body = /^ /; first = 0; if (body) print > main; else print }' \
  "$project/docs/tutorial.md" >"$build/tutorial.c"
{
  echo "int main(void)"
  echo "{"
  echo "  baum_mechanism *mechanism = pendulum();"
  echo "  double t = 1.0;"
  echo "  baum_counters counters;"
  cat "$build/main"
  echo "}"
} >>"$build/tutorial.c"
# shellcheck disable=SC2046
"$cc" -std=c11 "$build/tutorial.c" -o "$build/tutorial" $(pkg-config --cflags --libs baum)
LD_LIBRARY_PATH=$libraries "$build/tutorial"

echo "the binary of FMUs exports only functions of FMI"
if nm -D --defined-only "$libraries/baum/baum_fmu.so" | grep -v ' fmi3'; then
  fail "baum_fmu.so exports the symbols above"
fi

echo "every example, with the installed libraries"
for example in "$project"/examples/*.c; do
  # shellcheck disable=SC2046
  "$cc" -std=c11 "$example" -o "$build/example" $(pkg-config --cflags --libs baum_catalog) -lm
done

echo "no path of the build is installed"
if grep -rF "$project" "$libraries/cmake/baum" "$pc"/baum*.pc "$prefix/include/baum"; then
  fail "the lines above contain the path of the project"
fi
