// SPDX-License-Identifier: Apache-2.0
/// @file BallGrid.h
/// @brief Finds the balls of a cover that are near a place.
///
/// Hash grids, one for each power of two of the radius: a ball is in the cell of its centre, in the
/// grid whose cells are as wide as its radius or wider. Adding and removing take constant time, so
/// the grids live as long as the cover does.
///
/// A large ball asks for many cells of the grids of small ones, nearly all of them empty. So each
/// block of 4^3 cells has a bit for each that is not, and only blocks are looked up in vain.
/// (Without them, and with cells of one voxel, 90% of the time for hairball-256 went into that.)

#pragma once

#include "CostWindow.h"
#include "FineBall.h"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

class BallGrid {
public:
    void add(int32_t id, const FineBall& ball);
    /// @param ball  as it was added
    void remove(int32_t id, const FineBall& ball);

    /// @return the balls that come as near as @a slack (1/16 voxel) to @a ball, ascending; slack may
    /// be negative.
    std::vector<int32_t> near(const FineBall& ball, double slack = 0) const;
    /// @return balls that may reach into the box: those whose own boxes meet it, ascending.
    std::vector<int32_t> meeting(const FineBox& box) const;
    /// @return @a count balls next to @a ball, or all there are; itself (@a id) left out. Of those
    /// within a reach that has as many: the ones with the smallest gap for the smaller one's radius,
    /// ascending by that. The reach is a power of two times one of the ball's own.
    std::vector<int32_t> nearest(int32_t id, const FineBall& ball, std::size_t count) const;

    std::size_t size() const { return mSize; }

private:
    struct Entry {
        int32_t id;
        FineBall ball;
        double radius;
    };
    struct CellHash {
        std::size_t operator()(const openvdb::Vec3i& cell) const;
    };
    struct Grid {
        std::unordered_map<openvdb::Vec3i, std::vector<Entry>, CellHash> cells; ///< none is empty
        std::unordered_map<openvdb::Vec3i, uint64_t, CellHash> blocks;          ///< their cells
        std::size_t size = 0;
    };

    /// Calls body(entry) for at least all balls whose boxes meet the box.
    template <typename Body>
    void forEachNear(const FineBox& box, const Body& body) const;
    /// Calls body(block, cells) for the blocks from @a lo to @a hi.
    template <typename Body>
    static void forEachBlock(
        const Grid& grid, const openvdb::Vec3i& lo, const openvdb::Vec3i& hi, const Body& body);

    std::map<int, Grid> mGrids; ///< by log2 of the width of their cells
    std::size_t mSize = 0;
};

} // namespace tight
} // namespace openvdb_spheretree
