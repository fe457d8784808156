// SPDX-License-Identifier: Apache-2.0
#include "BlockModel.h"

#include "OrPyramid.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>

#include <memory>
#include <utility>
#include <vector>

namespace openvdb_spheretree {

using detail::LeafNode;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using openvdb::util::NullInterrupter;

namespace {

using Accessor = openvdb::tree::ValueAccessor<const MaskTree>;

/// The size of the tile, on or off, or of the leaf that @a ijk lies in.
int cubeSize(const Accessor& accessor, const Coord& ijk)
{
    switch (accessor.getValueDepth(ijk)) {
    case 3:
    case 2: return 8;
    case 1: return 128;
    default: return 4096; // of the root, or nothing
    }
}

int64_t countInLeaf(const LeafNode& leaf, const CoordBBox& box)
{
    if (box.volume() == LeafNode::SIZE) return int64_t(leaf.onVoxelCount());
    int64_t count = 0;
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) count += box.isInside(voxel.getCoord());
    return count;
}

/// On voxels in a box, by cubes of @a size that are cut further where nodes are smaller.
int64_t countOn(const Accessor& accessor, const CoordBBox& box, int size)
{
    int64_t count = 0;
    const Coord first = box.min() & ~(size - 1);
    for (int x = first[0]; x <= box.max()[0]; x += size) {
        for (int y = first[1]; y <= box.max()[1]; y += size) {
            for (int z = first[2]; z <= box.max()[2]; z += size) {
                CoordBBox part = CoordBBox::createCube(Coord(x, y, z), size);
                part.intersect(box);
                const LeafNode* leaf = accessor.probeConstLeaf(part.min());
                if (size == 8 && leaf) {
                    count += countInLeaf(*leaf, part);
                } else if (cubeSize(accessor, part.min()) < size) {
                    count += countOn(accessor, part, size == 4096 ? 128 : 8);
                } else if (accessor.isValueOn(part.min())) {
                    count += int64_t(part.volume());
                }
            }
        }
    }
    return count;
}

/// The voxels that the function decides: those next to an on voxel of the OR model.
MaskTree::Ptr candidatesOf(const MaskTree& orLevel)
{
    using namespace openvdb::tools;
    auto result = std::make_shared<MaskTree>(orLevel);
    dilateActiveValues(*result, 1, NN_FACE_EDGE_VERTEX, IGNORE_TILES);
    detail::forEachTile(orLevel, [&](const CoordBBox& box) {
        result->sparseFill(CoordBBox(box.min() - Coord(1), box.max() + Coord(1)), true);
    });
    return result;
}

} // namespace

int64_t ChildBlock::count() const
{
    Coord last = mFirst.offsetBy(mStep->factor - 1);
    if (mStep->dim == 2) last[2] = mFirst[2];
    return countOn(*mChildren, CoordBBox(mFirst, last), 4096);
}

bool ChildBlock::any(int x, int y, int z) const
{
    return mOr->isValueOn(mParent.offsetBy(x, y, z));
}

/// Evaluates the function in the voxels of a leaf.
class BlockEvaluator {
public:
    const Accessor children, orLevel;
    const PyramidStep& step;
    const CoordBBox& box; ///< of the OR level: with dim = 2 its planes are all there is

    /// Keeps those on voxels of @a leaf on for which the function is true.
    void decide(LeafNode& leaf, const std::function<bool(const ChildBlock&)>& isOn) const
    {
        ChildBlock block;
        block.mStep = &step;
        block.mChildren = &children;
        block.mOr = &orLevel;
        LeafNode::NodeMaskType decided;
        for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) {
            const Coord ijk = voxel.getCoord();
            const int f = step.factor;
            if (step.dim == 2 && (ijk[2] < box.min()[2] || ijk[2] > box.max()[2])) continue;
            block.mParent = ijk;
            block.mFirst =
                step.origin + Coord(f * ijk[0], f * ijk[1], step.dim == 2 ? ijk[2] : f * ijk[2]);
            if (isOn(block)) decided.setOn(voxel.pos());
        }
        leaf.setValueMask(decided);
    }
};

PyramidModel blockModel(std::function<bool(const ChildBlock&)> isOn, NullInterrupter* interrupter)
{
    return [isOn = std::move(isOn), interrupter](const MaskTree& level, const PyramidStep& step) {
        const MaskTree::Ptr orLevel = coarsen(level, step, interrupter);
        const MaskTree::Ptr candidates = candidatesOf(*orLevel);
        // Tiles of the OR level are on as they are; all others are cut up.
        MaskTree tiles(*orLevel);
        for (auto leaf = orLevel->cbeginLeaf(); leaf; ++leaf) {
            tiles.addTile(1, leaf->origin(), false, false);
        }
        candidates->topologyDifference(tiles);
        candidates->voxelizeActiveTiles();
        CoordBBox box;
        orLevel->evalActiveVoxelBoundingBox(box);
        std::vector<LeafNode*> leaves;
        candidates->getNodes(leaves);
        detail::parallelFor(leaves.size(), interrupter, [&](std::size_t i) {
            BlockEvaluator{Accessor(level), Accessor(*orLevel), step, box}.decide(*leaves[i], isOn);
        });
        candidates->topologyUnion(tiles);
        openvdb::tools::prune(*candidates);
        return candidates;
    };
}

} // namespace openvdb_spheretree
