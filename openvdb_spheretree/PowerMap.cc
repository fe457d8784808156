// SPDX-License-Identifier: Apache-2.0
#include "PowerMap.h"

#include "SphereTreeSettings.h"
#include "detail/LeafRows.h"
#include "detail/MaxPlus.h"
#include "detail/Memory.h"
#include "detail/NormSweep.h"
#include "detail/Parallel.h"

#include <openvdb/Exceptions.h>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;

template <typename Power>
struct Scratch {
    detail::RowBuffer<typename Power::Key> in, out;
    detail::RowBuffer<typename Power::Offset> offsets;
    detail::EnvelopeScratch envelope;
};

/// The distances of a leaf as rows of keys: every voxel starts as its own site.
template <typename Power, typename T>
void distancesToKeys(Axis axis, const T* distances, typename Power::Key* rows)
{
    alignas(64) T distanceRows[kLeafVoxels]; // moved while they are small
    detail::leafToRows(axis, distances, distanceRows);
    for (int i = 0; i < kLeafVoxels; ++i) {
        rows[i] = detail::powerKey<Power>(distanceRows[i], distanceRows[i]);
    }
}

/// One pass: keys become the best of their line, offsets say where it stood.
/// @param load        writes the 512 keys of a leaf, in row order
/// @param keys        result in leaf order; null on the last pass, where nobody reads it
template <typename Power, typename Load>
void alongAxis(Axis axis, const LeafLayout& layout, const Load& load, typename Power::Key* keys,
    typename Power::Offset* offsets, NullInterrupter* interrupter)
{
    const auto body = [&](std::size_t index, Scratch<Power>& scratch) {
        const LeafLayout::Run run = layout.run(axis, uint32_t(index));
        const int rows = int(run.count) * kLeafDim;
        auto* in = scratch.in.rows(rows, 1);
        auto* out = keys ? scratch.out.rows(rows) : nullptr;
        auto* steps = scratch.offsets.rows(rows);
        for (std::size_t i = 0; i < run.count; ++i) load(run.leaves[i], in + i * kLeafVoxels);
        detail::maxPlus<Power>(in, out, steps, rows, scratch.envelope);
        for (std::size_t i = 0; i < run.count; ++i) {
            const std::size_t leaf = std::size_t(run.leaves[i]) * kLeafVoxels;
            detail::rowsToLeaf(axis, steps + i * kLeafVoxels, offsets + leaf);
            if (keys) detail::rowsToLeaf(axis, out + i * kLeafVoxels, keys + leaf);
        }
    };
    detail::parallelForWithScratch<Scratch<Power>>(layout.runCount(axis), interrupter, body);
}

/// Steps along z (unless dim is 2), y and x.
template <typename Power>
void computeOffsets(const LeafLayout& layout, const DistanceMap& distances,
    const std::array<typename Power::Offset*, 3>& offsets, NullInterrupter* interrupter)
{
    using Key = typename Power::Key;
    const std::size_t size = std::size_t(layout.leafCount()) * kLeafVoxels;
    const auto keys = detail::makeLargeArray<Key>(size);

    const auto fromDistances = [&](Axis axis) {
        return [&distances, axis](uint32_t leaf, Key* rows) {
            const std::size_t first = std::size_t(leaf) * kLeafVoxels;
            if (distances.narrow()) distancesToKeys<Power>(axis, distances.narrow() + first, rows);
            else distancesToKeys<Power>(axis, distances.wide() + first, rows);
        };
    };
    const auto fromKeys = [&](Axis axis) {
        return [&keys, axis](uint32_t leaf, Key* rows) {
            detail::leafToRows(axis, keys.get() + std::size_t(leaf) * kLeafVoxels, rows);
        };
    };
    if (offsets[2]) {
        alongAxis<Power>(
            Axis::Z, layout, fromDistances(Axis::Z), keys.get(), offsets[2], interrupter);
        alongAxis<Power>(Axis::Y, layout, fromKeys(Axis::Y), keys.get(), offsets[1], interrupter);
    } else {
        alongAxis<Power>(
            Axis::Y, layout, fromDistances(Axis::Y), keys.get(), offsets[1], interrupter);
    }
    alongAxis<Power>(Axis::X, layout, fromKeys(Axis::X), nullptr, offsets[0], interrupter);
}

