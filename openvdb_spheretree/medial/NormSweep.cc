// SPDX-License-Identifier: Apache-2.0
#include "NormSweep.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/LeafWalk.h>

#include <algorithm>
#include <numeric>

namespace openvdb_spheretree::detail {

namespace {

constexpr uint32_t kFarAway = uint32_t(1) << 30;

/// A plane with a voxel more on every side.
constexpr int kCanvasWidth = 10, kCanvasSize = kCanvasWidth * kCanvasWidth;

constexpr uint32_t strideOf(int axis) { return 1u << (6 - 3 * axis); }

/// The leaves in groups of equal coordinate along an axis, which ascends.
struct Slabs {
    std::vector<uint32_t> leaves;
    std::vector<std::size_t> begin; ///< of each group, and the count at the end

    Slabs(const LeafLayout& layout, int axis) : leaves(layout.leafCount())
    {
        std::iota(leaves.begin(), leaves.end(), 0u);
        const auto along = [&](uint32_t leaf) { return layout.origin(leaf)[axis]; };
        std::stable_sort(leaves.begin(), leaves.end(),
            [&](uint32_t a, uint32_t b) { return along(a) < along(b); });
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            if (i == 0 || along(leaves[i]) != along(leaves[i - 1])) begin.push_back(i);
        }
        begin.push_back(leaves.size());
    }
    std::size_t size() const { return begin.size() - 1; }
};

} // namespace

/// The axes u < v are the two beside the sweep's. A step may also change those that were swept
/// before: `wideU` and `wideV` say so.
struct NormSweep::PlanePair {
    uint32_t leaf;
    std::array<uint32_t, 9> before; ///< leaves of the plane before, by 3 (du + 1) + dv + 1
    uint32_t here, there;           ///< index of voxel (0, 0) of this plane, of that
    uint32_t strideU, strideV;
    bool wideU, wideV;

    std::size_t voxel(int u, int v) const
    {
        return std::size_t(leaf) * kLeafVoxels + here + uint32_t(u) * strideU
            + uint32_t(v) * strideV;
    }
    /// Calls visit(du, dv, coordinates changed) for the voxels before that a step may come from.
    template <typename Visit>
    void forEachStep(const Visit& visit) const
    {
        for (int du = wideU ? -1 : 0; du <= (wideU ? 1 : 0); ++du) {
            for (int dv = wideV ? -1 : 0; dv <= (wideV ? 1 : 0); ++dv) {
                visit(du, dv, 1 + std::abs(du) + std::abs(dv));
            }
        }
    }
};

NormSweep::NormSweep(const LeafLayout& layout, const Distance& distance, int dim,
    openvdb::util::NullInterrupter* interrupter)
    : mLayout(layout), mDim(dim),
      mInterrupter(interrupter), mCost{0, uint32_t(distance.face()), uint32_t(distance.edge()),
                                     uint32_t(distance.corner())},
      mAround(layout.leafCount())
{
    constexpr std::size_t kChunk = 256;
    const std::size_t count = mAround.size();
    parallelFor((count + kChunk - 1) / kChunk, nullptr, [&](std::size_t chunk) {
        const std::size_t begin = chunk * kChunk;
        LeafWalk around(layout, uint32_t(begin));
        for (std::size_t leaf = begin; leaf < std::min(begin + kChunk, count); ++leaf) {
            around.moveTo(uint32_t(leaf));
            mAround[leaf] = around.all();
        }
    });
}

/// Calls visit(planes) for both directions of every axis; planes that it is called for at the same
/// time do not touch.
template <typename Visit>
void NormSweep::sweep(const Visit& visit) const
{
    for (int axis = mDim - 1; axis >= 0; --axis) {
        sweepAlong(axis, +1, visit);
        sweepAlong(axis, -1, visit);
    }
}

template <typename Visit>
void NormSweep::sweepAlong(int axis, int direction, const Visit& visit) const
{
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    const bool wideU = u > axis && u<mDim, wideV = v> axis && v < mDim;
    const Slabs slabs(mLayout, axis);
    const auto visitPlane = [&](uint32_t leaf, int t) {
        const int back = t - direction; // -1 or 8: in the leaf before
        const int outside = back < 0 ? -1 : back > 7 ? 1 : 0;
        PlanePair planes{leaf, {}, uint32_t(t) * strideOf(axis),
            uint32_t(back & 7) * strideOf(axis), strideOf(u), strideOf(v), wideU, wideV};
        planes.forEachStep([&](int du, int dv, int) {
            int step[3];
            step[axis] = outside, step[u] = du, step[v] = dv;
            planes.before[3 * (du + 1) + dv + 1] =
                mAround[leaf][LeafWalk::index(step[0], step[1], step[2])];
        });
        visit(planes);
    };
    for (std::size_t i = 0; i < slabs.size(); ++i) {
        const std::size_t slab = direction > 0 ? i : slabs.size() - 1 - i;
        const uint32_t* leaves = slabs.leaves.data() + slabs.begin[slab];
        const std::size_t count = slabs.begin[slab + 1] - slabs.begin[slab];
        for (int k = 0; k < kLeafDim; ++k) {
            const int t = direction > 0 ? k : 7 - k;
            parallelFor(count, mInterrupter, [&](std::size_t j) { visitPlane(leaves[j], t); });
        }
    }
}

