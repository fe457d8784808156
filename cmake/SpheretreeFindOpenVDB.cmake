# SPDX-License-Identifier: Apache-2.0
# Finds OpenVDB, and the TBB and the Blosc that it uses: the targets OpenVDB::openvdb, TBB::tbb and
# Blosc::blosc.
#
# OpenVDB installs a find module, FindOpenVDB.cmake, in a folder that CMake does not search by itself.
# We look for that folder; a folder that the user has put in CMAKE_MODULE_PATH comes first, and a
# package configuration, which some builds of OpenVDB have, is the last resort.
#
# A function, not a macro, because the module sets BUILD_SHARED_LIBS and more in the scope of whoever
# calls it. Used by this project's own build and, installed beside it, by its package configuration.

function(spheretree_find_openvdb)
    # The module reports each library it passes on its way, and damage in ones we do not use.
    set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
    find_path(OpenVDB_MODULE_DIR FindOpenVDB.cmake
        HINTS
            ${CMAKE_MODULE_PATH}
            ${OpenVDB_ROOT} $ENV{OpenVDB_ROOT} ${OPENVDB_ROOT} $ENV{OPENVDB_ROOT}
            ${CMAKE_PREFIX_PATH}
            ENV CMAKE_PREFIX_PATH
            ${CMAKE_SYSTEM_PREFIX_PATH}
        PATH_SUFFIXES
            lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB
            lib/cmake/OpenVDB
            lib64/cmake/OpenVDB
        NO_DEFAULT_PATH
        DOC "Folder of FindOpenVDB.cmake")
    mark_as_advanced(OpenVDB_MODULE_DIR)
    if(OpenVDB_MODULE_DIR)
        list(APPEND CMAKE_MODULE_PATH "${OpenVDB_MODULE_DIR}")
    endif()

    find_package(TBB QUIET COMPONENTS tbb)
    if(TARGET TBB::tbb AND NOT TARGET OpenVDB::openvdb)
        find_package(Boost QUIET COMPONENTS iostreams)
        if(NOT Boost_IOSTREAMS_FOUND)
            message(WARNING "No Boost iostreams: if the search for OpenVDB stops here, it needs it "
                "(Debian, Ubuntu: apt-get install libboost-iostreams-dev)")
        endif()
        find_package(OpenVDB QUIET COMPONENTS openvdb)
    endif()
    if(NOT TARGET Blosc::blosc) # an OpenVDB without it does not find it
        find_package(Blosc QUIET)
    endif()
    set(OpenVDB_VERSION "${OpenVDB_VERSION}" PARENT_SCOPE)
endfunction()
