// SPDX-License-Identifier: Apache-2.0
#include "SphereDag.h"

#include "detail/Parallel.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree {

namespace {

/// A voxel as one number; ordered like the voxels' leaves.
using VoxelKey = uint64_t;
using Witness = std::pair<VoxelKey, VoxelKey>; ///< site of the parent, site of the child

VoxelKey keyOf(const PowerMap::Voxel& voxel)
{
    return VoxelKey(voxel.leaf) * kLeafVoxels + voxel.offset;
}

openvdb::Coord coordOf(const LeafLayout& layout, VoxelKey key)
{
    return layout.voxel(uint32_t(key / kLeafVoxels), uint32_t(key % kLeafVoxels));
}

template <typename T>
void sortUnique(std::vector<T>& items)
{
    tbb::parallel_sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::vector<Witness> witnessesOfLeaf(
    uint32_t leaf, const MedialLevel& fine, const MedialLevel& coarse, const PyramidStep& step)
{
    std::vector<Witness> result;
    openvdb::Coord lastOrigin = openvdb::Coord::max();
    std::optional<uint32_t> parentLeaf; // of the parents of the last few voxels
    for (uint32_t offset = 0; offset < kLeafVoxels; ++offset) {
        if (!isOn(fine.layout.mask(leaf), offset)) continue;
        const openvdb::Coord parent = step.parentVoxel(fine.layout.voxel(leaf, offset));
        if ((parent & ~7) != lastOrigin) {
            lastOrigin = parent & ~7;
            parentLeaf = coarse.layout.findLeaf(parent);
        }
        if (!parentLeaf || !isOn(coarse.layout.mask(*parentLeaf), leafOffset(parent))) continue;
        result.emplace_back(keyOf(coarse.labels.label({*parentLeaf, leafOffset(parent)})),
            keyOf(fine.labels.label({leaf, offset})));
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

} // namespace

std::vector<DagEdge> sphereDag(const MedialLevel& fine, const MedialLevel& coarse,
    const PyramidStep& step, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::vector<Witness>> ofLeaf(fine.layout.leafCount());
    detail::parallelFor(ofLeaf.size(), interrupter, [&](std::size_t leaf) {
        ofLeaf[leaf] = witnessesOfLeaf(uint32_t(leaf), fine, coarse, step);
    });
    std::vector<Witness> witnesses;
    for (const auto& some : ofLeaf) witnesses.insert(witnesses.end(), some.begin(), some.end());
    sortUnique(witnesses);

    std::vector<DagEdge> edges(witnesses.size());
    detail::parallelFor(edges.size(), interrupter, [&](std::size_t i) {
        edges[i] = {coarse.ballAt(coordOf(coarse.layout, witnesses[i].first)),
            fine.ballAt(coordOf(fine.layout, witnesses[i].second))};
    });
    sortUnique(edges);
    return edges;
}

} // namespace openvdb_spheretree
