// SPDX-License-Identifier: Apache-2.0
/// @file CutsLayout.h
/// @brief What the arrays of SphereCuts are, spheres aside: a forest that has a cut of every number
/// of spheres.

#pragma once

#include "SphereCuts.h"

#include <cstdint>
#include <string>

namespace openvdb_spheretree {
namespace detail {

/// @return the number of spheres of the largest cut, which is that of the leaves; 0 of none.
int32_t leavesOf(const SphereCuts& cuts);

/// @brief Whether: arrays are alike in length; a node's parent comes after it and takes over where
/// it ends, in the cut of one sphere less; every node above the leaves has a child; and there is a
/// cut of N nodes for every N from 1 to the number of leaves.
/// @return what is wrong first, as the end of a sentence about the cuts; empty if all holds. Cost:
///         linear.
std::string cutsDamage(const SphereCuts& cuts);

} // namespace detail
} // namespace openvdb_spheretree
