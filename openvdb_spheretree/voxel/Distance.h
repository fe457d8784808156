// SPDX-License-Identifier: Apache-2.0
/// @file Distance.h
/// @brief The distances that balls may be made of: the Euclidean one, and the norms of a 3x3x3
/// neighbourhood (l1, l-infinity, chamfer).
///
/// A chamfer distance is the cost of the cheapest path from voxel to voxel, where a step across a
/// face, an edge or a corner costs a, b or c (G. Borgefors, "Distance transformations in digital
/// images", CVGIP 1986). With the coordinates of a difference sorted by size, x >= y >= z >= 0,
///     N(x, y, z) = a (x - y) + b (y - z) + c z = a x + (b - a) y + (c - b) z
/// which is a norm just when a >= b - a >= c - b >= 0: then it is the largest of these sums over
/// all orders of the coordinates. l1 is (1, 2, 3), l-infinity (1, 1, 1). In two dimensions c is not
/// used.
///
/// All distances are handled as squares: |d|^2, or N(d)^2. A norm is in units of which a voxel has
/// `unit()` = a.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace openvdb_spheretree {

class Distance {
public:
    static constexpr int kMaxWeight = 255;
    /// Squares of larger values do not fit 63 bits.
    static constexpr int64_t kFar = 3037000499;

    /// The Euclidean distance.
    Distance() = default;
    static Distance l1() { return {1, 2, 3}; }
    static Distance linf() { return {1, 1, 1}; }
    /// @throw openvdb::ValueError unless the weights are 1 to kMaxWeight and make a norm
    static Distance chamfer(int face, int edge, int corner);
    /// In a plane there are no corners: for objects with dim = 2 alone.
    /// @throw as above
    static Distance flatChamfer(int face, int edge);

    bool isEuclidean() const { return mFace == 0; }
    /// Costs of a step across a face, an edge, a corner; 0 for the Euclidean distance.
    int face() const { return mFace; }
    int edge() const { return mEdge; }
    int corner() const { return mCorner; }
    /// @return whether it has no cost of its own for a step across a corner, and so is for a plane.
    bool isFlat() const { return mFlat; }
    /// @return the width of a voxel in this distance.
    int unit() const { return isEuclidean() ? 1 : mFace; }

    /// @return N(x, y, z); only for norms.
    template <typename Number>
    Number norm(Number x, Number y, Number z) const
    {
        x = std::abs(x), y = std::abs(y), z = std::abs(z);
        const Number most = std::max(x, std::max(y, z)), least = std::min(x, std::min(y, z));
        const Number middle = x + y + z - most - least;
        return mFace * most + (mEdge - mFace) * middle + (mCorner - mEdge) * least;
    }
    /// @return the length of a vector, in units.
    double length(double x, double y, double z) const
    {
        return isEuclidean() ? std::sqrt(x * x + y * y + z * z) : norm(x, y, z);
    }
    /// @return the squared length of an integer vector, exactly; INT64_MAX where it does not fit 63
    ///         bits.
    int64_t lengthSq(int64_t x, int64_t y, int64_t z) const
    {
        if (std::max(std::abs(x), std::max(std::abs(y), std::abs(z))) > kFar) return INT64_MAX;
        if (!isEuclidean()) {
            const int64_t value = norm(x, y, z); // below 2^42
            return value > kFar ? INT64_MAX : value * value;
        }
        const uint64_t plane = uint64_t(x * x) + uint64_t(y * y); // twice kFar^2 is below 2^64
        if (plane > INT64_MAX) return INT64_MAX;
        const uint64_t sum = plane + uint64_t(z * z);
        return int64_t(std::min<uint64_t>(sum, INT64_MAX)); // itself no sum of three squares
    }

    /// @return the largest r with lengthSq(x, y, r) <= limitSq; -1 if there is none.
    int64_t reach(int64_t x, int64_t y, int64_t limitSq) const
    {
        const int64_t soFar = lengthSq(x, y, 0);
        if (soFar > limitSq || soFar == INT64_MAX) return -1;
        const int64_t left = limitSq - soFar;
        // Below 2^52 the rounded root has the right floor (base/IntegerRoot.h).
        constexpr int64_t kExact = int64_t(1) << 52;
        if (isEuclidean() && left < kExact) return int64_t(std::sqrt(double(left)));
        return isEuclidean() ? farReach(left) : normReach(x, y, limitSq);
    }

    /// @param radiusSq  of a norm a square
    /// @return a closed radius, squared, whose ball holds just the voxels of the open ball
    ///         { q : lengthSq(q) < radiusSq }: radiusSq - 1; of a norm, the square of the largest
    ///         cost of any path that is below the radius.
    int64_t closedSq(int64_t radiusSq) const;

    bool operator==(const Distance& o) const
    {
        return mFace == o.mFace && mEdge == o.mEdge && mCorner == o.mCorner && mFlat == o.mFlat;
    }
    bool operator!=(const Distance& o) const { return !(*this == o); }

private:
    static int64_t farReach(int64_t leftSq);
    int64_t normReach(int64_t x, int64_t y, int64_t limitSq) const;

    Distance(int face, int edge, int corner) : mFace(face), mEdge(edge), mCorner(corner) {}

    int mFace = 0, mEdge = 0, mCorner = 0;
    bool mFlat = false;
};

/// @return "l2", "l1", "linf", "chamfer:a,b,c", or "chamfer:a,b" in a plane.
std::string toString(const Distance&);
/// @throw openvdb::ValueError naming the value and what there is.
Distance distanceFromString(const std::string&);

} // namespace openvdb_spheretree
