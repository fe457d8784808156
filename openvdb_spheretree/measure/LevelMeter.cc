// SPDX-License-Identifier: Apache-2.0
/// @file LevelMeter.cc
/// @brief The errors of a level: excess, missing voxels, Hamming and one-sided Hausdorff; and those
/// of its stored spheres.
///
/// Per level: the sparse union of its spheres; what it has and the object has not, node by node;
/// the farthest voxel of that. Missing voxels follow from the counts:
///     |O \ U| = |O| - (|U| - |U \ O|).
/// The many balls of a solid's level 0 are not drawn where they are its medial balls.
///
/// Then the same counts for the spheres with radii as stored, and how far any point of these
/// reaches (StoredReach.h). Where the stored spheres hold the same voxels, which is usual without
/// padding, they are not drawn again.

#include "LevelMeter.h"

#include "FarthestVoxel.h"
#include "MedialCover.h"
#include "StoredReach.h"
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/Grid.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace openvdb_spheretree::detail {
namespace {

const char kEmptyObject[] = "the object is empty";

bool crossTooManyRows(const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& box,
    const SphereMetric& metric)
{
    return crossedRows(spheres, box, metric) > double(kMaxUnionRows);
}

std::string tooManyRows(const char* spheres)
{
    return std::string(spheres) + " cross more than the " + std::to_string(kMaxUnionRows)
        + " rows of voxels that are counted";
}

double percentOf(int64_t covered, int64_t excess, int64_t voxels)
{
    const int64_t missing = voxels - (covered - excess);
    return 100.0 * double(excess + missing) / double(voxels);
}

std::vector<ReachSphere> reachSpheres(const SphereTree& tree, const SphereTreeLevel& level)
{
    std::vector<ReachSphere> spheres;
    spheres.reserve(level.size());
    for (int32_t id = level.begin; id < level.end; ++id) {
        spheres.push_back({tree.spheres.center[id], storedRadiusVoxels(tree, id)});
    }
    return spheres;
}

/// @return spheres that hold the centers of all voxels whose cubes have a point of the stored ones.
std::vector<ExactSphere> touchingSpheres(const SphereTree& tree, const SphereTreeLevel& level)
{
    const Distance& distance = tree.settings.dist();
    const double half = distance.length(0.5, 0.5, 0.5) / distance.unit(); // of a cube's diagonal
    const double unit = double(tree.subdivision) * distance.unit();
    std::vector<ExactSphere> spheres = storedSpheres(tree, level);
    for (int32_t id = level.begin; id < level.end; ++id) {
        const double reach = unit * (storedRadiusVoxels(tree, id) + half);
        spheres[id - level.begin].radiusSq = int64_t(std::min(reach * reach, 0x1p62)) + 1;
    }
    return spheres;
}

/// A bound for level 0 of the paper's trees, without a search: it has very many balls, and all of them
/// reach about as far out (the search took up to 16 times as long as the whole tree). All voxels within
/// the closed radius of a leaf ball are the object's, so their cubes hold every point that is half a
/// diagonal less from its center.
/// @param level  its error must have been counted: a ball out of the object would have an excess
/// @return the bound in world units, half a diagonal too large at most; nothing for other levels
std::optional<double> reachOfLeafBalls(const SphereTree& tree, const SphereTreeLevel& level)
{
    if (level.level != 0 || !tree.settings.find<PyramidOptions>()) return std::nullopt;
    if (!level.error || level.error->excess != 0) return std::nullopt;
    if (!tree.settings.dist().isEuclidean()) return std::nullopt;
    const double halfDiagonal = std::sqrt(tree.settings.dim / 4.0);
    double most = 0; // voxels
    for (int32_t id = level.begin; id < level.end; ++id) {
        const auto i = std::size_t(id);
        if (tree.radiusSq[i] < 1 || tree.spheres.center[i] != tree.ijk[i].asVec3d()) {
            return std::nullopt; // no digital ball
        }
        const double within = std::max(0.5, std::sqrt(double(tree.radiusSq[i] - 1)) - halfDiagonal);
        most = std::max(most, double(tree.spheres.radiusWorld[i]) / tree.voxelSize() - within);
    }
    constexpr double kRounding = 1 + 1e-12;
    return most * tree.voxelSize() * kRounding;
}

} // namespace

LevelMeter::LevelMeter(const openvdb::BoolGrid& object, const Distance& distance)
    : mMask(maskOf(object.tree())), mNearest(mMask, distance), mVoxels(countVoxels(mMask))
{}

void LevelMeter::measure(const SphereTree& tree, SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter) const
{
    measureExact(tree, level, interrupter);
    level.stored.reset();
    level.storedUnknown.clear();
    const bool hasStoredRadii =
        tree.transform && tree.spheres.radiusWorld.size() == tree.spheres.center.size();
    if (level.error && hasStoredRadii) measureStored(tree, level, {}, interrupter);
}

void LevelMeter::measureExact(const SphereTree& tree, SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter) const
{
    level.error.reset();
    level.errorUnknown.clear();
    if (mVoxels == 0) {
        level.errorUnknown = kEmptyObject;
        return;
    }
    if (areMedialBalls(tree, level, mMask, mVoxels, interrupter)) {
        LevelError none;
        none.covered = mVoxels;
        level.error = none;
        return;
    }
    const std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    const openvdb::CoordBBox box = levelBox(tree, spheres);
    const SphereMetric metric = metricOf(tree);
    if (crossTooManyRows(spheres, box, metric)) {
        level.errorUnknown = tooManyRows("its spheres");
        return;
    }
    const openvdb::MaskTree::Ptr covered = sphereUnion(spheres, box, metric, interrupter);
    const MaskMinus excess(*covered, mMask);
    const VoxelCount count = countVoxels(excess, interrupter);
    const int64_t distSq = farthestDistSq(excess, count.samples, mMask, mNearest, interrupter);
    if (distSq >= NearestVoxel::kFar2 / 4 * NearestVoxel::kFar2) {
        level.errorUnknown =
            "its spheres reach farther from the object than the 2^29 voxels that are measured";
        return;
    }
    LevelError error;
    error.covered = countVoxels(*covered);
    error.excess = count.voxels;
    error.missing = mVoxels - (error.covered - error.excess);
    error.hammingPercent = percentOf(error.covered, error.excess, mVoxels);
    error.hausdorff = std::sqrt(double(distSq)) / metric.distance.unit();
    level.error = error;
}

/// A bound for the paper's trees, whose many spheres all reach about as far out (the search of StoredReach.h
/// took up to nine times as long as all else): a point is as far from the cube of any voxel of the object as
/// its own voxel is from that voxel, at most.
double LevelMeter::reachOfVoxels(
    const MaskMinus& outside, openvdb::util::NullInterrupter* interrupter) const
{
    const VoxelCount count = countVoxels(outside, interrupter);
    const int64_t distSq = farthestDistSq(outside, count.samples, mMask, mNearest, interrupter);
    return std::sqrt(double(distSq)) / mNearest.distance().unit();
}

void LevelMeter::measureStored(const SphereTree& tree, SphereTreeLevel& level,
    const StoredFigures& wanted, openvdb::util::NullInterrupter* interrupter) const
{
    level.stored.reset();
    level.storedUnknown.clear();
    if (mVoxels == 0) {
        level.storedUnknown = kEmptyObject;
        return;
    }
    const std::vector<ExactSphere> spheres = storedSpheres(tree, level);
    const openvdb::CoordBBox box = levelBox(tree, spheres);
    const SphereMetric metric = metricOf(tree);
    if (crossTooManyRows(spheres, box, metric)) {
        level.storedUnknown = tooManyRows("its stored spheres");
        return;
    }
    StoredError stored;
    if (wanted.hamming && level.error && spheres == levelSpheres(tree, level)) {
        stored.hammingPercent = level.error->hammingPercent;
    } else if (wanted.hamming) {
        const openvdb::MaskTree::Ptr covered = sphereUnion(spheres, box, metric, interrupter);
        const int64_t excess = countVoxels(MaskMinus(*covered, mMask), interrupter).voxels;
        stored.hammingPercent = percentOf(countVoxels(*covered), excess, mVoxels);
    }
    if (const auto bound = reachOfLeafBalls(tree, level); wanted.reach && bound) {
        stored.reachWorld = *bound;
    } else if (wanted.reach) {
        const int flatAxis = tree.settings.dim == 2 ? tree.flatAxis : -1;
        const std::vector<ExactSphere> wider = touchingSpheres(tree, level);
        const auto touched = sphereUnion(wider, levelBox(tree, wider), metric, interrupter);
        const MaskMinus outside(*touched, mMask);
        // Centers of given spheres were rounded.
        const double moved = tree.settings.isGiven() ? kGivenMove : 0;
        const double reach = tree.settings.find<PyramidOptions>()
            ? reachOfVoxels(outside, interrupter)
            : storedReach(
                reachSpheres(tree, level), outside, mMask, mNearest, flatAxis, interrupter);
        constexpr double kRounding = 1 + 1e-12; // as in storedReach(): a bound stays one
        stored.reachWorld = (reach + moved) * tree.voxelSize() * kRounding;
    }
    level.stored = stored;
}

} // namespace openvdb_spheretree::detail
