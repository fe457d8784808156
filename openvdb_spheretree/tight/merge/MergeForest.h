// SPDX-License-Identifier: Apache-2.0
/// @file MergeForest.h
/// @brief From leaves to one root (one for each group) by merging the cheapest pair of neighbours,
/// many pairs at a time.
///
/// What a merge costs is the model's business (StrictMerging.h, SlackMerging.h); here is the order of
/// merges. Pairs of near balls wait in a queue by cost. A round takes the cheapest pairs, at most
/// one in kShare of all balls, none near another one of the same round, and does them all: that is
/// what runs in parallel, and what keeps every intermediate cover valid. Where a merge changed the
/// surroundings of a pair, the pair is evaluated again before it is taken; costs fall as well as
/// rise, so all pairs are looked at anew whenever the count has shrunk by a seventh, or by a third
/// where they do not depend on other balls.
///
/// The result does not depend on threads: rounds are bounded by counts alone, and ties go by node.

#pragma once

#include <openvdb_spheretree/tight/fit/FineBall.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// What merging two nodes would give.
struct MergeCandidate {
    double cost = 0; ///< what the cover gains in outside voxels; negative where it loses some
    int32_t a = 0, b = 0;
    FineBall ball;     ///< empty: neither node owes anything, both can go
    int32_t round = 0; ///< in which it was evaluated

    /// The order of the queue: smallest first.
    bool operator<(const MergeCandidate& o) const
    {
        return cost != o.cost ? cost < o.cost : a != o.a ? a < o.a : b < o.b;
    }
};

/// What the order of merges asks of a kind of merging. The first nodes are the leaves.
class MergeModel {
public:
    virtual ~MergeModel() = default;
    virtual std::vector<FineBall> leaves() const = 0;
    /// Leaves of different groups never come together: CoverBall.h.
    virtual int32_t groupOf(int32_t /*leaf*/) const { return 0; }
    /// @return the merge of two nodes; thread-safe, changes nothing.
    virtual MergeCandidate evaluate(int32_t a, int32_t b) const = 0;
    /// Called for a merge that is going to be done.
    virtual void complete(MergeCandidate&) const {}
    /// Does merges, none of which is near another: the i-th becomes node `node + i`. Pairs that are
    /// dropped come by themselves: they become no nodes.
    virtual void merge(const std::vector<MergeCandidate>& merges, int32_t node) = 0;
    /// @return whether what a merge costs depends on the balls around it.
    virtual bool dependsOnOthers() const = 0;
};

struct ForestNode {
    FineBall ball;
    int32_t parent = -1;
    int32_t first = 1, last = 0; ///< it is part of the cuts of so many spheres: SphereCuts.h
};

/// Merges until each group is one ball.
/// @return the leaves, then every merged node in order; dropped candidates are no nodes.
/// @param neighbours  a ball may merge with: 6 where time counts; more than 8 gain nothing
std::vector<ForestNode> mergeToRoots(
    MergeModel& model, int neighbours, openvdb::util::NullInterrupter* interrupter);

} // namespace tight
} // namespace openvdb_spheretree
