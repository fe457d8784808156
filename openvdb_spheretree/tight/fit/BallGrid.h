// SPDX-License-Identifier: Apache-2.0
/// @file BallGrid.h
/// @brief Finds the balls of a cover that are near a place.
///
/// There is a hash grid for each power of two of the radius: a ball is in the cell of its centre, in the
/// grid whose cells are as wide as its radius or wider. Adding and removing take constant time, so
/// the grids live as long as the cover does.
///
/// A large ball reaches many cells of the grids of small ones, and nearly all are empty. So each
/// cluster of 4^3 cells has a bit for each cell that is not, and only clusters are looked up in vain.
/// (Without them, and with cells of one voxel, hairball-256 spent 90 % of its time on empty cells.)

#pragma once

#include "CostWindow.h"
#include "FineSphere.h"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

class BallGrid {
public:
    BallGrid() = default;
    /// Adds the balls by their place in the list; empty ones are left out.
    explicit BallGrid(const std::vector<ExactSphere>& balls);

    void add(int32_t id, const ExactSphere& ball);
    /// @param ball  as it was added
    void remove(int32_t id, const ExactSphere& ball);

    /// @return the balls no further than @a slack (1/16 voxel) from @a ball, ascending. A negative
    /// slack asks for an overlap.
    std::vector<int32_t> near(const ExactSphere& ball, double slack = 0) const;
    /// @return the balls whose boxes meet the box, ascending.
    std::vector<int32_t> meeting(const FineBox& box) const;
    /// @return the @a count balls next to @a ball, or all there are, without itself (@a id). Next is
    /// the one with the smallest gap, divided by the smaller radius plus a voxel; ascending.
    std::vector<int32_t> nearest(int32_t id, const ExactSphere& ball, std::size_t count) const;

    std::size_t size() const { return mSize; }

private:
    struct Entry {
        int32_t id;
        ExactSphere ball;
        double radius;
    };
    struct CellHash {
        std::size_t operator()(const openvdb::Vec3i& cell) const;
    };
    struct Grid {
        std::unordered_map<openvdb::Vec3i, std::vector<Entry>, CellHash> cells; ///< none is empty
        std::unordered_map<openvdb::Vec3i, uint64_t, CellHash> clusters; ///< which of their cells
        std::size_t size = 0;
    };

    /// Calls body(entry) for at least all balls whose boxes meet the box.
    template <typename Body>
    void forEachNear(const FineBox& box, const Body& body) const;
    /// Calls body(cluster, cells) for the clusters from @a lo to @a hi.
    template <typename Body>
    static void forEachCluster(
        const Grid& grid, const openvdb::Vec3i& lo, const openvdb::Vec3i& hi, const Body& body);

    std::map<int, Grid> mGrids; ///< by log2 of the width of their cells
    std::size_t mSize = 0;
};

} // namespace tight
} // namespace openvdb_spheretree
