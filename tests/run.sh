#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: sh tests/run.sh [STAGE...]
#        sh tests/run.sh --list     print the names of all stages
#
# Installs missing packages and runs the named stages, one after the other, until one fails. Without
# an argument, it runs the stages in the first of the rows below. The stages in the second row run
# only if they are named.
#   format types docs build test asan minimal install python
#   tidy coverage valgrind thread analyzer sweeps fuzz random browser site links debs packages readme fresh trixie wheels
# BAUM_COVERAGE is the smallest line coverage of src that stage coverage accepts, in percent (default: 95). Five folders
# of src must always have 100 %.
# BAUM_FUZZ_SECONDS is the time for which stage fuzz runs each fuzzer (default: 600).
# BAUM_FRESH names the stages that stage fresh runs on a bare Debian (default: the first row).
set -eu
cd "$(dirname "$0")/.."
. tests/setup.sh

usual="format types docs build test asan minimal install python"
named="tidy coverage valgrind thread analyzer sweeps fuzz random browser site links debs packages readme fresh trixie wheels"
prefix=$PWD/build/install-prefix
fuzz_seconds=${BAUM_FUZZ_SECONDS:-600}

stage_format() {
  find include src examples tests -name '*.[ch]' | sort |
    xargs clang-format --dry-run --Werror --style=file || {
    echo "to correct this: find include src examples tests -name '*.[ch]' | xargs clang-format -i"
    return 1
  }
  need_venv
  echo "limits"
  sh tests/layout/check_limits.sh "$venv/bin/lizard" src examples tests
}

