// SPDX-License-Identifier: Apache-2.0
#include "DistanceTransform.h"

#include "FlatAxis.h"
#include "SphereTreeSettings.h"
#include "detail/LeafTranspose.h"
#include "detail/Memory.h"
#include "detail/MinPlus.h"
#include "detail/NormSweep.h"
#include "detail/Parallel.h"
#include "slab/SlabDistance.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;

template <typename T>
constexpr uint32_t kLimit = sizeof(T) == 2 ? detail::kNarrowMax : detail::kWideMax;

template <typename T>
uint32_t largest(const T* values, std::size_t leaves, NullInterrupter* interrupter)
{
    std::atomic<uint32_t> result{0};
    detail::parallelFor(leaves, interrupter, [&](std::size_t leaf) {
        const T* first = values + leaf * kLeafVoxels;
        const uint32_t here = *std::max_element(first, first + kLeafVoxels);
        uint32_t seen = result.load();
        while (here > seen && !result.compare_exchange_weak(seen, here)) {}
    });
    return result;
}

/// @return the largest value; the values are exact if it is below kLimit<T>.
template <typename T>
uint32_t transform(const LeafLayout& layout, int dim, T* values, NullInterrupter* interrupter)
{
    const slab::XSteps<slab::StepOf<T>> steps(layout, interrupter);
    using Slab = slab::SlabDistance<T>;
    detail::parallelForWithScratch<Slab>(
        layout.slabCount(), interrupter, [&](std::size_t index, Slab& distances) {
            const auto store = [&](const LeafLayout::Run& run, const T* rows) {
                for (uint32_t i = 0; i < run.count; ++i, rows += kLeafVoxels) {
                    T* leaf = values + std::size_t(run.leaves[i]) * kLeafVoxels;
                    if (dim == 3) detail::rowsZToLeaf(rows, leaf);
                    else detail::rowsToLeaf(Axis::Y, rows, leaf);
                }
            };
            distances.forEachRun(layout, uint32_t(index), steps, dim, store);
        });
    return largest(values, layout.leafCount(), interrupter);
}

/// Balls of a norm have squared radii too.
void requireSquareFits(uint32_t largest, const Distance& distance)
{
    constexpr uint32_t kLargestRoot = 46340;
    if (largest < kLargestRoot) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object holds a ball of " << kLargestRoot / uint32_t(distance.unit())
                                      << " voxels radius or more, whose square does not fit 32 "
                                         "bits with dist="
                                      << toString(distance)
                                      << ": use a larger voxel, or smaller "
                                         "weights");
}

} // namespace

DistanceMap distanceTransform(
    const LeafLayout& layout, int dim, NullInterrupter* interrupter, const Distance& distance)
{
    const std::size_t size = std::size_t(layout.leafCount()) * kLeafVoxels;
    requireDim(dim);
    DistanceMap map;
    map.mDistance = distance;
    if (!distance.isEuclidean()) {
        detail::requireMemory(layout.leafCount(), kLeafVoxels * 2 * sizeof(uint32_t) + 128);
        map.mWide = detail::makeLargeArray<uint32_t>(size);
        detail::NormSweep(layout, distance, dim, interrupter).distances(map.mWide.get());
        map.mMaxDistSq = largest(map.mWide.get(), layout.leafCount(), interrupter);
        requireSquareFits(map.mMaxDistSq, distance);
        return map;
    }
    map.mNarrow = detail::makeLargeArray<uint16_t>(size);
    map.mMaxDistSq = transform(layout, dim, map.mNarrow.get(), interrupter);
    if (map.mMaxDistSq < kLimit<uint16_t>) return map;

    map.mNarrow.reset();
    map.mWide = detail::makeLargeArray<uint32_t>(size);
    map.mMaxDistSq = transform(layout, dim, map.mWide.get(), interrupter);
    if (map.mMaxDistSq < kLimit<uint32_t>) return map;
    OPENVDB_THROW(openvdb::ValueError,
        "the object holds a ball of 46340 voxels radius or more, whose "
        "square does not fit 32 bits: use a larger voxel");
}

openvdb::Int32Grid::Ptr distanceTransform(const openvdb::BoolGrid& object, int dim,
    NullInterrupter* interrupter, const Distance& distance)
{
    const FlatAxis flat = flatAxisOf(object, dim);
    const LeafLayout layout(*flat.toZ(
        std::make_shared<openvdb::MaskTree>(object.tree(), false, openvdb::TopologyCopy())));
    const DistanceMap map = distanceTransform(layout, dim, interrupter, distance);

    std::array<uint32_t, kLeafVoxels> place; // of a voxel of the turned leaf
    for (uint32_t k = 0; k < kLeafVoxels; ++k) {
        place[k] = leafOffset(flat.fromZ(openvdb::Coord(k >> 6, k >> 3 & 7, k & 7)));
    }
    using Leaf = openvdb::Int32Tree::LeafNodeType;
    std::vector<std::unique_ptr<Leaf>> leaves(layout.leafCount());
    detail::parallelFor(leaves.size(), interrupter, [&](std::size_t i) {
        leaves[i] = std::make_unique<Leaf>(flat.fromZ(layout.origin(uint32_t(i))), 0);
        Leaf::ValueType* values = leaves[i]->buffer().data();
        const LeafMask& mask = layout.mask(uint32_t(i));
        Leaf::NodeMaskType on;
        for (uint32_t k = 0; k < kLeafVoxels; ++k) {
            values[place[k]] = int32_t(map.at(uint32_t(i), k));
            if (isOn(mask, k)) on.setOn(place[k]);
        }
        leaves[i]->setValueMask(on);
    });
    auto grid = openvdb::Int32Grid::create(0);
    for (auto& leaf : leaves) grid->tree().addLeaf(leaf.release());
    grid->setTransform(object.transform().copy());
    return grid;
}

} // namespace openvdb_spheretree
