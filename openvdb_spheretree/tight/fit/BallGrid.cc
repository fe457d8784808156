// SPDX-License-Identifier: Apache-2.0
#include "BallGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

/// @return log2 of the width of the cells that a ball is put in; at least four voxels.
int log2CellOf(const ExactSphere& ball)
{
    int log2 = 6;
    while (double(int64_t(1) << log2) < ball.radius()) ++log2;
    return log2;
}

Coord cellOf(const int64_t center[3], int log2)
{
    return {int32_t(center[0] >> log2), int32_t(center[1] >> log2), int32_t(center[2] >> log2)};
}

/// @return the last cell that there can be, for places beyond it.
int32_t cellAt(int64_t cell)
{
    constexpr int64_t kLast = std::numeric_limits<int32_t>::max();
    return int32_t(std::clamp(cell, -kLast, kLast));
}

constexpr std::size_t kClusterShift = 2; ///< a cluster is 4 cells wide
constexpr int kClusterDim = 1 << kClusterShift;

Coord clusterOf(const Coord& cell) { return cell >> kClusterShift; }

/// @return the number of a cell within its cluster.
uint8_t numberOf(const Coord& cell)
{
    const Coord at = cell & (kClusterDim - 1);
    return uint8_t((at[0] * kClusterDim + at[1]) * kClusterDim + at[2]);
}

/// @return a bit for each cell of a cluster: whether it lies in @a box, which meets the cluster.
uint64_t cellsIn(const Coord& cluster, const CoordBBox& box)
{
    constexpr int64_t kFirst = 0, kLast = kClusterDim - 1;
    int lo[3], hi[3];
    for (int a = 0; a < 3; ++a) {
        const int64_t origin = int64_t(cluster[a]) * kClusterDim;
        lo[a] = int(std::max(kFirst, box.min()[a] - origin));
        hi[a] = int(std::min(kLast, box.max()[a] - origin));
    }
    uint64_t line = 0, plane = 0, all = 0;
    for (int z = lo[2]; z <= hi[2]; ++z) line |= uint64_t(1) << z;
    for (int y = lo[1]; y <= hi[1]; ++y) plane |= line << (kClusterDim * y);
    for (int x = lo[0]; x <= hi[0]; ++x) all |= plane << (kClusterDim * kClusterDim * x);
    return all;
}

/// Calls body(place, cluster) for the clusters in a box.
template <typename Grid, typename Body>
void forEachCluster(const Grid& grid, const CoordBBox& box, const Body& body)
{
    constexpr double kFewLookUps = 1000;
    const Coord size = box.dim();
    const double lookUps = double(size[0]) * size[1] * size[2];
    if (lookUps > std::min(kFewLookUps, double(grid.clusters.size()))) {
        grid.occupied.forEachIn(
            box, [&](const Coord& at) { body(at, grid.clusters.find(at)->second); });
        return;
    }
    for (const Coord& at : box) {
        const auto cluster = grid.clusters.find(at);
        if (cluster != grid.clusters.end()) body(at, cluster->second);
    }
}

} // namespace

BallGrid::BallGrid(const std::vector<ExactSphere>& balls)
{
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!balls[i].empty()) add(int32_t(i), balls[i]);
    }
}

void BallGrid::add(int32_t id, const ExactSphere& ball)
{
    const int log2 = log2CellOf(ball);
    const Coord cell = cellOf(ball.center, log2);
    Grid& grid = mGrids[log2];
    auto& [cells, entries] = grid.clusters[clusterOf(cell)];
    if (entries.empty()) grid.occupied.add(clusterOf(cell));
    const uint8_t number = numberOf(cell);
    const auto at = std::upper_bound(cells.begin(), cells.end(), number) - cells.begin();
    entries.insert(entries.begin() + at, {ball, ball.radius(), FineBox(ball), id});
    cells.insert(cells.begin() + at, number);
    ++mSize;
}

