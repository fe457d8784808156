// SPDX-License-Identifier: Apache-2.0
/// @file CoverageCheck.cc
/// @brief The checks that draw spheres: rebuilding the object, and covering it.

#include "CheckReport.h"
#include <openvdb_spheretree/sphere/SphereRaster.h>
#include <openvdb_spheretree/topology/LevelTopology.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/math/Math.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::MaskTree;

std::string voxelsOf(const MaskDifference& difference)
{
    return voxelsText(difference.voxels, difference.cubes.front().first());
}

/// @return whether some ball alone has more voxels than its level, which is reported. A damaged
/// radius would otherwise have a drawing of any size made.
bool ballsTooLarge(CheckReport& check, const SphereTreeLevel& level, int64_t voxels)
{
    const int dim = check.tree.settings.dim;
    const Distance& distance = check.tree.settings.dist();
    // A ball of any norm holds the l1 ball of its radius.
    constexpr double kPi = openvdb::math::pi<double>();
    const double unitBall =
        distance.isEuclidean() ? (dim == 3 ? 4 * kPi / 3 : kPi) : (dim == 3 ? 4.0 / 3 : 2);
    const double cube = distance.length(0.5, 0.5, dim == 3 ? 0.5 : 0);
    Offenders large;
    for (int32_t id = level.begin; id < level.end; ++id) {
        // A sphere this much smaller lies within the voxel cubes of the ball, wherever it is.
        const double inner = (std::sqrt(double(check.tree.radiusSq[id])) - cube) / distance.unit();
        if (inner < 1) continue;
        const double size = unitBall * inner * inner * (dim == 3 ? inner : 1);
        if (size * (1 - 1e-9) > double(voxels)) large.add(id);
    }
    if (large) {
        check.fail("level ", level.level, ": the digital ball is larger than the level's ", voxels,
            " voxels for ", large);
    }
    return bool(large);
}

/// @return more voxels than a level of this object can have, reconstructed without a clip as well.
/// What a file records is not trusted with memory.
double implausibleVoxels(const CheckReport& check, const SphereTreeLevel& level)
{
    const auto* pyramid = check.tree.settings.find<PyramidOptions>();
    const double scale = pyramid ? std::pow(double(pyramid->factor), level.level) : 1;
    const openvdb::Vec3d size =
        check.box.max().asVec3d() - check.box.min().asVec3d() + openvdb::Vec3d(1);
    double voxels = 1;
    for (int axis = 0; axis < 3; ++axis) voxels *= 4 * size[axis] / scale + 64;
    return voxels;
}

/// Union of the balls {q : |q - ijk|^2 < radiusSq} of a level, on its own grid; in 2-D, in their
/// plane.
MaskTree::Ptr drawDigitalBalls(const CheckReport& check, const SphereTreeLevel& level)
{
    const SphereTree& tree = check.tree;
    const Distance& distance = tree.settings.dist();
    std::vector<ExactSphere> balls;
    for (int32_t id = level.begin; id < level.end; ++id) {
        balls.push_back(
            ExactSphere::around(tree.ijk[id], 4 * distance.closedSq(tree.radiusSq[id])));
    }
    openvdb::CoordBBox box = boundingBox(balls, distance);
    if (tree.settings.dim == 2 && !box.empty()) {
        const int flat = tree.flatAxis;
        box.min()[flat] = box.max()[flat] = tree.ijk[level.begin][flat];
    }
    return sphereUnion(balls, box, distance, check.interrupter);
}

void checkRebuiltObject(CheckReport& check, const MaskTree& rebuilt)
{
    const std::string text = "level 0 does not rebuild the object: its digital balls ";
    const MaskDifference extra = maskDifference(rebuilt, check.mask, check.interrupter);
    const MaskDifference lost = maskDifference(check.mask, rebuilt, check.interrupter);
    if (extra.voxels > 0) check.fail(text, "hold ", voxelsOf(extra), " that the object has not");
    if (lost.voxels > 0 && !check.tree.settings.isInner()) {
        check.fail(text, "lack ", voxelsOf(lost));
    }
}

/// In tight trees, nodes of a level may be spheres that are no digital balls: there is no volume to
/// rebuild.
void checkNoVolume(CheckReport& check, const SphereTreeLevel& level)
{
    if (level.pyramidVoxels != 0) {
        check.fail("level ", level.level, " records ", level.pyramidVoxels,
            " pyramid voxels, but its spheres are no digital balls");
    }
    if (level.topology) {
        check.fail("level ", level.level,
            " records the topology of its voxels, but its spheres are no digital balls");
    }
    Offenders elsewhere;
    for (int32_t id = level.begin; id < level.end; ++id) {
        if (check.tree.radiusSq[id] != -1) continue;
        const openvdb::Vec3d apart = check.tree.spheres.center[id] - check.tree.ijk[id].asVec3d();
        const double most = std::max({std::abs(apart[0]), std::abs(apart[1]), std::abs(apart[2])});
        if (most > 0.5) elsewhere.add(id);
    }
    if (elsewhere) {
        check.fail(
            "level ", level.level, ": ijk is not the voxel nearest to the centre for ", elsewhere);
    }
}

} // namespace

