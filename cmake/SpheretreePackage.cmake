# SPDX-License-Identifier: Apache-2.0
# Packages by CPack: once the preset release is built, cpack -G DEB in its folder.

set(CPACK_PACKAGE_NAME vdb-spheretree)
set(CPACK_PACKAGE_VENDOR "${PROJECT_NAME}")
set(CPACK_PACKAGE_CONTACT "the authors of ${PROJECT_NAME} <spheretree@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION
    "Builds sphere-trees of sparse OpenVDB volumes and meshes: bounding hierarchies of spheres for
collision, proximity, planning, discrete elements and levels of detail. The command vdb_spheretree, the C++
library, and the Python module where it was built.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR TGZ)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# What the programs link is asked of the packages here (needs dpkg-dev).
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libopenvdb-dev)
# All that cmake --install installs, and the Python module where it is built. It is for one version of Python, which
# is no dependency: the command does without.
if(TARGET _spheretree)
    set(CPACK_INSTALL_CMAKE_PROJECTS
        "${PROJECT_BINARY_DIR};${PROJECT_NAME};ALL;/;${PROJECT_BINARY_DIR};${PROJECT_NAME};debian_python;/")
    string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS
        ", python3 (>= ${SPHERETREE_PYTHON_VERSION}~), python3-numpy")
endif()
include(CPack)
