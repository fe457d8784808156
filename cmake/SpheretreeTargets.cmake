# SPDX-License-Identifier: Apache-2.0
# What all targets of this project have in common.

# Further arguments are warnings of the target's own. Of clang, whose -Wconversion is about signs too,
# as much as of gcc.
# A product and a sum are rounded one by one, also where the processor could do both at once: so trees and
# answers are the same on every instruction set. In all targets, as each has copies of inline functions.
function(spheretree_compile_options target)
    target_compile_options(${target} PRIVATE
        $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra ${ARGN} -ffp-contract=off>
        $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-sign-conversion>
        $<$<AND:$<BOOL:${SPHERETREE_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)
endfunction()

# What guards a program that reads files of strangers: a canary on the stack, calls of the C library
# that know how large their targets are, relocations that are read-only once it runs, and with the
# property of position-independent code an address that differs at each start. All of it is private:
# who links the installed library decides for himself. (docs/experiments.md has the cost.)
function(spheretree_harden target)
    if(NOT SPHERETREE_HARDENING OR NOT UNIX OR APPLE)
        return()
    endif()
    # The C library checks nothing in code that is not optimized, and says so with a warning.
    target_compile_options(${target} PRIVATE
        -fstack-protector-strong
        $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE>
        $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
    target_link_options(${target} PRIVATE -Wl,-z,relro -Wl,-z,now)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()

# OpenVDB's headers take seconds to parse, and nearly every file includes them: those of its trees are
# parsed once a target, and no file compiles the trees of masks again (voxel/Masks.h). The whole of
# <openvdb/openvdb.h> is not among them: its maps leave 80 KB of code in each file that sees it. Further
# arguments are headers of the target's own. Sources include what they use all the same:
# SPHERETREE_PRECOMPILE=OFF builds without. In angle brackets they are named without a folder, or the
# compiler cache would depend on where the sources lie. Grids of other types are compiled once, too, for
# targets that have no kernels (in the library, for the files that include the header).
set(SPHERETREE_GRID_TEMPLATES <openvdb_spheretree/voxel/GridTemplates.h>)
function(spheretree_precompile target)
    if(NOT SPHERETREE_PRECOMPILE)
        return()
    endif()
    target_precompile_headers(${target} PRIVATE
        <openvdb_spheretree/voxel/Masks.h>
        <openvdb/tree/LeafManager.h> <openvdb/util/NullInterrupter.h>
        <tbb/blocked_range.h> <tbb/parallel_for.h> <tbb/parallel_reduce.h>
        <algorithm> <array> <cmath> <cstdint> <functional> <memory> <optional> <string> <vector>
        ${ARGN})
    # So that ccache sees through the precompiled header (it names these flags in its manual).
    target_compile_options(${target} PRIVATE
        $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
        "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

# The same for a target that is compiled like another one: it takes that one's.
function(spheretree_precompile_as target other)
    if(NOT SPHERETREE_PRECOMPILE)
        return()
    endif()
    target_precompile_headers(${target} REUSE_FROM ${other})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()
