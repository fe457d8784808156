// SPDX-License-Identifier: Apache-2.0
/// @file TreeUse.h
/// @brief What people do with a tree that was read, whatever its file said.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <cstdint>

namespace spheretree_test {

/// The uses are dealt out to so many turns: all together take too long for each of thousands of trees.
constexpr uint64_t kUseTurns = 24;

/// @brief Check, store and draw a tree, and as its turn is, export it to some formats, make a page, a chart or a level set of
/// it, keep a part, weigh or ask it. Each may be refused, as a file may say anything that is possible; none may crash, hang
/// or take memory without end.
/// @param turn  any number; kUseTurns of them in a row are all uses
/// @throw what is no refusal
void useTree(const openvdb_spheretree::SphereTree& tree, uint64_t turn);

} // namespace spheretree_test
