// SPDX-License-Identifier: Apache-2.0
#include "SphereTracks.h"

#include <openvdb_spheretree/base/Assignment.h>
#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace openvdb_spheretree {

namespace {

using openvdb::Vec3d;
using openvdb::util::NullInterrupter;
using Indices = std::vector<std::size_t>;

constexpr std::size_t kMostAtOnce = 256;

/// The spheres of a level, one entry each. Lengths are in world units, along the axes of the voxels.
struct Level {
    std::vector<Vec3d> center;
    std::vector<double> radius; ///< as stored
    std::vector<int32_t> track;
};

Level levelOf(const SphereTree& tree, const SphereTreeLevel& range)
{
    Level level;
    const double voxel = tree.voxelSize();
    for (int32_t id = range.begin; id < range.end; ++id) {
        level.center.push_back(tree.spheres.center[std::size_t(id)] * voxel);
        level.radius.push_back(double(tree.spheres.radiusWorld[std::size_t(id)]));
        level.track.push_back(tree.track.empty() ? id : tree.track[std::size_t(id)]);
    }
    return level;
}

/// Of the spheres as bodies of their own. Those of radius 0 count as a thousandth of the largest.
Vec3d centerOfMass(const Level& level)
{
    const double largest = *std::max_element(level.radius.begin(), level.radius.end());
    const double least = largest > 0 ? largest * 1e-3 : 1;
    Vec3d sum(0.0);
    double mass = 0;
    for (std::size_t i = 0; i < level.center.size(); ++i) {
        const double radius = std::max(level.radius[i], least);
        sum += level.center[i] * (radius * radius * radius);
        mass += radius * radius * radius;
    }
    return sum / mass;
}

double meanRadius(const Level& level)
{
    const double sum = std::accumulate(level.radius.begin(), level.radius.end(), 0.0);
    return sum / double(level.radius.size());
}

/// Pairs the spheres of one level of two frames.
class LevelPairing {
public:
    LevelPairing(const Level& now, const Level& last, NullInterrupter* interrupter)
        : mNow(now), mLast(last), mShift(centerOfMass(now) - centerOfMass(last)),
          mInterrupter(interrupter), mTrack(now.center.size(), -1)
    {}

    /// @return the track of each sphere, -1 for those that are new.
    std::vector<int32_t> pair()
    {
        Indices now(mNow.center.size()), last(mLast.center.size());
        std::iota(now.begin(), now.end(), std::size_t(0));
        std::iota(last.begin(), last.end(), std::size_t(0));
        pair(now, last);
        return std::move(mTrack);
    }

    /// @return the mean of all pairs after pair(); 0 without one.
    double meanMovement() const { return mPairs > 0 ? mMovement / double(mPairs) : 0; }

private:
    struct Rest {
        Indices now, last; ///< one of them is empty
    };

    /// All of the smaller set are paired: both its halves are no larger than those of the other. Depth: sets
    /// are halved.
    Rest pair(const Indices& now, const Indices& last)
    {
        if (now.empty() || last.empty()) return {now, last};
        if (std::max(now.size(), last.size()) <= kMostAtOnce) return pairAtOnce(now, last);
        Indices nowHalves[2], lastHalves[2];
        halve(now, last, nowHalves, lastHalves);
        const Rest low = pair(nowHalves[0], lastHalves[0]);
        const Rest high = pair(nowHalves[1], lastHalves[1]);
        Rest rest;
        for (const Rest* part : {&low, &high}) {
            rest.now.insert(rest.now.end(), part->now.begin(), part->now.end());
            rest.last.insert(rest.last.end(), part->last.begin(), part->last.end());
        }
        return rest;
    }

    Rest pairAtOnce(const Indices& now, const Indices& last)
    {
        detail::checkInterrupt(mInterrupter);
        const bool fewerNow = now.size() <= last.size();
        const Indices &rows = fewerNow ? now : last, &columns = fewerNow ? last : now;
        std::vector<double> costs;
        costs.reserve(rows.size() * columns.size());
        for (const std::size_t row : rows) {
            for (const std::size_t column : columns) {
                costs.push_back(fewerNow ? movement(row, column) : movement(column, row));
            }
        }
        const Indices chosen = detail::cheapestAssignment(rows.size(), columns.size(), costs);
        std::vector<bool> isTaken(columns.size(), false);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            isTaken[chosen[i]] = true;
            const std::size_t other = columns[chosen[i]];
            mTrack[fewerNow ? rows[i] : other] = mLast.track[fewerNow ? other : rows[i]];
            mMovement += costs[i * columns.size() + chosen[i]];
        }
        mPairs += rows.size();
        Rest rest;
        for (std::size_t j = 0; j < columns.size(); ++j) {
            if (!isTaken[j]) (fewerNow ? rest.last : rest.now).push_back(columns[j]);
        }
        return rest;
    }

