# SPDX-License-Identifier: BSD-3-Clause
# Finds the packages that baum needs. If one is missing, stops with a message that names it. Sets
#   BAUM_BACKENDS      what the library links
#   BAUM_CAPABILITIES  compile definitions that tell the sources which packages were found

function(baum_refuse what package option)
  set(way_out "")
  if(option)
    set(way_out " or configure with -D ${option}=OFF")
  endif()
  message(FATAL_ERROR "${what} was not found: install the Debian package ${package}${way_out}.")
endfunction()

set(BAUM_BACKENDS "")
set(BAUM_CAPABILITIES "BAUM_HAVE_SUNDIALS=0")

if(BAUM_BUNDLED)
  include(Bundled)
else()
  find_package(SuiteSparse QUIET)
  if(NOT SuiteSparse_FOUND)
    baum_refuse("SuiteSparse with KLU" libsuitesparse-dev "")
  endif()
  list(APPEND BAUM_BACKENDS SuiteSparse::KLU)
endif()

if(BAUM_SUNDIALS AND NOT BAUM_BUNDLED)
  find_package(BaumSundials QUIET)
  if(NOT BaumSundials_FOUND)
    baum_refuse("SUNDIALS 6.4 to 7 with KLU" libsundials-dev BAUM_SUNDIALS)
  endif()
  list(PREPEND BAUM_BACKENDS ${BAUM_SUNDIALS_TARGETS})
endif()
if(BAUM_SUNDIALS)
  set(BAUM_CAPABILITIES "BAUM_HAVE_SUNDIALS=1")
endif()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
list(APPEND BAUM_BACKENDS Threads::Threads m)

if(BAUM_TESTS)
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(CMOCKA QUIET IMPORTED_TARGET cmocka)
  endif()
  if(NOT TARGET PkgConfig::CMOCKA)
    baum_refuse("CMocka (through pkg-config)" "libcmocka-dev (and pkg-config)" BAUM_TESTS)
  endif()
  find_package(GSL QUIET) # used by tests only, which compare results with it
  if(NOT GSL_FOUND)
    baum_refuse("GSL" libgsl-dev BAUM_TESTS)
  endif()
endif()
