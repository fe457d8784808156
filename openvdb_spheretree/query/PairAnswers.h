// SPDX-License-Identifier: Apache-2.0
/// @file PairAnswers.h
/// @brief From leaves and frames back to nodes and the world: what questions to a pair share.

#pragma once

#include "Contact.h"
#include "PairKernels.h"

namespace openvdb_spheretree::detail {

/// Two trees, their poses, and both as a PairFrame.
struct BodyPair {
    const QueryTree& a;
    const QueryTree& b;
    const RigidTransform& poseA;
    PairFrame frame;

    BodyPair(const QueryTree& treeA, const RigidTransform& inWorldA, const QueryTree& treeB,
        const RigidTransform& inWorldB);

    Contact contact(const LeafPair& pair) const;
    /// @return the leaves of a pair of nodes that a search may begin with, and how far they are apart; none of no pair.
    /// @throw openvdb::LookupError if these are no leaves, or only one of both is given
    LeafPair leaves(const NodePair& nodes) const;
    /// @return whether the leaves show that the objects meet: they do so when shrunk to lie in them.
    bool objectsMeet(const LeafPair& pair) const;
    /// @return what the distance of the objects is at most, by this pair.
    double objectsUpper(const LeafPair& pair) const;
};

/// @return INT64_MAX for -1.
/// @throw openvdb::ValueError for other numbers below 1
int64_t blocksOrAny(int64_t maxBlocks);

/// @throw openvdb::ValueError naming @a what, unless it is 0 or more, and finite
void requireLength(double length, const char* what);

} // namespace openvdb_spheretree::detail