# Checks formatting, type hints and lint of the Python package and of the examples.
stage_types() {
  need_venv
  settings=bindings/python/pyproject.toml
  "$venv/bin/ruff" format --quiet --check --diff --config $settings bindings/python examples
  "$venv/bin/ruff" check --quiet --config $settings bindings/python examples
  "$venv/bin/mypy" --strict --config-file $settings bindings/python/baum examples/*.py \
    tests/python/hints.py
  "$venv/bin/pyright" --project $settings --pythonpath "$venv/bin/python"
}

# Makes the reference manual in build/doxygen. Fails if a public function, parameter or field has no documentation.
stage_docs() {
  mkdir -p build
  doxygen docs/Doxyfile
}

stage_build() {
  build_dev
  build_clang
}

build_dev() {
  need_venv
  build dev dev -DBAUM_WERROR=ON
}

build_clang() {
  need_venv
  build dev clang -DBAUM_WERROR=ON -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Debug
}

# run_tests FOLDER [CTEST ARGUMENT...] runs the tests of the build in build/FOLDER.
run_tests() {
  tested=build/$1
  shift
  ctest --test-dir "$tested" -j "$jobs" --output-on-failure --no-tests=error "$@"
}

stage_test() {
  build_dev
  run_tests dev
}

stage_asan() {
  need_venv
  build asan asan -DBAUM_WERROR=ON
  ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=1 \
    UBSAN_OPTIONS=print_stacktrace=1 run_tests asan -LE 'layout|sweep|grid'
}

stage_minimal() {
  need_venv
  build minimal minimal -DBAUM_WERROR=ON
  run_tests minimal -LE sweep
}

# Installs the library as a user does, and then moves it, because nothing may depend on the original folder.
install_release() {
  need_venv
  build release release -DBAUM_WERROR=ON -DBAUM_TESTS=OFF
  rm -rf "$prefix" "$prefix-before"
  quietly cmake --install build/release --prefix "$prefix-before"
  mv "$prefix-before" "$prefix"
}

stage_install() {
  install_release
  sh tests/install/check.sh "$prefix" "$PWD"
}

stage_python() {
  if [ ! -d bindings/python ]; then
    echo "skipped: there is no bindings/python yet"
    return
  fi
  need_venv
  [ -d "$prefix" ] || install_release
  quietly "$venv/bin/python" -m pip install --force-reinstall --no-deps --config-settings=wheel.cmake=false \
    ./bindings/python
  library=$(find "$prefix" -name libbaum.so)
  python=$PWD/$venv/bin/python
  tests=$PWD/tests/python
  (cd build && BAUM_LIBRARY=$library "$python" -W error::ResourceWarning -m unittest discover -s "$tests")
}

stage_tidy() {
  need_venv
  build_clang
  echo "clang-tidy"
  find src -name '*.c' | sort |
    xargs -P "$jobs" -n 1 clang-tidy -p build/clang --quiet 2>build/tidy.log || {
    grep -v 'warnings\{0,1\} generated' build/tidy.log || true
    return 1
  }
}

stage_coverage() {
  need_venv
  build coverage coverage
  find build/coverage -name '*.gcda' -delete
  run_tests coverage -LE 'layout|python|sweep'
  all=build/coverage/lines
  gcovr --root . --filter src/ --object-directory build/coverage --json "$all.json" --txt "$all.txt" \
    --print-summary --fail-under-line "${BAUM_COVERAGE:-95}"
  gcovr --root . --filter 'src/(base|linear|mechanism|dynamics|stabilization)/' --add-tracefile "$all.json" \
    --txt build/coverage/below.txt --fail-under-line 100 || {
    grep -v ' 100% *$' build/coverage/below.txt
    return 1
  }
  "$venv/bin/python" tests/layout/check_messages.py --untriggered "$all.json" .
}

# Runs the sweeps and grids, which stage asan omits, with the same sanitizers.
stage_sweeps() {
  need_venv
  build asan asan -DBAUM_WERROR=ON
  run_tests asan -L 'sweep|grid'
}

# Only definite leaks are errors. The replays of the fuzzers keep only pointers to the inside of their mechanisms, and
# valgrind calls such mechanisms "possibly lost".
stage_valgrind() {
  need_venv
  checks="--quiet;--trace-children=yes;--error-exitcode=99;--leak-check=full;--errors-for-leak-kinds=definite"
  build dev valgrind -DBAUM_WIDE=OFF "-DCMAKE_CROSSCOMPILING_EMULATOR=valgrind;$checks"
  run_tests valgrind -LE 'layout|python|sweep|grid'
}

stage_thread() {
  need_venv
  build dev thread -DBAUM_SANITIZE=thread
  run_tests thread -R thread
}

# Checks the pages of studies, motions and live views, and the shapes of elements. The checks need headless Chromium,
# which is a large package.
stage_browser() {
  need_packages chromium
  build_dev
  BAUM_LIBRARY=$PWD/build/dev/libbaum.so PYTHONPATH=$PWD/bindings/python PYTHONDONTWRITEBYTECODE=1 \
    "$venv/bin/python" tests/browser/check_page.py build/browser
  BAUM_LIBRARY=$PWD/build/dev/libbaum.so PYTHONPATH=$PWD/bindings/python PYTHONDONTWRITEBYTECODE=1 \
    "$venv/bin/python" tests/browser/check_motion.py build/browser
  BAUM_LIBRARY=$PWD/build/dev/libbaum.so PYTHONPATH=$PWD/bindings/python PYTHONDONTWRITEBYTECODE=1 \
    "$venv/bin/python" tests/browser/check_live.py build/browser
  BAUM_LIBRARY=$PWD/build/dev/libbaum.so PYTHONPATH=$PWD/bindings/python PYTHONDONTWRITEBYTECODE=1 \
    "$venv/bin/python" tests/browser/check_shapes.py build/browser
}

# Builds the documentation site, and runs the programs of the cookbook and of docs/scenes.md, including those that need SciPy,
# Numba, SALib or Optuna.
stage_site() {
  build_dev
  BAUM_LIBRARY=$PWD/build/dev/libbaum.so sh docs/build.sh
  quietly build/site-venv/bin/python -m pip install --quiet numba==0.68.1 SALib==1.6.0 optuna==5.0.0
  for programs in test_cookbook.py test_recipes.py; do
    BAUM_LIBRARY=$PWD/build/dev/libbaum.so PYTHONPATH=$PWD/bindings/python PYTHONDONTWRITEBYTECODE=1 \
      build/site-venv/bin/python -m unittest discover -s tests/python -p "$programs"
  done
  need_packages chromium
  build/site-venv/bin/python tests/browser/check_site.py build/site
}

# Checks the links to other sites in the pages of the documentation site, in the headers and in the
# docstrings. This is the only check of the documents that needs a network. Without a network, the
# stage returns the exit code 77.
stage_links() {
  getent hosts www.sphinx-doc.org >/dev/null || { echo "skipped: there is no network"; return 77; }
  build_dev
  export BAUM_LIBRARY="$PWD/build/dev/libbaum.so" PYTHONPATH="$PWD/bindings/python" PYTHONDONTWRITEBYTECODE=1
  sh docs/build.sh
  build/site-venv/bin/python -m sphinx -b linkcheck -c docs/site -d build/site-doctrees --quiet \
    build/site-source build/site-links
}

# If an input makes a fuzzer fail, the input is kept in build/fuzz as crash-*. Then correct the
# error, and add the input to tests/fuzz/corpus.
stage_fuzz() {
  need_venv
  need_packages libclang-rt-14-dev
  quietly cmake --preset asan -B build/fuzz -DBAUM_FUZZ=ON -DCMAKE_C_COMPILER=clang -DBAUM_EXAMPLES=OFF \
    "-DPython3_EXECUTABLE=$PWD/$venv/bin/python"
  quietly cmake --build build/fuzz --target fuzzers
  for program in build/fuzz/tests/fuzz/fuzz_*; do
    target=${program##*/fuzz_}
    mkdir -p "build/fuzz/corpus/$target"
    echo "$target, $fuzz_seconds s"
    ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=512 UBSAN_OPTIONS=print_stacktrace=1 \
      quietly "$program" "-max_total_time=$fuzz_seconds" -max_len=600 -timeout=20 -rss_limit_mb=4000 \
      -malloc_limit_mb=100000 -artifact_prefix=build/fuzz/ "build/fuzz/corpus/$target" \
      "tests/fuzz/corpus/$target"
    tail -n 1 build/last.log
  done
}

