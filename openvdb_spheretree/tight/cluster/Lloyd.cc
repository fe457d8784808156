// SPDX-License-Identifier: Apache-2.0
#include "Lloyd.h"

#include <openvdb_spheretree/base/Hash.h>

#include <algorithm>
#include <limits>

namespace openvdb_spheretree::tight {

namespace {

constexpr int kRounds = 200;
/// Coordinates are below 2^kBits, so squared distances are below 2^31.
constexpr int kBits = 14;

/// The points on a grid that is as fine as their squared distances allow.
class Clusters {
public:
    explicit Clusters(const std::vector<VoxelBlock>& points) : mNearest(points.size())
    {
        int64_t widest = 0;
        for (int a = 0; a < 3; ++a) {
            const auto [lo, hi] = std::minmax_element(
                points.begin(), points.end(), [&](const VoxelBlock& x, const VoxelBlock& y) {
                    return x.center[a] < y.center[a];
                });
            mOrigin[a] = lo->center[a];
            widest = std::max(widest, hi->center[a] - lo->center[a]);
        }
        while (widest >> mShift >= int64_t(1) << kBits) ++mShift;
        for (const VoxelBlock& point : points) {
            for (int a = 0; a < 3; ++a) {
                mAt[a].push_back(int32_t((point.center[a] - mOrigin[a]) >> mShift));
            }
            mWeight.push_back(point.voxels);
        }
    }

    void seed(std::size_t count, uint64_t seed)
    {
        std::vector<int32_t> nearestSq(size(), std::numeric_limits<int32_t>::max());
        std::size_t chosen = seed == 0 ? farthestFromMiddle() : drawn(mWeight, detail::hash(seed));
        while (true) {
            mCenters.push_back({mAt[0][chosen], mAt[1][chosen], mAt[2][chosen]});
            if (mCenters.size() == count) return;
            std::vector<int64_t> chance(size());
            for (std::size_t i = 0; i < size(); ++i) {
                nearestSq[i] = std::min(nearestSq[i], distanceSq(i, mCenters.back()));
                chance[i] = seed == 0 ? nearestSq[i] : weighted(i, nearestSq[i]);
            }
            const auto most = std::max_element(chance.begin(), chance.end());
            if (*most == 0) return; // every point is a center
            chosen = seed == 0 ? std::size_t(most - chance.begin())
                               : drawn(chance, detail::hash(seed ^ detail::hash(mCenters.size())));
        }
    }

    /// @return whether a point went to another center.
    bool assign()
    {
        std::vector<int32_t> best(size(), std::numeric_limits<int32_t>::max()), nearest(size(), 0);
        for (std::size_t c = 0; c < mCenters.size(); ++c) {
            const Center center = mCenters[c];
            for (std::size_t i = 0; i < size(); ++i) { // no branches: made for vector units
                const int32_t square = distanceSq(i, center);
                nearest[i] = square < best[i] ? int32_t(c) : nearest[i];
                best[i] = std::min(best[i], square);
            }
        }
        mDistanceSq.swap(best);
        const bool changed = nearest != mNearest || !mAssigned;
        mAssigned = true;
        mNearest.swap(nearest);
        return changed;
    }

    void recenter()
    {
        std::vector<std::array<int64_t, 4>> sums(mCenters.size());
        for (std::size_t i = 0; i < size(); ++i) {
            auto& sum = sums[std::size_t(mNearest[i])];
            for (int a = 0; a < 3; ++a) sum[a] += mWeight[i] * mAt[a][i];
            sum[3] += mWeight[i];
        }
        for (std::size_t c = 0; c < mCenters.size(); ++c) {
            if (sums[c][3] > 0) {
                for (int a = 0; a < 3; ++a) {
                    mCenters[c][a] = int32_t((sums[c][a] + sums[c][3] / 2) / sums[c][3]);
                }
                continue;
            }
            const auto far = std::max_element(mDistanceSq.begin(), mDistanceSq.end());
            const auto i = std::size_t(far - mDistanceSq.begin());
            for (int a = 0; a < 3; ++a) mCenters[c][a] = mAt[a][i];
            *far = 0; // another empty one takes another point
        }
    }

    std::vector<FineCenter> centers() const
    {
        std::vector<FineCenter> centers;
        for (const Center& center : mCenters) {
            FineCenter& fine = centers.emplace_back();
            for (int a = 0; a < 3; ++a) fine[a] = mOrigin[a] + (int64_t(center[a]) << mShift);
        }
        return centers;
    }

private:
    using Center = std::array<int32_t, 3>;

    std::size_t size() const { return mWeight.size(); }

    int32_t distanceSq(std::size_t i, const Center& center) const
    {
        const int32_t x = mAt[0][i] - center[0], y = mAt[1][i] - center[1],
                      z = mAt[2][i] - center[2];
        return x * x + y * y + z * z;
    }

    /// The sum of all of them stays below 2^63 for 2^20 points.
    int64_t weighted(std::size_t i, int32_t distanceSq) const
    {
        constexpr int64_t kMost = 4096;
        return std::min(mWeight[i], kMost) * distanceSq;
    }

    std::size_t farthestFromMiddle() const
    {
        std::array<int64_t, 3> middle{};
        for (int a = 0; a < 3; ++a) {
            for (const int32_t at : mAt[a]) middle[a] += at;
        }
        Center center;
        for (int a = 0; a < 3; ++a) center[a] = int32_t(middle[a] / int64_t(size()));
        std::size_t best = 0;
        for (std::size_t i = 1; i < size(); ++i) {
            if (distanceSq(i, center) > distanceSq(best, center)) best = i;
        }
        return best;
    }

    /// @return a place, each with a chance that goes as its number.
    static std::size_t drawn(const std::vector<int64_t>& chances, uint64_t random)
    {
        uint64_t all = 0;
        for (const int64_t chance : chances) all += uint64_t(chance);
        uint64_t left = random % all;
        std::size_t i = 0;
        while (left >= uint64_t(chances[i])) left -= uint64_t(chances[i++]);
        return i;
    }

    int64_t mOrigin[3];
    int mShift = 0;
    std::vector<int32_t> mAt[3];
    std::vector<int64_t> mWeight;
    std::vector<Center> mCenters;
    std::vector<int32_t> mNearest, mDistanceSq; ///< of each point: its center, and how far that is
    bool mAssigned = false;
};

} // namespace

std::vector<FineCenter> clusterCenters(
    const std::vector<VoxelBlock>& points, std::size_t count, uint64_t seed)
{
    Clusters clusters(points);
    clusters.seed(count, seed);
    for (int round = 0; round < kRounds && clusters.assign(); ++round) clusters.recenter();
    return clusters.centers();
}

} // namespace openvdb_spheretree::tight
