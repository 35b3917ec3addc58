# SPDX-License-Identifier: BSD-3-Clause
# Finds KLU of SuiteSparse, and COLAMD, which KLU needs, and makes the target SuiteSparse::KLU. Both
# libraries are found by their names, because releases before 7 have no CMake files. This file is
# installed in the same folder as baum-config.cmake, which uses it as well.
include(FindPackageHandleStandardArgs)

find_path(SuiteSparse_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse)
mark_as_advanced(SuiteSparse_INCLUDE_DIR)
set(SuiteSparse_LIBRARIES "")
foreach(name klu btf amd colamd suitesparseconfig)
  find_library(SuiteSparse_${name}_LIBRARY ${name})
  mark_as_advanced(SuiteSparse_${name}_LIBRARY)
  list(APPEND SuiteSparse_LIBRARIES ${SuiteSparse_${name}_LIBRARY})
endforeach()

find_package_handle_standard_args(
  SuiteSparse
  REQUIRED_VARS
    SuiteSparse_INCLUDE_DIR
    SuiteSparse_klu_LIBRARY
    SuiteSparse_btf_LIBRARY
    SuiteSparse_amd_LIBRARY
    SuiteSparse_colamd_LIBRARY
    SuiteSparse_suitesparseconfig_LIBRARY)
if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::KLU)
  add_library(SuiteSparse::KLU INTERFACE IMPORTED)
  target_include_directories(SuiteSparse::KLU INTERFACE ${SuiteSparse_INCLUDE_DIR})
  target_link_libraries(SuiteSparse::KLU INTERFACE ${SuiteSparse_LIBRARIES})
endif()
