# SPDX-License-Identifier: BSD-3-Clause
# Finds the parts of SUNDIALS that baum uses, in releases 6.4 to 7. SuiteSparse must have been found
# before. Sets BaumSundials_FOUND and BAUM_SUNDIALS_TARGETS. This file is installed in the same
# folder as baum-config.cmake, which uses it as well.
#
# SUNDIALS_FOUND is not used. It is false if one of the parallel parts of SUNDIALS lacks OpenMP, as
# with clang on Debian, although everything that baum needs is there.
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
