#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: sh examples/run.sh [NAME...]
#
# Installs missing packages, builds the release library and runs the named examples, by default all.
# For each example it writes files into out/: the text that the example prints (.txt), its tables
# (.json, and .dat for gnuplot), figures of these tables (.png), drawings (.svg), and pages that show
# studies or moving mechanisms (.html).
set -eu
cd "$(dirname "$0")/.."
. tests/setup.sh

names=${*:-pendulum slider_crank stability_region formulations tradeoff control_loop predictive_control events kinematics wire gyroscope rssr spatial_slider_crank rolling_disc stewart animation eight_gains jansen_leg peaucellier hookes_joint trebuchet suspension planetary_gear cart_pole mistakes}
out=$PWD/out

# shellcheck disable=SC2086
need_packages $build_packages gnuplot-nox
need_venv
heading "library and examples"
build release release -DBAUM_TESTS=OFF
mkdir -p "$out"

summary=
failures=0

# run TITLE COMMAND...: run one example, save and show what it prints, and record whether it failed.
run() {
  title=$1
  shift
  heading "$title"
  begun=$(date +%s)
  verdict=ok
  "$@" >"$out/$title.txt" 2>&1 || verdict=FAILED
  cat "$out/$title.txt"
  [ "$verdict" = ok ] || failures=$((failures + 1))
  summary="$summary$(printf '%-28s %-6s %5d s' "$title" "$verdict" "$(($(date +%s) - begun))")
"
}

for name in $names; do
  [ -e "examples/$name.c" ] || continue
  set -- --json "$out/$name.json" --data "$out/$name.dat"
  ! grep -q 'example\.page' "examples/$name.c" || set -- "$@" --page "$out/$name.html"
  run "$name" "build/release/examples/$name" "$@"
done

for program in examples/*.py; do
  [ -e "$program" ] && [ -d bindings/python ] || continue
  name=$(basename "$program" .py)
  case " $names " in *" $name "*) ;; *) continue ;; esac
  set -- --json "$out/${name}_py.json"
  ! grep -q 'options\.page' "$program" || set -- "$@" --page "$out/${name}_py.html"
  ! grep -q 'options\.folder' "$program" || set -- "$@" --folder "$out"
  run "${name}_py" env BAUM_LIBRARY="$PWD/build/release/libbaum.so" \
    PYTHONPATH="$PWD/bindings/python" PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=agg \
    "$venv/bin/python" "$program" "$@"
done

# Scripts draw figures in out/ from the tables there.
for script in examples/*.gp; do
  [ -e "$script" ] || continue
  name=$(basename "$script" .gp)
  case " $names " in *" $name "*) ;; *) continue ;; esac
  script=$PWD/$script
  run "${name}_figure" env --chdir="$out" gnuplot "$script"
done

heading "summary"
printf '%s' "$summary"
echo "tables and figures are in out/:"
(cd "$out" && ls -1 | sed 's/^/  /')
[ "$failures" -eq 0 ]
