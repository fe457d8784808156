// SPDX-License-Identifier: Apache-2.0
#include "NearestLevels.h"

#include "NearestSearch.h"
#include "SharedVoxels.h"
#include "StoredSphere.h"
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StepProgress.h>
#include <openvdb_spheretree/inner/InnerOrder.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace openvdb_spheretree::nearest {

namespace {

using openvdb::Coord;

/// The spheres of a level, as they are stored.
struct Level {
    std::vector<StoredSphere> stored;
    std::vector<ExactSphere> spheres; ///< those of `stored`
    int64_t wrong = 0;                ///< excess + missing, voxels
};

/// Searches levels, each once.
class LevelSearch {
public:
    /// @param inner     the inner spheres, in their order
    /// @param progress  the object's interrupter: each search is a step that costs 1: few spheres are
    ///                  tried more often, many take longer
    LevelSearch(const NearestObject& object, std::vector<ExactSphere> inner, double voxelSize,
        detail::StepProgress& progress)
        : mObject(object), mInner(std::move(inner)), mVoxelSize(voxelSize), mProgress(progress)
    {}

    int64_t most() const { return int64_t(mInner.size()); }

    const Level& of(int64_t count) { return known(count); }
    /// @return the same, or a better one from the spheres of a coarser level.
    const Level& noWorseThan(const Level& coarser, int64_t count)
    {
        Level& level = known(count);
        if (level.wrong <= coarser.wrong) return level;
        std::vector<ExactSphere> start = coarser.spheres;
        const auto more = missingBalls(mObject, start, count - int64_t(start.size()));
        start.insert(start.end(), more.begin(), more.end());
        return level = searched(std::move(start));
    }
    double errorPercent(int64_t count)
    {
        return 100.0 * double(of(count).wrong) / double(mObject.voxelCount);
    }
    /// @return the fewest spheres found with an error of @a percent or less; nothing if all have more.
    std::optional<int64_t> fewestWithin(double percent)
    {
        int64_t low = 0, high = 1; // low is not within
        while (errorPercent(high) > percent) {
            if (high == most()) return std::nullopt;
            low = high;
            high = std::min(2 * high, most());
        }
        for (bool guess = true; high - low > 1; guess = !guess) {
            const int64_t middle =
                guess && low > 0 ? guessBetween(low, high, percent) : low + (high - low) / 2;
            (errorPercent(middle) <= percent ? high : low) = middle;
        }
        return high;
    }

private:
    Level& known(int64_t count)
    {
        const auto found = mKnown.find(count);
        if (found != mKnown.end()) return found->second;
        return mKnown[count] = searched({mInner.begin(), mInner.begin() + count});
    }

    /// @return where the error comes down to @a percent, if it is a power of the number of spheres between.
    int64_t guessBetween(int64_t low, int64_t high, double percent)
    {
        const double least = 0.5 / double(mObject.voxelCount); // half a voxel stands for none
        const auto logOf = [least](double error) { return std::log(std::max(error, 100 * least)); };
        const double from = logOf(errorPercent(low)), to = logOf(errorPercent(high));
        const double share = (from - logOf(percent)) / (from - to);
        const double guess = double(low) * std::pow(double(high) / double(low), share);
        return std::clamp(int64_t(std::lround(guess)), low + 1, high - 1);
    }

    Level searched(std::vector<ExactSphere> start) const
    {
        const detail::Step step(&mProgress, 1);
        Level level;
        for (const ExactSphere& sphere : nearestFrom(mObject, std::move(start)).spheres) {
            level.stored.push_back(storedSphere(sphere, mVoxelSize));
            level.spheres.push_back(level.stored.back().sphere);
        }
        level.wrong = wrongVoxels(mObject, level.spheres);
        return level;
    }

    const NearestObject& mObject;
    const std::vector<ExactSphere> mInner;
    const double mVoxelSize;
    detail::StepProgress& mProgress;
    std::map<int64_t, Level> mKnown; ///< by count
};

/// @return the number of spheres of each level, finest first.
std::vector<int64_t> countsOf(const SphereBudget& budget, LevelSearch& search)
{
    if (!budget.error) return budget.counts(search.most());
    const std::optional<int64_t> fewest = search.fewestWithin(*budget.error);
    if (!fewest) {
        OPENVDB_THROW(openvdb::ValueError,
            "error=" << *budget.error << " cannot be reached with spheres=" << search.most()
                     << ": these have an error of " << search.errorPercent(search.most())
                     << "%; allow more of them, or a larger error");
    }
    std::vector<int64_t> counts{*fewest};
    if (budget.branching == 0) return counts;
    SphereBudget ladder; // of the branching alone
    ladder.branching = budget.branching;
    for (const int64_t count : ladder.counts(search.most())) {
        if (count < *fewest) counts.push_back(count);
    }
    return counts;
}

/// Appends levels, the coarsest first.
class LevelAppender {
public:
    /// @param plane  added to z: where the plane of a flat object is
    LevelAppender(SphereTree& tree, int32_t plane, openvdb::util::NullInterrupter* interrupter)
        : mTree(tree), mPlane(plane), mInterrupter(interrupter)
    {}

