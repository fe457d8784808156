// SPDX-License-Identifier: Apache-2.0
#include "ObjectSurface.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <openvdb/Grid.h>
#include <openvdb/math/Transform.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatTree;
using openvdb::Vec3d;
using Leaf = openvdb::BoolTree::LeafNodeType;

constexpr int kLeafShift = 3; ///< a leaf node is a block of 8 voxels a side
constexpr int kMaxShift = 12; ///< blocks have at most 4096
constexpr float kHalf = 0.5f;
constexpr int64_t kMostBlocks = int64_t(1) << 30; ///< along an axis

/// @return a multiple of 8 blocks of any size, near the object: blocks are counted from there, since
///         the points of a mesh are floats.
Coord baseOf(const CoordBBox& box) { return box.min() & ~((8 << kMaxShift) - 1); }

/// Blocks from the base: of the widest objects their numbers fit 32 bits from a shift of 2 on.
Coord blockOf(const Coord& voxel, const Coord& base, int shift)
{
    const auto along = [&](int axis) {
        return int32_t((int64_t(voxel[axis]) - base[axis]) >> shift);
    };
    return {along(0), along(1), along(2)};
}

CoordBBox blocksOf(const CoordBBox& voxels, const Coord& base, int shift)
{
    return {blockOf(voxels.min(), base, shift), blockOf(voxels.max(), base, shift)};
}

/// @return the least shift whose blocks have numbers far from the ends of 32 bits.
int leastShiftOf(const CoordBBox& box)
{
    int shift = 0;
    while (longestSideOf(box) >> shift > kMostBlocks) ++shift;
    return shift;
}

/// Adds the voxels of a leaf node to its blocks.
void addLeaf(const Leaf& leaf, const Coord& base, int shift, FloatTree& blocks)
{
    const float voxel = 1.0f / float(1 << 3 * shift);
    const Coord first = blockOf(leaf.origin(), base, shift);
    FloatTree::LeafNodeType& target = *blocks.touchLeaf(first);
    for (auto on = leaf.cbeginValueOn(); on; ++on) {
        const Coord local = Leaf::offsetToLocalCoord(on.pos()) >> std::size_t(shift);
        const auto at = FloatTree::LeafNodeType::coordToOffset(first + local);
        target.setValueOn(at, target.getValue(at) + voxel);
    }
}

/// @return shares of blocks twice as large along each side.
FloatTree::Ptr halved(const FloatTree& blocks)
{
    auto larger = std::make_shared<FloatTree>(0.0f);
    openvdb::tree::ValueAccessor<FloatTree> access(*larger);
    for (auto on = blocks.cbeginValueOn(); on; ++on) {
        if (!on.isVoxelValue()) {
            const CoordBBox box = on.getBoundingBox();
            larger->sparseFill(CoordBBox(box.min() >> 1, box.max() >> 1), 1.0f);
            continue;
        }
        const Coord ijk = on.getCoord() >> 1;
        access.setValueOn(ijk, access.getValue(ijk) + *on / 8);
    }
    return larger;
}

/// @return the share of the object's voxels in blocks of 2^shift voxels a side.
FloatTree::Ptr blocksOf(const openvdb::BoolTree& object, const Coord& base, int shift,
    openvdb::util::NullInterrupter* interrupter)
{
    auto blocks = std::make_shared<FloatTree>(0.0f);
    const int ofLeaves = std::min(shift, kLeafShift);
    for (auto leaf = object.cbeginLeaf(); leaf; ++leaf) {
        checkInterrupt(interrupter);
        addLeaf(*leaf, base, ofLeaves, *blocks);
    }
    auto tile = object.cbeginValueOn();
    tile.setMaxDepth(openvdb::BoolTree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        blocks->sparseFill(blocksOf(tile.getBoundingBox(), base, ofLeaves), 1.0f);
    }
    for (int made = ofLeaves; made < shift; ++made) blocks = halved(*blocks);
    return blocks;
}

