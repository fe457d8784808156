// SPDX-License-Identifier: Apache-2.0
/// @file BallsInBox.h
/// @brief Which of many balls matter in a box of voxels: what LeafDescent.h asks on its way down.
///
/// A ball does not matter in a box that it does not meet, nor where another one has more power in all of the
/// box: what the weaker one holds there, the stronger one holds as well. Powers are compared with the ball that has
/// the most in the middle of the box. A difference of two powers is linear, so along each axis it is smallest at
/// one of the ends.
///
/// Cost: about 4 ns a ball and box. In doubles, with room for rounding: a ball that does not matter may be
/// listed, but none that matters is left out.

#pragma once

#include <openvdb_spheretree/sphere/ExactSphere.h>

#include <openvdb/Types.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace openvdb_spheretree::tight {

/// The ball with the most power in the middle of a box, of those seen so far.
struct StrongestBall {
    int32_t ball = -1; ///< none
    double power = -std::numeric_limits<double>::infinity();
};

/// What the kernel reads of the balls.
struct BallArrays {
    const double *x, *y, *z, *radiusSq; ///< 1/16 voxel
};

class BallsInBox {
public:
    explicit BallsInBox(const std::vector<ExactSphere>& balls);

    /// Appends to @a to those of @a from that meet the box, in order, but for some that have less power in all of
    /// it than the strongest one so far.
    /// @param strongest  of balls before these; receives that of all
    /// @param untilHeld  end with a ball that holds all of the box
    void list(const openvdb::CoordBBox& box, const std::vector<int32_t>& from, bool untilHeld,
        StrongestBall& strongest, std::vector<int32_t>& to) const;

private:
    BallArrays arrays() const
    {
        return {mColumns[0].data(), mColumns[1].data(), mColumns[2].data(), mColumns[3].data()};
    }

    std::vector<double> mColumns[4];
};

} // namespace openvdb_spheretree::tight
