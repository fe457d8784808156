// SPDX-License-Identifier: Apache-2.0
/// @file NormSweep.h
/// @brief Distance transform and power labels for norms of the 3x3x3 neighbourhood, by sweeping
/// planes of voxels to and fro along each axis.
///
/// A cheapest path has at most three kinds of steps, all of one sign an axis, in any order. So it
/// may take its steps along z alone first, then all others within a plane of constant x, then those
/// that change x. The transform does the same, with two sweeps an axis, in the order z, y, x
/// (Borgefors' chamfer masks, taken apart by axis). All voxels of a plane are independent.
///     along z: value of the voxel before + a;
///     along y: those at y - 1 with z - 1, z, z + 1;  along x: the nine at x - 1
///
/// *Locality.* A path to the nearest background voxel meets no other one before: background is 0
/// wherever a path meets it, and need not be stored. A path from a ball's center to a voxel of the
/// ball stays in the ball.
///
/// *Labels.* The distance changes by at most N(p - q) between p and q, so the power
/// distance(p) - N(p - q) of any p is at most distance(q), which q reaches itself. The label of q
/// is therefore the largest ball, then the first, among those p with distance(p) = distance(q) +
/// N(p - q). This holds all along a cheapest path from p to q: labels travel as distances do, to
/// neighbours whose distance is smaller by just the step's cost.
///
/// Exact, integer. Cost: 26 comparisons a voxel, whatever the weights and radii.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NullInterrupter.h>

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class NormSweep {
public:
    /// @param layout  kept by reference
    /// @param dim     3, or 2 to leave the z axis out
    NormSweep(const LeafLayout& layout, const Distance& distance, int dim,
        openvdb::util::NullInterrupter* interrupter);

    /// @param values  512 a leaf, in leaf order: receives distances, 0 for background. Those of
    ///                2^30 or more are wrong.
    void distances(uint32_t* values) const;

    /// @param values  the distances
    /// @param sites   receives the label of each object voxel, as 512 leaf + index
    void labels(const uint32_t* values, uint32_t* sites) const;

private:
    /// A plane of 8 x 8 voxels of a leaf, and the one before it in the direction of a sweep.
    struct PlanePair;

    template <typename Visit>
    void sweep(const Visit& visit) const;
    template <typename Visit>
    void sweepAlong(int axis, int direction, const Visit& visit) const;
    template <typename Value>
    void loadBefore(const PlanePair& planes, const Value* values, Value* canvas) const;
    void relax(const PlanePair& planes, uint32_t* values) const;
    void passLabels(const PlanePair& planes, const uint32_t* values, uint32_t* sites) const;
    bool better(uint32_t site, uint32_t than, const uint32_t* values) const;

    const LeafLayout& mLayout;
    int mDim;
    openvdb::util::NullInterrupter* mInterrupter;
    std::array<uint32_t, 4> mCost;                 ///< of a step that changes this many coordinates
    std::vector<std::array<uint32_t, 27>> mAround; ///< of each leaf, as LeafWalk::all()
};

} // namespace openvdb_spheretree::detail
