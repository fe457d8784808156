// SPDX-License-Identifier: Apache-2.0
#include "BallGrid.h"

#include "../detail/Hash.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

using openvdb::Vec3i;

/// @return log2 of the width of the cells that a ball is put in; at least a voxel wide.
int log2CellOf(const FineBall& ball)
{
    int log2 = 4;
    while (double(int64_t(1) << log2) < ball.radius()) ++log2;
    return log2;
}

Vec3i cellOf(const int64_t center[3], int log2)
{
    return {int32_t(center[0] >> log2), int32_t(center[1] >> log2), int32_t(center[2] >> log2)};
}

bool boxesMeet(const FineBall& ball, const FineBox& box)
{
    const auto reach = int64_t(std::ceil(ball.radius()));
    for (int a = 0; a < 3; ++a) {
        if (ball.center[a] + reach < box.lo[a] || ball.center[a] - reach > box.hi[a]) return false;
    }
    return true;
}

} // namespace

std::size_t BallGrid::CellHash::operator()(const Vec3i& cell) const
{
    const uint64_t xy = uint64_t(uint32_t(cell[0])) << 32 | uint32_t(cell[1]);
    return std::size_t(detail::hash(detail::hash(xy) ^ uint32_t(cell[2])));
}

void BallGrid::add(int32_t id, const FineBall& ball)
{
    const int log2 = log2CellOf(ball);
    Grid& grid = mGrids[log2];
    grid.cells[cellOf(ball.center, log2)].push_back({id, ball});
    ++grid.size;
    ++mSize;
}

void BallGrid::remove(int32_t id, const FineBall& ball)
{
    const int log2 = log2CellOf(ball);
    const auto grid = mGrids.find(log2);
    const auto cell = grid->second.cells.find(cellOf(ball.center, log2));
    auto& entries = cell->second;
    entries.erase(std::find_if(
        entries.begin(), entries.end(), [&](const Entry& entry) { return entry.id == id; }));
    if (entries.empty()) grid->second.cells.erase(cell);
    if (--grid->second.size == 0) mGrids.erase(grid);
    --mSize;
}

template <typename Body>
void BallGrid::forEachNear(const FineBox& box, const Body& body) const
{
    for (const auto& [log2, grid] : mGrids) {
        const int64_t width = int64_t(1) << log2; // no ball of this grid has a larger radius
        Vec3i lo, hi;
        double cells = 1;
        for (int a = 0; a < 3; ++a) {
            lo[a] = int32_t((box.lo[a] - width) >> log2);
            hi[a] = int32_t((box.hi[a] + width) >> log2);
            cells *= double(hi[a]) - lo[a] + 1;
        }
        if (cells > double(grid.cells.size())) {
            for (const auto& cell : grid.cells) {
                for (const Entry& entry : cell.second) body(entry);
            }
            continue;
        }
        for (int32_t x = lo[0]; x <= hi[0]; ++x) {
            for (int32_t y = lo[1]; y <= hi[1]; ++y) {
                for (int32_t z = lo[2]; z <= hi[2]; ++z) {
                    const auto cell = grid.cells.find({x, y, z});
                    if (cell == grid.cells.end()) continue;
                    for (const Entry& entry : cell->second) body(entry);
                }
            }
        }
    }
}

std::vector<int32_t> BallGrid::near(const FineBall& ball, double slack) const
{
    FineBox box;
    box.expand(ball, std::max(0.0, slack));
    std::vector<int32_t> found;
    forEachNear(box, [&](const Entry& entry) {
        if (gapBetween(entry.ball, ball) <= slack) found.push_back(entry.id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<int32_t> BallGrid::meeting(const FineBox& box) const
{
    std::vector<int32_t> found;
    forEachNear(box, [&](const Entry& entry) {
        if (boxesMeet(entry.ball, box)) found.push_back(entry.id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<int32_t> BallGrid::nearest(int32_t id, const FineBall& ball, std::size_t count) const
{
    std::vector<std::pair<double, int32_t>> found;
    for (double slack = 2 * kFine + ball.radius() / 2;; slack *= 2) {
        FineBox box;
        box.expand(ball, slack);
        found.clear();
        std::size_t itself = 0;
        forEachNear(box, [&](const Entry& entry) {
            const double gap = gapBetween(entry.ball, ball);
            if (entry.id == id) itself = 1;
            if (entry.id == id || gap > slack) return;
            found.emplace_back(
                gap / (std::min(entry.ball.radius(), ball.radius()) + kFine), entry.id);
        });
        if (found.size() >= std::min(count, mSize - itself)) break;
    }
    const std::size_t kept = std::min(count, found.size());
    std::partial_sort(found.begin(), found.begin() + std::ptrdiff_t(kept), found.end());
    std::vector<int32_t> ids;
    for (std::size_t i = 0; i < kept; ++i) ids.push_back(found[i].second);
    return ids;
}

} // namespace tight
} // namespace openvdb_spheretree
