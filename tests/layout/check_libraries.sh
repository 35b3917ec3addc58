#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_libraries.sh SHARED STATIC
# Checks what the shared library loads. This may only be SUNDIALS, KLU, COLAMD, the C library, and
# MPI where SUNDIALS uses it (Debian 13). Neither the shared nor the static library may call BLAS,
# LAPACK, Fortran, or anything under the GPL.
set -eu
shared=$1
static=$2

loaded=$(readelf -d "$shared" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
[ -n "$loaded" ] || { echo "readelf read nothing"; exit 1; }
foreign=$(echo "$loaded" |
  grep -Ev '^(libsundials_[a-z]+|lib(klu|btf|amd|colamd|suitesparseconfig)|libmpi|libc|libm|libpthread|libgcc_s|ld-linux.*)\.so' ||
  true)
called=$( (nm -D --undefined-only "$shared"; nm -g --undefined-only "$static") | awk 'NF == 2 { print $2 }' |
  sort -u)
gpl=$(echo "$called" |
  grep -E '^(SuiteSparseQR|spqr|cholmod|gsl|cblas|LAPACKE|_gfortran|METIS)_|^[sdcz][a-z0-9]+_$' || true)
[ -z "$foreign$gpl" ] && echo "loads $(echo "$loaded" | tr "\n" " ")" && exit 0
printf '%s\n' "$foreign" "$gpl"
exit 1
