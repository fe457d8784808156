// SPDX-License-Identifier: Apache-2.0
#include "MiniballCenters.h"

#include "Miniball.h"
#include <openvdb_spheretree/base/CompressedRows.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/ExactSphere.h>
#include <openvdb_spheretree/tree/LevelFrame.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace openvdb_spheretree::detail {

namespace {

/// Units of centers in a voxel: rounding a center adds at most sqrt(3) / 32 voxels to a radius.
constexpr int64_t kUnits = 16;
/// Squares are so many times as large as in halves of a voxel.
constexpr int64_t kFiner = (kUnits / 2) * (kUnits / 2);

/// A sphere that contains leaf balls, as SphereTree has it.
struct FittedSphere {
    ExactSphere exact{{0, 0, 0}, 0}; ///< units of 1/16 voxel
    double radius = 0;               ///< voxels
};

/// @return a leaf ball's radius in voxels.
double leafRadius(const SphereTree& tree, int32_t leaf)
{
    return std::sqrt(double(tree.radiusSq[leaf]) - 1);
}

int64_t apartSq(const SphereTree& tree, int32_t leaf, const ExactSphere& sphere)
{
    const openvdb::Coord& c = tree.ijk[leaf];
    return Distance().lengthSq(kUnits * c[0] - sphere.center[0], kUnits * c[1] - sphere.center[1],
        kUnits * c[2] - sphere.center[2]);
}

/// The smallest radius around the sphere's center that contains the leaf balls. Only those that
/// reach farthest in floating point are measured exactly.
void measure(FittedSphere& sphere, const SphereTree& tree, const NodeSpan& below)
{
    const auto reach = [&](int32_t leaf) {
        return std::sqrt(double(apartSq(tree, leaf, sphere.exact)))
            + double(kUnits) * leafRadius(tree, leaf);
    };
    double most = 0;
    for (const int32_t leaf : below) most = std::max(most, reach(leaf));
    for (const int32_t leaf : below) {
        if (reach(leaf) < most * (1 - 1e-12)) continue;
        const RootSum needed{apartSq(tree, leaf, sphere.exact),
            kUnits * kUnits * (int64_t(tree.radiusSq[leaf]) - 1)};
        sphere.exact.radiusSq = std::max(sphere.exact.radiusSq, needed.coverSq());
        // RootSum is made for halves of voxels.
        sphere.radius = std::max(sphere.radius, needed.radius() * 2 / double(kUnits));
    }
}

FittedSphere smallestSphere(
    const SphereTree& tree, const NodeSpan& below, std::vector<RealBall>& balls)
{
    const openvdb::Coord& base = tree.ijk[*below.begin()];
    balls.clear();
    for (const int32_t leaf : below) {
        const openvdb::Vec3d apart = tree.ijk[leaf].asVec3d() - base.asVec3d();
        balls.push_back({apart, leafRadius(tree, leaf)});
    }
    const openvdb::Vec3d center = miniball(balls).center;
    FittedSphere sphere;
    for (int axis = 0; axis < 3; ++axis) {
        sphere.exact.center[axis] =
            kUnits * base[axis] + std::llround(double(kUnits) * center[axis]);
    }
    measure(sphere, tree, below);
    return sphere;
}

void requireRoom(const SphereTree& tree)
{
    const auto size = sidesOf(tree.object.bbox);
    constexpr int64_t kMost = int64_t(1) << 61;
    const auto far = [&](int axis) { return 2 * kUnits * (size[std::size_t(axis)] + 1); };
    const int64_t widest =
        *std::max_element(tree.spheres.coverRadiusSq.begin(), tree.spheres.coverRadiusSq.end());
    const bool fits =
        Distance().lengthSq(far(0), far(1), far(2)) < kMost && widest < kMost / kFiner;
    if (fits) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object '" << tree.object.name << "', of " << size[0] << " x " << size[1] << " x "
                       << size[2]
                       << " voxels, is too wide for center=miniball: use center=medial, or larger "
                          "voxels");
}

} // namespace

void centerOnMiniballs(SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    requireRoom(tree);
    Spheres& spheres = tree.spheres;
    const bool extended = tree.settings.type() == TreeType::Extended;
    const SphereTreeLevel& finest = tree.levels.front();
    std::vector<int32_t> ancestor(finest.size()); // of each leaf ball, on the level
    std::iota(ancestor.begin(), ancestor.end(), finest.begin);
    CompressedRows leaves; // below each node of the level
    for (const SphereTreeLevel& level : tree.levels) {
        const LevelFrame frame(level.level, tree.origin, tree.settings, tree.flatAxis);
        const bool inner = level.level > 0;
        if (inner) {
            for (int32_t& node : ancestor) node = spheres.parent[node];
            leaves = compressedRows(
                ancestor.size(), std::size_t(level.size()),
                [&](std::size_t leaf) { return ancestor[leaf] - level.begin; },
                [&](std::size_t leaf) { return finest.begin + int32_t(leaf); });
        }
        parallelForWithScratch<std::vector<RealBall>>(
            level.size(), interrupter, [&](std::size_t place, std::vector<RealBall>& scratch) {
                const int32_t id = level.begin + int32_t(place);
                const auto below = inner ? leaves[int32_t(place)] : NodeSpan{};
                if (below.empty()) { // its own sphere in finer units: the same voxels
                    const RootSum own = frame.radius(tree.radiusSq[id]);
                    spheres.coverRadiusSq[id] = RootSum{own.a * kFiner, own.b * kFiner}.coverSq();
                    return;
                }
                FittedSphere best = smallestSphere(tree, below, scratch);
                openvdb::Vec3d& center = spheres.center[id];
                if (extended) {
                    FittedSphere medial; // around the medial center
                    for (int a = 0; a < 3; ++a) {
                        medial.exact.center[a] = std::llround(double(kUnits) * center[a]);
                    }
                    measure(medial, tree, below);
                    if (medial.exact.radiusSq < best.exact.radiusSq) best = medial;
                }
                for (int a = 0; a < 3; ++a) {
                    center[a] = double(best.exact.center[a]) / double(kUnits);
                }
                spheres.coverRadiusSq[id] = best.exact.radiusSq;
                spheres.radius[id] = best.radius;
            });
    }
    tree.subdivision = int(kUnits);
}

} // namespace openvdb_spheretree::detail