/// Fills the blocks that are less than half full and have none that is fuller beside them.
void fillThinParts(FloatTree& blocks)
{
    openvdb::tree::ValueAccessor<const FloatTree> access(blocks);
    const auto isThin = [&](const Coord& ijk) {
        for (auto beside = CoordBBox(ijk.offsetBy(-1), ijk.offsetBy(1)).begin(); beside; ++beside) {
            if (access.getValue(*beside) >= kHalf) return false;
        }
        return true;
    };
    std::vector<Coord> thin;
    for (auto on = blocks.cbeginValueOn(); on; ++on) {
        if (*on < kHalf && isThin(on.getCoord())) thin.push_back(on.getCoord());
    }
    for (const Coord& ijk : thin) blocks.setValueOn(ijk, 1.0f);
}

/// @return about how many faces of blocks have nothing on their other side. Of a large tile whose
///         sides are partly covered it is a guess.
int64_t openFaces(const FloatTree& blocks)
{
    openvdb::tree::ValueAccessor<const FloatTree> access(blocks);
    int64_t faces = 0;
    for (auto on = blocks.cbeginValueOn(); on; ++on) {
        const CoordBBox box = on.getBoundingBox();
        const int64_t side = box.dim()[0];
        const Coord middle = box.min().offsetBy(int(side / 2));
        for (int axis = 0; axis < 3; ++axis) {
            Coord below = middle, above = middle;
            below[axis] = box.min()[axis] - 1;
            above[axis] = box.max()[axis] + 1;
            for (const Coord& beside : {below, above}) {
                if (!access.isValueOn(beside)) faces += side * side;
            }
        }
    }
    return faces;
}

/// @return the voxels of blocks that are at least half full.
double voxelsIn(const FloatTree& blocks, int shift)
{
    double filled = 0;
    for (auto on = blocks.cbeginValueOn(); on; ++on) {
        if (*on >= kHalf) filled += double(on.getVoxelCount());
    }
    return filled * std::pow(8.0, shift);
}

/// @return a surface whose points are in blocks from the base.
ObjectSurface meshOf(FloatTree::Ptr blocks, int shift)
{
    ObjectSurface surface;
    surface.factor = 1 << shift;
    const auto grid = openvdb::FloatGrid::create(std::move(blocks));
    openvdb::tools::volumeToMesh(*grid, surface.points, surface.quads, kHalf);
    return surface;
}

/// Turns points from blocks into world units around the middle of the object, and quads so that they
/// turn left as seen from outside.
void placeInWorld(ObjectSurface& surface, const openvdb::BoolGrid& object, const CoordBBox& box,
    const Coord& base)
{
    const Vec3d middle = (box.min().asVec3d() + box.max().asVec3d()) / 2;
    surface.originWorld = object.transform().indexToWorld(middle);
    const auto map = object.transform().baseMap();
    const double factor = surface.factor;
    const Vec3d shift = base.asVec3d() - middle + Vec3d((factor - 1) / 2);
    for (openvdb::Vec3s& point : surface.points) {
        point = openvdb::Vec3s(map->applyJacobian(factor * Vec3d(point) + shift));
    }
    const bool isMirrored = map->determinant() < 0;
    if (isMirrored) return; // OpenVDB's turn left around what is less than one half
    for (openvdb::Vec4I& quad : surface.quads) std::swap(quad[1], quad[3]);
}

} // namespace

std::optional<ObjectSurface> objectSurface(
    const openvdb::BoolGrid& object, int64_t triangles, openvdb::util::NullInterrupter* interrupter)
{
    const CoordBBox box = object.evalActiveVoxelBoundingBox();
    const Coord base = baseOf(box);
    // Twice as many as wanted are tried: the guess may be too high.
    int shift = leastShiftOf(box);
    const FloatTree::Ptr leaves = blocksOf(object.tree(), base, kLeafShift, interrupter);
    for (double quads = 64.0 * double(openFaces(*leaves)); quads > double(triangles); quads /= 4) {
        ++shift;
    }
    for (; shift <= kMaxShift; ++shift) {
        checkInterrupt(interrupter);
        const FloatTree::Ptr blocks = blocksOf(object.tree(), base, shift, interrupter);
        fillThinParts(*blocks);
        const double voxels = voxelsIn(*blocks, shift);
        ObjectSurface surface = meshOf(blocks, shift);
        if (2 * int64_t(surface.quads.size()) > triangles) continue;
        surface.growth = voxels / double(object.activeVoxelCount());
        placeInWorld(surface, object, box, base);
        return surface;
    }
    return std::nullopt;
}

} // namespace openvdb_spheretree::detail
