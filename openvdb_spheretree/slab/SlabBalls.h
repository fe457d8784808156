// SPDX-License-Identifier: Apache-2.0
/// @file SlabBalls.h
/// @brief The medial balls of a slab, once all labels that lead to it are known along x.
///
/// A label leads from a voxel along x to a voxel of the slab, from there along y, then along z to
/// the center of its ball. The voxel that it reaches along x has the ball's radiusSq in its key,
/// and it is carried along: a center need not be its own label, so its key may hold another ball's
/// radius.
///
/// 1. Marks are where labels lead to along x. All of them are followed along y, with their radii.
/// 2. Their targets are followed along z. Many marks have become one target by then. (To follow
///    each mark to its center, and find its radius by the center's rank, took three times as long.)

#pragma once

#include "SlabLabels.h"
#include <openvdb_spheretree/kernel/MaxPlus.h>
#include <openvdb_spheretree/kernel/OffsetBits.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace openvdb_spheretree::slab {

/// Memory of one thread, for one slab after the other.
template <typename Power>
class SlabBalls {
    using Labels = SlabLabels<Power>;
    using Key = typename Power::Key;
    using Offset = typename Power::Offset;

public:
    /// Holds a radiusSq: half as many bits as a key.
    using RadiusSq = std::conditional_t<sizeof(Key) == 4, uint16_t, uint32_t>;

    /// @param labels   those of leaves without a mark may be undefined
    /// @param centers  a mask for each leaf of the slab: where labels lead to along x; receives the
    ///                 centers of balls
    /// @return radiusSq of the balls, ordered by center.
    std::vector<RadiusSq> collect(
        const LeafLayout& layout, uint32_t slab, const Labels& labels, LeafMask* centers)
    {
        const std::size_t leaves = layout.slab(slab).size();
        const RadiusInKey inKey{labels};
        mMarks.assign(centers, centers + leaves);
        mTargets.resize(leaves);
        const RadiusSq* radiusSq = nullptr; // of centers, 512 a leaf
        if (!labels.dz) {
            const Pass alongY{Axis::Y, mMarks.data(), labels.dy, centers};
            radiusSq = follow(layout, slab, alongY, inKey, mOfCenters);
        } else {
            const Pass alongY{Axis::Y, mMarks.data(), labels.dy, mTargets.data()};
            const RadiusSq* ofTargets = follow(layout, slab, alongY, inKey, mOfTargets);
            const Offset* dz = labels.dz;
            if (labels.dzFollowsDy) {
                const ValueOfVoxel<Offset> ofMarks{labels.dz, labels.firstLeaf};
                dz = follow(layout, slab, alongY, ofMarks, mDzOfTargets);
            }
            const Pass alongZ{Axis::Z, mTargets.data(), dz, centers};
            const ValueOfVoxel<RadiusSq> carried{ofTargets, labels.firstLeaf};
            radiusSq = follow(layout, slab, alongZ, carried, mOfCenters);
        }
        std::vector<RadiusSq> radii(detail::countMarks(centers, leaves));
        detail::visitWithPlaces(
            layout, slab, centers, [&](uint32_t leaf, uint32_t index, std::size_t place) {
                radii[place] = radiusSq[std::size_t(leaf - labels.firstLeaf) * kLeafVoxels + index];
            });
        return radii;
    }

private:
    /// Offsets along one axis, followed from some voxels of the slab. Arrays have an entry for each
    /// leaf of the slab, or 512.
    struct Pass {
        Axis axis;
        const LeafMask* marks; ///< the voxels
        const Offset* offsets;
        LeafMask* targets; ///< receives where they lead
    };

    /// The radius in a voxel's key. The slab wrote its keys past the caches, so they are
    /// prefetched.
    struct RadiusInKey {
        const Labels& labels;

