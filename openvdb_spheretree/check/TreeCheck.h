// SPDX-License-Identifier: Apache-2.0
/// @file TreeCheck.h
/// @brief Verifies a finished sphere-tree against its object: everything it guarantees, recomputed
/// from what is stored.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <string>
#include <vector>

namespace openvdb_spheretree {

/// What a sphere-tree was found to break.
enum class FaultKind {
    Shape,        ///< arrays, levels, cuts or numbers: nothing else has been checked
    Place,        ///< the object lies where the tree has it, in world space
    Counts,       ///< recorded voxels, leaves, tiles and bounding box are the object's
    Records,      ///< topology and errors are recorded of each level that can have them, or of none
    Topology,     ///< recorded components, tunnels and cavities are those of the levels' voxels
    Radii,        ///< the three radii of a sphere agree
    Links,        ///< every node has one parent on the next level, and a child where it must
    Edges,        ///< edges of the Sphere-DAG are the object's
    LeafBalls,    ///< stored spheres contain the leaf balls below them
    DigitalBalls, ///< level 0 rebuilds the object; other levels rebuild their recorded voxels
    Coverage,     ///< no level misses a voxel, in exact radii nor in stored ones
    Chains,       ///< chains of spheres hold every voxel of the object, through levels and cuts
    Inside,       ///< inner spheres hold no voxel that the object has not
    Errors,       ///< recorded errors are those of the levels
    Surface       ///< stored spheres of a level cover a mesh: MeshCheck.h
};

/// @return its name in small letters, such as "shape" or "leaf balls".
std::string toString(FaultKind kind);

struct TreeFault {
    FaultKind kind;
    std::string sentence; ///< for people: what is wrong, and the first offender
};

/// @brief Check that a tree keeps what FaultKind lists.
///
/// Links: every non-root has one parent on the next level; inner nodes of extended and tight trees
/// have a child. LeafBalls: of extended trees, those centered on miniballs, and tight ones with
/// cover=balls. Chains: in a tight tree every voxel of the object has a chain of nodes, one a
/// level, each the child of the one above, that all hold it, in exact radii and in stored ones;
/// where there are cuts, those of 1, 2, 4, ... and all spheres have such chains up to them.
/// Coverage: of other trees, or where chains break. Inside: of trees with side=inner, in place of
/// these two. Of trees with side=fit nothing of the kind: what their spheres have in excess and miss is as
/// recorded, and their nodes need no child.
///
/// Of given spheres (GivenTree.h): shape, place, counts, records, radii, coverage and errors.
///
/// Topology: of level 0, and of levels whose digital balls rebuild all their voxels. In extended
/// trees, which drop balls, those above level 0 need not.
/// Records: levels of extended and reversible trees have a topology where the settings say so.
/// Either all levels have an error, or a reason for none, or no level has.
///
/// Not checked: *which* node of the next level is a parent, beyond what it must contain; and whether
/// spheres of a level differ, which those of tight trees need not. Edges are held against the object's
/// only where nothing was found before.
/// @return the faults in the order of the checks, each with its first offender; a kind may come several
///         times; empty if all holds
/// @throw Interrupted if the interrupter (may be null) said so; openvdb::ValueError where the object's
///        errors cannot be counted (LevelErrors.h)
/// Cost: more than building the tree; all threads.
std::vector<TreeFault> checkSphereTree(const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return whether a grid is what a tree was built over, as far as a glance tells: as many voxels, in the same box, in
///         the same place of the world.
bool isObjectOf(const openvdb::BoolGrid& object, const SphereTree& tree);

} // namespace openvdb_spheretree
