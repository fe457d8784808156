// SPDX-License-Identifier: Apache-2.0
/// @file TreeUse.h
/// @brief What people do with a tree that was read, whatever its file said.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

namespace spheretree_test {

/// @brief Check, store, export, draw and ask a tree. Each may be refused, as a file may say anything that is
/// possible; none may crash, hang or take memory without end.
/// @throw what is no refusal
void useTree(const openvdb_spheretree::SphereTree& tree);

} // namespace spheretree_test
