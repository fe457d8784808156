// SPDX-License-Identifier: Apache-2.0
/// @file SphereTreeSettings.h
/// @brief What the builder of a sphere-tree can be asked for. Every field is recorded in the tree
/// it builds, and all but `memory` in the files written from it.

#pragma once

#include "SphereBudget.h"
#include <openvdb_spheretree/pyramid/Closing.h>
#include <openvdb_spheretree/pyramid/PyramidModel.h>
#include <openvdb_spheretree/voxel/Dimension.h>
#include <openvdb_spheretree/voxel/Distance.h>

#include <cstdint>
#include <string>

namespace openvdb_spheretree {

enum class TreeType {
    Reversible, ///< every level rebuilds its own pyramid level (Broutta et al. 2009, 3.2)
    Extended,   ///< every sphere contains the leaf balls below it (Algorithm 2)
    Tight       ///< the least error at a number of spheres that we know how to reach: TightTree.h
};

enum class ParentRule {
    Centre, ///< the label of the parent voxel of the ball's centre (the paper's rule)
    Dag     ///< among the ball's parents in the Sphere-DAG, the one it protrudes from least
};

enum class Reconstruction {
    Clip, ///< rebuild a level from its spheres, within the box of the object's own pyramid level
    Free, ///< the same without the box: levels swell, and may need more steps to end at one sphere
    None  ///< coarsen a level as it is
};

enum class DagEdges {
    Shared,      ///< balls whose power cells share a voxel (Definition 2): SphereDag.h
    Intersecting ///< all spheres that meet (Eq. 3), for study: IntersectionDag.h
};

enum class RadiusScale {
    Tight, ///< f^k sqrt(radiusSq - 1) + sqrt(dim) (f^k - 1) / 2: no more than coverage needs
    Paper  ///< f^k sqrt(radiusSq) in place of the first term, on the levels above 0
};

/// How much work goes into a tight tree.
enum class Quality {
    Fast,   ///< merge the cheapest pair of neighbours, each ball around its own cells
    Normal, ///< a ball owes only what no other ball covers, and is placed to 1/16 voxel
    Best    ///< the same, and a search from there
};

/// What a sphere contains for certain.
enum class Cover {
    Voxels, ///< tight trees: every object voxel has a chain of spheres from top to bottom
    Balls   ///< every leaf ball below it
};

/// Where reversible and extended trees have their spheres' centres.
enum class Center {
    Medial,  ///< the centre of the medial ball
    Miniball ///< that of the smallest sphere around the leaf balls below
};

/// What level 0 of a tight tree is made of.
enum class Leaves {
    Pruned, ///< the medial balls that are left when those go whose voxels all lie in others
    Medial  ///< all medial balls
};

enum class Side {
    Outer, ///< spheres cover the object
    Inner  ///< spheres lie inside the object, and cover as much of it as they can
};

struct SphereTreeSettings {
    TreeType tree = TreeType::Tight;
    /// @name Tight trees
    /// @{
    Quality quality = Quality::Normal;
    SphereBudget budget; ///< which levels there are
    Cover cover = Cover::Voxels;
    Leaves leaves = Leaves::Pruned;
    Side side = Side::Outer;
    bool cuts = false; ///< also keep the tree for every number of spheres: SphereCuts.h
    /// @}
    Center center = Center::Medial; ///< reversible and extended trees
    /// @name Reversible and extended trees, unless it says otherwise; tight trees refuse others
    /// @{
    /// Voxels of a level merged per axis into one voxel of the next level: 2 to kMaxFactor.
    int factor = 2;
    /// All trees: 3, or 2 for an object one voxel thick along an axis, which then takes no part.
    int dim = 3;
    /// With dim = 2, the axis along which the object is one voxel thick (0, 1 or 2 for x, y, z).
    /// Found by the builder, whatever stands here.
    int flatAxis = 2;
    Distance dist; ///< what the balls are balls of
    /// Pyramid model: 0 for OR, else OR after a closing of this radius (voxels of the child level).
    int closing = 0;
    /// An including model of one's own, in place of the above. It sees an object with dim = 2
    /// turned so that it is flat along z. Files record that there was one, not which.
    PyramidModel customModel;
    /// Set by the builder, and on a tree read back, whose customModel is then empty.
    bool hadCustomModel = false;
    ParentRule parent = ParentRule::Centre;
    /// Extended tree: store the smallest sphere around its own centre that contains the leaf balls
    /// below it (Section 4.2 of the paper), rather than the one that the reconstruction used.
    bool finalFit = true;
    Reconstruction reconstruct = Reconstruction::Clip; ///< extended tree only
    RadiusScale scale = RadiusScale::Tight;
    /// @}
    /// Added to every radius that is stored, in voxels of level 0: 0 covers voxel centres, and
    /// kPadCubes (the only negative value) stands for sqrt(dim) / 2, which covers whole cubes.
    double padding = kPadCubes;
    /// Also collect the edges of the Sphere-DAG.
    bool dag = false;
    /// Also count components, tunnels and cavities of the voxels of every level.
    bool topology = true;
    DagEdges edges = DagEdges::Shared; ///< which ones; parent=dag always goes by shared voxels
    /// Name of the tree, and of the grid it is stored in.
    std::string name = "spheretree";
    /// Bytes that the labels of a level and what they are made from may take while they are
    /// computed; 0 for three quarters of the machine's memory. Where they need more, they are
    /// compressed, and then go to a temporary file (docs/algorithm.md, "Less memory than that").
    /// The tree is the same whatever it is, so no file records it.
    int64_t memory = 0;

    static constexpr double kPadCubes = -1.0;
    static constexpr double kMaxPadding = 1e9;
    /// @return the padding in voxels of level 0.
    double paddingVoxels() const;
    /// @throw openvdb::ValueError naming the first setting out of range, and its range.
    void validate() const;
};

/// @name The names that the command line and the metadata of files use
/// @{
const char* toString(TreeType);
const char* toString(ParentRule);
const char* toString(Reconstruction);
const char* toString(RadiusScale);
const char* toString(DagEdges);
const char* toString(Side);
const char* toString(Leaves);
const char* toString(Center);
const char* toString(Cover);
const char* toString(Quality);
/// @return "cubes", "voxels", or the number as text.
std::string paddingToString(double padding);
/// @return "75%" for 0, else the bytes, in GiB and so on where they come to a whole number.
std::string memoryToString(int64_t memory);
/// @return "or", "closing:2" and so on, or "custom".
std::string modelToString(const SphereTreeSettings&);
/// @throw openvdb::ValueError naming the value and the values there are.
TreeType treeTypeFromString(const std::string&);
ParentRule parentRuleFromString(const std::string&);
Reconstruction reconstructionFromString(const std::string&);
RadiusScale radiusScaleFromString(const std::string&);
DagEdges dagEdgesFromString(const std::string&);
Side sideFromString(const std::string&);
Leaves leavesFromString(const std::string&);
Center centerFromString(const std::string&);
Cover coverFromString(const std::string&);
Quality qualityFromString(const std::string&);
double paddingFromString(const std::string&);
/// @return the bytes of "4GiB", "500MB", "4e9" or, as a share of the machine's memory, "50%"; 0 for
///         "75%".
int64_t memoryFromString(const std::string&);
/// @return the radius of "closing:R", 0 for "or".
int closingFromString(const std::string&);
/// @}

} // namespace openvdb_spheretree
