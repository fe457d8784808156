// SPDX-License-Identifier: Apache-2.0
#include "OrPyramid.h"

#include "LeafCoarsener.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/ParallelSort.h>
#include <openvdb_spheretree/voxel/Dimension.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/Exceptions.h>
#include <openvdb/tools/Prune.h>

#include <memory>

namespace openvdb_spheretree {

namespace {

using detail::floorDiv;
using detail::LeafCoarsener;
using detail::LeafNode;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using openvdb::util::NullInterrupter;

/// The widest object ends on level 28; an including model may take a few more.
constexpr std::size_t kMaxLevels = 40;

/// Leaves of the finer level, or tiles as large (node null), by the leaf that takes them in: one
/// entry for each such leaf.
struct LeafPart {
    Coord parent; ///< origin of the leaf of the next level
    Coord origin; ///< of the leaf of this level
    const LeafNode* node;
};

/// A larger tile.
struct TilePart {
    CoordBBox parents; ///< its voxels on the next level
    int size;          ///< of the tile
    /// Origin of the cube of the tile's size, on the next level, that holds all parents, if nothing
    /// else has a share in these; otherwise the tile is alone.
    Coord cube;
    bool alone;

    bool operator<(const TilePart& other) const
    {
        if (alone != other.alone) return alone < other.alone;
        if (size != other.size) return size < other.size;
        return cube != other.cube ? cube < other.cube : parents.min() < other.parents.min();
    }
    bool sharesCube(const TilePart& other) const
    {
        return !alone && !other.alone && size == other.size && cube == other.cube;
    }
};

struct Parts {
    std::vector<LeafPart> leaves;
    std::vector<TilePart> tiles;
};

void addLeafPart(
    Parts& parts, const LeafCoarsener& coarsener, const Coord& origin, const LeafNode* node)
{
    const CoordBBox range = coarsener.parentLeaves(origin);
    const Coord first = range.min(), last = range.max();
    for (int x = first[0]; x <= last[0]; x += 8) {
        for (int y = first[1]; y <= last[1]; y += 8) {
            for (int z = first[2]; z <= last[2]; z += 8) {
                parts.leaves.push_back({Coord(x, y, z), origin, node});
            }
        }
    }
}

TilePart tilePart(const CoordBBox& tile, const PyramidStep& step)
{
    TilePart part;
    part.size = tile.max()[0] - tile.min()[0] + 1;
    part.parents = CoordBBox(step.parentVoxel(tile.min()), step.parentVoxel(tile.max()));
    part.cube = part.parents.min() & ~(part.size - 1);
    part.alone = part.cube != (part.parents.max() & ~(part.size - 1));
    for (int axis = 0; axis < step.dim; ++axis) {
        const int at = tile.min()[axis] - step.origin[axis];
        if (at % step.factor != 0 || part.size % step.factor != 0) part.alone = true;
    }
    return part;
}

Parts collectParts(const MaskTree& level, const LeafCoarsener& coarsener, const PyramidStep& step)
{
    Parts parts;
    parts.leaves.reserve(level.leafCount());
    for (auto it = level.cbeginLeaf(); it; ++it) {
        if (!it->isEmpty()) addLeafPart(parts, coarsener, it->origin(), &*it);
    }
    detail::forEachTile(level, [&](const CoordBBox& box) {
        if (box.max()[0] - box.min()[0] == 7) {
            addLeafPart(parts, coarsener, box.min(), nullptr);
        } else {
            parts.tiles.push_back(tilePart(box, step));
        }
    });
    return parts;
}

void joinLeaves(std::vector<LeafPart>& parts, const LeafCoarsener& coarsener, MaskTree& result,
    NullInterrupter* interrupter)
{
    detail::parallelSort(parts.begin(), parts.end(), interrupter,
        [](const LeafPart& a, const LeafPart& b) { return a.parent < b.parent; });
    std::vector<std::size_t> begins; // of groups with the same parent, and the end of the last
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i == 0 || parts[i].parent != parts[i - 1].parent) begins.push_back(i);
    }
    begins.push_back(parts.size());
    std::vector<std::unique_ptr<LeafNode>> leaves(begins.size() - 1);
    detail::parallelFor(leaves.size(), interrupter, [&](std::size_t i) {
        LeafMask joined{};
        for (std::size_t k = begins[i]; k < begins[i + 1]; ++k) {
            const LeafNode* const node = parts[k].node;
            const LeafMask mask = node ? LeafMask::from(node->getValueMask()) : LeafMask::full();
            coarsener.add(mask, parts[k].origin, parts[k].parent, joined);
        }
        leaves[i] = std::make_unique<LeafNode>(parts[begins[i]].parent, false);
        joined.copyTo(leaves[i]->getValueMask());
    });
    for (auto& leaf : leaves) {
        if (leaf->isDense()) result.addTile(1, leaf->origin(), true, true);
        else if (!leaf->isEmpty()) result.addLeaf(leaf.release());
    }
}

/// Tiles that fill a cube of their own size together become a tile at once: one box at a time would
/// first make small tiles of it, 4096 a cube.
void joinTiles(std::vector<TilePart>& tiles, MaskTree& result, NullInterrupter* interrupter)
{
    detail::parallelSort(tiles.begin(), tiles.end(), interrupter);
    for (auto begin = tiles.begin(); begin != tiles.end();) {
        detail::checkInterrupt(interrupter);
        auto end = begin + 1;
        openvdb::Index64 voxels = begin->parents.volume();
        for (; end != tiles.end() && end->sharesCube(*begin); ++end) {
            voxels += end->parents.volume();
        }
        const CoordBBox cube = CoordBBox::createCube(begin->cube, begin->size);
        if (!begin->alone && voxels == cube.volume()) {
            result.fill(cube, true, true);
        } else {
            for (auto tile = begin; tile != end; ++tile) result.fill(tile->parents, true, true);
        }
        begin = end;
    }
}

