// SPDX-License-Identifier: Apache-2.0
/// @file slab/SlabBalls.h
/// @brief The medial balls of a slab, once all labels that lead to it are known along x.
///
/// A label leads from a voxel along x to a voxel of the slab, from there along y, and from there along
/// z to the ball's centre. The key of the slab's first voxel on that way holds the ball's radiusSq. A
/// centre need not be its own label, so its own key may hold another ball's.

#pragma once

#include "../LeafLayout.h"
#include "../MedialAxis.h"
#include "../PowerMap.h"
#include "../detail/BallOrder.h"
#include "../detail/MaxPlus.h"
#include "../detail/StepBits.h"
#include "SlabLabels.h"

#include <openvdb/util/NodeMasks.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// Memory of one thread; sees slab after slab.
template <typename Power>
class SlabBalls {
    using Voxel = PowerMap::Voxel;

public:
    /// @param labels   those of leaves without a mark may be undefined
    /// @param centers  one mask for each leaf of the slab: where labels lead to along x; receives
    ///                 the centres of balls
    /// @return the balls, ordered by centre.
    std::vector<MedialBall> collect(
        const LeafLayout& layout, uint32_t slab, const SlabLabels<Power>& labels, LeafMask* centers)
    {
        const LeafLayout::Slab leaves = layout.slab(slab);
        mMarks.assign(centers, centers + leaves.size());
        std::fill(centers, centers + leaves.size(), LeafMask{});
        mWays.clear();
        for (uint32_t leaf = leaves.begin; leaf < leaves.end; ++leaf) {
            const LeafMask& marks = mMarks[leaf - leaves.begin];
            if (detail::hasMarks(marks)) followLeaf(layout, leaf, marks, labels, centers);
        }
        countRanks(centers, leaves.size());
        for (const Way& way : mWays)
            mRadiusSq[rankOf(way.center, leaves.begin, centers)] = way.radiusSq;

        std::vector<MedialBall> balls(mRadiusSq.size());
        detail::visitWithPlaces(
            layout, slab, centers, [&](uint32_t leaf, uint32_t offset, std::size_t place) {
                const std::size_t rank = rankOf({leaf, offset}, leaves.begin, centers);
                const int32_t radiusSq =
                    mRadiusSq[rank] ? mRadiusSq[rank] : radiusSqAt({leaf, offset}, labels);
                balls[place] = {layout.voxel(leaf, offset), radiusSq};
            });
        return balls;
    }

private:
    /// From a voxel that a label leads to along x, to another one.
    struct Way {
        Voxel center;
        int32_t radiusSq;
    };

    static int32_t radiusSqAt(Voxel voxel, const SlabLabels<Power>& labels)
    {
        return int32_t(detail::siteSqOf<Power>(labels.keysOf(voxel.leaf)[voxel.offset]));
    }

    /// Marks the centres that labels lead to from a leaf.
    void followLeaf(const LeafLayout& layout, uint32_t leaf, const LeafMask& marks,
        const SlabLabels<Power>& labels, LeafMask* centers)
    {
        const LeafMask staysY = detail::stepBits(labels.dyOf(leaf), Axis::Y, marks).stays;
        LeafMask staysZ;
        staysZ.fill(~uint64_t(0));
        if (labels.dz) staysZ = detail::stepBits(labels.dzOf(leaf), Axis::Z, marks).stays;
        for (uint32_t x = 0; x < kLeafDim; ++x) {
            if (marks[x] == 0) continue;
            const uint64_t own = marks[x] & staysY[x] & staysZ[x];
            centers[leaf - labels.firstLeaf][x] |= own;
            for (uint64_t left = marks[x] & ~own; left; left &= left - 1) {
                const Voxel voxel{leaf, 64 * x + openvdb::util::FindLowestOn(left)};
                const Voxel center = labels.center(layout, voxel);
                centers[center.leaf - labels.firstLeaf][center.offset >> 6] |= uint64_t(1)
                    << (center.offset & 63);
                mWays.push_back({center, radiusSqAt(voxel, labels)});
            }
        }
    }

    /// Numbers the centres leaf by leaf, and makes room for their radii.
    void countRanks(const LeafMask* centers, uint32_t leaves)
    {
        mFirstRank.clear();
        std::size_t rank = 0;
        for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
            for (const uint64_t word : centers[leaf]) {
                mFirstRank.push_back(uint32_t(rank));
                rank += openvdb::util::CountOn(word);
            }
        }
        mRadiusSq.assign(rank, 0);
    }
    std::size_t rankOf(Voxel center, uint32_t firstLeaf, const LeafMask* centers) const
    {
        const uint32_t leaf = center.leaf - firstLeaf, x = center.offset >> 6;
        const uint64_t before = (uint64_t(1) << (center.offset & 63)) - 1;
        return mFirstRank[8 * std::size_t(leaf) + x]
            + openvdb::util::CountOn(centers[leaf][x] & before);
    }

    std::vector<LeafMask> mMarks; ///< of the slab
    std::vector<Way> mWays;
    std::vector<uint32_t> mFirstRank; ///< of the words of leaves
    std::vector<int32_t> mRadiusSq;   ///< of centres that ways lead to; 0: its own key has it
};

} // namespace slab
} // namespace openvdb_spheretree
