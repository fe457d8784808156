// SPDX-License-Identifier: Apache-2.0
/// @file PackedStream.h
/// @brief A stream of labels that has few slabs in memory at a time, and all others compressed.
///
/// For objects with balls so large that most slabs wait for others. A group of leaves is unpacked
/// twice at most:
///
/// 1. *enter*: slab by slab, the labels along z and y, which are packed in groups of leaves
///    (StreamPlan.h) and stored (PackedStore.h);
/// 2. *along x*: band by band, the keys of all its groups, then the columns of its runs;
/// 3. *finish*: slab by slab, the groups to which a label leads, for medial balls and queries.

#pragma once

#include "PackedStore.h"
#include "StreamPlan.h"
#include "StreamWork.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/kernel/MaxPlus.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace openvdb_spheretree::slab {

/// A label in a form that compresses well.
///
/// After the passes along z and y, a voxel's value is the site's radiusSq less the squares of the
/// offsets to it along y and z. So the key is not packed. In the power cell of a ball radiusSq is
/// constant, and offsets fall by one from voxel to voxel, which compresses well. The offset along z
/// is that of the voxel that dy leads to (SlabLabels::dzFollowsDy), so that a leaf is unpacked
/// without the others of its slab.
template <typename Power>
struct PackedLabel {
    using SiteSq = std::conditional_t<sizeof(typename Power::Key) == 4, uint16_t, uint32_t>;
    SiteSq siteSq;
    typename Power::Offset dy, dz;
};

/// @param packed  receives 512
template <typename Power>
void packLeaf(const LeafLayout& layout, uint32_t leaf, const SlabLabels<Power>& labels,
    PackedLabel<Power>* packed)
{
    const auto* keys = labels.keysOf(leaf);
    const auto* dy = labels.dyOf(leaf);
    for (uint32_t k = 0; k < kLeafVoxels; ++k) {
        packed[k].siteSq = typename PackedLabel<Power>::SiteSq(detail::siteSqOf<Power>(keys[k]));
        packed[k].dy = dy[k];
        const VoxelRef voxel{leaf, k};
        const VoxelRef there = moved(layout, Axis::Y, voxel, dy[k]);
        packed[k].dz = typename Power::Offset(labels.dzAfter(voxel, there));
    }
}

/// @param keys  receives 512
template <typename Power>
void unpackKeys(const PackedLabel<Power>* packed, typename Power::Key* keys)
{
    for (uint32_t k = 0; k < kLeafVoxels; ++k) {
        const uint32_t siteSq = packed[k].siteSq;
        // Of a site, less than its radiusSq: 31 bits hold the sum, for 2 32766^2 < 2^31.
        const auto below = uint32_t(packed[k].dy * packed[k].dy + packed[k].dz * packed[k].dz);
        keys[k] = detail::powerKey<Power>(siteSq - below, siteSq);
    }
}

/// @param labels  receive those of a leaf; with dzFollowsDy
template <typename Power>
void unpackLeaf(const PackedLabel<Power>* packed, uint32_t leaf, const SlabLabels<Power>& labels)
{
    unpackKeys<Power>(packed, labels.keysOf(leaf));
    auto* dy = labels.dyOf(leaf);
    for (uint32_t k = 0; k < kLeafVoxels; ++k) dy[k] = packed[k].dy;
    if (!labels.dz) return;
    auto* dz = labels.dzOf(leaf);
    for (uint32_t k = 0; k < kLeafVoxels; ++k) dz[k] = packed[k].dz;
}

template <typename Power, typename T>
class PackedStream {
    using Work = StreamWork<Power, T>;
    using Key = typename Power::Key;
    using Packed = PackedLabel<Power>;

public:
    /// @param work  kept by reference
    PackedStream(Work& work, const StreamPlan& plan)
        : mWork(work), mLayout(work.layout), mPlan(plan),
          mCut(mLayout, kLeafVoxels * sizeof(Key), plan.bandBytes),
          mStore(mCut.groups.size(), plan.storedBytes), mKeysOf(mLayout.slabCount())
    {}

    void run()
    {
        constexpr int64_t kMostCompressed = 8; // few labels are by more
        if (mPlan.packedBytes / kMostCompressed > mPlan.storedBytes) mStore.makeFile();
        enterAll();
        mWork.allEntered();
        labelAlongX();
        finishAll();
    }

private:
    /// Memory of one thread for a group.
    struct GroupScratch {
        std::vector<Packed> labels;
        PackedStore::Bytes bytes;
    };
    struct SlabScratch {
        SlabMemory<Power> memory;
        GroupScratch group;
        SlabBalls<Power> balls;
    };

    void enterAll()
    {
        std::vector<typename Work::Entry> entries(mPlan.slabs);
        std::vector<SlabScratch> scratches(mPlan.slabs);
        double seconds = 0;
        detail::timed("distances and power labels", mWork.interrupter, &seconds, [&] {
            forEachSlab([&](uint32_t slab, std::size_t slot) {
                SlabScratch& scratch = scratches[slot];
                const auto labels = scratch.memory.open(mLayout.slab(slab), mWork.dim, mWork.kept);
                mWork.enter(slab, labels, entries[slot]);
                const detail::Stage all("", nullptr, &entries[slot].seconds);
                const detail::Stage power("", nullptr, &entries[slot].powerSeconds);
                pack(slab, labels, scratch.group);
            });
        });
        mWork.share(seconds, entries);
    }

