// SPDX-License-Identifier: Apache-2.0
/// @file BallGrid.h
/// @brief Finds the balls of a cover that are near a place.
///
/// There is a hash grid for each power of two of the radius. A ball is in the grid whose cells are
/// just as wide as its radius or wider, in the cell of its center. Adding and removing touch the
/// balls of a few cells alone, so the grids live as long as the cover does.
///
/// A large ball reaches many cells of the grids of small ones, and nearly all are empty. So balls
/// are listed by clusters of 4^3 cells, one look-up each, and those of other cells are passed over.
/// (Without clusters, and with cells of one voxel, hairball-256 spent 90 % of its time on empty
/// cells.) Where many clusters would be looked up, OccupiedCells lists those with balls: objects
/// may have parts that lie far apart.

#pragma once

#include "FineSphere.h"
#include "OccupiedCells.h"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace openvdb_spheretree::tight {

class BallGrid {
public:
    BallGrid() = default;
    /// Adds the balls by their place in the list; empty ones are left out.
    explicit BallGrid(const std::vector<ExactSphere>& balls);

    void add(int32_t id, const ExactSphere& ball);
    /// @param ball  as it was added
    void remove(int32_t id, const ExactSphere& ball);

    /// @return the balls no further than @a slack (1/16 voxel) from @a ball, ascending. If that is
    /// negative, they overlap by as much.
    std::vector<int32_t> near(const ExactSphere& ball, double slack = 0) const;
    /// @return the balls whose boxes meet the box, ascending.
    std::vector<int32_t> meeting(const FineBox& box) const;
    /// @return the @a count balls nearest to @a ball, nearest first, without ball @a id; all if
    /// there are fewer. Nearest is the smallest gap, divided by the smaller radius plus a voxel.
    std::vector<int32_t> nearest(int32_t id, const ExactSphere& ball, std::size_t count) const;

    std::size_t size() const { return mSize; }

private:
    struct Entry {
        ExactSphere ball;
        double radius; ///< of the ball
        FineBox box;   ///< around it
        int32_t id;
    };
    /// The balls of 4^3 cells, in the order of cells. A query reads one byte of each, and the
    /// entries in cells near.
    struct Cluster {
        std::vector<uint8_t> cells; ///< of each entry, its cell's number within the cluster
        std::vector<Entry> entries;
    };
    using Clusters = std::unordered_map<openvdb::Coord, Cluster, CoordHash>;
    struct Grid {
        Clusters clusters; ///< the balls in each; none is empty
        OccupiedCells occupied;
    };

    /// Calls body(entry) for at least all balls whose boxes meet the box.
    template <typename Body>
    void forEachNear(const FineBox& box, const Body& body) const;

    std::map<int, Grid> mGrids; ///< by log2 of the width of their cells
    std::size_t mSize = 0;
};

} // namespace openvdb_spheretree::tight