/// @throw openvdb::ValueError unless @a result has every voxel of the OR model and, with dim = 2,
///        is no thicker than it.
void requireIncluding(
    const MaskTree& level, const MaskTree& result, const PyramidStep& step, NullInterrupter* stop)
{
    const MaskTree::Ptr needed = coarsen(level, step, stop);
    const detail::MaskDifference lost = detail::maskDifference(*needed, result, stop);
    if (lost.voxels > 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "the pyramid model is not including: it leaves out "
                << lost.voxels << (lost.voxels == 1 ? " voxel" : " voxels")
                << " with a child that is on (first: " << lost.cubes.front().first() << ')');
    }
    if (step.dim == 3) return;
    CoordBBox all, most;
    result.evalActiveVoxelBoundingBox(all);
    needed->evalActiveVoxelBoundingBox(most);
    if (all.min()[2] >= most.min()[2] && all.max()[2] <= most.max()[2]) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the pyramid model adds voxels along z, which takes no part with dim=2: they lie in "
            << all << ", the object's in " << most);
}

} // namespace

void requireFactor(int factor)
{
    if (factor >= 2 && factor <= kMaxFactor) return;
    OPENVDB_THROW(openvdb::ValueError,
        "factor=" << factor << " is out of range: it must be 2 to " << kMaxFactor);
}

Coord PyramidStep::parentVoxel(const Coord& ijk) const
{
    const Coord from = ijk - origin;
    if (factor == 2) return Coord(from[0] >> 1, from[1] >> 1, dim == 2 ? from[2] : from[2] >> 1);
    return Coord(floorDiv(from[0], factor), floorDiv(from[1], factor),
        dim == 2 ? from[2] : floorDiv(from[2], factor));
}

MaskTree::Ptr coarsen(const MaskTree& level, const PyramidStep& step, NullInterrupter* interrupter)
{
    const LeafCoarsener coarsener(step);
    Parts parts = collectParts(level, coarsener, step);
    auto result = std::make_shared<MaskTree>(false);
    joinLeaves(parts.leaves, coarsener, *result, interrupter);
    joinTiles(parts.tiles, *result, interrupter);
    openvdb::tools::prune(*result); // boxes may have filled leaves, leaves internal nodes
    return result;
}

MaskTree::Ptr nextLevel(const MaskTree& level, const PyramidStep& step, const PyramidModel& model,
    NullInterrupter* interrupter)
{
    if (!model) return coarsen(level, step, interrupter);
    const MaskTree::Ptr result = model(level, step);
    if (!result) OPENVDB_THROW(openvdb::ValueError, "the pyramid model gave no voxels: null");
    requireIncluding(level, *result, step, interrupter);
    return result;
}

Coord pyramidOrigin(const CoordBBox& bbox)
{
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t extent = int64_t(bbox.max()[axis]) - bbox.min()[axis] + 1;
        if (extent > kMaxExtent) {
            OPENVDB_THROW(openvdb::ValueError,
                "the object is " << extent << " voxels wide along "
                                 << "xyz"[axis] << ", more than 2^" << kMaxExtentBits
                                 << ": use a larger voxel, or split the object");
        }
    }
    return bbox.min() & ~7;
}

Coord pyramidOrigin(const CoordBBox& bbox, const Coord& wanted, std::optional<int> flatAxis)
{
    Coord origin = pyramidOrigin(bbox);
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == flatAxis) continue;
        const int64_t reach = int64_t(bbox.max()[axis]) - wanted[axis] + 1;
        if (wanted[axis] <= bbox.min()[axis] && reach <= kMaxExtent) {
            origin[axis] = wanted[axis];
            continue;
        }
        OPENVDB_THROW(openvdb::ValueError,
            "origin=" << wanted[0] << ',' << wanted[1] << ',' << wanted[2]
                      << " does not suit the object, which reaches from voxel " << bbox.min()
                      << " to " << bbox.max()
                      << ": along each axis it must be no higher than the first of these, and no "
                         "more than 2^28 voxels from the last");
    }
    return origin;
}

OrPyramid buildOrPyramid(const openvdb::BoolGrid& object, int factor, int dim,
    const PyramidModel& model, NullInterrupter* interrupter)
{
    const FlatAxis flat = flatAxisOf(object, dim);
    OrPyramid pyramid;
    pyramid.levels.push_back(voxelsOf(object, flat));
    CoordBBox bbox;
    if (!pyramid.levels[0]->evalActiveVoxelBoundingBox(bbox)) {
        OPENVDB_THROW(openvdb::ValueError, "the object has no voxels");
    }
    pyramid.origin = pyramidOrigin(bbox);
    requireFactor(factor);
    requireDim(dim);
    PyramidStep step{pyramid.origin, factor, dim};
    while (pyramid.levels.back()->activeVoxelCount() > 1) {
        if (pyramid.levels.size() > kMaxLevels) {
            OPENVDB_THROW(openvdb::ValueError,
                "the pyramid does not end at one voxel: the model grows levels as fast as they "
                "shrink, or the object is more than one voxel thick along every axis with dim=2");
        }
        const MaskTree& level = *pyramid.levels.back();
        pyramid.levels.push_back(nextLevel(level, step, model, interrupter));
        step.origin = Coord();
    }
    pyramid.origin = flat.fromZ(pyramid.origin);
    for (MaskTree::Ptr& level : pyramid.levels) level = flat.fromZ(level);
    return pyramid;
}

} // namespace openvdb_spheretree
