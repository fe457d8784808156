// SPDX-License-Identifier: Apache-2.0
/// @file Collide.h
/// @brief Whether two bodies meet, and where.
///
///     if (collide(a, poseA, b, poseB).verdict == Verdict::Touching) ...
///
/// Names are those of FCL and Coal where the meaning is the same. What answers say about leaf spheres and about objects is in
/// docs/queries.md: where both trees hold their objects, Verdict::Apart is certain, also in the last bit of poses; and
/// Verdict::Touching is decided between two leaf spheres in doubles.
///
/// A mesh has no inside, and a body within another one does not touch it. Spheres do.
///
/// Nothing is allocated but what a list of contacts takes, and while more than 64 of them are looked for as much again.
/// Results are the same on every instruction set, and calls are thread-safe. Cost: for "apart" every pair of spheres that
/// meet above the leaves is opened, some 40 blocks of 8 where a dragon of 128 voxels nearly touches another one. Tests:
/// TestCollide.cc, against all pairs of leaves; TestAllocations.cc.

#pragma once

#include "Contact.h"
#include "QueryTree.h"
#include "RigidTransform.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace openvdb_spheretree {

enum class Verdict : uint8_t { Apart, Touching, Undecided };

struct CollisionRequest {
    /// Bodies nearer than this touch: world units, 0 or more.
    double securityMargin = 0;
    /// Up to so many contacts go to the list of collide(); more than one: those of the deepest pairs. Memory and time go by
    /// those that are found.
    int maxContacts = 1;
    /// Also say where the pair of the result meets.
    bool enableContact = false;
    /// Also find a lower bound of the distance of bodies that are apart. Some 10% of the time; with several contacts a search of
    /// its own.
    bool enableDistanceLowerBound = false;
    /// Also decide about the objects where the spheres touch: a second search may follow.
    bool decideObjects = false;
    /// No more blocks than this are tested, then the verdict is Undecided. -1: any number. Each search of more than 64
    /// contacts, and that for the lower bound of several, has this many.
    int64_t maxBlocks = -1;
    /// The pair that touched a moment ago, looked at first. It takes no part where several contacts are asked for. Of trees that do
    /// not hold their leaves it may touch beside the objects, where a search without it finds them apart: both are true.
    NodePair warmStart;
};

struct CollisionResult {
    /// Touching: two leaf spheres do. Apart: objects are, of trees that hold theirs (holdsObject()); and leaf spheres
    /// are, of trees that hold those (holdsLeaves()). With cover=voxels leaf spheres may still meet beside the objects.
    Verdict verdict = Verdict::Undecided;
    /// Of the objects' voxel cubes. Without decideObjects they are Touching only if the pair in `nodes` shows it.
    Verdict objects = Verdict::Undecided;
    /// Of bodies that touch: any two leaf spheres that do, or the deepest ones of several.
    NodePair nodes;
    std::optional<Contact> contact; ///< of these, if asked for
    /// Of bodies that are apart: the distance of the objects, or of the leaf spheres, is no less, each where `verdict` is
    /// about them. Not asked for it is what is known anyway: 0, or the margin.
    double distanceLowerBound = 0;
    /// False: maxBlocks came to an end. Nothing is known, or of several contacts there may be deeper ones.
    bool isDecided = true;
    int64_t blocks = 0; ///< tested; the same on every machine

    bool isCollision() const { return verdict == Verdict::Touching; }
};

/// @param contacts  may be null; receives up to request.maxContacts of them, the deepest first. Its memory is
///                  used again.
/// @throw openvdb::ValueError for a margin below 0 or not finite, for contacts or blocks below 1, and for bodies that
///        only so large a margin could have touch that floats cannot square it (10^13 world units)
/// @throw openvdb::LookupError if one of the nodes of warmStart is no leaf
CollisionResult collide(const QueryTree& a, const RigidTransform& poseA, const QueryTree& b,
    const RigidTransform& poseB, const CollisionRequest& request = {},
    std::vector<Contact>* contacts = nullptr);

/// Called with pairs of leaf spheres that touch, some at a time, in a fixed order. False: no more.
using ContactCallback = std::function<bool(const NodePair* pairs, int count)>;

/// @brief Calls @a callback with all pairs of leaf spheres that are within @a securityMargin, each once. With cover=voxels
/// pairs may be missing where no voxel cubes are within it: ask trees of Exactness::LeafUnion for all.
/// @return the verdict; Touching also if the callback ended it. `nodes` is one of the pairs.
/// @throw openvdb::ValueError as above
CollisionResult collideAll(const QueryTree& a, const RigidTransform& poseA, const QueryTree& b,
    const RigidTransform& poseB, double securityMargin, const ContactCallback& callback);

/// @brief Many poses of one pair, in parallel: where b is in the frame of a.
/// @param request   maxContacts, the bound of the distance and warmStart take no part
/// @param verdicts  room for one a pose: CollisionResult::verdict, or with decideObjects CollisionResult::objects
/// @throw openvdb::ValueError as collide(); Interrupted if the interrupter (may be null) said so: verdicts are then
///        not all there
void collideBatch(const QueryTree& a, const QueryTree& b, const std::vector<RigidTransform>& poses,
    Verdict* verdicts, const CollisionRequest& request = {},
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
