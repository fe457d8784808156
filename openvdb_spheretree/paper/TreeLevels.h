// SPDX-License-Identifier: Apache-2.0
/// @file TreeLevels.h
/// @brief What the tree builders share: a level's nodes while the tree grows from level 0 to its
/// root.

#pragma once

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/pyramid/PyramidModel.h>
#include <openvdb_spheretree/tree/LevelFrame.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace openvdb_spheretree::detail {

/// The nodes of one level; their indices are within the level.
struct LevelNodes {
    std::vector<MedialBall> balls; ///< ordered by center
    std::vector<double> radius;    ///< units of the distance, on level 0; empty: as the balls are
    std::vector<int64_t> coverSq;  ///< the same, exactly: see SphereTree
    std::vector<int32_t> parent;   ///< node of the next level; empty at the root
    std::vector<DagEdge> dag;      ///< edges to nodes of the next level, if asked for
    int64_t pyramidVoxels = 0;
    std::optional<LevelTopology> topology; ///< of these voxels, if asked for
};

/// @brief Stop before a tree grows that has no room, as soon as the balls of level 0 are known.
/// @throw openvdb::ValueError if there are more nodes than ids, or their arrays (SphereTree) need
///        more memory than this machine has
void requireRoomForNodes(std::size_t nodes);

/// @return whether a build looks at the labels of all voxels.
bool needsDag(const PyramidOptions& options);

/// What a build is given, and where it reports to.
struct BuildContext {
    const SphereTreeSettings& settings;
    const PyramidOptions& options; ///< of the settings
    openvdb::Coord origin;
    openvdb::CoordBBox bbox; ///< of the object
    openvdb::util::NullInterrupter* interrupter;
    StageSeconds* seconds;
    PyramidModel model; ///< empty: OR

    /// The step from @a level to the one above it.
    PyramidStep stepFrom(int level) const
    {
        return {level == 0 ? origin : openvdb::Coord(), options.factor, settings.dim};
    }
    /// @return the level of these voxels.
    /// @param children  nodes of the level below, if there is one: linkLevels() finds their parents
    std::unique_ptr<MedialLevel> medialLevel(
        const openvdb::MaskTree& voxels, int level, const LevelNodes* children = nullptr) const;
    /// @return the level above @a level, whose voxels are @a voxels.
    /// @throw openvdb::ValueError if the model is not including, or does not come to an end
    openvdb::MaskTree::Ptr coarsened(const openvdb::MaskTree& voxels, int level) const;
    LevelFrame frame(int level) const { return LevelFrame(level, origin, settings); }
    /// @return all balls of a level, which keeps them only where a DAG needs it.
    LevelNodes allBalls(std::unique_ptr<MedialLevel>& level) const;
};

/// @brief The one place that decides which model options ask for: customModel, else a closing, else
/// OR (empty).
/// @throw openvdb::ValueError if the options are those of a tree read back, whose custom model no
///        file holds
PyramidModel modelOf(const PyramidOptions& options, openvdb::util::NullInterrupter* interrupter);

/// How the nodes of a level hang on the medial balls of the next one.
struct Links {
    std::vector<int32_t> parent; ///< per node: index in the coarser level's balls
    std::vector<DagEdge> dag;    ///< coarser ball, node; empty unless the settings want a DAG
};

/// @return the topology of a level's voxels, if the settings want it.
std::optional<LevelTopology> topologyOf(const MedialLevel& level, const BuildContext& context);

/// @brief Find the parents of @a nodes among the balls of @a coarse, a level that was made with
/// them as children.
/// @param fine  the level whose balls the nodes are; needed for a DAG alone
Links linkLevels(const LevelNodes& nodes, int level, const MedialLevel* fine, MedialLevel& coarse,
    const BuildContext& context);

/// @brief The two kinds of tree, level 0 first, ending with a level of one node.
std::vector<LevelNodes> reversibleLevels(
    openvdb::MaskTree::Ptr object, const BuildContext& context);
std::vector<LevelNodes> extendedLevels(openvdb::MaskTree::Ptr object, const BuildContext& context);

} // namespace openvdb_spheretree::detail
