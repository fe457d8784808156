// SPDX-License-Identifier: Apache-2.0
#include "LevelMaker.h"

#include "CoverSearch.h"

#include <algorithm>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

constexpr int kTrialsPerBall = 60;

/// More trials gain little, but few balls have searches that end in different places, and take no
/// time.
int searchesFor(std::size_t count)
{
    constexpr std::size_t kBalls = 128, kMost = 6;
    return int(std::max<std::size_t>(1, std::min(kMost, kBalls / count)));
}

} // namespace

std::vector<CoverBall> LevelMaker::improve(const std::vector<CoverBall>& start,
    const std::vector<CoverBall>& finer, const CoverDebt& debt) const
{
    SearchedCover best;
    best.balls = start;
    for (int search = 0; search < searchesFor(start.size()); ++search) {
        const SearchEffort effort{fit, kTrialsPerBall, uint64_t(search) << 40, flat};
        SearchedCover found = improveCover(start, finer, object, debt, effort, interrupter);
        if (found.change < best.change) best = std::move(found);
    }
    return std::move(best.balls);
}

} // namespace tight
} // namespace openvdb_spheretree