void BallGrid::remove(int32_t id, const ExactSphere& ball)
{
    const int log2 = log2CellOf(ball);
    const auto grid = mGrids.find(log2);
    Clusters& clusters = grid->second.clusters;
    const Coord cell = cellOf(ball.center, log2);
    const auto cluster = clusters.find(clusterOf(cell));
    auto& [cells, entries] = cluster->second;
    auto at = std::lower_bound(cells.begin(), cells.end(), numberOf(cell)) - cells.begin();
    while (entries[std::size_t(at)].id != id) ++at;
    cells.erase(cells.begin() + at);
    entries.erase(entries.begin() + at);
    if (entries.empty()) {
        grid->second.occupied.remove(cluster->first);
        clusters.erase(cluster);
    }
    if (clusters.empty()) mGrids.erase(grid);
    --mSize;
}

template <typename Body>
void BallGrid::forEachNear(const FineBox& box, const Body& body) const
{
    for (const auto& [log2, grid] : mGrids) {
        const int64_t width = int64_t(1) << log2; // no ball of this grid has a larger radius
        CoordBBox near;
        for (int a = 0; a < 3; ++a) {
            near.min()[a] = cellAt((box.lo[a] - width) >> log2);
            near.max()[a] = cellAt((box.hi[a] + width) >> log2);
        }
        const CoordBBox clusters = near >> kClusterShift;
        forEachCluster(grid, clusters, [&](const Coord& at, const Cluster& cluster) {
            const uint64_t wanted = cellsIn(at, near);
            for (std::size_t i = 0; i < cluster.cells.size(); ++i) {
                if (wanted >> cluster.cells[i] & 1) body(cluster.entries[i]);
            }
        });
    }
}

std::vector<int32_t> BallGrid::near(const ExactSphere& ball, double slack) const
{
    std::vector<int32_t> found;
    const double radius = ball.radius();
    forEachNear(FineBox(ball, std::max(0.0, slack)), [&](const Entry& entry) {
        const double gap = centerDistance(entry.ball, ball) - entry.radius - radius;
        if (gap <= slack) found.push_back(entry.id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<int32_t> BallGrid::meeting(const FineBox& box) const
{
    std::vector<int32_t> found;
    forEachNear(box, [&](const Entry& entry) {
        if (entry.box.meets(box)) found.push_back(entry.id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<int32_t> BallGrid::nearest(int32_t id, const ExactSphere& ball, std::size_t count) const
{
    if (count == 0) return {};
    // All others are a fair answer, however far they are: without a neighbour no ball could merge.
    constexpr double kFarthest = double(int64_t(1) << 36); // wider than any object
    std::size_t others = mSize;
    const double radius = ball.radius();
    std::vector<std::pair<double, int32_t>> found; // by gaps for their radius, ascending
    for (double slack = 0;; slack = slack == 0 ? 2 * kFine + radius / 2 : 2 * slack) {
        found.clear();
        double largest = std::numeric_limits<double>::infinity(); // of such gaps, worth keeping
        forEachNear(FineBox(ball, slack), [&](const Entry& entry) {
            if (entry.id == id) {
                others = mSize - 1;
                return;
            }
            const double smaller = std::min(entry.radius, radius) + kFine;
            const double reach = entry.radius + radius + std::min(slack, largest * smaller);
            constexpr double kRounding = 1;
            const double apartSq = centerDistanceSq(entry.ball, ball);
            if (reach < -kRounding || apartSq > (reach + kRounding) * (reach + kRounding)) return;
            const double gap = std::sqrt(apartSq) - entry.radius - radius;
            const std::pair<double, int32_t> place(gap / smaller, entry.id);
            if (gap > slack) return;
            found.insert(std::upper_bound(found.begin(), found.end(), place), place);
            if (found.size() > count) found.pop_back();
            if (found.size() == count) largest = found.back().first;
        });
        if (found.size() < std::min(count, others) && slack < kFarthest) continue;
        // What is farther than the slack has a larger gap for its radius than this.
        if (found.empty() || found.back().first < slack / (radius + kFine) || slack >= kFarthest) {
            break;
        }
    }
    std::vector<int32_t> ids;
    for (const auto& [gap, other] : found) ids.push_back(other);
    return ids;
}

} // namespace openvdb_spheretree::tight
