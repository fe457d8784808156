// SPDX-License-Identifier: Apache-2.0
#include "TrilinearCover.h"

#include "LeafValues.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tree/ValueAccessor.h>

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using MaskReader = openvdb::tree::ValueAccessor<const MaskTree>;

// ---- Which leaf nodes there must be

/// Calls f(dx, dy, dz) for the 26 steps to a neighbour.
template <typename F>
void forEachStep(const F& f)
{
    for (int i = 0; i < 27; ++i) {
        if (i != 13) f(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
    }
}

/// Whether any voxel of the leaf lies on its side (or edge, or corner) in a direction.
bool reaches(const LeafMask& mask, int dx, int dy, int dz)
{
    uint64_t plane = dx < 0 ? mask[0] : mask[7];
    if (dx == 0) {
        for (const uint64_t word : mask) plane |= word;
    }
    if (dy != 0) plane &= dy < 0 ? 0xffull : 0xffull << 56;
    if (dz != 0) plane &= 0x0101010101010101ull << (dz < 0 ? 0 : 7);
    return plane != 0;
}

/// The places of leaf nodes that touch a tile from outside and lie in no tile themselves. Tiles may
/// hold 10^8 leaf places, so whole tiles beside it are passed over at once: node by node of 4096^3,
/// then 128^3 voxels.
template <typename Visit>
class TilePlaces {
public:
    TilePlaces(const MaskReader& mask, const CoordBBox& tile, const Visit& visit)
        : mMask(mask), mTile(tile), mAround(tile), mVisit(visit)
    {
        mAround.expand(kLeafDim);
        forEachStep([&](int dx, int dy, int dz) {
            const auto side = int(sidesOf(tile)[0]);
            visitNode(tile.min().offsetBy(dx * side, dy * side, dz * side), side);
        });
    }

private:
    void visitNode(const Coord& origin, int side)
    {
        if (isTile(origin, side)) return;
        if (side == kLeafDim) return mVisit(origin);
        const int below = side == int(UpperNode::DIM) ? int(LowerNode::DIM) : kLeafDim;
        CoordBBox box = CoordBBox::createCube(origin, side);
        box.intersect(mAround);
        const Coord first = box.min() & ~(below - 1);
        for (int x = first[0]; x <= box.max()[0]; x += below) {
            for (int y = first[1]; y <= box.max()[1]; y += below) {
                for (int z = first[2]; z <= box.max()[2]; z += below) {
                    visitNode(Coord(x, y, z), below);
                }
            }
        }
    }

    /// Whether an active tile covers the node.
    bool isTile(const Coord& origin, int side) const
    {
        const int depth = mMask.getValueDepth(origin); // 0: a tile of the root, 3: a voxel
        const int depthOfNode = side == kLeafDim ? 2 : side == int(LowerNode::DIM) ? 1 : 0;
        return depth >= 0 && depth <= depthOfNode && mMask.isValueOn(origin);
    }

    const MaskReader& mMask;
    const CoordBBox mTile;
    CoordBBox mAround;
    const Visit& mVisit;
};

/// Calls visit(tile, place) for every active tile and each such place beside it.
template <typename Visit>
void forEachTilePlace(
    const MaskTree& mask, openvdb::util::NullInterrupter* interrupter, const Visit& visit)
{
    std::vector<CoordBBox> tiles;
    forEachTile(mask, [&](const CoordBBox& box) { tiles.push_back(box); });
    parallelFor(tiles.size(), interrupter, [&](std::size_t i) {
        const MaskReader reader(mask);
        const auto visitPlace = [&](const Coord& place) { visit(reader, tiles[i], place); };
        TilePlaces<decltype(visitPlace)>(reader, tiles[i], visitPlace);
    });
}

/// Places of leaf nodes, found by many threads.
class Places {
public:
    void add(const Coord& place) { mFound.local().push_back(place); }

    /// @return whether there are any. Tiles there are cut into leaf nodes.
    bool makeLeaves(MaskTree& mask)
    {
        bool any = false;
        openvdb::tree::ValueAccessor<MaskTree> writer(mask);
        for (const auto& places : mFound) {
            for (const Coord& place : places) writer.touchLeaf(place);
            any |= !places.empty();
        }
        return any;
    }

private:
    tbb::enumerable_thread_specific<std::vector<Coord>> mFound;
};

/// Leaf nodes for all voxels beside those of the mask.
void makeLeavesAround(MaskTree& mask, openvdb::util::NullInterrupter* interrupter)
{
    Places places;
    std::vector<const LeafNode*> leaves;
    const MaskTree& before = mask;
    before.getNodes(leaves);
    const auto makeReader = [&] { return MaskReader(before); };
    parallelForWith(leaves.size(), interrupter, makeReader, [&](std::size_t i, MaskReader& reader) {
        const LeafMask voxels = LeafMask::from(leaves[i]->getValueMask());
        forEachStep([&](int dx, int dy, int dz) {
            if (!reaches(voxels, dx, dy, dz)) return;
            const Coord place =
                leaves[i]->origin().offsetBy(dx * kLeafDim, dy * kLeafDim, dz * kLeafDim);
            if (!reader.probeConstLeaf(place) && !reader.isValueOn(place)) places.add(place);
        });
    });
    forEachTilePlace(
        before, interrupter, [&](const MaskReader& reader, const CoordBBox&, const Coord& place) {
            if (!reader.probeConstLeaf(place)) places.add(place);
        });
    places.makeLeaves(mask);
}

/// Leaf nodes in tiles of the mask, beside places that are not all on.
/// @return whether any tile has been cut.
bool cutTileBorders(MaskTree& mask, openvdb::util::NullInterrupter* interrupter)
{
    Places places;
    const MaskTree& before = mask;
    forEachTilePlace(before, interrupter,
        [&](const MaskReader& reader, const CoordBBox& tile, const Coord& place) {
            const LeafNode* leaf = reader.probeConstLeaf(place);
            if (leaf && leaf->getValueMask().isOn()) return;
            forEachStep([&](int dx, int dy, int dz) {
                const Coord inside = place.offsetBy(dx * kLeafDim, dy * kLeafDim, dz * kLeafDim);
                if (tile.isInside(inside)) places.add(inside);
            });
        });
    return places.makeLeaves(mask);
}

// ---- The values in and around a leaf

constexpr int kSide = kLeafDim + 2;
constexpr int kSamples = kSide * kSide * kSide;

constexpr int sampleIndex(int x, int y, int z) { return (x * kSide + y) * kSide + z; }

/// The samples of 10^3 voxels, from one before a leaf to one behind it.
template <typename TreeT>
class SampleBlock {
public:
    using ValueT = typename TreeT::ValueType;

    explicit SampleBlock(const TreeT& tree) : mReader(tree), mLoaded(kSlots) {}

    const ValueT* gather(const Coord& origin)
    {
        for (int i = 0; i < 27; ++i) gatherFrom(origin, i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
        return mSamples.data();
    }

private:
    using Leaf = typename TreeT::LeafNodeType;

    struct Loaded {
        const Leaf* leaf = nullptr;
        std::unique_ptr<LeafValues<Leaf>> values;
    };
    // Three planes of a node of 16^3 leaf nodes, which come one after the other, and one more.
    static constexpr std::size_t kSlots = 4 * 16 * 16;

    struct Span {
        int first, last; ///< of the block
        int offset;      ///< from there to the leaf's coordinates
    };
    static Span spanOf(int step)
    {
        if (step == 0) return {1, kLeafDim, -1};
        return step < 0 ? Span{0, 0, kLeafDim - 1} : Span{kSide - 1, kSide - 1, 1 - kSide};
    }

    void gatherFrom(const Coord& origin, int dx, int dy, int dz)
    {
        const Coord place = origin.offsetBy(dx * kLeafDim, dy * kLeafDim, dz * kLeafDim);
        const Leaf* const leaf = mReader.probeConstLeaf(place);
        const ValueT* const values = leaf ? valuesOf(*leaf) : nullptr;
        const ValueT tile = leaf ? ValueT() : mReader.getValue(place);
        const Span xs = spanOf(dx), ys = spanOf(dy), zs = spanOf(dz);
        for (int x = xs.first; x <= xs.last; ++x) {
            for (int y = ys.first; y <= ys.last; ++y) {
                const int row = (x + xs.offset) << 6 | (y + ys.offset) << 3;
                ValueT* const to = &mSamples[sampleIndex(x, y, 0)];
                for (int z = zs.first; z <= zs.last; ++z) {
                    to[z] = values ? values[row | (z + zs.offset)] : tile;
                }
            }
        }
    }

    /// Leaf nodes that are in the file are kept for a while: 27 leaf nodes ask for them.
    const ValueT* valuesOf(const Leaf& leaf)
    {
        if (!leaf.buffer().isOutOfCore()) return leaf.buffer().data();
        const Coord at = leaf.origin() >> 3;
        Loaded& slot = mLoaded[std::size_t((at[0] & 3) << 8 | (at[1] & 15) << 4 | (at[2] & 15))];
        if (slot.leaf != &leaf) {
            slot.leaf = nullptr;
            slot.values = std::make_unique<LeafValues<Leaf>>(leaf);
            slot.leaf = &leaf;
        }
        return slot.values->data();
    }

    /// It caches no leaf node: an accessor that does has its values loaded.
    openvdb::tree::ValueAccessor2<const TreeT, /*IsSafe=*/true, 1, 2> mReader;
    std::vector<Loaded> mLoaded;
    std::array<ValueT, kSamples> mSamples;
};

// ---- The 27 points of a voxel's cube

/// The samples whose mean is the interpolation at a point of the cube, from that of the center.
struct CubePoint {
    int count = 1;
    int sample[8] = {};
};

std::array<CubePoint, 27> cubePoints()
{
    std::array<CubePoint, 27> points;
    for (int i = 0; i < 27; ++i) {
        CubePoint& point = points[i];
        const int steps[] = {i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1};
        const int strides[] = {sampleIndex(1, 0, 0), sampleIndex(0, 1, 0), sampleIndex(0, 0, 1)};
        for (int axis = 0; axis < 3; ++axis) {
            if (steps[axis] == 0) continue;
            for (int n = 0; n < point.count; ++n) {
                point.sample[point.count + n] = point.sample[n] + steps[axis] * strides[axis];
            }
            point.count *= 2;
        }
    }
    return points;
}

/// Whether the interpolation is in the solid somewhere (or, if not @a any, everywhere) in the cube
/// around a sample.
template <typename ValueT>
bool meets(const ValueT* center, const HalfSpace& solid, bool any)
{
    static const std::array<CubePoint, 27> kPoints = cubePoints();
    std::array<ValueT, 8> samples;
    for (const CubePoint& point : kPoints) {
        for (int n = 0; n < point.count; ++n) samples[n] = center[point.sample[n]];
        if (solid.holds(orderOfMean(samples.data(), point.count, solid.bound)) == any) return any;
    }
    return !any;
}

/// By sample of a block, how many of the 27 samples around it are in the solid; only in its middle.
using SolidCounts = std::array<uint8_t, kSamples>;

template <typename ValueT>
void countSolid(const ValueT* samples, const HalfSpace& solid, SolidCounts& counts)
{
    for (int i = 0; i < kSamples; ++i) {
        counts[i] = solid.contains(samples[i]);
    }
    for (const int stride : {sampleIndex(1, 0, 0), sampleIndex(0, 1, 0), sampleIndex(0, 0, 1)}) {
        SolidCounts sums{};
        for (int i = stride; i < kSamples - stride; ++i) {
            sums[i] = uint8_t(counts[i - stride] + counts[i] + counts[i + stride]);
        }
        counts = sums;
    }
}

template <typename TreeT>
struct Scratch {
    explicit Scratch(const TreeT& tree) : block(tree) {}
    SampleBlock<TreeT> block;
    SolidCounts counts;
};

/// Calls decide(voxels, samples, counts) for leaf nodes of the mask, in parallel. Those that are full
/// are left out where voxels are only added.
template <typename TreeT, typename Decide>
void forEachLeaf(const TreeT& values, const HalfSpace& solid, MaskTree& mask, bool isFullFinal,
    openvdb::util::NullInterrupter* interrupter, const Decide& decide)
{
    std::vector<LeafNode*> leaves;
    mask.getNodes(leaves);
    const auto makeScratch = [&] { return std::make_unique<Scratch<TreeT>>(values); };
    parallelForWith(leaves.size(), interrupter, makeScratch, [&](std::size_t i, auto& scratch) {
        if (isFullFinal && leaves[i]->getValueMask().isOn()) return;
        const auto* const samples = scratch->block.gather(leaves[i]->origin());
        countSolid(samples, solid, scratch->counts);
        LeafMask voxels = LeafMask::from(leaves[i]->getValueMask());
        decide(voxels, samples, scratch->counts);
        openvdb::util::NodeMask<3> result;
        voxels.copyTo(result);
        leaves[i]->setValueMask(result);
    });
    openvdb::tools::pruneInactive(mask);
}

int sampleOf(uint32_t voxel)
{
    return sampleIndex(int(voxel >> 6) + 1, int(voxel >> 3 & 7) + 1, int(voxel & 7) + 1);
}

} // namespace

template <typename TreeT>
void addMetCubes(const TreeT& values, const HalfSpace& solid, MaskTree& centers,
    openvdb::util::NullInterrupter* interrupter)
{
    makeLeavesAround(centers, interrupter);
    forEachLeaf(values, solid, centers, /*isFullFinal=*/true, interrupter,
        [&](LeafMask& voxels, const auto* samples, const SolidCounts& counts) {
            (LeafMask::full() - voxels).visitOn([&](uint32_t voxel) {
                const int at = sampleOf(voxel);
                if (counts[at] > 0 && meets(samples + at, solid, true)) voxels.setOn(voxel);
            });
        });
}

template <typename TreeT>
void keepWholeCubes(const TreeT& values, const HalfSpace& solid, MaskTree& centers,
    openvdb::util::NullInterrupter* interrupter)
{
    const bool anyTileIsCut = cutTileBorders(centers, interrupter);
    forEachLeaf(values, solid, centers, /*isFullFinal=*/false, interrupter,
        [&](LeafMask& voxels, const auto* samples, const SolidCounts& counts) {
            LeafMask lost{};
            voxels.visitOn([&](uint32_t voxel) {
                const int at = sampleOf(voxel);
                if (counts[at] < 27 && !meets(samples + at, solid, false)) lost.setOn(voxel);
            });
            voxels -= lost;
        });
    if (anyTileIsCut)
        openvdb::tools::prune(centers); // those that have lost nothing are tiles again
}

#define SPHERETREE_COVER(TreeT)                                                                    \
    template void addMetCubes(                                                                     \
        const TreeT&, const HalfSpace&, MaskTree&, openvdb::util::NullInterrupter*);               \
    template void keepWholeCubes(                                                                  \
        const TreeT&, const HalfSpace&, MaskTree&, openvdb::util::NullInterrupter*);
SPHERETREE_COVER(openvdb::FloatTree)
SPHERETREE_COVER(openvdb::DoubleTree)
SPHERETREE_COVER(openvdb::Int32Tree)
SPHERETREE_COVER(openvdb::Int64Tree)
#undef SPHERETREE_COVER

} // namespace openvdb_spheretree::detail
