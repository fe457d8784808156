// SPDX-License-Identifier: Apache-2.0
#include "OrPyramid.h"

#include "LeafLayout.h"
#include "SphereTreeSettings.h"
#include "detail/Parallel.h"

#include <openvdb/Exceptions.h>
#include <openvdb/tools/Prune.h>

#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <memory>

namespace openvdb_spheretree {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using openvdb::util::NullInterrupter;
using MaskLeaf = MaskTree::LeafNodeType;

/// The widest object ends on level 28; an including model may take a few more.
constexpr std::size_t kMaxLevels = 40;

int floorDiv(int a, int b) { return a >= 0 ? a / b : -((-int64_t(a) + b - 1) / b); }

/// A cube of the finer level: a leaf with its mask, or a tile (mask null).
struct Cell {
    Coord parent; ///< origin of the cube of the same size, one level up, that takes it in
    Coord octant; ///< 0 or 1 per axis: which eighth of that cube it becomes
    const MaskLeaf* leaf;
};

/// The cells of one size, by the cube they go into.
struct Cells {
    int size;
    std::vector<Cell> cells;
    std::vector<std::size_t> groupBegin; ///< where a new parent starts, and the count at the end
};

Cell makeCell(const Coord& origin, int size, const Coord& pyramidOrigin, const MaskLeaf* leaf)
{
    Cell cell{{}, {}, leaf};
    for (int axis = 0; axis < 3; ++axis) {
        // Half the cell's place, as a cube of half its size. That is a multiple of size / 2, unless
        // the pyramid's origin is no multiple of the tile size (then the caller fills boxes).
        const int half = (origin[axis] - pyramidOrigin[axis]) / 2;
        cell.parent[axis] = floorDiv(half, size) * size;
        cell.octant[axis] = (half - cell.parent[axis]) / (size / 2);
    }
    return cell;
}

void groupByParent(Cells& cells)
{
    tbb::parallel_sort(cells.cells.begin(), cells.cells.end(), [](const Cell& a, const Cell& b) {
        return a.parent != b.parent ? a.parent < b.parent : a.octant < b.octant;
    });
    for (std::size_t i = 0; i < cells.cells.size(); ++i) {
        if (i == 0 || cells.cells[i].parent != cells.cells[i - 1].parent) {
            cells.groupBegin.push_back(i);
        }
    }
    cells.groupBegin.push_back(cells.cells.size());
}

/// The mask of a leaf at half resolution: bit 8 y + z of word x for x, y, z in [0, 4).
std::array<uint64_t, 4> halved(const MaskLeaf& leaf)
{
    std::array<uint64_t, 4> result{};
    for (uint32_t x = 0; x < 4; ++x) {
        uint64_t word = leaf.getValueMask().getWord<uint64_t>(2 * x)
            | leaf.getValueMask().getWord<uint64_t>(2 * x + 1);
        word |= word >> 8;             // OR of y pairs, in even rows
        word |= word >> 1;             // OR of z pairs, in even bits
        word &= 0x0055005500550055ull; // rows 0, 2, 4, 6; bits 0, 2, 4, 6
        word = (word | word >> 1) & 0x0033003300330033ull;
        word = (word | word >> 2) & 0x000f000f000f000full; // four bits a row
        word = (word | word >> 8) & 0x00000f0f00000f0full; // rows to bytes 0 and 1, 4 and 5
        result[x] = (word | word >> 16) & 0x0f0f0f0full;
    }
    return result;
}

/// The leaf that up to eight leaves or leaf-sized tiles make.
MaskLeaf::NodeMaskType joinLeaves(const Cell* begin, const Cell* end)
{
    MaskLeaf::NodeMaskType mask;
    for (const Cell* cell = begin; cell != end; ++cell) {
        std::array<uint64_t, 4> half;
        half.fill(0x0f0f0f0full);
        if (cell->leaf) half = halved(*cell->leaf);
        const int shift = 32 * cell->octant[1] + 4 * cell->octant[2];
        for (uint32_t x = 0; x < 4; ++x) {
            mask.getWord<uint64_t>(4 * uint32_t(cell->octant[0]) + x) |= half[x] << shift;
        }
    }
    return mask;
}

void addLeaves(Cells& cells, MaskTree& result, NullInterrupter* interrupter)
{
    groupByParent(cells);
    const std::size_t groups = cells.groupBegin.size() - 1;
    std::vector<std::unique_ptr<MaskLeaf>> leaves(groups);
    detail::parallelFor(groups, interrupter, [&](std::size_t i) {
        const Cell* begin = cells.cells.data() + cells.groupBegin[i];
        const Cell* end = cells.cells.data() + cells.groupBegin[i + 1];
        leaves[i] = std::make_unique<MaskLeaf>(begin->parent, false);
        leaves[i]->setValueMask(joinLeaves(begin, end));
    });
    for (auto& leaf : leaves) {
        if (leaf->isDense()) result.addTile(1, leaf->origin(), true, true);
        else result.addLeaf(leaf.release());
    }
}

void addTiles(Cells& cells, MaskTree& result)
{
    groupByParent(cells);
    const int half = cells.size / 2;
    for (std::size_t i = 0; i + 1 < cells.groupBegin.size(); ++i) {
        const Cell* begin = cells.cells.data() + cells.groupBegin[i];
        const Cell* end = cells.cells.data() + cells.groupBegin[i + 1];
        if (end - begin == 8) {
            result.fill(CoordBBox::createCube(begin->parent, cells.size), true, true);
            continue;
        }
        for (const Cell* cell = begin; cell != end; ++cell) {
            const Coord at = cell->parent
                + Coord(half * cell->octant[0], half * cell->octant[1], half * cell->octant[2]);
            result.fill(CoordBBox::createCube(at, half), true, true);
        }
    }
}

/// Factor 2 in three dimensions: whole leaves and tiles at a time.
MaskTree::Ptr coarsenByLeaves(
    const MaskTree& level, const PyramidStep& step, NullInterrupter* interrupter)
{
    Cells leaves{8, {}, {}};
    for (auto it = level.cbeginLeaf(); it; ++it) {
        if (!it->isEmpty()) leaves.cells.push_back(makeCell(it->origin(), 8, step.origin, &*it));
    }
    std::vector<Cells> tiles;
    std::vector<CoordBBox> boxes; // tiles that the pyramid's origin cuts
    auto tile = level.cbeginValueOn();
    tile.setMaxDepth(MaskTree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        CoordBBox box;
        tile.getBoundingBox(box);
        const int size = box.extents()[0];
        if (size == 8) {
            leaves.cells.push_back(makeCell(box.min(), 8, step.origin, nullptr));
        } else if (((step.origin & (size - 1)) != Coord())) {
            boxes.emplace_back(step.parentVoxel(box.min()), step.parentVoxel(box.max()));
        } else {
            auto same = std::find_if(
                tiles.begin(), tiles.end(), [&](const Cells& c) { return c.size == size; });
            if (same == tiles.end()) same = tiles.insert(tiles.end(), Cells{size, {}, {}});
            same->cells.push_back(makeCell(box.min(), size, step.origin, nullptr));
        }
    }
    auto result = std::make_shared<MaskTree>(false);
    addLeaves(leaves, *result, interrupter);
    for (Cells& cells : tiles) addTiles(cells, *result);
    for (const CoordBBox& box : boxes) result->fill(box, true, true);
    return result;
}

/// Any factor and dimension: voxel by voxel, tiles as boxes.
MaskTree::Ptr coarsenByVoxels(
    const MaskTree& level, const PyramidStep& step, NullInterrupter* interrupter)
{
    std::vector<const MaskLeaf*> leaves;
    for (auto it = level.cbeginLeaf(); it; ++it) leaves.push_back(&*it);
    using Range = tbb::blocked_range<std::size_t>;
    const auto addRange = [&](const Range& range, MaskTree::Ptr part) {
        detail::checkInterrupt(interrupter);
        if (!part) part = std::make_shared<MaskTree>(false);
        openvdb::tree::ValueAccessor<MaskTree> accessor(*part);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            for (auto voxel = leaves[i]->cbeginValueOn(); voxel; ++voxel) {
                accessor.setValueOn(step.parentVoxel(voxel.getCoord()));
            }
        }
        return part;
    };
    const auto join = [](MaskTree::Ptr a, const MaskTree::Ptr& b) {
        if (!a) return b;
        if (b) a->topologyUnion(*b);
        return a;
    };
    MaskTree::Ptr result =
        tbb::parallel_reduce(Range(0, leaves.size(), 64), MaskTree::Ptr(), addRange, join);
    if (!result) result = std::make_shared<MaskTree>(false);