/// The labels of a norm are numbers of voxels, in 32 bits.
void requireNumberedVoxels(const LeafLayout& layout)
{
    constexpr uint32_t kMaxLeaves = uint32_t(1) << 23;
    if (layout.leafCount() > kMaxLeaves) {
        OPENVDB_THROW(openvdb::ValueError,
            "the object has " << layout.leafCount()
                              << " leaf nodes, and with this distance 2^23 is the most: use a "
                                 "larger voxel, or dist=l2");
    }
    detail::requireMemory(layout.leafCount(), kLeafVoxels * (2 * sizeof(uint32_t)));
}

} // namespace

PowerMap powerMap(
    const LeafLayout& layout, const DistanceMap& distances, int dim, NullInterrupter* interrupter)
{
    requireDim(dim);
    if (!distances.distance().isEuclidean()) {
        requireNumberedVoxels(layout);
        PowerMap map;
        map.mLayout = &layout;
        map.mSites =
            detail::makeLargeArray<uint32_t>(std::size_t(layout.leafCount()) * kLeafVoxels);
        detail::NormSweep(layout, distances.distance(), dim, interrupter)
            .labels(distances.wide(), map.mSites.get());
        return map;
    }
    if (distances.maxDistSq() > detail::WidePower::kMaxRadiusSq) {
        OPENVDB_THROW(openvdb::ValueError,
            "the object holds a ball of more than 32767 voxels radius, "
            "beyond what power labels hold: use a larger voxel");
    }
    const std::size_t size = std::size_t(layout.leafCount()) * kLeafVoxels;
    const bool narrow = distances.maxDistSq() <= detail::NarrowPower::kMaxRadiusSq;
    // Keys while it runs, steps to stay.
    const int64_t voxelBytes = narrow ? sizeof(int32_t) + dim : sizeof(int64_t) + 2 * dim;
    detail::requireMemory(layout.leafCount(), kLeafVoxels * (voxelBytes + 2));
    PowerMap map;
    map.mLayout = &layout;
    for (int axis = 0; axis < dim; ++axis) {
        if (narrow) map.mOffsets[axis].narrow = detail::makeLargeArray<int8_t>(size);
        else map.mOffsets[axis].wide = detail::makeLargeArray<int16_t>(size);
    }
    const auto& o = map.mOffsets;
    if (narrow) {
        const std::array<int8_t*, 3> offsets{
            o[0].narrow.get(), o[1].narrow.get(), o[2].narrow.get()};
        const bool small = distances.maxDistSq() <= detail::SmallPower::kMaxRadiusSq;
        if (small) computeOffsets<detail::SmallPower>(layout, distances, offsets, interrupter);
        else computeOffsets<detail::NarrowPower>(layout, distances, offsets, interrupter);
    } else {
        computeOffsets<detail::WidePower>(
            layout, distances, {o[0].wide.get(), o[1].wide.get(), o[2].wide.get()}, interrupter);
    }
    return map;
}

openvdb::Coord PowerMap::label(const openvdb::Coord& ijk) const
{
    const auto leaf = mLayout->findLeaf(ijk);
    if (!leaf || !isOn(mLayout->mask(*leaf), leafOffset(ijk))) {
        OPENVDB_THROW(openvdb::LookupError, "voxel " << ijk << " is not in the object: no label");
    }
    const Voxel site = label(Voxel{*leaf, leafOffset(ijk)});
    return mLayout->voxel(site.leaf, site.offset);
}

} // namespace openvdb_spheretree
