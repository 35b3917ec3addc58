# SPDX-License-Identifier: BSD-3-Clause
# Installs the shared libraries in the folder of the Python files, each under one name. Also
# installs the licenses of the software that they contain.
set_property(TARGET baum baum_catalog PROPERTY VERSION)
set_property(TARGET baum baum_catalog PROPERTY SOVERSION)
install(TARGETS baum baum_catalog baum_fmu COMPONENT package LIBRARY DESTINATION baum RUNTIME DESTINATION baum
        ARCHIVE EXCLUDE_FROM_ALL DESTINATION baum COMPONENT import_libraries)
install(FILES LICENSE COMPONENT package DESTINATION ${SKBUILD_METADATA_DIR}/licenses)
if(BAUM_BUNDLED)
  install(DIRECTORY ${BAUM_BUNDLED_LICENSES} COMPONENT package DESTINATION ${SKBUILD_METADATA_DIR})
endif()
