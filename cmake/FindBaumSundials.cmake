# SPDX-License-Identifier: BSD-3-Clause
# The parts of SUNDIALS that baum uses, in releases 6.4 to 7, after SuiteSparse was found. Sets
# BaumSundials_FOUND and BAUM_SUNDIALS_TARGETS. Installed beside baum-config.cmake, which uses it too.
#
# SUNDIALS_FOUND is not asked: it is false where one of its parallel parts lacks OpenMP, as with
# clang on Debian, although everything that baum links is there.
find_package(SUNDIALS QUIET CONFIG)

set(BAUM_SUNDIALS_TARGETS "")
if(SUNDIALS_VERSION VERSION_GREATER_EQUAL 6.4 AND SUNDIALS_VERSION VERSION_LESS 8)
  set(_common core)
  if(SUNDIALS_VERSION VERSION_LESS 7)
    set(_common generic)
  endif()
  foreach(_part cvode ida nvecserial sunmatrixsparse sunmatrixdense sunlinsolklu sunlinsoldense
                sunnonlinsolfixedpoint sunnonlinsolnewton ${_common})
    list(APPEND BAUM_SUNDIALS_TARGETS SUNDIALS::${_part})
    if(NOT TARGET SUNDIALS::${_part})
      set(BaumSundials_NOT_FOUND_MESSAGE "SUNDIALS has no ${_part}")
    endif()
  endforeach()
  if(BaumSundials_NOT_FOUND_MESSAGE)
    set(BAUM_SUNDIALS_TARGETS "")
  elseif(NOT TARGET SUNDIALS::KLU)
    add_library(SUNDIALS::KLU INTERFACE IMPORTED)
    target_link_libraries(SUNDIALS::KLU INTERFACE SuiteSparse::KLU)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  BaumSundials
  REQUIRED_VARS BAUM_SUNDIALS_TARGETS
  VERSION_VAR SUNDIALS_VERSION)
