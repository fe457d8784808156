// SPDX-License-Identifier: Apache-2.0
/// @file BallsInBox.h
/// @brief Which of many balls matter in a box of voxels: what LeafDescent.h asks on its way down.
///
/// A ball does not matter in a box that it does not meet, nor where another one has more power in
/// all of the box: what the weaker one holds there, the stronger one holds as well. Powers are
/// compared with the ball that has the most in the middle of the box. A difference of two powers is
/// linear, so along each axis it is smallest at one of the ends.
///
/// Cost: about 4 ns a ball and box. In doubles, with room for rounding, so that balls of any size
/// are compared safely: a ball that does not matter may be listed, but none that matters is left
/// out.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <openvdb/Types.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace openvdb_spheretree::tight {

/// The ball with the most power in the middle of a box, of those seen so far.
struct StrongestBall {
    int32_t ball = -1; ///< none
    double power = -std::numeric_limits<double>::infinity();
    double size = 0; ///< radiusSq + distance^2: the power is rounded by a share of it
};

/// What the kernel reads of the balls.
struct BallArrays {
    const double *x, *y, *z, *radiusSq; ///< 1/16 voxel
};

/// A box by its middle and half its sides, 1/16 voxel.
struct BoxMiddle {
    explicit BoxMiddle(const openvdb::CoordBBox& box)
    {
        for (int a = 0; a < 3; ++a) {
            const double first = double(kFine) * box.min()[a], last = double(kFine) * box.max()[a];
            middle[a] = 0.5 * (first + last);
            half[a] = 0.5 * (last - first);
        }
    }

    double middle[3], half[3];
};

class BallsInBox {
public:
    explicit BallsInBox(const std::vector<ExactSphere>& balls);

    /// Appends to @a to those of @a from that meet the box, in order, but for some that have less
    /// power in all of it than the strongest one so far.
    /// @param untilHeld  stop soon after a strongest ball that holds all of the box: what follows
    ///                   may be left out
    /// @param strongest  of the same box, of balls before these; receives that of those looked at
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