stage_random() {
  need_venv
  build release random -DBAUM_TESTS=ON
  build/random/tests/bench_random 10000
  build/random/tests/bench_random_spatial 10000
  build/random/tests/test_scene 5000
  build/random/tests/bench_reactions 1000
  build/random/tests/bench_doubts -n 2000 -f 10000 -j 2
  build/random/tests/bench_doubts -n 2000 -f 10000 -j 2 -e
  build/random/tests/bench_sweeps all
}

# fresh_run RELEASE COMMAND... runs the commands on a bare Debian RELEASE, in a clone of the
# project.
fresh_run() {
  need_packages debootstrap git
  rm -rf build/fresh-clone
  git clone --quiet . build/fresh-clone
  [ ! -d build/packages ] || mv build/packages build/fresh-clone
  release=$1
  shift
  as_root sh tests/install/fresh.sh "$release" "$PWD/build/fresh-$release" "$PWD/build/fresh-clone" "$@"
}

# Runs examples/run.sh and tests/run.sh on a bare Debian 12. This stage is meant for releases and large changes.
stage_fresh() {
  fresh_run bookworm "sh examples/run.sh" "sh tests/run.sh ${BAUM_FRESH:-}"
}

# On a bare Debian 13, which has SUNDIALS 7, runs the stages that depend on the compiler or on
# SUNDIALS. Also builds and installs the Debian packages of baum there.
stage_trixie() {
  fresh_run trixie "sh tests/run.sh build test minimal install python debs" \
    "sh tests/install/packages.sh build/debian"
}

# Builds the Debian packages in build/debian.
stage_debs() {
  need_packages lintian dpkg-dev
  quietly cmake --preset debian
  quietly cmake --build build/debian
  rm -f build/debian/*.deb
  quietly cpack --config build/debian/CPackConfig.cmake -B build/debian
  lintian --allow-root --fail-on error build/debian/*.deb
}

# Installs the Debian packages on a bare Debian 12, uses them, and removes them.
stage_packages() {
  stage_debs
  rm -rf build/packages
  mkdir build/packages
  cp build/debian/*.deb build/packages
  fresh_run bookworm "sh tests/install/packages.sh packages"
}

# Runs the commands for installing in README.md and docs/install.md exactly as printed, on a bare Debian 12 and 13.
stage_readme() {
  fresh_run bookworm "sh tests/install/readme.sh"
  fresh_run trixie "sh tests/install/readme.sh"
}

# Builds the Python packages for all systems, and runs those that can be run on Linux.
stage_wheels() {
  need_packages debootstrap qemu-user-static wine64 nodejs binutils python3-venv
  as_root sh tests/install/wheels.sh "$PWD"
}

# The analyzer of gcc 12 calls arrays that vectorized loops have filled uninitialized. Stage valgrind finds such errors.
stage_analyzer() {
  need_venv
  build release analyzer -DBAUM_WERROR=ON -DBAUM_TESTS=OFF \
    "-DCMAKE_C_FLAGS=-fanalyzer -Wno-analyzer-use-of-uninitialized-value"
}

if [ "$*" = --list ]; then
  echo "$usual $named"
  exit 0
fi
for stage in "$@"; do
  case " $usual $named " in
    *" $stage "*) ;;
    *) echo "there is no stage $stage; the stages are: $usual $named" >&2; exit 2 ;;
  esac
done
[ $# -gt 0 ] || set -- $usual

# shellcheck disable=SC2086
need_packages $build_packages g++ clang clang-format clang-tidy gcovr valgrind doxygen

summary=
for stage in "$@"; do
  heading "$stage"
  begun=$(date +%s)
  set +e
  (set -e; "stage_$stage")
  code=$?
  set -e
  seconds=$(($(date +%s) - begun))
  verdict=ok
  case $code in 0) ;; 77) verdict=skipped code=0 ;; *) verdict=FAILED ;; esac
  echo "---- $stage: $verdict, $seconds s"
  summary="$summary$(printf '%-10s %-7s %5d s' "$stage" "$verdict" "$seconds")
"
  [ "$code" -eq 0 ] || break
done

heading "summary"
printf '%s' "$summary"
exit "$code"
