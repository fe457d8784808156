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

#include <openvdb/Types.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <vector>

namespace spheretree_test {

using openvdb::Coord;
using openvdb::CoordBBox;

/// In the order of Coord::operator<, each once.
using Voxels = std::vector<Coord>;

void sortVoxels(Voxels& voxels);
CoordBBox boxOf(const Voxels& voxels);
Voxels voxelsOfBox(const CoordBBox& box);
Voxels translated(Voxels voxels, const Coord& by);

inline int64_t squaredDistance(const Coord& a, const Coord& b)
{
    const int64_t x = int64_t(a[0]) - b[0], y = int64_t(a[1]) - b[1], z = int64_t(a[2]) - b[2];
    return x * x + y * y + z * z;
}

/// Costs of a step across a face, an edge, a corner.
using Weights = std::array<int, 3>;

/// The length between two voxels: |.|^2, or that of a norm. References ask for it a million times, so it is inline.
class Length {
public:
    Length() = default;

    /// The norm with these costs: corner steps until the smallest coordinate is 0, then edge steps,
    /// then face steps.
    explicit Length(const Weights& weights) : mIsNorm(true), mWeights(weights) {}

    int64_t operator()(const Coord& a, const Coord& b) const
    {
        if (!mIsNorm) return squaredDistance(a, b);
        const auto [x, y, z] = std::array<int64_t, 3>{std::abs(int64_t(a[0]) - b[0]),
            std::abs(int64_t(a[1]) - b[1]), std::abs(int64_t(a[2]) - b[2])};
        const int64_t least = std::min({x, y, z}), most = std::max({x, y, z});
        const int64_t middle = x + y + z - least - most;
        return mWeights[2] * least + mWeights[1] * (middle - least) + mWeights[0] * (most - middle);
    }

private:
    bool mIsNorm = false;
    Weights mWeights{};
};

class NaiveReference {
public:
    struct Ball {
        Coord center;
        int64_t radiusSq;
    };

    explicit NaiveReference(Voxels voxels, int dim = 3, const Length& length = {});

    const Voxels& voxels() const { return mVoxels; }
    int64_t distSq(std::size_t voxel) const { return mDistSq[voxel]; }
    const Coord& label(std::size_t voxel) const { return mVoxels[mLabels[voxel]]; }

    /// In the order of their centres.
    std::vector<Ball> balls() const;

private:
    bool apart(const Coord& a, const Coord& b) const { return mDim == 2 && a[2] != b[2]; }

    void computeDistances();
    void computeLabels();
    bool winsTie(std::size_t p, std::size_t best) const;

    Voxels mVoxels;
    int mDim;
    Length mLength;
    std::vector<int64_t> mDistSq;
    std::vector<std::size_t> mLabels;
};

/// @brief The levels of the OR pyramid as sets of voxels, the finest first, down to a single voxel.
/// Levels above 0 are counted from the object's box minimum, rounded down to a multiple of 8.
std::vector<std::set<Coord>> naiveOrPyramid(const Voxels& object, int factor, int dim = 3);

} // namespace spheretree_test
