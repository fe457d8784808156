// SPDX-License-Identifier: Apache-2.0
#include "PowerMap.h"

#include "NormSweep.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/voxel/Dimension.h>

#include <openvdb/Exceptions.h>

namespace openvdb_spheretree {

PowerMap normLabels(const LeafLayout& layout, const DistanceMap& distances, int dim,
    openvdb::util::NullInterrupter* interrupter)
{
    requireDim(dim);
    // Labels are numbers of voxels, 512 leaf + index: 2^23 leaves fill 32 bits.
    constexpr uint32_t kMaxLeaves = uint32_t(1) << 23;
    if (layout.leafCount() > kMaxLeaves) {
        OPENVDB_THROW(openvdb::ValueError,
            "the object has " << layout.leafCount()
                              << " leaf nodes, and with this distance 2^23 is the most: use a "
                                 "larger voxel, or dist=l2");
    }
    detail::requireMemory(layout.leafCount(), kLeafVoxels * (2 * sizeof(uint32_t)));
    PowerMap map;
    map.mLayout = &layout;
    map.mSites = detail::makeLargeArray<uint32_t>(std::size_t(layout.leafCount()) * kLeafVoxels);
    detail::NormSweep(layout, distances.distance(), dim, interrupter)
        .labels(distances.wide(), map.mSites.get());
    return map;
}

openvdb::Coord PowerMap::label(const openvdb::Coord& ijk) const
{
    const auto leaf = mLayout->findLeaf(ijk);
    if (!leaf || !mLayout->mask(*leaf).isOn(leafIndex(ijk))) {
        OPENVDB_THROW(openvdb::LookupError, "voxel " << ijk << " is not in the object: no label");
    }
    const VoxelRef site = label(VoxelRef{*leaf, leafIndex(ijk)});
    return mLayout->voxel(site.leaf, site.index);
}

} // namespace openvdb_spheretree
