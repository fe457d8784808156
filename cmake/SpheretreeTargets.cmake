# SPDX-License-Identifier: Apache-2.0
# What all targets of this project have in common.

# Further arguments are warnings of the target's own.
function(spheretree_compile_options target)
    target_compile_options(${target} PRIVATE
        $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra ${ARGN}>
        $<$<AND:$<BOOL:${SPHERETREE_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)
endfunction()

# OpenVDB's headers take seconds to parse, and nearly every file includes them: those of its trees are
# parsed once a target, and no file compiles the trees of masks again (voxel/Masks.h). The whole of
# <openvdb/openvdb.h> is not among them: its maps leave 80 KB of code in each file that sees it. Further
# arguments are headers of the target's own. Sources include what they use all the same:
# SPHERETREE_PRECOMPILE=OFF builds without.
function(spheretree_precompile target)
    if(NOT SPHERETREE_PRECOMPILE)
        return()
    endif()
    target_precompile_headers(${target} PRIVATE
        "${PROJECT_SOURCE_DIR}/openvdb_spheretree/voxel/Masks.h"
        <openvdb/tree/LeafManager.h> <openvdb/util/NullInterrupter.h>
        <tbb/blocked_range.h> <tbb/parallel_for.h> <tbb/parallel_reduce.h>
        <algorithm> <array> <cmath> <cstdint> <functional> <memory> <optional> <string> <vector>
        ${ARGN})
    # So that ccache sees through the precompiled header (it names this flag in its manual).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# The same for a target that is compiled like another one: it takes that one's.
function(spheretree_precompile_as target other)
    if(NOT SPHERETREE_PRECOMPILE)
        return()
    endif()
    target_precompile_headers(${target} REUSE_FROM ${other})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()
