# SPDX-License-Identifier: BSD-3-Clause
# Installs the headers, the shared and the static libraries, the CMake package and the .pc files.
# None of them contains an absolute path.
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/baum)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
# Debian packages contain the license in their copyright files, so they omit this component.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)
install(DIRECTORY include/baum DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
# There are two sets of targets, because only a program that uses the static libraries needs the
# backends.
foreach(library baum baum_static)
  string(REPLACE baum baum_catalog catalog ${library})
  install(
    TARGETS ${library} ${catalog}
    EXPORT ${library}-targets
    LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
  install(
    EXPORT ${library}-targets
    NAMESPACE baum::
    DESTINATION ${config_dir})
endforeach()

if(TARGET baum_fmu)
  set(folder ${CMAKE_INSTALL_LIBDIR}/baum)
  install(TARGETS baum_fmu COMPONENT runtime LIBRARY DESTINATION ${folder} RUNTIME DESTINATION ${folder}
          ARCHIVE EXCLUDE_FROM_ALL DESTINATION ${folder})
endif()

configure_package_config_file(cmake/baum-config.cmake.in baum-config.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(baum-config-version.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES ${PROJECT_BINARY_DIR}/baum-config.cmake ${PROJECT_BINARY_DIR}/baum-config-version.cmake
        cmake/FindSuiteSparse.cmake cmake/FindBaumSundials.cmake
  DESTINATION ${config_dir})

# The file baum.pc names the libraries that baum links. It contains no paths of these libraries.
set(BAUM_PC_PRIVATE "")
foreach(target IN LISTS BAUM_SUNDIALS_TARGETS)
  string(REPLACE "SUNDIALS::" " -lsundials_" flag ${target})
  string(APPEND BAUM_PC_PRIVATE ${flag})
endforeach()
if(TARGET MPI::MPI_C) # SUNDIALS 7 of Debian is compiled with MPI
  string(APPEND BAUM_PC_PRIVATE " -lmpi")
endif()
string(APPEND BAUM_PC_PRIVATE " -lklu -lbtf -lamd -lcolamd -lsuitesparseconfig")
# The static library suitesparseconfig may need OpenMP.
execute_process(COMMAND ${CMAKE_C_COMPILER} -print-file-name=libgomp.so OUTPUT_VARIABLE path
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(IS_ABSOLUTE "${path}")
  string(APPEND BAUM_PC_PRIVATE " -lgomp")
endif()
string(APPEND BAUM_PC_PRIVATE " -pthread -lm")
file(RELATIVE_PATH BAUM_PC_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
string(REGEX REPLACE "/$" "" BAUM_PC_PREFIX "${BAUM_PC_PREFIX}")
foreach(package baum baum_catalog)
  configure_file(cmake/${package}.pc.in ${package}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${package}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
