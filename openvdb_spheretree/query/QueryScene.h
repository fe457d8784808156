// SPDX-License-Identifier: Apache-2.0
/// @file QueryScene.h
/// @brief Rigid bodies that move: which of them touch.
///
///     QueryScene scene;
///     const int hand = scene.add(handTree), scan = scene.add(scanTree);
///     scene.setPose(hand, pose);
///     for (const ScenePair& pair : scene.touchingPairs()) ...
///
/// Bodies of one shape share its QueryTree. Pairs that are never asked about are ignored: neighbouring links of a
/// robot, or two bodies that do not move.
///
/// *How.* The sphere around each body (QueryTree::center()), and all the way that it goes, is brought to the world. Pairs
/// whose spheres overlap (SweepPairs.h) may touch, and collide() or continuousCollide() decides. Finding them anew takes
/// less than one narrow question a body, so nothing is kept from pose to pose, and answers depend on the poses alone.
///
/// Cost: as SweepPairs.h, then the narrow questions, in parallel. Results are the same for any
/// number of threads. Asking is thread-safe, changing is not. Tests: TestQueryScene.cc and TestSceneMotions.cc, against
/// all pairs.

#pragma once

#include "Collide.h"
#include "ContinuousCollide.h"
#include "QueryTree.h"
#include "RigidMotion.h"
#include "RigidTransform.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace openvdb_spheretree {

/// Two bodies, a < b, and what is known of them.
struct ScenePair {
    int a = -1, b = -1;
    CollisionResult result;
    /// Up to maxContacts of the request, the deepest first, if that is more than one.
    std::vector<Contact> contacts;
};

/// Two bodies that move, a < b, and when they first touch.
struct MovingPair {
    int a = -1, b = -1;
    ContinuousCollisionResult result;
};

class QueryScene {
public:
    /// @return the number of the body: 0, 1, 2 ... as they are added.
    int add(const QueryTree& tree, const RigidTransform& pose = {});
    /// @return how many bodies were added: one more than the last number. Those that were removed count.
    int size() const { return int(mBodies.size()); }
    /// @return whether there is a body of this number, which was not removed.
    bool has(int body) const;

    /// @name A body by its number
    /// @throw openvdb::IndexError if there is none
    /// @{
    void setPose(int body, const RigidTransform& pose);
    const RigidTransform& pose(int body) const;
    const QueryTree& tree(int body) const;
    /// Its number is not given again, and pairs that were ignored for it are forgotten.
    void remove(int body);
    /// The pair is never among the answers; or again, with @a isIgnored = false.
    void ignore(int a, int b, bool isIgnored = true);
    bool isIgnored(int a, int b) const;
    /// @}

    /// @return pairs whose spheres are within @a margin (world units, 0 or more): no others can be. Sorted.
    /// @throw openvdb::ValueError for a margin that is none
    std::vector<std::pair<int, int>> nearPairs(double margin = 0) const;

    /// @return all pairs that do not come out as Verdict::Apart, sorted: those that touch, and with
    ///         request.maxBlocks those that are undecided.
    /// @param request      of each pair; warmStart takes no part
    /// @param interrupter  may be null
    /// @throw openvdb::ValueError as collide(), naming the pair; Interrupted
    std::vector<ScenePair> touchingPairs(const CollisionRequest& request = {},
        openvdb::util::NullInterrupter* interrupter = nullptr) const;

    /// @brief All bodies move at the same time, each on its own way; their poses take no part.
    /// @param motions  one a body, by number; that of a body that was removed takes no part
    /// @return all pairs that touch on their way, each with the time at which it first does, sorted by bodies; and with
    ///         request.maxBlocks those that are undecided. No voxel cubes of other pairs meet, where trees hold their
    ///         objects, and no leaf spheres, where they hold their leaves: as continuousCollide() has it.
    /// @throw openvdb::ValueError if there are not as many motions as size(), and as continuousCollide(), naming the pair;
    ///        Interrupted
    std::vector<MovingPair> firstContacts(const std::vector<RigidMotion>& motions,
        const ContinuousCollisionRequest& request = {},
        openvdb::util::NullInterrupter* interrupter = nullptr) const;

private:
    struct Body {
        QueryTree tree;
        RigidTransform pose;
    };
    using Pairs = std::vector<std::pair<int, int>>;

    const Body& body(int number) const;
    Pairs withoutIgnored(Pairs pairs) const;

    std::vector<std::optional<Body>> mBodies; ///< by number; none where it was removed
    std::set<std::pair<int, int>> mIgnored;
};

} // namespace openvdb_spheretree
