// SPDX-License-Identifier: Apache-2.0
/// @file LevelErrors.cc
/// @brief The exact error of every level: excess, missing voxels, Hamming and one-sided Hausdorff.
///
/// Per level: the sparse union of its spheres; what it has and the object has not, node by node;
/// the farthest voxel of that. Missing voxels follow from the counts:
///     |O \ U| = |O| - (|U| - |U \ O|).
/// The many balls of a solid's level 0 are not drawn where they are its medial balls.

#include "LevelErrors.h"

#include "FarthestVoxel.h"
#include "MedialCover.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/index/NearestVoxel.h>
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/Grid.h>

#include <cmath>

namespace openvdb_spheretree {
namespace {

/// What the levels are compared with.
struct ObjectIndex {
    openvdb::MaskTree mask;
    detail::NearestVoxel nearest;
    int64_t voxels;

    ObjectIndex(const openvdb::BoolTree& tree, const Distance& distance)
        : mask(detail::maskOf(tree)), nearest(mask, distance), voxels(detail::countVoxels(mask))
    {}
};

/// Why an error is unknown is said without numbers of the level, so that levels have it in common.
void computeError(const SphereTree& tree, const ObjectIndex& object, SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter)
{
    level.error.reset();
    level.errorUnknown.clear();
    if (object.voxels == 0) {
        level.errorUnknown = "the object is empty";
        return;
    }
    if (detail::areMedialBalls(tree, level, object.mask, object.voxels, interrupter)) {
        LevelError none;
        none.covered = object.voxels;
        level.error = none;
        return;
    }
    const std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    const openvdb::CoordBBox box = levelBox(tree, spheres);
    const SphereMetric metric = metricOf(tree);
    if (crossedRows(spheres, box, metric) > double(kMaxUnionRows)) {
        level.errorUnknown = "its spheres cross more than the " + std::to_string(kMaxUnionRows)
            + " rows of voxels that are counted";
        return;
    }
    const openvdb::MaskTree::Ptr covered = sphereUnion(spheres, box, metric, interrupter);
    const detail::MaskMinus excess(*covered, object.mask);
    const detail::VoxelCount count = detail::countVoxels(excess, interrupter);
    const int64_t distSq =
        detail::farthestDistSq(excess, count.samples, object.mask, object.nearest, interrupter);
    if (distSq >= detail::NearestVoxel::kFar2 / 4 * detail::NearestVoxel::kFar2) {
        level.errorUnknown =
            "its spheres reach farther from the object than the 2^29 voxels that are measured";
        return;
    }
    LevelError error;
    error.covered = detail::countVoxels(*covered);
    error.excess = count.voxels;
    error.missing = object.voxels - (error.covered - error.excess);
    error.hammingPercent = 100.0 * double(error.excess + error.missing) / double(object.voxels);
    error.hausdorff = std::sqrt(double(distSq)) / metric.distance.unit();
    level.error = error;
}

} // namespace

void computeLevelErrors(
    SphereTree& tree, const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    const ObjectIndex index(object.tree(), tree.settings.dist());
    std::vector<SphereTreeLevel> levels = tree.levels; // the tree changes at the end, or not at all
    for (SphereTreeLevel& level : levels) {
        detail::checkInterrupt(interrupter);
        const std::string name = "errors of level " + std::to_string(level.level);
        const detail::Stage stage(name.c_str(), interrupter, nullptr);
        computeError(tree, index, level, interrupter);
    }
    tree.levels = std::move(levels);
}

} // namespace openvdb_spheretree
