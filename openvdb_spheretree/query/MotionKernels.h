// SPDX-License-Identifier: Apache-2.0
/// @file MotionKernels.h
/// @brief The search for the first time at which leaves of two bodies meet, of which one moves, or both.
///
/// One descent of both trees, keyed by time: a pair waits with a time before which it cannot meet, the soonest of a block on
/// top, and ends where that is not before the best contact so far. For leaves that time is found to the tolerance in doubles.
///
/// *A safe step* (conservative advancement; B. Mirtich, 1996) of spheres, which do not turn: at time t let g be the gap, a the
/// acceleration of the center. For a time H the center stays within s = a H^2 / 2 of the straight way along its
/// velocity. With H = sqrt(g / a), s is g / 2 at most. So nothing meets before the straight way comes within the
/// radii plus s, which a quadratic equation tells, or before H. A sphere of an inner node takes two steps: any number is safe.
///
/// *Where both move* all this is of the vector between their centers, in a frame that does not turn: its velocity is the difference of
/// both, at that time, and its acceleration is the sum of theirs at most.

#pragma once

#include "MotionFrame.h"
#include "MutualFrame.h"
#include "PairKernels.h"

namespace openvdb_spheretree::detail {

struct MotionLimits {
    double margin = 0;    ///< what gaps are less by
    double tolerance = 0; ///< such a gap of this or less is contact
    double end = 1;       ///< times go from 0 to this
    int64_t maxBlocks = std::numeric_limits<int64_t>::max();
};

struct MotionEnd {
    LeafPair pair;   ///< that meets first; its gap is that at `time`
    double time = 0; ///< of contact; the end if there is none
    double free = 0; ///< nothing meets before
    bool isDecided = true;
    int64_t blocks = 0;
};

/// @param frame  in floats
MotionEnd findFirstContact(const MotionFrame& frame, const MotionLimits& limits);
MotionEnd findFirstContact(const MutualFrame& frame, const MotionLimits& limits);

/// @return where two spheres first are in contact, from @a from on, and their gap then in @a gap; more than @a end if they
///         never are.
double timeOfContact(const MotionFrame& frame, const FloatSphere& ofA, const FloatSphere& ofB,
    double from, double end, const MotionLimits& limits, double& gap);
double timeOfContact(const MutualFrame& frame, const FloatSphere& ofA, const FloatSphere& ofB,
    double from, double end, const MotionLimits& limits, double& gap);

} // namespace openvdb_spheretree::detail