        RadiusSq operator()(uint32_t leaf, uint32_t index) const
        {
            return RadiusSq(detail::siteSqOf<Power>(labels.keysOf(leaf)[index]));
        }
        /// Of the voxels of a leaf that are marked. Inlined, or compilers see a function without
        /// effects, and drop calls of it.
        HWY_INLINE void prefetch(uint32_t leaf, const LeafMask& marks) const
        {
            constexpr int kLine = 64 / sizeof(Key);
            constexpr uint64_t kOfLine = (uint64_t(1) << kLine) - 1;
            const Key* keys = labels.keysOf(leaf);
            for (uint32_t x = 0; x < 8; ++x, keys += 64) {
                const Key* line = keys;
                for (uint64_t left = marks[x]; left; left >>= kLine, line += kLine) {
                    if (left & kOfLine) hwy::Prefetch(line);
                }
            }
        }
    };

    /// A value of a voxel in an array of 512 a leaf, which is read in order.
    template <typename Value>
    struct ValueOfVoxel {
        const Value* values;
        uint32_t firstLeaf;

        Value operator()(uint32_t leaf, uint32_t index) const
        {
            return values[std::size_t(leaf - firstLeaf) * kLeafVoxels + index];
        }
        void prefetch(uint32_t, const LeafMask&) const {}
    };

    /// Marks the targets of a pass, and carries a value along: the radius, or the offset that
    /// follows. Voxels with the same target have the same value, as they belong to one ball.
    /// @param valueOf  of a marked voxel: RadiusInKey or ValueOfVoxel
    /// @return the values at the targets, 512 a leaf, elsewhere undefined; they are in @a memory.
    template <typename Value, typename ValueOf>
    static const Value* follow(const LeafLayout& layout, uint32_t slab, const Pass& pass,
        const ValueOf& valueOf, std::vector<Value>& memory)
    {
        const LeafLayout::Slab leaves = layout.slab(slab);
        memory.resize(std::max(memory.size(), std::size_t(leaves.size()) * kLeafVoxels));
        std::fill(pass.targets, pass.targets + leaves.size(), LeafMask{});
        const LeafLayout::Slab runs = layout.runsOfSlab(pass.axis, slab);
        for (uint32_t index = runs.begin; index < runs.end; ++index) {
            const LeafLayout::Run run = layout.run(pass.axis, index);
            for (uint32_t i = 0; i < run.count; ++i) {
                if (i + 1 < run.count) {
                    const uint32_t next = run.leaves[i + 1];
                    valueOf.prefetch(next, pass.marks[next - leaves.begin]);
                }
                followLeaf(run, i, leaves.begin, pass, valueOf, memory.data());
            }
        }
        return memory.data();
    }

    template <typename Value, typename ValueOf>
    static void followLeaf(const LeafLayout::Run& run, uint32_t i, uint32_t firstLeaf,
        const Pass& pass, const ValueOf& valueOf, Value* values)
    {
        const uint32_t leaf = run.leaves[i], here = leaf - firstLeaf;
        const Offset* offsets = pass.offsets + std::size_t(here) * kLeafVoxels;
        const auto fresh = detail::freshOffsets(offsets, pass.axis, pass.marks[here]);
        pass.targets[here] |= fresh.stay;
        fresh.stay.visitOn([&](uint32_t index) {
            values[std::size_t(here) * kLeafVoxels + index] = valueOf(leaf, index);
        });
        fresh.go.visitOn([&](uint32_t index) {
            const Target target = targetOf(pass.axis, index, offsets[index]);
            const uint32_t there = run.leaves[int(i) + target.leaves] - firstLeaf;
            pass.targets[there].setOn(target.index);
            values[std::size_t(there) * kLeafVoxels + target.index] = valueOf(leaf, index);
        });
    }

    std::vector<LeafMask> mMarks;                 ///< along x, of the slab
    std::vector<LeafMask> mTargets;               ///< along y, of the slab
    std::vector<RadiusSq> mOfTargets, mOfCenters; ///< 512 a leaf
    std::vector<Offset> mDzOfTargets;             ///< the same, where dz follows dy
};

} // namespace openvdb_spheretree::slab
