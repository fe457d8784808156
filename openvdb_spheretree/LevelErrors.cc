// SPDX-License-Identifier: Apache-2.0
/// @file LevelErrors.cc
/// @brief The exact error of every level (DESIGN: excess, missing, Hamming, one-sided Hausdorff).
///
/// Per level: the sparse union of its spheres; what it has and the object has not, node by node;
/// the farthest voxel of that. Missing voxels follow from the counts:
///     |O \ U| = |O| - (|U| - |U \ O|).

#include "LevelErrors.h"

#include "SphereUnion.h"
#include "detail/FarthestVoxel.h"
#include "detail/MaskDifference.h"
#include "detail/NearestVoxel.h"
#include "detail/Parallel.h"

#include <cmath>

namespace openvdb_spheretree {
namespace {

/// What the levels are compared with.
struct ObjectIndex {
    openvdb::MaskTree mask;
    detail::NearestVoxel nearest;
    int64_t voxels;

    explicit ObjectIndex(const openvdb::BoolTree& tree)
        : mask(detail::maskOf(tree)), nearest(mask), voxels(detail::countVoxels(mask))
    {}
};

/// Where the voxels of a level count: anywhere its spheres reach, but in the object's plane in 2-D.
openvdb::CoordBBox countedBox(const SphereTree& tree, const std::vector<ExactSphere>& spheres)
{
    openvdb::CoordBBox box = boundingBox(spheres);
    if (tree.settings.dim == 2) {
        box.min().z() = tree.object.bbox.min().z();
        box.max().z() = tree.object.bbox.min().z();
    }
    return box;
}

/// Rows along z that the spheres cross: their discs, but no more than all rows of the box. Rounded;
/// overlaps count again.
double estimatedRows(const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& box)
{
    if (box.empty()) return 0;
    double discs = 0;
    for (const ExactSphere& s : spheres) discs += s.coverSq < 0 ? 0 : M_PI * double(s.coverSq) / 4;
    const auto side = [&box](int a) { return double(box.max()[a]) - box.min()[a] + 1; };
    return std::min(discs, side(0) * side(1));
}

std::string tooManyRows(double rows)
{
    return "its spheres cross about " + std::to_string(std::llround(rows))
        + " voxel rows, more than the " + std::to_string(kMaxErrorRows) + " that are counted";
}

std::string tooFar()
{
    return "its spheres reach farther from the object than the 2^29 voxels that are measured";
}

void computeError(const SphereTree& tree, const ObjectIndex& object, SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter)
{
    level.error.reset();
    level.errorUnknown.clear();
    if (object.voxels == 0) {
        level.errorUnknown = "the object is empty";
        return;
    }
    const std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    const openvdb::CoordBBox box = countedBox(tree, spheres);
    const double rows = estimatedRows(spheres, box);
    if (rows > double(kMaxErrorRows)) {
        level.errorUnknown = tooManyRows(rows);
        return;
    }
    const openvdb::MaskTree::Ptr covered = sphereUnion(spheres, box, interrupter);
    const detail::MaskDifference excess =
        detail::maskDifference(*covered, object.mask, interrupter);
    const int64_t distSq = detail::farthestDistSq(excess.cells, object.nearest, interrupter);
    if (distSq >= detail::NearestVoxel::kFar2 / 4 * detail::NearestVoxel::kFar2) {
        level.errorUnknown = tooFar();
        return;
    }
    LevelError error;
    error.covered = detail::countVoxels(*covered);
    error.excess = excess.voxels;
    error.missing = object.voxels - (error.covered - error.excess);
    error.hammingPercent = 100.0 * double(error.excess + error.missing) / double(object.voxels);
    error.hausdorff = std::sqrt(double(distSq));
    level.error = error;
}

} // namespace

void computeLevelErrors(
    SphereTree& tree, const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    const ObjectIndex index(object.tree());
    std::vector<SphereTreeLevel> levels = tree.levels; // the tree changes at the end, or not at all
    for (SphereTreeLevel& level : levels) {
        detail::checkInterrupt(interrupter);
        computeError(tree, index, level, interrupter);
    }
    tree.levels = std::move(levels);
}

} // namespace openvdb_spheretree
