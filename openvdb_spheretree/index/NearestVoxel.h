// SPDX-License-Identifier: Apache-2.0
/// @file NearestVoxel.h
/// @brief Nearest-voxel queries on a sparse mask: a tree of bounding boxes over its leaves
/// and tiles.
///
/// Nodes are sorted along a Morton curve and grouped by eight, level by level, without pointers.
/// Each box is the tight one of its voxels, so each of its faces has a voxel: that bounds the
/// distance from above as well, and most calls of anyWithin() end near the root.
///
/// Query points are in doubled coordinates, for centers between voxels, and so are squared
/// distances: |2 q - point2|^2, or of a norm N(2 q - point2)^2. Exact at voxel centers. Between
/// them a tile counts as the continuous box of its voxel centers: results may be too small, by half
/// a voxel an axis.
///
/// The same boxes answer for the *solid*, the union of the voxels' closed unit cubes: nearestBlock()
/// takes any point, and finds a box of cubes that is nearest. There a tile is just its box of cubes.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class NearestVoxel {
public:
    /// Beyond this (in doubled coordinates, 2^29 voxels) a distance is not exact, only known to be
    /// at least this.
    static constexpr int64_t kFar2 = int64_t(1) << 30;

    /// A box of the solid, in index space: voxels as closed cubes. Empty until it is found.
    struct Block {
        double lo[3] = {1, 1, 1}, hi[3] = {0, 0, 0};
        bool empty() const { return lo[0] > hi[0]; }
        bool operator==(const Block& o) const
        {
            return std::equal(lo, lo + 3, o.lo) && std::equal(hi, hi + 3, o.hi);
        }
    };

    /// @return the cube of a voxel.
    static Block blockOf(const openvdb::Coord& voxel);

    explicit NearestVoxel(const openvdb::MaskTree& mask, const Distance& distance = {});

    const Distance& distance() const { return mDistance; }

    /// @return the squared distance to the nearest voxel where it is more than @a enough; otherwise
    ///         anything up to @a enough that is no less than it: the search stops there.
    int64_t distSq(const int64_t point2[3], int64_t enough) const;

    /// @return the squared distance (in doubled coordinates) of @a voxel to the nearest voxel of
    ///         the mask, which @a nearest becomes; the mask must have one.
    int64_t nearest(const openvdb::Coord& voxel, openvdb::Coord& nearest) const;

    /// @return the distance of a point of index space to the solid, in units of the metric; that of
    ///         the whole numbers is exact, that of others as doubles are. The mask must have a voxel.
    /// @param block  a box of the solid at that distance; where it is one already, only what is
    ///               nearer takes its place (so that a point next to the last one costs little)
    double nearestBlock(const double point[3], Block& block) const;

    /// @return whether a voxel is within the squared distance @a limit.
    bool anyWithin(const int64_t point2[3], int64_t limit) const;

    /// @param distance2  of the metric, in doubled coordinates
    /// @return whether every voxel of a box is within a distance of the mask, for all that one query for its middle
    ///         tells: false may be wrong.
    bool areAllWithin(const openvdb::CoordBBox& box, double distance2) const;

private:
    struct Box {
        int32_t lo[3], hi[3];
    };
    struct Item {
        Box box;
        openvdb::Coord origin;
        bool solid;      ///< every voxel of the box is there
        LeafMask voxels; ///< only of a leaf
    };
    struct Query {
        const int64_t* point2;
        int64_t enough;
        int64_t best;              ///< nothing at or beyond this distance is of interest any more
        openvdb::Coord voxel = {}; ///< which is at that distance, where one was found in an item
    };
    struct BlockQuery {
        const double* point;
        double best; ///< a distance; the Euclidean one squared, which takes no root
        Block& block;
    };
    static constexpr int kFanout = 8;

    int64_t nearSq(const Box& box, const int64_t point2[3]) const;
    int64_t faceSq(const Box& box, const int64_t point2[3]) const;
    static Item itemOf(const openvdb::MaskTree::LeafNodeType& leaf); ///< which is not empty
    void group();
    void searchNode(std::size_t level, std::size_t node, Query& query) const;
    void searchItem(const Item& item, Query& query) const;
    double blockMeasure(const Block& block, const double point[3]) const;
    void searchBlocks(std::size_t level, std::size_t node, BlockQuery& query) const;
    void searchRows(const Item& item, BlockQuery& query) const;

    Distance mDistance;
    std::vector<Item> mItems;
    std::vector<std::vector<Box>> mLevels; ///< of boxes: [0] those of the items, back() the root's
};

} // namespace openvdb_spheretree::detail
