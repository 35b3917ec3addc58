# SPDX-License-Identifier: BSD-3-Clause
# Makes the Debian packages libbaum0, libbaum-dev and python3-baum.
#   cmake --preset debian && cmake --build build/debian && (cd build/debian && cpack)
# Debian's policy forbids a RUNPATH. It requires a copyright file and a changelog in each package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The baum authors <maintainers@baum.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(version "(= ${PROJECT_VERSION})")

set(runtime libbaum${BAUM_SOVERSION})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${runtime})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Every version may add functions, so programs need at least the version they were compiled with.
set(needed "${BAUM_SOVERSION} ${runtime} (>= ${PROJECT_VERSION})")
file(WRITE ${PROJECT_BINARY_DIR}/shlibs "libbaum ${needed}\nlibbaum_catalog ${needed}\n")
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/shlibs ${PROJECT_BINARY_DIR}/triggers)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "Simulates bodies tied by joints with stabilized equations of motion.
 This package contains the shared libraries.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbaum-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${runtime} ${version}, libsuitesparse-dev, libsundials-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Simulates bodies tied by joints with stabilized equations of motion.
 This package contains headers, static libraries, and files for CMake and
 pkg-config.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-baum)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
# The Python package refuses a library with another minor version.
math(EXPR next "${PROJECT_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.9), python3-numpy, ${runtime} (>= ${PROJECT_VERSION}), ${runtime} (<< ${PROJECT_VERSION_MAJOR}.${next}~)")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Simulates bodies tied by joints with stabilized equations of motion.
 This package contains the Python package.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst
                                              ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)

set(python_folder lib/python3/dist-packages)
install(
  DIRECTORY bindings/python/baum
  DESTINATION ${python_folder}
  COMPONENT python
  EXCLUDE_FROM_ALL
  PATTERN __pycache__ EXCLUDE)
file(WRITE ${PROJECT_BINARY_DIR}/METADATA
     "Metadata-Version: 2.1\nName: baum\nVersion: ${PROJECT_VERSION}\nSummary: ${PROJECT_DESCRIPTION}\n")
install(
  FILES ${PROJECT_BINARY_DIR}/METADATA
  DESTINATION ${python_folder}/baum-${PROJECT_VERSION}.dist-info
  COMPONENT python
  EXCLUDE_FROM_ALL)

# documents(COMPONENT PACKAGE) makes the files that PACKAGE installs in /usr/share/doc.
function(documents component package)
  set(folder ${PROJECT_BINARY_DIR}/documents/${package})
  file(READ LICENSE licence)
  file(WRITE ${folder}/copyright
       "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\n${licence}")
  file(WRITE ${folder}/changelog
       "${package} (${PROJECT_VERSION}) unstable; urgency=low\n\n  * Built from its source.\n\n"
       " -- The baum authors <maintainers@baum.invalid>  Thu, 01 Jan 2026 00:00:00 +0000\n")
  execute_process(COMMAND gzip -9nf ${folder}/changelog)
  install(
    FILES ${folder}/copyright ${folder}/changelog.gz
    DESTINATION share/doc/${package}
    COMPONENT ${component}
    EXCLUDE_FROM_ALL)
endfunction()
documents(runtime ${runtime})
documents(development libbaum-dev)
documents(python python3-baum)

include(CPack)
