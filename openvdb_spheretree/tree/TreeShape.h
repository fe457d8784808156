// SPDX-License-Identifier: Apache-2.0
/// @file TreeShape.h
/// @brief What arrays, levels, numbers, parents and edges of a tree must be: one rule a function.
///
/// A rule finds all that break it. Errors name the first of them with its values; reports count
/// them. SphereTree::validate(), the readers and writers of files, the check of a tree and the rows
/// of its DAG use these: a tree that breaks one cannot be read. What a sound tree keeps beyond that is
/// in check/.

#pragma once

#include "SphereTree.h"
#include <openvdb_spheretree/base/TextStream.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

template <typename... Parts>
std::string sentence(const Parts&... parts)
{
    detail::TextStream text;
    (text << ... << parts);
    return text.str();
}

/// Nodes that break a rule: how many, and the first.
class Offenders {
public:
    void add(int32_t id)
    {
        if (mCount++ == 0) mFirst = id;
    }
    explicit operator bool() const { return mCount > 0; }
    friend std::ostream& operator<<(std::ostream& out, const Offenders& o)
    {
        return out << o.mCount << (o.mCount == 1 ? " node" : " nodes") << " (first: id " << o.mFirst
                   << ')';
    }

private:
    int64_t mCount = 0;
    int32_t mFirst = -1;
};

/// A rule that is broken.
struct Damage {
    std::string all;   ///< by how many, as a sentence of a report
    std::string first; ///< by whom first and with what value, as the message of an error
};

/// @name The rules of all trees
/// Those after shapeDamage() may be called only where it finds nothing.
/// @{

/// Centers are in units of 1/2, 1/16 or 1/1024 voxel.
std::vector<Damage> unitDamage(int subdivision);
/// There are nodes, all arrays have an entry for each, and units are right. There is a transform,
/// and it is linear. Levels are 0, 1, ... without a gap, or any single one; and ranges of ids, the
/// top level first.
std::vector<Damage> shapeDamage(const SphereTree& tree);
/// Centers are whole numbers of units and of 32 bits in voxels, and radii are finite and at least
/// 0.
std::vector<Damage> sphereDamage(const Spheres& spheres, int subdivision);
/// A parent is on the next level up, which leaves no room for a cycle; the top level has none.
std::vector<Damage> parentDamage(const SphereTree& tree);
/// Edges are sorted, and there once.
std::vector<Damage> edgeOrderDamage(const std::vector<DagEdge>& edges);
/// The same; and they are between nodes of the tree, and lead to the next level down.
std::vector<Damage> edgeDamage(const std::vector<DagEdge>& edges, const SphereTree& tree);
/// @}

/// Each node has a track of its own, below the next one to be given; or none has.
std::vector<Damage> trackDamage(const SphereTree& tree);

/// The box of the object does not end before it begins, has room for the object's voxels, and is no wider than what
/// trees are built of. Around given spheres it may be as wide as coordinates go.
std::vector<Damage> boxDamage(const SphereTree& tree);

/// Counts and errors beside the nodes are numbers from 0 on, and the object's box is one that can be.
std::vector<Damage> figureDamage(const SphereTree& tree);

/// @return what is wrong by all rules above, and digital balls without a radius (-1 marks spheres
///         that are none); where the ranges of levels are wrong, nothing else is looked at.
std::vector<Damage> treeDamage(const SphereTree& tree);

/// @brief The rules of cuts, spheres aside: arrays are alike in length; a node's parent comes after
/// it, and begins with the cut of one sphere less than the node ends with; every node above the
/// leaves has a child; and there is a cut of N nodes for every N from 1 to the number of leaves.
/// @return what is wrong first, as the end of a sentence about the cuts; empty if all holds. Cost:
///         linear.
std::string cutsDamage(const SphereCuts& cuts);
/// @return the number of spheres of the largest cut, which is that of the leaves; 0 of none.
int32_t leavesOf(const SphereCuts& cuts);

/// @throw openvdb::ValueError with the first, if there is any
void throwFirst(const std::vector<Damage>& damage);

/// @throw openvdb::ValueError naming the first thing that is wrong with cuts in these units
void requireCuts(const SphereCuts& cuts, int subdivision);

/// @return a tree without nodes and levels, and all else that @a tree knows beside them, edges and
///         cuts.
SphereTree describedLike(const SphereTree& tree);

} // namespace openvdb_spheretree::detail
