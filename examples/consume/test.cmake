# SPDX-License-Identifier: Apache-2.0
# The test of this folder: installs the build tree BUILD into a prefix of its own below WORK, then
# configures, builds and runs the project in SOURCE against what was installed, and nothing else. A
# second project links the extras too, with a program that includes every header there is.

file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")

function(build_and_run source build)
    execute_process(COMMAND_ERROR_IS_FATAL ANY
        COMMAND "${CMAKE_COMMAND}" -S "${source}" -B "${build}" -G "${GENERATOR}"
            "-DCMAKE_BUILD_TYPE=${CONFIG}"
            "-DCMAKE_CXX_COMPILER=${COMPILER}"
            "-DCMAKE_CXX_FLAGS=${FLAGS}"
            "-DCMAKE_PREFIX_PATH=${prefix};${PREFIX_PATH}"
            "-DCMAKE_MODULE_PATH=${MODULE_PATH}"
            "-DOpenVDB_ROOT=${OpenVDB_ROOT}"
            -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
    execute_process(COMMAND_ERROR_IS_FATAL ANY
        COMMAND "${CMAKE_COMMAND}" --build "${build}" --config "${CONFIG}")
    find_program(program consume REQUIRED NO_CACHE
        PATHS "${build}" "${build}/${CONFIG}" NO_DEFAULT_PATH)
    execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND "${program}" WORKING_DIRECTORY "${build}")
endfunction()

execute_process(COMMAND_ERROR_IS_FATAL ANY
    COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --config "${CONFIG}" --prefix "${prefix}")
build_and_run("${SOURCE}" "${WORK}/build")

file(GLOB_RECURSE headers RELATIVE "${prefix}/include" "${prefix}/include/openvdb_spheretree/*.h")
if(NOT headers)
    message(FATAL_ERROR "no headers were installed in ${prefix}/include")
endif()
list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>\n")
list(JOIN headers "" includes)
file(COPY "${SOURCE}/CMakeLists.txt" DESTINATION "${WORK}/headers")
file(APPEND "${WORK}/headers/CMakeLists.txt"
    "find_package(openvdb_spheretree 0.2 REQUIRED COMPONENTS extras)\n"
    "target_link_libraries(consume PRIVATE openvdb_spheretree::openvdb_spheretree_extras)\n")
file(WRITE "${WORK}/headers/main.cc" "${includes}#include <fstream>
int main()
{
    openvdb::initialize();
    std::ofstream(\"corner.off\") << \"OFF 4 4 0\\n0 0 0\\n1 0 0\\n0 1 0\\n0 0 1\\n\"
                                   \"3 0 2 1\\n3 0 1 3\\n3 1 2 3\\n3 0 3 2\\n\";
    return openvdb_spheretree::readMeshFile(\"corner.off\").triangles.size() == 4 ? 0 : 1;
}
")
build_and_run("${WORK}/headers" "${WORK}/headers/build")
