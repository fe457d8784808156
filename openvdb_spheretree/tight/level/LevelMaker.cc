// SPDX-License-Identifier: Apache-2.0
#include "LevelMaker.h"

#include <algorithm>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// More trials gain little, but few balls have searches that end in different places, and take no
/// time.
int searchesFor(std::size_t count)
{
    constexpr std::size_t kBalls = 128, kMost = 6;
    return int(std::max<std::size_t>(1, std::min(kMost, kBalls / count)));
}

} // namespace

int LevelMaker::trialsFor(std::size_t count)
{
    constexpr std::size_t kLeast = 4, kMost = 100, kAll = 200000;
    return int(std::max(kLeast, std::min(kMost, kAll / count)));
}

SearchedCover LevelMaker::search(const std::vector<CoverBall>& start,
    const std::vector<CoverBall>& finer, const CoverGoal& goal, int trialsPerBall, int number) const
{
    const SearchEffort effort{fit, trialsPerBall, uint64_t(number) << 40, flat};
    return improveCover(start, finer, object, goal, effort, interrupter);
}

std::vector<CoverBall> LevelMaker::improve(const std::vector<CoverBall>& start,
    const std::vector<CoverBall>& finer, const CoverGoal& goal) const
{
    SearchedCover best;
    best.balls = start;
    for (int number = 0; number < searchesFor(start.size()); ++number) {
        SearchedCover found = search(start, finer, goal, trialsFor(start.size()), number);
        if (found.change < best.change) best = std::move(found);
    }
    return std::move(best.balls);
}

std::vector<CoverBall> filledUp(
    const std::vector<CoverBall>& cover, const std::vector<CoverBall>& leaves)
{
    std::vector<CoverBall> filled;
    for (const CoverBall& ball : cover) {
        if (!ball.empty()) filled.push_back(ball);
    }
    for (auto leaf = leaves.begin(); leaf != leaves.end() && filled.size() < cover.size(); ++leaf) {
        if (std::find(cover.begin(), cover.end(), *leaf) == cover.end()) filled.push_back(*leaf);
    }
    return filled;
}

} // namespace tight
} // namespace openvdb_spheretree
