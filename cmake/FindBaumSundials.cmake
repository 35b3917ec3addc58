# SPDX-License-Identifier: BSD-3-Clause
# The parts of SUNDIALS that baum uses, in releases 6.4 to 7. Sets BaumSundials_FOUND and
# BAUM_SUNDIALS_TARGETS. Installed beside baum-config.cmake, which uses it too.
find_package(SUNDIALS QUIET CONFIG)

set(BAUM_SUNDIALS_TARGETS "")
set(BAUM_SUNDIALS_MISSING "")
if(SUNDIALS_FOUND AND SUNDIALS_VERSION VERSION_GREATER_EQUAL 6.4 AND SUNDIALS_VERSION VERSION_LESS 8)
  if(SUNDIALS_VERSION VERSION_LESS 7)
    set(common generic)
  else()
    set(common core)
  endif()
  foreach(part cvode ida nvecserial sunmatrixsparse sunmatrixdense sunlinsolklu sunlinsoldense
               sunnonlinsolfixedpoint sunnonlinsolnewton ${common})
    if(TARGET SUNDIALS::${part})
      list(APPEND BAUM_SUNDIALS_TARGETS SUNDIALS::${part})
    else()
      list(APPEND BAUM_SUNDIALS_MISSING ${part})
    endif()
  endforeach()
endif()

include(FindPackageHandleStandardArgs)
if(BAUM_SUNDIALS_MISSING)
  set(BAUM_SUNDIALS_TARGETS "")
endif()
find_package_handle_standard_args(
  BaumSundials
  REQUIRED_VARS BAUM_SUNDIALS_TARGETS
  VERSION_VAR SUNDIALS_VERSION)
