// SPDX-License-Identifier: Apache-2.0
#include "BallMorphology.h"

#include "OrPyramid.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/medial/DistanceMap.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using openvdb::util::NullInterrupter;

/// The leaf cubes, of 8^3 voxels, that hold a voxel: one voxel for each.
MaskTree::Ptr leafCubesOf(const MaskTree& voxels, NullInterrupter* interrupter)
{
    return coarsen(voxels, PyramidStep{Coord(), 8, 3}, interrupter);
}

/// The cubes, and all others at most @a count further along each axis.
MaskTree::Ptr grown(const MaskTree& cubes, int count)
{
    using namespace openvdb::tools;
    auto result = std::make_shared<MaskTree>(cubes);
    dilateActiveValues(*result, count, NN_FACE_EDGE_VERTEX, IGNORE_TILES);
    forEachTile(cubes, [&](const CoordBBox& tile) {
        result->sparseFill(CoordBBox(tile.min() - Coord(count), tile.max() + Coord(count)), true);
    });
    prune(*result);
    return result;
}

/// All voxels of cubes, as tiles, within @a box along z. (In two dimensions nothing happens outside
/// the planes of the object, and cubes reach beyond them.)
MaskTree::Ptr voxelsOfCubes(const MaskTree& cubes, const CoordBBox& box, int dim)
{
    auto result = std::make_shared<MaskTree>(false);
    const auto add = [&](const CoordBBox& of) {
        const Coord &a = of.min(), &b = of.max();
        CoordBBox voxels(
            Coord(8 * a[0], 8 * a[1], 8 * a[2]), Coord(8 * b[0] + 7, 8 * b[1] + 7, 8 * b[2] + 7));
        if (dim == 2) {
            voxels.min()[2] = std::max(voxels.min()[2], box.min()[2]);
            voxels.max()[2] = std::min(voxels.max()[2], box.max()[2]);
        }
        if (!voxels.empty()) result->sparseFill(voxels, true);
    };
    for (auto leaf = cubes.cbeginLeaf(); leaf; ++leaf) {
        for (auto cube = leaf->cbeginValueOn(); cube; ++cube) {
            add(CoordBBox(cube.getCoord(), cube.getCoord()));
        }
    }
    forEachTile(cubes, add);
    return result;
}

/// The voxels of @a set at most @a radius away from a voxel that is not in it.
MaskTree::Ptr nearOutside(const MaskTree& set, int radius, int dim, NullInterrupter* interrupter)
{
    const LeafLayout layout(set);
    const DistanceMap distances = distanceTransform(layout, dim, {}, interrupter);
    std::vector<std::unique_ptr<LeafNode>> leaves(layout.leafCount());
    parallelFor(leaves.size(), interrupter, [&](std::size_t i) {
        LeafNode::NodeMaskType mask;
        const LeafMask& voxels = layout.mask(uint32_t(i));
        for (uint32_t k = 0; k < kLeafVoxels; ++k) {
            const bool near = distances.at(uint32_t(i), k) <= uint32_t(radius * radius);
            if (near && voxels.isOn(k)) mask.setOn(k);
        }
        if (mask.isOff()) return;
        leaves[i] = std::make_unique<LeafNode>(layout.origin(uint32_t(i)), false);
        leaves[i]->setValueMask(mask);
    });
    auto result = std::make_shared<MaskTree>(false);
    for (auto& leaf : leaves) {
        if (leaf) result->addLeaf(leaf.release());
    }
    return result;
}

/// @return how many leaf cubes are on throughout.
int64_t fullCubes(const MaskTree& set)
{
    int64_t count = 0;
    for (auto leaf = set.cbeginLeaf(); leaf; ++leaf) count += leaf->isDense();
    forEachTile(set, [&](const CoordBBox& tile) { count += int64_t(tile.volume() / kLeafVoxels); });
    return count;
}

/// For objects of many parts far apart the band is far larger than they are.
/// @param cubes  all leaf cubes of the set and of the band
/// @throw openvdb::ValueError, before the band is made
void requireRoomForBand(const MaskTree& cubes, const MaskTree& set, int radius, const char* what)
{
    constexpr double kBytes = kLeafVoxels * 2 * sizeof(uint32_t) + 400; // distances, and the layout
    const int64_t band = int64_t(cubes.activeVoxelCount()) - fullCubes(set);
    requireMemory(double(band) * kBytes,
        what + std::string("=") + std::to_string(radius) + " looks at " + std::to_string(band)
            + " leaf nodes around the object, which",
        "use a smaller radius or a larger voxel, or split the object");
}

} // namespace

/// By the distance transform of a band of off voxels. To it, what lies behind the band is on like the set. The band is twice as wide as the
/// cubes that can be near the set, so voxels of these cubes are farther than the radius from what
/// lies behind.
MaskTree::Ptr voxelsNear(
    const MaskTree& set, int radius, int dim, const char* what, NullInterrupter* interrupter)
{
    CoordBBox box;
    set.evalActiveVoxelBoundingBox(box);
    const int cubes = (radius + 7) / 8;
    const MaskTree::Ptr inReach = grown(*leafCubesOf(set, interrupter), cubes);
    const MaskTree::Ptr around = grown(*inReach, cubes);
    requireRoomForBand(*around, set, radius, what);
    const MaskTree::Ptr band = voxelsOfCubes(*around, box, dim);
    band->topologyDifference(set);
    const MaskTree::Ptr near = nearOutside(*band, radius, dim, interrupter);
    near->topologyIntersection(*voxelsOfCubes(*inReach, box, dim));
    return near;
}

void erodeAround(
    MaskTree& set, const MaskTree& around, int radius, int dim, NullInterrupter* interrupter)
{
    CoordBBox box;
    around.evalActiveVoxelBoundingBox(box);
    const MaskTree::Ptr cubes = leafCubesOf(around, interrupter);
    MaskTree inReach(set);
    inReach.topologyIntersection(*voxelsOfCubes(*grown(*cubes, (radius + 7) / 8), box, dim));
    const MaskTree::Ptr lost = nearOutside(inReach, radius, dim, interrupter);
    lost->topologyIntersection(*voxelsOfCubes(*cubes, box, dim)); // no others were in reach
    set.topologyDifference(*lost);
}

} // namespace openvdb_spheretree::detail
