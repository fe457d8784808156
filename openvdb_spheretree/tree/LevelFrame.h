// SPDX-License-Identifier: Apache-2.0
/// @file LevelFrame.h
/// @brief Where a level's balls are in the frame of level 0, and how large, exactly.
///
/// A voxel v of level k is the block f^k v + [0, f^k - 1]^dim. A medial ball (c, radiusSq) of level
/// k becomes the closed sphere
///     center  f^k c + (f^k - 1) / 2 + origin
///     radius  f^k sqrt(radiusSq - 1) + sqrt(dim) (f^k - 1) / 2
/// which covers every level-0 voxel center of the level-k voxels that the ball covers (the paper:
/// all radii of a level grow by the same value). Level 0 needs no frame: there the sphere of radius
/// sqrt(radiusSq - 1) holds just the ball's voxels.
///
/// With a norm N (Distance.h) radii are in its units, f^k closed + N(1, 1, 1) (f^k - 1) / 2, where
/// `closed` is the radius of the closed ball of the same voxels; such sums are integers.
///
/// Twice a radius is always a sum of two square roots of integers; such a sum is compared exactly
/// with the root of a third one, so which voxels a sphere holds is never a matter of rounding.

#pragma once

#include "SphereTreeSettings.h"
#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/medial/MedialAxis.h>
#include <openvdb_spheretree/voxel/Distance.h>

#include <openvdb/Types.h>

#include <array>
#include <cstdint>

namespace openvdb_spheretree {

/// Twice a point of index space: integers, also for centers between voxels.
struct Doubled {
    int64_t x, y, z;

    openvdb::Vec3d halved() const { return {0.5 * double(x), 0.5 * double(y), 0.5 * double(z)}; }
};

/// @return the squared distance of two doubled points (four times that of the points).
inline int64_t distanceSq(const Doubled& a, const Doubled& b, const Distance& distance = {})
{
    return distance.lengthSq(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// The radius (sqrt(a) + sqrt(b)) / 2, in units of the distance.
struct RootSum {
    int64_t a, b;

    /// @return the largest D with sqrt(D) <= 2 radius: a voxel center q is within the radius of a
    /// center c just when |2q - 2c|^2 <= D.
    int64_t coverSq() const
    {
        const auto product = 4 * (unsigned __int128)(a) * (unsigned __int128)(b);
        return a + b + (product ? detail::floorSqrtWide(product) : 0); // leaf balls have one root
    }
    /// @return the radius, rounded up.
    double radius() const
    {
        using namespace detail;
        return 0.5 * addUp(sqrtUp(toDoubleUp(a)), sqrtUp(toDoubleUp(b)));
    }
};

/// @return the largest D with sqrt(D) <= sqrt(a) + sqrt(b) + sqrt(c), exactly; all of these fit 62
/// bits.
int64_t coverSqOfRoots(int64_t a, int64_t b, int64_t c);

class LevelFrame {
public:
    /// A level's voxels may be this wide, in voxels of level 0: squares of twice its radii fit 63
    /// bits.
    static constexpr int64_t kMaxScale = int64_t(1) << 29;

    /// @param settings  those of no pyramid stand for the default
    /// @param flatAxis  not scaled if `dim` is 2
    /// @throw openvdb::ValueError if the level's voxels are wider than that, or than the distance's
    ///        weights allow
    LevelFrame(int level, const openvdb::Coord& origin, const SphereTreeSettings& settings,
        int flatAxis = 2);

    /// @return twice the center of a voxel of the level.
    Doubled center(const openvdb::Coord& ijk) const
    {
        return {mStep[0] * ijk[0] + mFirst[0], mStep[1] * ijk[1] + mFirst[1],
            mStep[2] * ijk[2] + mFirst[2]};
    }
    /// @return the radius of a ball of the level, by the formula above.
    /// @throw openvdb::ValueError if its square does not fit 63 bits
    RootSum radius(int32_t radiusSq) const;
    /// @return sqrt(dim) (f^k - 1) / 2, or the like of a norm: what a level-k radius in level-0
    /// voxels grows by.
    RootSum growth() const { return {0, mGrowthSq}; }
    /// @return f^k.
    int64_t scale() const { return mScale; }

private:
    [[noreturn]] void throwTooWide() const;

    int mLevel;
    bool mTight;
    Distance mDistance;
    int64_t mScale = 1;
    int64_t mGrowthSq;
    std::array<int64_t, 3> mStep, mFirst; ///< twice: from voxel to voxel, and where voxel 0 is
};

} // namespace openvdb_spheretree
