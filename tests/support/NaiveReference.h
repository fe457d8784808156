// SPDX-License-Identifier: Apache-2.0
/// @file NaiveReference.h
/// @brief What the core stages compute, by definition and one voxel at a time: every object voxel
/// against every background voxel, every object voxel against every site. Shares no code with the
/// library.
///
/// Other lengths than |.|^2 may be given: those of a norm, not squared.
///
/// Squared distance of p: the smallest |p - b|^2 over all background voxels b of the object's box,
/// one wider on every side (the nearest background voxel never lies further out).
/// Label of q: the object voxel p of largest distSq(p) - |p - q|^2, then of largest distSq(p), then
/// the first in the order of Coord::operator<. Medial balls: the voxels that label one.
/// With dim = 2 the z axis takes no part: every slice is an object of its own.
///
/// Cost: O(voxels^2); LineReference.h is for larger objects.

#pragma once

#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <set>
#include <vector>

namespace spheretree_test {

using openvdb::Coord;
using openvdb::CoordBBox;

/// In the order of Coord::operator<, each once.
using Voxels = std::vector<Coord>;

inline void sortVoxels(Voxels& voxels)
{
    std::sort(voxels.begin(), voxels.end());
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
}

inline CoordBBox boxOf(const Voxels& voxels)
{
    CoordBBox box;
    for (const Coord& voxel : voxels) box.expand(voxel);
    return box;
}

inline Voxels voxelsOfBox(const CoordBBox& box)
{
    Voxels voxels;
    for (int x = box.min()[0]; x <= box.max()[0]; ++x) {
        for (int y = box.min()[1]; y <= box.max()[1]; ++y) {
            for (int z = box.min()[2]; z <= box.max()[2]; ++z) voxels.emplace_back(x, y, z);
        }
    }
    return voxels;
}

inline Voxels translated(Voxels voxels, const Coord& by)
{
    for (Coord& voxel : voxels) voxel += by;
    return voxels;
}

inline int64_t squaredDistance(const Coord& a, const Coord& b)
{
    const int64_t x = int64_t(a[0]) - b[0], y = int64_t(a[1]) - b[1], z = int64_t(a[2]) - b[2];
    return x * x + y * y + z * z;
}

/// A function of two voxels.
using Length = std::function<int64_t(const Coord&, const Coord&)>;

/// Costs of a step across a face, an edge, a corner.
using Weights = std::array<int, 3>;

/// The norm with these costs: corner steps until the smallest coordinate is 0, then edge steps,
/// then face steps.
inline Length normOf(const Weights& weights)
{
    return [weights](const Coord& p, const Coord& q) {
        std::array<int64_t, 3> d;
        for (int axis = 0; axis < 3; ++axis) d[axis] = std::abs(int64_t(p[axis]) - q[axis]);
        std::sort(d.begin(), d.end());
        return weights[2] * d[0] + weights[1] * (d[1] - d[0]) + weights[0] * (d[2] - d[1]);
    };
}

class NaiveReference {
public:
    struct Ball {
        Coord center;
        int64_t radiusSq;
    };

    explicit NaiveReference(Voxels voxels, int dim = 3, Length length = squaredDistance)
        : mVoxels(std::move(voxels)), mDim(dim), mLength(std::move(length))
    {
        sortVoxels(mVoxels);
        computeDistances();
        computeLabels();
    }

    const Voxels& voxels() const { return mVoxels; }
    int64_t distSq(std::size_t voxel) const { return mDistSq[voxel]; }
    const Coord& label(std::size_t voxel) const { return mVoxels[mLabels[voxel]]; }

    /// In the order of their centres.
    std::vector<Ball> balls() const
    {
        std::vector<Ball> result;
        for (std::size_t site : std::set<std::size_t>(mLabels.begin(), mLabels.end())) {
            result.push_back({mVoxels[site], mDistSq[site]});
        }
        return result;
    }

private:
    bool apart(const Coord& a, const Coord& b) const { return mDim == 2 && a[2] != b[2]; }

    void computeDistances()
    {
        CoordBBox box = boxOf(mVoxels);
        box.expand(1);
        Voxels background;
        for (const Coord& voxel : voxelsOfBox(box)) {
            const bool on = std::binary_search(mVoxels.begin(), mVoxels.end(), voxel);
            if (!on) background.push_back(voxel);
        }
        for (const Coord& p : mVoxels) {
            int64_t nearest = std::numeric_limits<int64_t>::max();
            for (const Coord& b : background) {
                if (!apart(p, b)) nearest = std::min(nearest, mLength(p, b));
            }
            mDistSq.push_back(nearest);
        }
    }

    void computeLabels()
    {
        for (const Coord& q : mVoxels) {
            std::size_t best = mVoxels.size();
            int64_t bestValue = 0;
            for (std::size_t p = 0; p < mVoxels.size(); ++p) {
                if (apart(mVoxels[p], q)) continue;
                const int64_t value = mDistSq[p] - mLength(mVoxels[p], q);
                if (best == mVoxels.size() || value > bestValue
                    || (value == bestValue && winsTie(p, best))) {
                    best = p;
                    bestValue = value;
                }
            }
            mLabels.push_back(best);
        }
    }

    bool winsTie(std::size_t p, std::size_t best) const
    {
        if (mDistSq[p] != mDistSq[best]) return mDistSq[p] > mDistSq[best];
        return mVoxels[p] < mVoxels[best];
    }

    Voxels mVoxels;
    int mDim;
    Length mLength;
    std::vector<int64_t> mDistSq;
    std::vector<std::size_t> mLabels;
};

/// @brief The levels of the OR pyramid as sets of voxels, the finest first, down to a single voxel.
/// Levels above 0 are counted from the object's box minimum, rounded down to a multiple of 8.
inline std::vector<std::set<Coord>> naiveOrPyramid(const Voxels& object, int factor, int dim = 3)
{
    const auto floorDiv = [](int64_t a, int64_t b) {
        int64_t quotient = a / b;
        if (quotient * b > a) --quotient;
        return int(quotient);
    };
    const Coord lowest = boxOf(object).min();
    Coord origin(
        8 * floorDiv(lowest[0], 8), 8 * floorDiv(lowest[1], 8), 8 * floorDiv(lowest[2], 8));
    std::vector<std::set<Coord>> levels;
    levels.emplace_back(object.begin(), object.end());
    while (levels.back().size() > 1) {
        std::set<Coord> next;
        for (const Coord& voxel : levels.back()) {
            const Coord v = voxel - origin;
            next.insert(Coord(floorDiv(v[0], factor), floorDiv(v[1], factor),
                dim == 2 ? v[2] : floorDiv(v[2], factor)));
        }
        levels.push_back(next);
        origin = Coord(0, 0, 0);
    }
    return levels;
}

} // namespace spheretree_test
