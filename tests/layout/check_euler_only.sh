#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_euler_only.sh PROGRAM
# Checks a static program that calls only baum_euler(). It must neither contain nor load anything of
# SUNDIALS.
set -eu
program=$1

nm "$program" | grep -q ' T baum_euler$' || { echo "baum_euler() is not linked in"; exit 1; }
symbols=$(nm "$program" |
  grep -E ' (SUN|N_V|CV(ode|Spils|Ls|Diag)|CVode|IDA|KIN|ARK|ERK|sundials|baum_(cvode|ida))' ||
  true)
libraries=$(readelf -d "$program" | grep NEEDED | grep sundials || true)
[ -z "$symbols$libraries" ] && echo "no symbol and no library of SUNDIALS" && exit 0
printf '%s\n' "$symbols" "$libraries"
exit 1
