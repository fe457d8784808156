// SPDX-License-Identifier: Apache-2.0
/// @file SlabBalls.h
/// @brief The medial balls of a slab, once all labels that lead to it are known along x.
///
/// A label leads from a voxel along x to a voxel of the slab, from there along y, and from there
/// along z to the ball's centre. The slab's first voxel on that way has the ball's radiusSq in its
/// key, which goes along; a centre need not be its own label, so its own key may hold another ball's.
/// All marks go along y, then all ends along z, where many have become one: to follow each mark to
/// its centre, and find its radius by the centre's rank, took three times as long (dragon-512).

#pragma once

#include "SlabLabels.h"
#include <openvdb_spheretree/kernel/LabelStepEnds.h>
#include <openvdb_spheretree/kernel/MaxPlus.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>

#include <hwy/cache_control.h>
#include <openvdb/util/NodeMasks.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// Memory of one thread; sees slab after slab.
template <typename Power>
class SlabBalls {
    using Labels = SlabLabels<Power>;
    using Key = typename Power::Key;
    using Offset = typename Power::Offset;

public:
    /// Holds a radiusSq: half as many bits as a key.
    using RadiusSq = std::conditional_t<sizeof(Key) == 4, uint16_t, uint32_t>;

    /// @param labels   those of leaves without a mark may be undefined
    /// @param centers  one mask for each leaf of the slab: where labels lead to along x; receives
    ///                 the centres of balls
    /// @return radiusSq of the balls, ordered by centre.
    std::vector<RadiusSq> collect(
        const LeafLayout& layout, uint32_t slab, const Labels& labels, LeafMask* centers)
    {
        const OfKey ofKey{labels};
        mMarks.assign(centers, centers + layout.slab(slab).size());
        const Ways alongY{Axis::Y, mMarks.data(), labels.dy};
        const RadiusSq* radiusSq = nullptr; // of centres, 512 a leaf
        if (labels.dz) {
            mEnds.resize(layout.slab(slab).size());
            const RadiusSq* ofEnd = follow(layout, slab, alongY, ofKey, mEnds.data(), mOfEnds);
            const Array<RadiusSq> before{ofEnd, labels.firstLeaf};
            const Array<Offset> dz{labels.dz, labels.firstLeaf};
            const Ways alongZ{Axis::Z, mEnds.data(),
                labels.dzFollowsDy ? follow(layout, slab, alongY, dz, mEnds.data(), mDzOfEnds)
                                   : labels.dz};
            radiusSq = follow(layout, slab, alongZ, before, centers, mOfCenters);
        } else {
            radiusSq = follow(layout, slab, alongY, ofKey, centers, mOfCenters);
        }
        std::vector<RadiusSq> radii(detail::countMarks(centers, layout.slab(slab).size()));
        detail::visitWithPlaces(
            layout, slab, centers, [&](uint32_t leaf, uint32_t offset, std::size_t place) {
                const std::size_t at = std::size_t(leaf - labels.firstLeaf) * kLeafVoxels + offset;
                radii[place] = radiusSq[at];
            });
        return radii;
    }

private:
    /// Steps along an axis from the voxels that are marked, in all leaves of the slab.
    struct Ways {
        Axis axis;
        const LeafMask* marks;
        const Offset* steps;
    };

    /// The radius in a voxel's key. Keys are past the caches, where the slab has put them.
    struct OfKey {
        const Labels& labels;

        RadiusSq operator()(uint32_t leaf, uint32_t offset) const
        {
            return RadiusSq(detail::siteSqOf<Power>(labels.keysOf(leaf)[offset]));
        }
        /// Asks for the keys of a leaf's voxels that are marked. Inlined, or compilers see a
        /// function without effects, and drop calls of it.
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
    /// Values that are read in order, 512 a leaf.
    template <typename Value>
    struct Array {
        const Value* values;
        uint32_t firstLeaf;

        Value operator()(uint32_t leaf, uint32_t offset) const
        {
            return values[std::size_t(leaf - firstLeaf) * kLeafVoxels + offset];
        }
        void prefetch(uint32_t, const LeafMask&) const {}
    };

    /// What ways along one axis lead to, in all leaves of the slab.
    template <typename Value>
    struct Ends {
        LeafMask* marks;
        Value* values; ///< of what is marked, 512 a leaf
    };

    /// Marks where the ways end, and takes a value along that is the same for all ways of one end:
    /// the radius, as they are of one ball, or what follows.
    /// @param valueOf  of a voxel that is marked: OfKey or Array
    /// @return the values at the ends, 512 a leaf, elsewhere undefined; they are in `memory`.
    template <typename Value, typename ValueOf>
    static const Value* follow(const LeafLayout& layout, uint32_t slab, const Ways& ways,
        const ValueOf& valueOf, LeafMask* marks, std::vector<Value>& memory)
    {
        const LeafLayout::Slab leaves = layout.slab(slab);
        memory.resize(std::max(memory.size(), std::size_t(leaves.size()) * kLeafVoxels));
        std::fill(marks, marks + leaves.size(), LeafMask{});
        const Ends<Value> ends{marks, memory.data()};
        const LeafLayout::Slab runs = layout.runsOfSlab(ways.axis, slab);
        for (uint32_t index = runs.begin; index < runs.end; ++index) {
            const LeafLayout::Run run = layout.run(ways.axis, index);
            for (uint32_t i = 0; i < run.count; ++i) {
                if (i + 1 < run.count) {
                    const uint32_t next = run.leaves[i + 1];
                    valueOf.prefetch(next, ways.marks[next - leaves.begin]);
                }
                followLeaf(run, i, leaves.begin, ways, valueOf, ends);
            }
        }
        return ends.values;
    }

    template <typename Value, typename ValueOf>
    static void followLeaf(const LeafLayout::Run& run, uint32_t i, uint32_t firstLeaf,
        const Ways& ways, const ValueOf& valueOf, const Ends<Value>& ends)
    {
        const uint32_t leaf = run.leaves[i], place = leaf - firstLeaf;
        const std::size_t first = std::size_t(place) * kLeafVoxels;
        const auto* steps = ways.steps + first;
        const detail::FreshSteps fresh = detail::freshSteps(steps, ways.axis, ways.marks[place]);
        for (uint32_t x = 0; x < 8; ++x) ends.marks[place][x] |= fresh.stay[x];
        visitOn(fresh.stay,
            [&](uint32_t offset) { ends.values[first + offset] = valueOf(leaf, offset); });
        detail::forEachEnd(
            ways.axis, i, steps, fresh.go, [&](uint32_t offset, uint32_t leafOfEnd, uint32_t end) {
                const uint32_t there = run.leaves[leafOfEnd] - firstLeaf;
                ends.marks[there][end >> 6] |= uint64_t(1) << (end & 63);
                ends.values[std::size_t(there) * kLeafVoxels + end] = valueOf(leaf, offset);
            });
    }

    template <typename Visit>
    static void visitOn(const LeafMask& mask, const Visit& visit)
    {
        for (uint32_t x = 0; x < 8; ++x) {
            for (uint64_t left = mask[x]; left; left &= left - 1) {
                visit(64 * x + openvdb::util::FindLowestOn(left));
            }
        }
    }

    std::vector<LeafMask> mMarks;              ///< along x, of the slab
    std::vector<LeafMask> mEnds;               ///< along y, of the slab
    std::vector<RadiusSq> mOfEnds, mOfCenters; ///< 512 a leaf
    std::vector<Offset> mDzOfEnds;             ///< the same, where dz follows dy
};

} // namespace slab
} // namespace openvdb_spheretree
