// SPDX-License-Identifier: Apache-2.0
/// @file ContinuousCollide.h
/// @brief When a body that moves first meets another one, which stands still or moves as well.
///
///     const auto first = continuousCollide(room, poseOfRoom, robot, RigidMotion::screw(from, to));
///     if (first.isCollide) ... first.timeOfContact ...
///     const auto both = continuousCollide(arm, motionOfArm, robot, motionOfRobot);
///
/// Nothing is sampled. Before the time that is found no voxel cubes of the two meet, where both trees hold their objects
/// (QueryTree::holdsObject()); and no leaf spheres, where both hold their leaves (holdsLeaves()). (With a `securityMargin` none are nearer than that.)
/// At that time the bodies are `tolerance` apart at most, beyond the margin. That a motion is free is as
/// certain. (A pair that passes within the tolerance without meeting may count as contact.)
///
/// Of two bodies that move at the same time each goes along its own line or screw. As one sees the other that is no screw, so
/// a step of time is shorter and takes more; where neither turns, or the first one stands still, it is the question to one that moves.
///
/// How: MotionKernels.h. Nothing is allocated. Results are the same on every instruction set, and calls are thread-safe.
/// Tests: TestContinuousCollide.cc, at 300 instants before each contact.

#pragma once

#include "Contact.h"
#include "QueryTree.h"
#include "RigidMotion.h"
#include "RigidTransform.h"

#include <cstdint>
#include <optional>

namespace openvdb_spheretree {

struct ContinuousCollisionRequest {
    /// World units, above 0; 10^-12 of the smaller body's radius are the least. 0: a ten-thousandth of that radius.
    double tolerance = 0;
    /// The motion is looked at from time 0 to this: above 0, 1 at most.
    double endTime = 1;
    /// No more blocks than this are tested. -1: any number.
    int64_t maxBlocks = -1;
    /// Bodies nearer than this are in contact: world units, 0 or more.
    double securityMargin = 0;
};

struct ContinuousCollisionResult {
    bool isCollide = false;
    /// Of the first contact; endTime if there is none.
    double timeOfContact = 1;
    /// Nothing meets before: timeOfContact itself, unless blocks came to an end.
    double freeUntil = 0;
    /// The leaf spheres that meet, where they are at that time.
    std::optional<Contact> contact;
    bool isDecided = true; ///< false: maxBlocks came to an end, and there may be an earlier contact
    int64_t blocks = 0;    ///< tested, each step of time for itself; the same on every machine
};

/// @param poseA    where a stands still
/// @param motionB  of b, in the world
/// @throw openvdb::ValueError for a tolerance, a time or a number of blocks that is none, or bodies that come to lie too
///        far away (10^12 world units)
ContinuousCollisionResult continuousCollide(const QueryTree& a, const RigidTransform& poseA,
    const QueryTree& b, const RigidMotion& motionB, const ContinuousCollisionRequest& request = {});

/// @param motionA,motionB  of both, in the world, at the same time
/// @throw openvdb::ValueError as above
ContinuousCollisionResult continuousCollide(const QueryTree& a, const RigidMotion& motionA,
    const QueryTree& b, const RigidMotion& motionB, const ContinuousCollisionRequest& request = {});

} // namespace openvdb_spheretree
