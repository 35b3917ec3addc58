#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: check_symbols.sh SHARED STATIC HEADERS
# Checks the symbols of the libraries. They must have our prefix, and exported symbols must be
# declared in a public header. The libraries must not call functions that print, open files or end
# the process. Only base/alloc may allocate memory. Threads must not share data that can change.
set -eu
shared=$1
static=$2
headers=$3
failures=0

# complain WHY NAMES prints the names, unless there are none.
complain() {
  [ -z "$2" ] && return
  printf '%s:\n%s\n' "$1" "$2"
  failures=$((failures + 1))
}

exported=$(nm -D --defined-only "$shared" | awk '{ print $NF }')
global=$(nm -g --defined-only "$static" | awk 'NF >= 3 { print $NF }')
# Each line contains the name of an object file, and a symbol that this file uses but does not
# define.
called=$(nm -g --undefined-only "$static" | awk '
  /:$/ { object = $1; sub(/:$/, "", object); next }
  NF == 2 { print object, $2 }')
# These symbols are added by compilers for coverage and for sanitizers.
added='^(__asan|__ubsan|__tsan|__gcov|__llvm|_GLOBAL_)'

[ -n "$exported" ] && [ -n "$global" ] || { echo "nm read nothing"; exit 1; }

complain "exported without the prefix baum_" \
  "$(echo "$exported" | grep -Ev "^baum_|$added" || true)"
complain "exported although private" "$(echo "$exported" | grep '^baum_i_' || true)"
complain "exported but in no public header" "$(for name in $exported; do
  grep -qw -- "$name" "$headers"/*.h || echo "$name"
done)"
complain "in the static library without the prefix baum_" \
  "$(echo "$global" | grep -Ev "^baum_|$added" || true)"

quiet=' (printf|__printf_chk|fprintf|__fprintf_chk|vprintf|vfprintf|puts|putchar|fputs|fputc|fwrite|perror|fopen|freopen|open|system|exit|_exit|_Exit|quick_exit|abort|signal|sigaction)$'
# The library may open only three kinds of files: study files, reports, and the file that contains
# the processor's name.
complain "prints, opens a file, or ends the process" "$(echo "$called" | grep -E "$quiet" |
  grep -Ev '^(study_file|file)\.c\.o (fputs|fwrite)$|^platform\.c\.o f?open$|^report_environment\.c\.o fopen$' || true)"
complain "allocates outside base/alloc" "$(echo "$called" |
  grep -E ' (malloc|calloc|realloc|free|aligned_alloc|posix_memalign|strdup|strndup)$' |
  grep -v '^alloc\.c\.o ' || true)"
complain "has variables that all threads share" "$(size -A "$static" | awk '
  / \(ex / { object = $1 }
  /^\.(data|bss) / && $2 > 0 { print object, $1, $2 " bytes" }')"

echo "$(echo "$exported" | wc -l) exported, $(echo "$global" | wc -l) global, $failures complaints"
[ "$failures" -eq 0 ]