    template <typename Body>
    void forEachSlab(const Body& body)
    {
        detail::parallelForWithSlots(mLayout.slabCount(), mPlan.slabs, mWork.interrupter,
            [&](std::size_t slab, std::size_t slot) { body(uint32_t(slab), slot); });
    }

    void pack(uint32_t slab, const SlabLabels<Power>& labels, GroupScratch& scratch)
    {
        for (const uint32_t index : mCut.ofSlab[slab]) {
            const LeafGroup& group = mCut.groups[index];
            const std::size_t size = std::size_t(group.end - group.begin) * kLeafVoxels;
            scratch.labels.resize(size);
            for (uint32_t leaf = group.begin; leaf < group.end; ++leaf) {
                packLeaf(mLayout, leaf, labels, placeOf(leaf, group, scratch));
            }
            mStore.put(
                index, scratch.labels.data(), size * sizeof(Packed), sizeof(Packed), scratch.bytes);
        }
    }

    static Packed* placeOf(uint32_t leaf, const LeafGroup& group, GroupScratch& scratch)
    {
        return scratch.labels.data() + std::size_t(leaf - group.begin) * kLeafVoxels;
    }

    void unpack(uint32_t index, GroupScratch& scratch) const
    {
        const LeafGroup& group = mCut.groups[index];
        const std::size_t size = std::size_t(group.end - group.begin) * kLeafVoxels;
        scratch.labels.resize(size);
        mStore.get(index, scratch.labels.data(), size * sizeof(Packed), scratch.bytes);
    }

    void labelAlongX()
    {
        const detail::Stage stage(
            "power labels along x", mWork.interrupter, &mWork.seconds().power);
        for (std::size_t band = 0; band + 1 < mCut.firstOfBand.size(); ++band) {
            unpackBand(mCut.firstOfBand[band], mCut.firstOfBand[band + 1]);
            const uint32_t first = mCut.firstRunOfBand[band];
            detail::parallelForWithScratch<ColumnPower<Power>>(
                mCut.firstRunOfBand[band + 1] - first, mWork.interrupter,
                [&](std::size_t i, ColumnPower<Power>& power) {
                    const uint32_t index = first + uint32_t(i), slab = mWork.firstSlab(index);
                    const LeafLayout::Run run = mLayout.run(Axis::X, index);
                    power.column.clear();
                    for (uint32_t k = 0; k < run.count; ++k) {
                        power.column.add(run.leaves[k], keysOf(slab + k, run.leaves[k]));
                    }
                    power.column.last = run.count;
                    mWork.labelColumn(power);
                });
        }
        mKeys.reset();
    }

    /// The keys of the groups [first, end), one behind the other.
    void unpackBand(uint32_t first, uint32_t end)
    {
        int64_t leaves = 0;
        for (uint32_t index = first; index < end; ++index) {
            const LeafGroup& group = mCut.groups[index];
            mKeysOf[group.slab] = leaves - group.begin; // those of a slab are neighbours
            leaves += group.end - group.begin;
        }
        if (leaves > mRoom) {
            mKeys.reset(); // before there is more
            mKeys = detail::makeLargeArray<Key>(std::size_t(leaves) * kLeafVoxels);
            mRoom = leaves;
        }
        std::vector<GroupScratch> scratches(mPlan.slabs);
        detail::parallelForWithSlots(
            end - first, mPlan.slabs, mWork.interrupter, [&](std::size_t i, std::size_t slot) {
                const LeafGroup& group = mCut.groups[first + i];
                unpack(first + uint32_t(i), scratches[slot]);
                for (uint32_t leaf = group.begin; leaf < group.end; ++leaf) {
                    unpackKeys<Power>(
                        placeOf(leaf, group, scratches[slot]), keysOf(group.slab, leaf));
                }
            });
    }

    Key* keysOf(uint32_t slab, uint32_t leaf) const
    {
        return mKeys.get() + std::ptrdiff_t(mKeysOf[slab] + leaf) * kLeafVoxels;
    }

    void finishAll()
    {
        const detail::Stage stage("medial balls", mWork.interrupter, &mWork.seconds().medial);
        std::vector<SlabScratch> scratches(mPlan.slabs);
        forEachSlab([&](uint32_t slab, std::size_t slot) {
            SlabScratch& scratch = scratches[slot];
            auto labels = scratch.memory.open(mLayout.slab(slab), mWork.dim, {});
            labels.dzFollowsDy = true;
            for (const uint32_t index : mCut.ofSlab[slab]) {
                const LeafGroup& group = mCut.groups[index];
                uint32_t leaf = group.begin;
                while (leaf < group.end && !mWork.hasMarks(leaf)) ++leaf;
                if (leaf == group.end) continue;
                unpack(index, scratch.group);
                for (leaf = group.begin; leaf < group.end; ++leaf) {
                    unpackLeaf<Power>(placeOf(leaf, group, scratch.group), leaf, labels);
                }
            }
            mWork.finish(slab, labels, scratch.balls);
        });
    }

    Work& mWork;
    const LeafLayout& mLayout;
    const StreamPlan mPlan;
    const LeafGroups mCut;
    PackedStore mStore;
    detail::LargeArray<Key> mKeys; ///< of a band
    int64_t mRoom = 0;             ///< leaves that they are for
    std::vector<int64_t> mKeysOf;  ///< of a slab: where the keys of leaf 0 would be
};

} // namespace openvdb_spheretree::slab