    /// Halves both sets by rank along the longest side of the box of the first, so that halves of sets of
    /// one size are of one size.
    void halve(
        const Indices& now, const Indices& last, Indices (&nowHalves)[2], Indices (&lastHalves)[2])
    {
        const int axis = longestSide(now);
        split(now, nowHalves, [&](std::size_t i) { return mNow.center[i][axis]; });
        split(last, lastHalves, [&](std::size_t i) { return mLast.center[i][axis]; });
    }

    int longestSide(const Indices& spheres) const
    {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        Vec3d low(kFar), high(-kFar);
        for (const std::size_t i : spheres) {
            low = openvdb::math::minComponent(low, mNow.center[i]);
            high = openvdb::math::maxComponent(high, mNow.center[i]);
        }
        const Vec3d side = high - low;
        const int axis = side[1] > side[0] ? 1 : 0;
        return side[2] > side[axis] ? 2 : axis;
    }

    template <typename Place>
    static void split(const Indices& all, Indices (&halves)[2], const Place& place)
    {
        Indices sorted = all;
        std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(place(a), a) < std::pair(place(b), b);
        });
        const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
        halves[0].assign(sorted.begin(), middle);
        halves[1].assign(middle, sorted.end());
    }

    double movement(std::size_t now, std::size_t last) const
    {
        return (mNow.center[now] - (mLast.center[last] + mShift)).length()
            + std::abs(mNow.radius[now] - mLast.radius[last]);
    }

    const Level &mNow, &mLast;
    const Vec3d mShift;
    NullInterrupter* mInterrupter;
    std::vector<int32_t> mTrack;
    std::size_t mPairs = 0;
    double mMovement = 0; ///< of all pairs
};

int32_t takeNext(int32_t& next)
{
    if (next == std::numeric_limits<int32_t>::max()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the sequence has had 2^31 spheres, which is all that tracks can number: begin a new "
            "one");
    }
    return next++;
}

/// Calls body(range, now, before) for the levels that both trees have.
template <typename Body>
void forEachCommonLevel(const SphereTree& tree, const SphereTree& last, const Body& body)
{
    for (const SphereTreeLevel& range : tree.levels) {
        if (!last.hasLevel(range.level)) continue;
        body(range, levelOf(tree, range), levelOf(last, last.level(range.level)));
    }
}

} // namespace

void startTracks(SphereTree& tree)
{
    tree.track.resize(std::size_t(tree.size()));
    std::iota(tree.track.begin(), tree.track.end(), 0);
    tree.nextTrack = tree.size();
}

void continueTracks(SphereTree& tree, const SphereTree& last, NullInterrupter* interrupter)
{
    std::vector<int32_t> track(std::size_t(tree.size()), -1);
    forEachCommonLevel(
        tree, last, [&](const SphereTreeLevel& range, const Level& now, const Level& before) {
            const auto paired = LevelPairing(now, before, interrupter).pair();
            std::copy(paired.begin(), paired.end(), track.begin() + range.begin);
        });
    int32_t next = last.track.empty() ? last.size() : last.nextTrack;
    for (int32_t& each : track) {
        if (each < 0) each = takeNext(next);
    }
    tree.track = std::move(track);
    tree.nextTrack = next;
}

double movementSince(const SphereTree& last, const SphereTree& tree, NullInterrupter* interrupter)
{
    double sum = 0;
    forEachCommonLevel(
        tree, last, [&](const SphereTreeLevel&, const Level& now, const Level& before) {
            LevelPairing pairing(now, before, interrupter);
            pairing.pair();
            const double radius = meanRadius(before);
            sum += pairing.meanMovement() / (radius > 0 ? radius : last.voxelSize());
        });
    return sum;
}

} // namespace openvdb_spheretree
