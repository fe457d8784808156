// SPDX-License-Identifier: Apache-2.0
/// @file BlockHit.h
/// @brief What a walk down the blocks of a tree finds.

#pragma once

#include <cstdint>

namespace openvdb_spheretree::detail {

struct BlockHit {
    float key;      ///< of the leaf: its distance, or where a ray enters it; without one the limit
    int32_t leaf;   ///< number of the leaf; -1 if there is none
    int32_t blocks; ///< tested: what the question has cost
};

} // namespace openvdb_spheretree::detail