/// Dividing by the voxel size may round what was exact down: hence the factor, finer than floats.
std::vector<ExactSphere> unpaddedSpheres(const SphereTree& tree, const SphereTreeLevel& level)
{
    std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    for (int32_t id = level.begin; id < level.end; ++id) {
        const double radius =
            double(tree.spheres.radiusWorld[id]) / tree.voxelSize() - tree.settings.paddingVoxels();
        const double reach = tree.subdivision * radius * tree.settings.dist().unit() * (1 + 1e-12);
        spheres[id - level.begin].radiusSq =
            radius < 0 ? -1 : int64_t(std::min(reach * reach, 9e18));
    }
    return spheres;
}

bool noneSmaller(const std::vector<ExactSphere>& spheres, const std::vector<ExactSphere>& than)
{
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (spheres[i].radiusSq < than[i].radiusSq) return false;
    }
    return true;
}

void checkTopologyOf(
    CheckReport& check, const SphereTreeLevel& level, const openvdb::MaskTree& voxels)
{
    if (!level.topology) return;
    check.kind = FaultKind::Topology;
    const LevelTopology& recorded = *level.topology;
    const LevelTopology actual = levelTopology(LeafLayout(voxels), check.interrupter);
    const char* const whose =
        level.level == 0 ? " of the object, which has " : " of its voxels, which have ";
    const auto compare = [&](const char* what, int64_t was, int64_t is) {
        if (was != is) check.fail("level ", level.level, " records ", was, ' ', what, whose, is);
    };
    compare("components", recorded.components, actual.components);
    compare("tunnels", recorded.tunnels, actual.tunnels);
    compare("cavities", recorded.cavities, actual.cavities);
}

void checkDigitalBalls(CheckReport& check)
{
    for (const SphereTreeLevel& level : check.tree.levels) {
        check.kind = FaultKind::DigitalBalls;
        const auto ids = check.tree.radiusSq.begin();
        if (std::find(ids + level.begin, ids + level.end, -1) != ids + level.end) {
            checkNoVolume(check, level);
            continue;
        }
        const bool finest = level.level == 0;
        const int64_t voxels = finest ? countVoxels(check.mask) : level.pyramidVoxels;
        if (double(voxels) > implausibleVoxels(check, level)) {
            check.fail("level ", level.level, " records ", voxels,
                " pyramid voxels, more than the object's box has room for");
            continue;
        }
        if (ballsTooLarge(check, level, voxels)) continue;
        const MaskTree::Ptr rebuilt = drawDigitalBalls(check, level);
        if (finest) checkRebuiltObject(check, *rebuilt);
        // An extended tree drops balls without children above level 0.
        const int64_t count = countVoxels(*rebuilt);
        const bool fewer = !finest && check.tree.settings.type() == TreeType::Extended;
        if (count == level.pyramidVoxels && !finest) checkTopologyOf(check, level, *rebuilt);
        check.kind = FaultKind::DigitalBalls;
        if (count == level.pyramidVoxels || (fewer && count < level.pyramidVoxels)) continue;
        check.fail("level ", level.level, " records ", level.pyramidVoxels,
            " pyramid voxels, but its digital balls rebuild ", count);
    }
}

void checkCoverage(CheckReport& check)
{
    check.kind = FaultKind::Coverage;
    for (const SphereTreeLevel& level : check.tree.levels) {
        // Whether the spheres miss an object voxel. Draws only where the object is.
        const auto misses = [&](const std::vector<ExactSphere>& spheres, const char* radii) {
            const MaskTree::Ptr covered = rasterSpheres(
                spheres, metricOf(check.tree), check.box, &check.mask, check.interrupter);
            const MaskDifference missed = maskDifference(check.mask, *covered, check.interrupter);
            if (missed.voxels == 0) return false;
            check.fail(
                "level ", level.level, " misses ", voxelsOf(missed), " of the object, in ", radii);
            return true;
        };
        const std::vector<ExactSphere> exact = levelSpheres(check.tree, level);
        const std::vector<ExactSphere> stored = unpaddedSpheres(check.tree, level);
        if (!misses(exact, "the exact radii") && noneSmaller(stored, exact)) continue;
        misses(stored, "the stored radii less their padding");
    }
}

/// There are no other radii than those of the file. Its own tolerance is that of GivenTree.h.
void checkGivenCoverage(CheckReport& check)
{
    check.kind = FaultKind::Coverage;
    const SphereTreeLevel& level = check.tree.root();
    const MaskTree::Ptr covered = rasterSpheres(levelSpheres(check.tree, level),
        metricOf(check.tree), check.box, &check.mask, check.interrupter);
    const MaskDifference missed = maskDifference(check.mask, *covered, check.interrupter);
    if (missed.voxels == 0) return;
    check.fail("the spheres do not cover the object: ", voxelsOf(missed), " of its ",
        countVoxels(check.mask), " lie in none of them");
}

} // namespace openvdb_spheretree::detail
