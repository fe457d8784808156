// SPDX-License-Identifier: Apache-2.0
#include "LevelCounts.h"

#include <openvdb/Exceptions.h>

#include <sstream>

namespace openvdb_spheretree::tight {

namespace {

/// @return the fewest balls within the bounds; all leaf balls are the object itself, without any error.
template <typename Within>
int64_t fewest(int64_t leafBalls, const Within& within)
{
    int64_t low = 1, high = leafBalls; // high is within, and nothing below low is known to be
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (within(middle)) high = middle;
        else low = middle + 1;
    }
    constexpr int kMoreTries = 8;
    for (int64_t count = high - 2; count > 0 && count >= high - kMoreTries; --count) {
        if (within(count)) high = count;
    }
    return high;
}

} // namespace

bool isWithin(const SphereBudget& budget, double voxelSize, const LevelError& error)
{
    return (!budget.error || error.hammingPercent <= *budget.error)
        && (!budget.distance || error.hausdorff * voxelSize <= *budget.distance);
}

std::vector<int64_t> levelCounts(
    const SphereBudget& budget, int64_t leafBalls, double voxelSize, const ErrorOfCut& errorOf)
{
    if (!budget.hasBound()) return budget.counts(leafBalls);
    const int64_t count =
        fewest(leafBalls, [&](int64_t n) { return isWithin(budget, voxelSize, errorOf(n)); });
    if (!budget.spheres.empty() && count > budget.spheres.front()) {
        std::ostringstream bounds;
        if (budget.error) bounds << "error=" << *budget.error;
        if (budget.error && budget.distance) bounds << " and ";
        if (budget.distance) bounds << "distance=" << *budget.distance;
        OPENVDB_THROW(openvdb::ValueError,
            bounds.str() << " cannot be reached with spheres=" << budget.spheres.front()
                         << ": it takes " << count
                         << " spheres (before any search); allow more of them, or a looser bound");
    }
    if (budget.branching == 0) return {count};
    std::vector<int64_t> counts{count};
    SphereBudget ladder; // of the branching alone
    ladder.branching = budget.branching;
    for (const int64_t n : ladder.counts(leafBalls)) {
        if (n < count) counts.push_back(n);
    }
    return counts;
}

} // namespace openvdb_spheretree::tight