    void append(const Level& level, SphereTreeLevel& range)
    {
        std::vector<int32_t> parents(level.spheres.size(), -1);
        if (!mAbove.empty()) {
            parents = parentsOf(level.spheres, mAbove, mTree.settings.dim == 2, mInterrupter);
        }
        const std::vector<Coord> voxels = nearestVoxels(level.spheres);
        std::vector<int32_t> order(voxels.size()), ids(voxels.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
            [&](int32_t a, int32_t b) { return voxels[a] < voxels[b]; });
        range.begin = mTree.size();
        for (const int32_t i : order) {
            ids[i] = mTree.size();
            appendSphere(level.stored[i], parents[i] < 0 ? -1 : mIds[parents[i]]);
            mTree.ijk.push_back(voxels[i]);
            mTree.radiusSq.push_back(-1); // no digital ball
        }
        range.end = mTree.size();
        mAbove = level.spheres;
        mIds = std::move(ids);
    }

private:
    openvdb::Vec3d centerOf(const ExactSphere& sphere) const
    {
        const double unit = double(tight::kFine);
        const openvdb::Vec3d center(double(sphere.center[0]) / unit,
            double(sphere.center[1]) / unit, double(sphere.center[2]) / unit + mPlane);
        return FlatAxis(mTree.flatAxis).fromZ(center);
    }

    std::vector<Coord> nearestVoxels(const std::vector<ExactSphere>& spheres) const
    {
        std::vector<Coord> voxels;
        for (const ExactSphere& sphere : spheres) {
            const openvdb::Vec3d center = centerOf(sphere);
            Coord& voxel = voxels.emplace_back();
            for (int a = 0; a < 3; ++a) voxel[a] = int32_t(std::floor(center[a] + 0.5));
        }
        return voxels;
    }

    void appendSphere(const StoredSphere& stored, int32_t parent)
    {
        Spheres& spheres = mTree.spheres;
        spheres.center.push_back(centerOf(stored.sphere));
        spheres.radius.push_back(stored.radius);
        spheres.coverRadiusSq.push_back(stored.sphere.radiusSq);
        spheres.radiusWorld.push_back(stored.radiusWorld);
        spheres.parent.push_back(parent);
    }

    SphereTree& mTree;
    const int32_t mPlane;
    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<ExactSphere> mAbove; ///< those of the level above
    std::vector<int32_t> mIds;       ///< of the same
};

/// @return the voxels of a flat object, moved to the plane z = 0, which all levels of samples have.
openvdb::MaskTree atPlaneZero(const openvdb::MaskTree& voxels, int32_t plane)
{
    openvdb::MaskTree moved(false);
    openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(moved);
    for (auto voxel = voxels.cbeginValueOn(); voxel; ++voxel) {
        accessor.setValueOn(voxel.getCoord().offsetBy(0, 0, -plane));
    }
    return moved;
}

int32_t firstPlane(const openvdb::MaskTree& voxels)
{
    openvdb::CoordBBox box;
    voxels.evalActiveVoxelBoundingBox(box);
    return box.min()[2];
}

/// The inner spheres that searches start from, in their order.
std::vector<ExactSphere> innerSpheres(const MedialLevel& medial, const SphereTreeSettings& settings,
    openvdb::util::NullInterrupter* interrupter)
{
    const std::vector<int64_t>& spheres = settings.budgeted().budget.spheres;
    const int64_t most =
        spheres.empty() ? INT64_MAX : *std::max_element(spheres.begin(), spheres.end());
    const detail::InnerOrder order =
        detail::innerOrder(medial.layout, medial.balls, settings.dim, most, interrupter);
    std::vector<ExactSphere> result;
    for (const int32_t ball : order.ball) result.push_back(tight::fineBall(medial.balls[ball]));
    return result;
}

} // namespace

void appendNearestTree(SphereTree& tree, const openvdb::MaskTree& object, StageSeconds& seconds,
    openvdb::util::NullInterrupter* interrupter)
{
    const SphereTreeSettings& settings = tree.settings;
    const bool flat = settings.dim == 2;
    const int32_t plane = flat ? firstPlane(object) : 0;
    const openvdb::MaskTree voxels = flat ? atPlaneZero(object, plane) : object;
    LevelQueries queries;
    queries.memory = settings.memory;
    const MedialLevel medial(voxels, settings.dim, Distance(), interrupter, &seconds, queries);
    auto inner = detail::timed("inner balls", interrupter, &seconds.tree,
        [&] { return innerSpheres(medial, settings, interrupter); });
    const tight::SampledObject samples(medial.layout);
    const detail::Stage stage("nearest spheres", interrupter, &seconds.tree);
    detail::StepProgress progress(interrupter);
    const NearestObject nearest{
        voxels, samples, medial.layout.voxelCount(), settings.dim, settings.memory, &progress};
    LevelSearch search(nearest, std::move(inner), tree.voxelSize(), progress);
    const SphereBudget& budget = settings.budgeted().budget;
    constexpr double kUsual = 15; // searches for the fewest spheres within a bound
    const double searches = budget.error ? kUsual : double(budget.counts(search.most()).size());
    progress.expect(searches);
    const std::vector<int64_t> counts = countsOf(budget, search);
    tree.subdivision = int(tight::kFine);
    tree.levels.resize(counts.size());
    LevelAppender levels(tree, plane, interrupter);
    const Level* coarser = nullptr;
    for (int k = int(counts.size()) - 1; k >= 0; --k) {
        const Level& level =
            coarser ? search.noWorseThan(*coarser, counts[k]) : search.of(counts[k]);
        tree.levels[k].level = k;
        levels.append(level, tree.levels[k]);
        coarser = &level;
    }
}

} // namespace openvdb_spheretree::nearest
