// SPDX-License-Identifier: Apache-2.0
#include "LevelCounts.h"

#include <openvdb_spheretree/base/TextStream.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <map>

namespace openvdb_spheretree::tight {

namespace {

/// "error=10 and distance=2vox".
std::string boundsText(const SphereBudget& budget)
{
    detail::TextStream text;
    if (budget.error) text << "error=" << *budget.error;
    if (budget.error && budget.distance) text << " and ";
    if (budget.distance) text << "distance=" << distanceBoundToString(budget);
    return text.str();
}

/// The errors of cuts, each counted once.
class CutErrors {
public:
    CutErrors(const SphereTreeSettings& settings, int64_t leafBalls, double voxelSize,
        const ErrorOfCut& errorOf)
        : mSettings(settings), mBudget(settings.tight().budget), mLeafBalls(leafBalls),
          mVoxelSize(voxelSize), mErrorOf(errorOf)
    {}

    bool isWithin(int64_t count)
    {
        // Without padding, all leaf balls are the object itself, without any error; given ones need
        // not be.
        const bool areObject = mSettings.tight().leaves != Leaves::Given;
        if (mBudget.bounds == BoundOf::Unpadded && count == mLeafBalls && areObject) return true;
        return tight::isWithin(mBudget, mVoxelSize, errorOf(count));
    }

    /// @return the fewest balls found within the bounds; 0 if there are none.
    int64_t fewest()
    {
        int64_t low = 0, high = 1; // low is not within
        while (!isWithin(high)) {
            if (high == mLeafBalls) return 0;
            low = high;
            high = std::min(2 * high, mLeafBalls);
        }
        while (high - low > 1) {
            const int64_t middle = low + (high - low) / 2;
            if (isWithin(middle)) high = middle;
            else low = middle;
        }
        constexpr int kMoreTries = 8; // each may take as long as a tree
        const int64_t least = std::max<int64_t>(1, high - kMoreTries);
        for (int64_t count = high - 2; count >= least; --count) {
            if (isWithin(count)) high = count;
        }
        return high;
    }

    [[noreturn]] void throwUnreachable();
    [[noreturn]] void throwTooMany(int64_t count);

private:
    const BoundedError& errorOf(int64_t count)
    {
        const auto known = mKnown.find(count);
        return known != mKnown.end() ? known->second : mKnown[count] = mErrorOf(count);
    }
    /// What @a count spheres have of the figures that are bounded.
    std::string figures(int64_t count)
    {
        const BoundedError& error = errorOf(count);
        detail::TextStream text;
        text << count << (count == 1 ? " sphere" : " spheres");
        if (!error.unknown.empty()) return text.str() + " have an error that is not known";
        if (mBudget.error) text << " have an error of " << error.hammingPercent << "%";
        if (mBudget.error && mBudget.distance) text << " and";
        if (mBudget.distance) text << " reach " << error.reachWorld;
        return text.str();
    }

    const SphereTreeSettings& mSettings;
    const SphereBudget& mBudget;
    const int64_t mLeafBalls;
    const double mVoxelSize;
    const ErrorOfCut& mErrorOf;
    std::map<int64_t, BoundedError> mKnown; ///< by count
};

/// Names the least of each figure among the cuts that were tried.
void CutErrors::throwUnreachable()
{
    const BoundedError& finest = errorOf(mLeafBalls);
    if (!finest.unknown.empty()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the error of " << mLeafBalls
                            << " spheres is not known, so no bound on it can be kept: "
                            << finest.unknown << "; ask for spheres= instead");
    }
    const auto least = [&](double BoundedError::*figure) {
        auto best = mKnown.find(mLeafBalls);
        for (auto it = mKnown.begin(); it != mKnown.end(); ++it) {
            const bool isKnown = it->second.unknown.empty();
            if (isKnown && it->second.*figure < best->second.*figure) best = it;
        }
        return best;
    };
    detail::TextStream what;
    if (mBudget.error) {
        const auto best = least(&BoundedError::hammingPercent);
        what << "; the least error found is " << best->second.hammingPercent << "%, with "
             << best->first << " of " << mLeafBalls << " spheres";
    }
    if (mBudget.distance) {
        const auto best = least(&BoundedError::reachWorld);
        what << "; the least reach found is " << best->second.reachWorld << ", with " << best->first
             << " of " << mLeafBalls << " spheres";
    }
    OPENVDB_THROW(openvdb::ValueError,
        boundsText(mBudget) << " cannot be reached: padding=" << paddingToString(mSettings.padding)
                            << " makes stored radii " << mSettings.paddingVoxels() * mVoxelSize
                            << " world units larger" << what.str()
                            << ": use smaller voxels, less padding (padding=voxels has none, and "
                               "covers centers of voxels alone), "
                            << (mBudget.bounds == BoundOf::Stored
                                       ? "a larger bound, or bounds=unpadded to bound the errors "
                                         "without the padding"
                                       : "or a larger bound"));
}

void CutErrors::throwTooMany(int64_t count)
{
    const int64_t most = mBudget.spheres.front();
    const bool isKnown = mBudget.bounds == BoundOf::Stored || count < mLeafBalls;
    OPENVDB_THROW(openvdb::ValueError,
        boundsText(mBudget) << " cannot be reached with spheres=" << most
                            << "; the fewest found within it: "
                            << (isKnown ? figures(count) : std::to_string(count) + " spheres")
                            << "; " << figures(most)
                            << "; allow more of them, or a looser bound; other voxels may take "
                               "fewer, and a tree of named numbers alone, such as spheres="
                            << most << ", may be within it");
}

} // namespace

bool isWithin(const SphereBudget& budget, double voxelSize, const BoundedError& error)
{
    return error.unknown.empty() && (!budget.error || error.hammingPercent <= *budget.error)
        && (!budget.distance || error.reachWorld <= budget.distanceWorld(voxelSize));
}

void requireReachable(const SphereTreeSettings& settings, double voxelSize)
{
    const SphereBudget& budget = settings.tight().budget;
    if (!budget.distance || budget.bounds != BoundOf::Stored) return;
    const double least = (settings.paddingVoxels() - 0.5) * voxelSize;
    if (budget.distanceWorld(voxelSize) >= least) return;
    OPENVDB_THROW(openvdb::ValueError,
        "distance=" << distanceBoundToString(budget)
                    << " cannot be reached: padding=" << paddingToString(settings.padding)
                    << " makes stored radii " << settings.paddingVoxels() * voxelSize
                    << " world units larger, and alone reaches at least " << least
                    << " out of the object's voxels, of " << voxelSize
                    << ": use smaller voxels, less padding (padding=voxels has none, and covers "
                       "centers of voxels alone), or a larger "
                       "bound");
}

std::vector<int64_t> levelCounts(const SphereTreeSettings& settings, int64_t leafBalls,
    double voxelSize, const ErrorOfCut& errorOf)
{
    const SphereBudget& budget = settings.tight().budget;
    if (!budget.hasBound()) return budget.counts(leafBalls);
    CutErrors errors(settings, leafBalls, voxelSize, errorOf);
    const int64_t count = errors.fewest();
    if (count == 0) errors.throwUnreachable();
    if (!budget.spheres.empty() && count > budget.spheres.front()) errors.throwTooMany(count);
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
