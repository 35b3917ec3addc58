# SPDX-License-Identifier: BSD-3-Clause
# SuiteSparse's KLU and SPQR as SuiteSparse::KLU and SuiteSparse::SPQR, found by name because
# releases before 7 bring no CMake files. Installed beside baum-config.cmake, which uses it too.
include(FindPackageHandleStandardArgs)

function(baum_find_suitesparse part header)
  find_path(SuiteSparse_${part}_INCLUDE_DIR ${header} PATH_SUFFIXES suitesparse)
  set(paths "")
  foreach(name IN LISTS ARGN)
    find_library(SuiteSparse_${name}_LIBRARY ${name})
    mark_as_advanced(SuiteSparse_${name}_LIBRARY)
    list(APPEND paths ${SuiteSparse_${name}_LIBRARY})
  endforeach()
  mark_as_advanced(SuiteSparse_${part}_INCLUDE_DIR)
  if(NOT SuiteSparse_${part}_INCLUDE_DIR OR "${paths}" MATCHES "NOTFOUND")
    return()
  endif()
  set(SuiteSparse_${part}_FOUND TRUE PARENT_SCOPE)
  if(NOT TARGET SuiteSparse::${part})
    add_library(SuiteSparse::${part} INTERFACE IMPORTED)
    target_include_directories(SuiteSparse::${part} INTERFACE ${SuiteSparse_${part}_INCLUDE_DIR})
    target_link_libraries(SuiteSparse::${part} INTERFACE ${paths})
  endif()
endfunction()

baum_find_suitesparse(KLU klu.h klu btf amd colamd suitesparseconfig)
baum_find_suitesparse(SPQR SuiteSparseQR_C.h spqr cholmod suitesparseconfig)

find_package_handle_standard_args(
  SuiteSparse
  REQUIRED_VARS SuiteSparse_KLU_INCLUDE_DIR SuiteSparse_klu_LIBRARY
  HANDLE_COMPONENTS)
