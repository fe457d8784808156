# SPDX-License-Identifier: Apache-2.0
# What the library is built on. Whatever is missing is reported at once, with the Debian packages.

spheretree_find_openvdb()
find_package(ZLIB QUIET)
find_package(PNG QUIET)
find_package(hwy CONFIG QUIET)

set(missing "")
foreach(dependency IN ITEMS
        "OpenVDB::openvdb|OpenVDB|libopenvdb-dev libboost-iostreams-dev libblosc-dev"
        "TBB::tbb|oneTBB|libtbb-dev"
        "Blosc::blosc|Blosc|libblosc-dev"
        "ZLIB::ZLIB|zlib|zlib1g-dev"
        "PNG::PNG|libpng|libpng-dev"
        "hwy::hwy|Highway|libhwy-dev")
    string(REPLACE "|" ";" dependency "${dependency}")
    list(GET dependency 0 target)
    list(GET dependency 1 name)
    list(GET dependency 2 packages)
    if(NOT TARGET ${target})
        string(APPEND missing "  ${name}: apt-get install ${packages}\n")
    endif()
endforeach()
if(missing)
    message(FATAL_ERROR "Not found:\n${missing}"
        "On Debian or Ubuntu install the packages named; elsewhere set CMAKE_PREFIX_PATH to where "
        "they are, and CMAKE_MODULE_PATH to the folder of FindOpenVDB.cmake.")
endif()
message(STATUS "OpenVDB ${OpenVDB_VERSION}, Highway ${hwy_VERSION}")

# Sets SPHERETREE_HAS_NAME: whether the library is wanted (SPHERETREE_WITH_NAME) and there. The library
# itself is taken, not the target of its package: Debian's of assimp names libraries that only assimp's
# own build needs, and finding them would then be up to everybody who links this library. Of headers alone
# there is no LIBRARY. A fourth argument is a folder that the header may be in.
macro(spheretree_find_optional name header)
    set(SPHERETREE_HAS_${name} OFF)
    if(SPHERETREE_WITH_${name})
        find_path(${name}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARGV3})
        mark_as_advanced(${name}_INCLUDE_DIR)
        if(${ARGC} GREATER 2)
            find_library(${name}_LIBRARY ${ARGV2})
            mark_as_advanced(${name}_LIBRARY)
        endif()
        if(${name}_INCLUDE_DIR AND (${ARGC} EQUAL 2 OR ${name}_LIBRARY))
            set(SPHERETREE_HAS_${name} ON)
        endif()
    endif()
endmacro()

# Sums of stored trees: the same numbers as zlib's, three times as fast.
spheretree_find_optional(LIBDEFLATE libdeflate.h deflate)
if(SPHERETREE_HAS_LIBDEFLATE)
    message(STATUS "Checksums by libdeflate (${LIBDEFLATE_LIBRARY})")
elseif(SPHERETREE_WITH_LIBDEFLATE)
    message(STATUS "Checksums by zlib; libdeflate, which is faster, was not found (Debian: apt-get install libdeflate-dev)")
else()
    message(STATUS "Checksums by zlib, since SPHERETREE_WITH_LIBDEFLATE is off")
endif()

spheretree_find_optional(ASSIMP assimp/Importer.hpp assimp)
spheretree_find_optional(NLOHMANN_JSON nlohmann/json.hpp)
set(meshes "Mesh files: .obj .off .ply .stl")
if(SPHERETREE_HAS_ASSIMP AND NOT SPHERETREE_HAS_NLOHMANN_JSON)
    # It tells what a glTF scene requires of its readers, which assimp does not heed.
    set(SPHERETREE_HAS_ASSIMP OFF)
    message(STATUS "${meshes}; no others, since nlohmann-json is not used or not found (Debian: apt-get install nlohmann-json3-dev)")
elseif(SPHERETREE_HAS_ASSIMP)
    message(STATUS "${meshes}, and what assimp reads (${ASSIMP_LIBRARY})")
elseif(SPHERETREE_WITH_ASSIMP)
    message(STATUS "${meshes}; no others, since assimp was not found (Debian: apt-get install libassimp-dev)")
else()
    message(STATUS "${meshes}; no others, since SPHERETREE_WITH_ASSIMP is off")
endif()

if(SPHERETREE_HAS_NLOHMANN_JSON)
    message(STATUS "Spheres of others: .csv and .json")
elseif(SPHERETREE_WITH_NLOHMANN_JSON)
    message(STATUS "Spheres of others: .csv; no .json, since nlohmann-json was not found (Debian: apt-get install nlohmann-json3-dev)")
else()
    message(STATUS "Spheres of others: .csv; no .json, since SPHERETREE_WITH_NLOHMANN_JSON is off")
endif()

spheretree_find_optional(JPEG jpeglib.h jpeg)
if(SPHERETREE_HAS_JPEG)
    message(STATUS "Pictures: .png and .jpg (${JPEG_LIBRARY})")
elseif(SPHERETREE_WITH_JPEG)
    message(STATUS "Pictures: .png; no .jpg, since libjpeg was not found (Debian: apt-get install libjpeg-dev)")
else()
    message(STATUS "Pictures: .png; no .jpg, since SPHERETREE_WITH_JPEG is off")
endif()

spheretree_find_optional(CAIRO cairo.h cairo cairo)
if(SPHERETREE_HAS_CAIRO)
    message(STATUS "Curves of errors: .svg and .png (${CAIRO_LIBRARY})")
elseif(SPHERETREE_WITH_CAIRO)
    message(STATUS "Curves of errors: .svg; no .png, since cairo was not found (Debian: apt-get install libcairo2-dev)")
else()
    message(STATUS "Curves of errors: .svg; no .png, since SPHERETREE_WITH_CAIRO is off")
endif()

spheretree_find_optional(NANOVDB nanovdb/util/OpenToNanoVDB.h)
if(SPHERETREE_HAS_NANOVDB)
    message(STATUS "Points and grids for NanoVDB: .nvdb")
elseif(SPHERETREE_WITH_NANOVDB)
    message(STATUS "No .nvdb, since NanoVDB was not found (Debian: apt-get install libnanovdb-dev)")
else()
    message(STATUS "No .nvdb, since SPHERETREE_WITH_NANOVDB is off")
endif()
