// SPDX-License-Identifier: Apache-2.0
/// @file PairKernels.h
/// @brief Searches through two trees at a time, for pairs of leaves that meet or are near.
///
/// All descend alike: of two spheres that may matter the larger one is opened (a leaf never is), and the block of its
/// children is tested against the other one in one go. The order is fixed, so that results are the
/// same on every instruction set. Pairs wait on a stack: each opening takes one and adds at most eight, and goes
/// one block deeper in one of the trees, so it has at most 7 (depth + depth) + 1 pairs, kMostPairs.

#pragma once

#include "Contact.h"
#include "PairFrame.h"

#include <cstdint>
#include <limits>

namespace openvdb_spheretree::detail {

constexpr int kMostPairs = 2 * kMostDepth * (kBlockWidth - 1) + 1;

struct LeafPair {
    int32_t a = -1, b = -1; ///< leaves; -1: none
    double gap = std::numeric_limits<double>::infinity();
};

struct SearchLimits {
    /// Pairs with a gap above this do not meet.
    double margin = 0;
    int64_t maxBlocks = std::numeric_limits<int64_t>::max();
};

struct SearchEnd {
    LeafPair pair;         ///< the first one found, if any
    bool isDecided = true; ///< false: blocks ran out
    double lowerBound =
        -std::numeric_limits<double>::infinity(); ///< of all gaps, if none was found
    int64_t blocks = 0;                           ///< tested
};

/// @brief Looks for any pair of leaves that meets.
/// @param wantBound  also compute `lowerBound`
SearchEnd findOverlap(const PairFrame& frame, const SearchLimits& limits, bool wantBound);

/// What is called with pairs of leaves that meet, a few at a time. False: no more.
struct PairSink {
    void* context;
    bool (*add)(void* context, const NodePair* pairs, int count);
    int32_t firstA, firstB; ///< node ids of leaf 0
};

/// @brief Calls @a sink with all pairs of leaves that meet.
SearchEnd findAllOverlaps(const PairFrame& frame, const SearchLimits& limits, const PairSink& sink);

/// The nearest pairs found so far: at most `wanted`, in a heap with the farthest first.
struct NearestLimits {
    int wanted = 1;
    /// Pairs with a gap of this or more are not looked for.
    double below = std::numeric_limits<double>::infinity();
    /// A found pair may be farther than the nearest by this, or by this part of its gap.
    double absErr = 0, relErr = 0;
    /// The search ends at a pair with a gap of this or less.
    double stopBelow = -std::numeric_limits<double>::infinity();
    int64_t maxBlocks = std::numeric_limits<int64_t>::max();
};

/// @brief Looks for the pairs of leaves with the smallest gaps.
/// @param pairs  room for limits.wanted; receives those found, the nearest first. Pairs that are
///               there already (count) are where the search starts.
/// @param count  of pairs, before and after
SearchEnd findNearest(
    const PairFrame& frame, const NearestLimits& limits, LeafPair* pairs, int& count);

} // namespace openvdb_spheretree::detail
