// SPDX-License-Identifier: Apache-2.0
/// @file FarthestVoxel.cc
/// @brief Branch and bound over cubes of voxels, with one best distance B for all threads.
///
/// A box of voxels with center c and half diagonal r is dismissed when an object voxel lies within
/// B - r of c, for then no voxel of the box is farther than B.
///
/// 1. The exact distances of some samples, then all of the cube that the farthest one is in.
/// 2. Every node, in parallel (NodeSearch): its leaves, in Morton order, so that those of any
///    larger cube stand together. The box of such a cube is dismissed, or the cube is split in
///    eight, down to single leaves. Tiles are split likewise.
/// 3. A leaf that is not dismissed (visitLeaf): voxels within B go by words (LeafReach.h), which is
///    enough where B is a few voxels. Of those left, one at a time has its exact distance taken,
///    which may raise B; then all go that are within B of the object voxel nearest to it.
///
/// The order decides how much is dismissed, not the result: a maximum. Distances are doubled and
/// squared integers; the one place with rounding, B - r, is rounded down, which dismisses less.

#include "FarthestVoxel.h"

#include "LeafReach.h"
#include <openvdb_spheretree/base/AtomicExtremes.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

/// A leaf's voxels, and where in its node of 128 it is.
struct PlacedLeaf {
    const VoxelCube* leaf;
    uint32_t morton; ///< of 12 bits

    /// @return which eighth of a cube of @a size it is in.
    uint32_t partOf(int32_t size) const
    {
        const uint32_t half = uint32_t(size) / 16; // in leaves
        return morton / (half * half * half) & 7;
    }
};

class FarthestSearch {
public:
    FarthestSearch(const openvdb::MaskTree& mask, const NearestVoxel& object)
        : mMask(mask), mObject(object)
    {}

    int64_t bestSq2() const { return mBestSq2.load(std::memory_order_relaxed); }

    /// Raises B to the distance of a voxel. @return that distance, or anything up to B.
    int64_t visitVoxel(const Coord& voxel)
    {
        const int64_t point2[3] = {
            2 * int64_t(voxel[0]), 2 * int64_t(voxel[1]), 2 * int64_t(voxel[2])};
        const int64_t sq2 = mObject.distSq(point2, bestSq2());
        raiseTo(mBestSq2, sq2);
        return sq2;
    }

    /// Recursion: from 4096 to 8 in nine halvings.
    void visit(const VoxelCube& cube, LeafReach& reach)
    {
        if (cube.size == kLeafDim) return visitLeaf(cube.origin, cube.mask, reach);
        if (dismissed(CoordBBox::createCube(cube.origin, cube.size))) return;
        for (int i = 0; i < 8; ++i) visit(cube.eighth(i), reach);
    }

    /// Visits leaves that are in one cube of @a size, in Morton order.
    /// Recursion: from 128 to 8 in four halvings.
    void visitGroup(const PlacedLeaf* begin, const PlacedLeaf* end, int32_t size, LeafReach& reach)
    {
        if (end - begin == 1) return visit(*begin->leaf, reach);
        CoordBBox box;
        for (const PlacedLeaf* placed = begin; placed != end; ++placed) {
            box.expand(CoordBBox::createCube(placed->leaf->origin, kLeafDim));
        }
        if (dismissed(box)) return;
        while (begin != end) {
            const uint32_t part = begin->partOf(size);
            const PlacedLeaf* const first = begin;
            while (begin != end && begin->partOf(size) == part) ++begin;
            visitGroup(first, begin, size / 2, reach);
        }
    }

private:
    /// @return whether no voxel of the box can be farther than B.
    bool dismissed(const CoordBBox& box) const
    {
        return mObject.areAllWithin(box, std::sqrt(double(bestSq2())));
    }

    /// Visits voxels of a leaf until none is left, each with all that are within B of the object
    /// voxel nearest to it: one search settles many voxels.
    void visitLeaf(const Coord& origin, LeafMask left, LeafReach& reach)
    {
        if (dismissed(CoordBBox::createCube(origin, kLeafDim))) return;
        reach.takeNear(mMask, mObject.distance(), bestSq2() / 4, origin, left);
        while (!left.none()) {
            const Coord voxel = VoxelCube{origin, kLeafDim, left}.first();
            Coord nearest;
            raiseTo(mBestSq2, mObject.nearest(voxel, nearest));
            const ExactSphere near = ExactSphere::around(nearest, bestSq2());
            LeafMask settled = voxelsOf(near, /*shift=*/1, origin, mObject.distance());
            settled.setOn(leafIndex(voxel)); // however far it is
            left -= settled;
        }
    }