    auto tile = level.cbeginValueOn();
    tile.setMaxDepth(MaskTree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        CoordBBox box;
        tile.getBoundingBox(box);
        result->fill({step.parentVoxel(box.min()), step.parentVoxel(box.max())}, true, true);
    }
    return result;
}

/// @throw openvdb::ValueError unless @a result has every voxel of the OR model.
void requireIncluding(
    const MaskTree& level, const MaskTree& result, const PyramidStep& step, NullInterrupter* i)
{
    MaskTree::Ptr lost = coarsen(level, step, i);
    lost->topologyDifference(result);
    if (lost->activeVoxelCount() == 0) return;
    CoordBBox box;
    lost->evalActiveVoxelBoundingBox(box);
    OPENVDB_THROW(openvdb::ValueError,
        "the pyramid model is not including: it leaves out "
            << lost->activeVoxelCount() << " voxels with a child that is on, in the box " << box);
}

} // namespace

Coord PyramidStep::parentVoxel(const Coord& ijk) const
{
    return Coord(floorDiv(ijk[0] - origin[0], factor), floorDiv(ijk[1] - origin[1], factor),
        dim == 2 ? ijk[2] - origin[2] : floorDiv(ijk[2] - origin[2], factor));
}

MaskTree::Ptr coarsen(const MaskTree& level, const PyramidStep& step, NullInterrupter* interrupter)
{
    const bool wholeLeaves = step.factor == 2 && step.dim == 3 && (step.origin & 7) == Coord();
    const MaskTree::Ptr result = wholeLeaves ? coarsenByLeaves(level, step, interrupter)
                                             : coarsenByVoxels(level, step, interrupter);
    openvdb::tools::prune(*result); // boxes may have filled leaves, leaves internal nodes
    return result;
}

Coord pyramidOrigin(const CoordBBox& bbox)
{
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t extent = int64_t(bbox.max()[axis]) - bbox.min()[axis] + 1;
        if (extent > kMaxExtent) {
            OPENVDB_THROW(openvdb::ValueError,
                "the object is " << extent << " voxels wide along "
                                 << "xyz"[axis]
                                 << ", more than 2^28: use a larger voxel, or split the object");
        }
    }
    return bbox.min() & ~7;
}

OrPyramid buildOrPyramid(const openvdb::BoolGrid& object, int factor, int dim,
    NullInterrupter* interrupter, const PyramidModel& model)
{
    OrPyramid pyramid;
    pyramid.levels.push_back(
        std::make_shared<MaskTree>(object.tree(), false, openvdb::TopologyCopy()));
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
                "shrink, or the object is more than one voxel thick along z with dim=2");
        }
        const MaskTree& level = *pyramid.levels.back();
        MaskTree::Ptr next = model ? model(level, step) : coarsen(level, step, interrupter);
        if (model) requireIncluding(level, *next, step, interrupter);
        pyramid.levels.push_back(next);
        step.origin = Coord();
    }
    return pyramid;
}

} // namespace openvdb_spheretree
