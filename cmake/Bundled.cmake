# SPDX-License-Identifier: BSD-3-Clause
# Compiles the parts of SuiteSparse 5 and SUNDIALS 6 that baum uses. Their source files become part
# of the library. BAUM_BUNDLED is the folder that contains the folders SuiteSparse-* and sundials-*.
# Sets
#   BAUM_BUNDLED_OBJECTS    the object files, which become part of the library
#   BAUM_BUNDLED_LICENSES   the folder with the license texts of SuiteSparse and SUNDIALS
file(GLOB suitesparse ${BAUM_BUNDLED}/SuiteSparse-5.*)
file(GLOB sundials ${BAUM_BUNDLED}/sundials-6.*)
if(NOT suitesparse OR NOT sundials)
  message(FATAL_ERROR "BAUM_BUNDLED: ${BAUM_BUNDLED} lacks SuiteSparse-5.* or sundials-6.*")
endif()

set(bundled ${suitesparse}/SuiteSparse_config/SuiteSparse_config.c ${sundials}/src/nvector/serial/nvector_serial.c)
foreach(part AMD BTF COLAMD KLU)
  file(GLOB files ${suitesparse}/${part}/Source/*.c)
  list(APPEND bundled ${files})
endforeach()
foreach(part sunmatrix/sparse sunmatrix/dense sunmatrix/band sunlinsol/klu sunlinsol/dense sunlinsol/band
             sunnonlinsol/newton sunnonlinsol/fixedpoint)
  string(REPLACE / _ name ${part})
  list(APPEND bundled ${sundials}/src/${part}/${name}.c)
endforeach()
file(GLOB files ${sundials}/src/sundials/sundials_*.c ${sundials}/src/cvode/*.c ${sundials}/src/ida/*.c)
list(FILTER files EXCLUDE REGEX "futils|xbraid|profiler|hypamgpre")
list(APPEND bundled ${files})

# SUNDIALS uses 32-bit indices on all systems.
file(STRINGS ${sundials}/CMakeLists.txt version REGEX "^set\\(PACKAGE_VERSION_(MAJOR|MINOR|PATCH)")
string(REGEX MATCHALL "[0-9]+" version "${version}")
list(GET version 0 PACKAGE_VERSION_MAJOR)
list(GET version 1 PACKAGE_VERSION_MINOR)
list(GET version 2 PACKAGE_VERSION_PATCH)
list(JOIN version . PACKAGE_VERSION)
set(PRECISION_LEVEL "#define SUNDIALS_DOUBLE_PRECISION 1")
set(INDEX_TYPE "#define SUNDIALS_INT32_T 1")
set(SUNDIALS_CINDEX_TYPE int32_t)
set(SUNDIALS_LOGGING_LEVEL 0)
foreach(has MATH_PRECISIONS ISINF_ISNAN INLINE SNPRINTF_AND_VA_COPY)
  set(SUNDIALS_C_COMPILER_HAS_${has} ON)
endforeach()
set(made ${CMAKE_CURRENT_BINARY_DIR}/bundled)
configure_file(${sundials}/include/sundials/sundials_config.in ${made}/sundials/sundials_config.h)
file(WRITE ${made}/sundials/sundials_export.h
     "#define SUNDIALS_EXPORT\n#define SUNDIALS_DEPRECATED_EXPORT\n")

set(include ${made} ${sundials}/include ${suitesparse}/SuiteSparse_config)
foreach(part AMD BTF COLAMD KLU)
  list(APPEND include ${suitesparse}/${part}/Include)
endforeach()
include_directories(SYSTEM ${include})

add_library(baum_bundled OBJECT ${bundled})
set_target_properties(baum_bundled PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden)
target_include_directories(baum_bundled PRIVATE ${sundials}/src/sundials)
target_compile_definitions(baum_bundled PRIVATE NTIMER NPRINT)
target_compile_options(baum_bundled PRIVATE -w -ffp-contract=off)
set(BAUM_BUNDLED_OBJECTS $<TARGET_OBJECTS:baum_bundled>)

# The text of the LGPL, lesser.txt, is copied into the folder KLU.
set(BAUM_BUNDLED_LICENSES ${CMAKE_CURRENT_BINARY_DIR}/licenses)
set(BAUM_RUNTIME_LICENSES "" CACHE STRING "License texts of what the compiler adds to the libraries")
file(COPY ${BAUM_RUNTIME_LICENSES} DESTINATION ${BAUM_BUNDLED_LICENSES}/runtime)
file(COPY ${sundials}/LICENSE ${sundials}/NOTICE DESTINATION ${BAUM_BUNDLED_LICENSES}/SUNDIALS)
foreach(part AMD BTF COLAMD KLU)
  file(COPY ${suitesparse}/${part}/Doc/License.txt DESTINATION ${BAUM_BUNDLED_LICENSES}/${part})
endforeach()
file(COPY ${suitesparse}/KLU/Doc/lesser.txt DESTINATION ${BAUM_BUNDLED_LICENSES}/KLU)