    const openvdb::MaskTree& mMask;
    const NearestVoxel& mObject; ///< the same, as an index
    std::atomic<int64_t> mBestSq2{0};
};

/// @return the place of a leaf in its node of 128: bits of x, y and z, from the highest on.
uint32_t mortonOf(const Coord& origin)
{
    uint32_t code = 0;
    for (int bit = 6; bit >= 3; --bit) {
        for (int a = 0; a < 3; ++a) code = code << 1 | (uint32_t(origin[a]) >> bit & 1);
    }
    return code;
}

/// Visits nodes of a set. Memory of one thread.
class NodeSearch {
public:
    void visit(FarthestSearch& search, const MaskMinus& set, std::size_t node)
    {
        set.cubes(node, mCubes);
        for (std::size_t i = 0; i < mCubes.size();) {
            if (mCubes[i].size > kLeafDim) {
                search.visit(mCubes[i++], mReach);
                continue;
            }
            // The leaves that are in one node of 128.
            const Coord nodeOrigin = mCubes[i].origin & ~127;
            mAt.assign(kPlaces, nullptr);
            const auto isLeafThere = [&](const VoxelCube& cube) {
                return cube.size == kLeafDim && (cube.origin & ~127) == nodeOrigin;
            };
            for (; i < mCubes.size() && isLeafThere(mCubes[i]); ++i) {
                mAt[mortonOf(mCubes[i].origin)] = &mCubes[i];
            }
            mPlaced.clear();
            for (uint32_t place = 0; place < kPlaces; ++place) {
                if (mAt[place]) mPlaced.push_back({mAt[place], place});
            }
            search.visitGroup(mPlaced.data(), mPlaced.data() + mPlaced.size(), 128, mReach);
        }
    }

    /// Visits the cube of a sample alone.
    void visit(FarthestSearch& search, const MaskMinus& set, const VoxelCount::Sample& sample)
    {
        set.cubes(sample.node, mCubes);
        const auto cube = std::find_if(mCubes.begin(), mCubes.end(),
            [&](const VoxelCube& c) { return c.origin == (sample.voxel & ~(c.size - 1)); });
        search.visit(*cube, mReach);
    }

private:
    static constexpr uint32_t kPlaces = 16 * 16 * 16;
    std::vector<VoxelCube> mCubes;
    std::vector<const VoxelCube*> mAt; ///< by place
    std::vector<PlacedLeaf> mPlaced;
    LeafReach mReach;
};

} // namespace

VoxelCount countVoxels(const MaskMinus& set, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<VoxelCount> counts(set.nodeCount());
    using Cubes = std::vector<VoxelCube>;
    parallelForWithScratch<Cubes>(counts.size(), interrupter, [&](std::size_t node, Cubes& cubes) {
        set.cubes(node, cubes);
        uint32_t seen = 0; // eighths
        for (const VoxelCube& cube : cubes) {
            counts[node].voxels += cube.voxels();
            const uint32_t eighth = 1u << (mortonOf(cube.origin) >> 9);
            if (!(seen & eighth)) counts[node].samples.push_back({node, cube.first()});
            seen |= eighth;
        }
    });
    VoxelCount all;
    for (const VoxelCount& count : counts) {
        all.voxels += count.voxels;
        all.samples.insert(all.samples.end(), count.samples.begin(), count.samples.end());
    }
    return all;
}

int64_t farthestDistSq(const MaskMinus& set, const std::vector<VoxelCount::Sample>& samples,
    const openvdb::MaskTree& mask, const NearestVoxel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    if (samples.empty()) return 0;
    FarthestSearch search(mask, object);
    constexpr std::size_t kSamples = 512; // whose distances are the seed
    const std::size_t step = samples.size() / kSamples + 1;
    std::size_t best = 0;
    for (std::size_t i = 0; i < samples.size(); i += step) {
        const int64_t before = search.bestSq2();
        if (search.visitVoxel(samples[i].voxel) > before) best = i;
    }
    NodeSearch().visit(search, set, samples[best]);
    parallelForWithScratch<NodeSearch>(set.nodeCount(), interrupter,
        [&](std::size_t node, NodeSearch& scratch) { scratch.visit(search, set, node); });
    return search.bestSq2() / 4;
}

} // namespace openvdb_spheretree::detail