/// The plane before, with its border; 0 where there is no leaf. Only what steps may come from.
template <typename Value>
void NormSweep::loadBefore(const PlanePair& planes, const Value* values, Value* canvas) const
{
    planes.forEachStep([&](int du, int dv, int) {
        const uint32_t leaf = planes.before[3 * (du + 1) + dv + 1];
        const int firstU = du < 0 ? 7 : 0, lastU = du > 0 ? 0 : 7;
        const int firstV = dv < 0 ? 7 : 0, lastV = dv > 0 ? 0 : 7;
        for (int u = firstU; u <= lastU; ++u) {
            Value* to = canvas + (u + 8 * du + 1) * kCanvasWidth + 8 * dv + 1;
            if (leaf == LeafWalk::kNone) {
                std::fill(to + firstV, to + lastV + 1, Value(0));
                continue;
            }
            const Value* from = values + std::size_t(leaf) * kLeafVoxels + planes.there
                + uint32_t(u) * planes.strideU;
            for (int v = firstV; v <= lastV; ++v) to[v] = from[uint32_t(v) * planes.strideV];
        }
    });
}

/// Background has 0 and keeps it.
void NormSweep::relax(const PlanePair& planes, uint32_t* values) const
{
    uint32_t canvas[kCanvasSize];
    loadBefore(planes, values, canvas);
    for (int u = 0; u < kLeafDim; ++u) {
        uint32_t row[kLeafDim];
        for (int v = 0; v < kLeafDim; ++v) row[v] = values[planes.voxel(u, v)];
        planes.forEachStep([&](int du, int dv, int changed) {
            const uint32_t* from = canvas + (u + du + 1) * kCanvasWidth + dv + 1;
            const uint32_t cost = mCost[changed];
            for (int v = 0; v < kLeafDim; ++v) row[v] = std::min(row[v], from[v] + cost);
        });
        for (int v = 0; v < kLeafDim; ++v) values[planes.voxel(u, v)] = row[v];
    }
}

void NormSweep::distances(uint32_t* values) const
{
    parallelFor(mLayout.leafCount(), mInterrupter, [&](std::size_t leaf) {
        uint32_t* of = values + leaf * kLeafVoxels;
        const LeafMask& mask = mLayout.mask(uint32_t(leaf));
        for (uint32_t i = 0; i < kLeafVoxels; ++i) of[i] = mask.isOn(i) ? kFarAway : 0;
    });
    sweep([&](const PlanePair& planes) { relax(planes, values); });
}

bool NormSweep::better(uint32_t site, uint32_t than, const uint32_t* values) const
{
    if (values[site] != values[than]) return values[site] > values[than];
    return mLayout.voxel(site / kLeafVoxels, site % kLeafVoxels)
        < mLayout.voxel(than / kLeafVoxels, than % kLeafVoxels);
}

void NormSweep::passLabels(const PlanePair& planes, const uint32_t* values, uint32_t* sites) const
{
    uint32_t distance[kCanvasSize], site[kCanvasSize];
    loadBefore(planes, values, distance);
    loadBefore(planes, static_cast<const uint32_t*>(sites), site);
    for (int u = 0; u < kLeafDim; ++u) {
        for (int v = 0; v < kLeafDim; ++v) {
            const std::size_t here = planes.voxel(u, v);
            if (values[here] == 0) continue;
            uint32_t best = sites[here];
            planes.forEachStep([&](int du, int dv, int changed) {
                const int from = (u + du + 1) * kCanvasWidth + v + dv + 1;
                if (distance[from] != values[here] + mCost[changed]) return;
                if (site[from] != best && better(site[from], best, values)) best = site[from];
            });
            sites[here] = best;
        }
    }
}

void NormSweep::labels(const uint32_t* values, uint32_t* sites) const
{
    const std::size_t size = std::size_t(mLayout.leafCount()) * kLeafVoxels;
    parallelFor(size, mInterrupter, [&](std::size_t i) { sites[i] = uint32_t(i); });
    sweep([&](const PlanePair& planes) { passLabels(planes, values, sites); });
}

} // namespace openvdb_spheretree::detail
