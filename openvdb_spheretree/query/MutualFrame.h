// SPDX-License-Identifier: Apache-2.0
/// @file MutualFrame.h
/// @brief Two bodies that both move, in the frame that each of them has at time 0.
///
/// Seen from a body that turns, the other one goes along no helix, and is accelerated by the turn as well. So the frames stand
/// still, and both bodies move in them: the block that is opened, and the sphere of the other body. What both slide along their axes
/// is one way, that of the other body less the block's: where they go along together, nothing of it is left.
/// With the terms of MotionFrame.h the vector between two centers is
///
///     between + sin(w t) v + (1 - cos(w t)) k - sin(w' t) v' - (1 - cos(w' t)) k' + t drift.

#pragma once

#include "MotionFrame.h"
#include "PairFrame.h"
#include "RigidMotion.h"

#include <openvdb/Types.h>

#include <array>

namespace openvdb_spheretree::detail {

/// In the frame of a block at time 0. What screws slide is in the drift.
struct MutualSide {
    Screw<float> own, other;
    std::array<float, 3> drift; ///< of the other body as seen from the block's, per time
};

struct MutualFrame {
    PairFrame pair;         ///< at time 0
    Screw<double> ofA, ofB; ///< in the frame of a, without what they slide
    openvdb::Vec3d drift;   ///< of b as seen from a
    MutualSide inA = {}, inB = {};
    float pad = 0; ///< as of a PairFrame, at any time

    MutualFrame(const QueryData& dataA, const RigidMotion& motionA, const QueryData& dataB,
        const RigidMotion& motionB);

    /// @throw openvdb::ValueError if anything comes to lie too far to square distances in floats
    void enterFloats();
    /// @return no less than the way of a point of b, as seen from a point of a, in a time of 1.
    double longestWay() const;
};

} // namespace openvdb_spheretree::detail
