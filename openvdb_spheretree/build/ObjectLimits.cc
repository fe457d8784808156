// SPDX-License-Identifier: Apache-2.0
#include "ObjectLimits.h"

#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tree/LevelFrame.h>
#include <openvdb_spheretree/base/EmptyObject.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/NodeBytes.h>

#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;

void requireFlat(const ObjectInfo& object)
{
    if (flatAxisOf(object.bbox) >= 0) return;
    const auto side = sidesOf(object.bbox);
    OPENVDB_THROW(openvdb::ValueError,
        "dim=2 needs an object one voxel thick along an axis, but '"
            << object.name << "' has " << side[0] << " x " << side[1] << " x " << side[2]
            << " voxels: use dim=3");
}

void requireRoomForSquares(const ObjectInfo& object, const Distance& distance)
{
    const auto side = sidesOf(object.bbox);
    // Twice the centers, and radii beyond the object's own size: four times its extent is enough.
    if (distance.lengthSq(4 * side[0], 4 * side[1], 4 * side[2]) != INT64_MAX) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object '" << object.name << "' is too wide for dist=" << toString(distance)
                       << ": use smaller weights, or larger voxels");
}

/// Squared lengths in 1/16 voxel have to fit in 64 bits, here and in programs that read the tree.
/// None is longer than twice the object's diagonal.
void requireRoomForFineSquares(const ObjectInfo& object)
{
    constexpr int64_t kMost = int64_t(1) << 61;
    const auto side = sidesOf(object.bbox);
    const auto far = [&](int axis) { return 2 * tight::kFine * (side[axis] + 1); };
    if (Distance().lengthSq(far(0), far(1), far(2)) < kMost) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object '" << object.name << "', of " << side[0] << " x " << side[1] << " x " << side[2]
                       << " voxels, is too wide for tree=tight: use tree=extended, or larger "
                          "voxels");
}

/// @return the side of the single voxel that the pyramid ends in; with the first tree that ends at
///         one, other trees are no wider.
int64_t widthOfTop(
    const openvdb::CoordBBox& box, const Coord& origin, const SphereTreeSettings& settings)
{
    const auto* pyramid = settings.find<PyramidOptions>();
    const int64_t factor = pyramid ? pyramid->factor : 2;
    const auto side = sidesOf(box);
    int64_t longest = *std::max_element(side.begin(), side.end()) + kLeafDim - 1;
    for (int axis = 0; axis < 3; ++axis) {
        longest = std::max(longest, int64_t(box.max()[axis]) - origin[axis] + 1);
    }
    int64_t width = 1;
    while (width < longest) width *= factor;       // below 2^29 * 2^15
    return std::min(width, LevelFrame::kMaxScale); // wider ones are refused
}

/// @return the longest radius there may be, in widths of the top voxel. Of a pyramid's spheres it is
///         the voxel's diagonal, 1.74 for l2 and at most 3 for norms, and 1.87 with scale=paper.
///         Tight ones are no longer than twice the diagonal of the object, inner ones lie in it.
int radiusInWidths(const SphereTreeSettings& settings)
{
    if (settings.isInner()) return 1;
    if (settings.type() == TreeType::Tight) return 4;
    return settings.dist().isEuclidean() ? 2 : 3;
}

/// Every sphere must lie where voxels have 32-bit coordinates, or its voxels could not be counted.
void requireRoomAround(
    const ObjectInfo& object, const Coord& origin, const SphereTreeSettings& settings)
{
    // More than the steps from voxel to voxel, leaf to leaf and node to node, the two radii of a
    // closing, and the growth of radii that are not fitted anew at every level of a small object.
    constexpr int64_t kSteps = int64_t(1) << 16;
    constexpr int64_t kFirst = std::numeric_limits<int32_t>::min();
    constexpr int64_t kLast = std::numeric_limits<int32_t>::max();
    const int64_t width = widthOfTop(object.bbox, origin, settings);
    const int64_t reach = radiusInWidths(settings) * width + kSteps;
    for (int axis = 0; axis < 3; ++axis) {
        const bool isLow = origin[axis] - reach < kFirst;
        if (!isLow && origin[axis] + width + reach <= kLast) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "the object '" << object.name << "' reaches from voxel " << object.bbox.min() << " to "
                           << object.bbox.max() << ", too near the " << (isLow ? "first" : "last")
                           << " coordinate along "
                           << "xyz"[axis] << ", " << (isLow ? kFirst : kLast)
                           << ", for the spheres around it, which may need " << width + reach
                           << " voxels: move it towards voxel [0, 0, 0], and the transform of its "
                              "grid the other way");
    }
}

} // namespace

Coord requireValidObject(const ObjectInfo& object, const SphereTreeSettings& settings)
{
    if (object.voxels == 0) {
        OPENVDB_THROW(EmptyObject, "the object '" << object.name << "' has no voxels");
    }
    Coord origin = pyramidOrigin(object.bbox); // refuses boxes that are too wide
    if (settings.dim == 2) requireFlat(object);
    requireRoomForSquares(object, settings.dist());
    if (settings.find<TightOptions>()) requireRoomForFineSquares(object);
    const auto* pyramid = settings.find<PyramidOptions>();
    if (pyramid && pyramid->origin) {
        const bool isFlat = settings.dim == 2;
        origin = pyramidOrigin(object.bbox, *pyramid->origin,
            isFlat ? std::optional(flatAxisOf(object.bbox)) : std::nullopt);
    }
    requireRoomAround(object, origin, settings);
    return origin;
}

void requireRoomForNodes(const openvdb::BoolGrid& object)
{
    // The object itself, its voxels as a mask, and levels above, of which each has fewer nodes.
    constexpr double kCopies = 3;
    requireMemory(kCopies * nodeBytes(object.tree()),
        "the voxels of '" + object.getName() + "' lie so far apart that copies of their "
            + std::to_string(object.tree().leafCount()) + " leaf nodes, and of the nodes above,",
        kNodeRemedy);
}

} // namespace openvdb_spheretree::detail
