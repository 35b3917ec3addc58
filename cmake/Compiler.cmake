# SPDX-License-Identifier: BSD-3-Clause
# The function baum_compile_options(target) sets the options of a target: C11, reproducible
# arithmetic, hidden symbols, and our warnings, as far as the compiler knows them. Sanitizers are
# applied to everything that is built here.
include(CheckCCompilerFlag)
include(CheckLinkerFlag)

set(BAUM_WARNINGS "")
foreach(
  flag
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion
  -Wstrict-prototypes -Wmissing-prototypes -Wold-style-definition -Wundef -Wvla -Wcast-qual
  -Wcast-align -Wpointer-arith -Wwrite-strings -Wformat=2 -Wimplicit-fallthrough -Wswitch-enum
  -Wnull-dereference -Wduplicated-cond -Wduplicated-branches -Wlogical-op -Wredundant-decls)
  string(MAKE_C_IDENTIFIER "BAUM_KNOWS${flag}" known)
  check_c_compiler_flag(${flag} ${known})
  if(${known})
    list(APPEND BAUM_WARNINGS ${flag})
  endif()
endforeach()
if(CMAKE_C_COMPILER_ID MATCHES Clang)
  # With this option, clang warns about NAN and INFINITY of the C standard, which are floats by
  # definition. gcc does not warn about them.
  list(REMOVE_ITEM BAUM_WARNINGS -Wdouble-promotion)
  # In this project, integer constants are enums. New releases of compilers warn when enums are used
  # with doubles.
  list(APPEND BAUM_WARNINGS -Wno-enum-float-conversion)
endif()
check_c_compiler_flag(-ffp-contract=off BAUM_KNOWS_fp_contract)
check_linker_flag(C LINKER:--as-needed BAUM_KNOWS_as_needed)

# Hot files (src/base/hot.h) are compiled so that loops are vectorized and that no time is lost by
# errno and traps. If the compiler supports wide vectors, they are compiled twice.
set(BAUM_HOT_OPTIONS "")
foreach(flag -O3 -fno-math-errno -fno-trapping-math)
  string(MAKE_C_IDENTIFIER "BAUM_KNOWS${flag}" known)
  check_c_compiler_flag(${flag} ${known})
  if(${known})
    list(APPEND BAUM_HOT_OPTIONS ${flag})
  endif()
endforeach()
if(CMAKE_BUILD_TYPE STREQUAL "Debug" OR BAUM_SANITIZE)
  list(REMOVE_ITEM BAUM_HOT_OPTIONS -O3)
endif()
set(BAUM_WIDE_OPTIONS "")
if(BAUM_WIDE AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  check_c_compiler_flag("-mavx2 -mfma -ffp-contract=fast" BAUM_KNOWS_wide)
  if(BAUM_KNOWS_wide)
    set(BAUM_WIDE_OPTIONS ${BAUM_HOT_OPTIONS} -mavx2 -mfma -ffp-contract=fast)
  endif()
endif()

check_linker_flag(C LINKER:-z,defs BAUM_KNOWS_z_defs)

# If a symbol is nowhere defined, the linker fails here, and not when a user links the library. The
# option cannot be used with sanitizers, because their symbols remain undefined in the library.
if(BAUM_KNOWS_z_defs AND NOT BAUM_SANITIZE)
  set(BAUM_NO_UNDEFINED LINKER:-z,defs)
endif()
set(BAUM_FMU_EXPORTS LINKER:--version-script=${PROJECT_SOURCE_DIR}/src/fmu/exports.map)
check_linker_flag(C ${BAUM_FMU_EXPORTS} BAUM_KNOWS_version_script)
set(BAUM_AS_NEEDED $<$<BOOL:${BAUM_KNOWS_as_needed}>:LINKER:--as-needed>)

if(BAUM_SANITIZE)
  set(sanitize -fsanitize=${BAUM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_options(${sanitize})
  add_link_options(${sanitize})
endif()

# With these options, the compiled code tells the fuzzer which branches an input takes.
if(BAUM_FUZZ)
  if(NOT CMAKE_C_COMPILER_ID MATCHES Clang)
    message(FATAL_ERROR "BAUM_FUZZ needs clang and its libFuzzer, not ${CMAKE_C_COMPILER}")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()

function(baum_compile_options target)
  set_target_properties(
    ${target}
    PROPERTIES C_STANDARD 11
               C_STANDARD_REQUIRED ON
               C_EXTENSIONS OFF
               C_VISIBILITY_PRESET hidden)
  target_compile_definitions(${target} PRIVATE _POSIX_C_SOURCE=200809L)
  target_compile_options(
    ${target} PRIVATE ${BAUM_WARNINGS} $<$<BOOL:${BAUM_WERROR}>:-Werror>
                      $<$<BOOL:${BAUM_KNOWS_fp_contract}>:-ffp-contract=off>)
endfunction()
