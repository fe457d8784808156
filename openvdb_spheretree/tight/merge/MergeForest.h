// SPDX-License-Identifier: Apache-2.0
/// @file MergeForest.h
/// @brief Merges leaf balls to one root, or to one for each group: the cheapest pairs of neighbours
/// first, many pairs at a time.
///
/// A model knows what a merge costs (StrictMerging.h, SlackMerging.h). Here is the order of merges.
/// 1. Pairs of near balls wait in a queue, the cheapest first.
/// 2. A round takes the cheapest pairs, at most one for every 64 balls, and merges them in
///    parallel. Where costs depend on other balls, no pair is near another one of the same round,
///    so the cover stays valid.
/// 3. There, a pair near a merge is evaluated again before it is taken. A cost may also fall
///    unnoticed. So the queue is filled anew whenever the count has shrunk by 15 %, or by 30 %
///    where costs do not depend on other balls.
///
/// The result does not depend on threads: counts alone bound a round, and of equal costs the pair
/// with the smaller node numbers is first.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// What merging two nodes would give.
struct MergeCandidate {
    double cost = 0; ///< by how many outside voxels the cover grows; negative where it shrinks
    int32_t a = 0, b = 0;
    ExactSphere ball;  ///< empty: no voxel needs either node, both can go
    int32_t round = 0; ///< in which it was evaluated

    /// The order of the queue: smallest first.
    bool operator<(const MergeCandidate& o) const
    {
        return cost != o.cost ? cost < o.cost : a != o.a ? a < o.a : b < o.b;
    }
};

/// A kind of merging. The first nodes are the leaf balls.
class MergeModel {
public:
    virtual ~MergeModel() = default;
    virtual std::vector<ExactSphere> leafBalls() const = 0;
    /// Leaf balls of different groups never merge: CoverBall.h.
    virtual int32_t groupOf(int32_t /*leafBall*/) const { return 0; }
    /// @return the merge of two nodes; thread-safe, changes nothing.
    virtual MergeCandidate evaluate(int32_t a, int32_t b) const = 0;
    /// Enlarges the ball of a merge, just before that is done, if evaluate() made it too small;
    /// thread-safe.
    virtual void complete(MergeCandidate&) const {}
    /// Does merges, no two of the same node: the i-th becomes node `node + i`. Where costs depend
    /// on other balls, none is near another one. Pairs without a ball come in a call of their own
    /// and become no nodes.
    virtual void merge(const std::vector<MergeCandidate>& merges, int32_t node) = 0;
    /// @return whether what a merge costs depends on the balls around it.
    virtual bool dependsOnOthers() const = 0;
};

/// The forest is binary; children stand before their parents.
struct ForestNode {
    ExactSphere ball;
    int32_t parent = -1;
    int32_t first = 1, last = 0; ///< it is in the cuts of first to last balls: SphereCuts.h
};

/// Merges until @a count balls are left, or each group is one ball. There are no cuts below that.
/// @return the leaf balls, then every merged node in order.
/// @param neighbours  that a ball may merge with
std::vector<ForestNode> mergeToCount(
    MergeModel& model, int neighbours, int64_t count, openvdb::util::NullInterrupter* interrupter);

/// Merges until each group is one ball.
std::vector<ForestNode> mergeToRoots(
    MergeModel& model, int neighbours, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
