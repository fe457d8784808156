// SPDX-License-Identifier: Apache-2.0
/// @file Resample.cc
/// @brief OpenVDB's own resampler goes over the leaf nodes of the input and only one output voxel beyond:
/// where voxels get smaller, half of the slope to the background is lost at the low side of each leaf
/// node. So the nodes of the output are found here, and each is sampled by itself:
/// 1. `requireRoom`: what the result will take, before any work.
/// 2. `placesOf`: leaf nodes of the result that any voxel of the input reaches into, by less than one
///    voxel beyond its center along each axis.
/// 3. `sampleLeaf`, in parallel.
#include "Resample.h"

#include "DelayedValues.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/GridTemplates.h> // compiles in half the time
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetRebuild.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/ValueTransformer.h>
#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;
using openvdb::math::Transform;

/// Level sets of integers have no surface to be made anew around.
using ResampledGrids = openvdb::NumericGridTypes::Append<openvdb::BoolGrid, openvdb::MaskGrid>;

constexpr double kFarthest = 1 << 30; ///< coordinates of the result, well within 32 bits
constexpr int kBand = 3;              ///< half the width of level sets, in voxels

void requireLinear(const openvdb::GridBase& grid)
{
    if (grid.transform().isLinear()) return;
    OPENVDB_THROW(openvdb::ValueError,
        detail::describe(grid)
            << " has a frustum transform, whose voxels are of many sizes: give it "
               "a linear one in the program that made it");
}

/// The world volume of a voxel.
double voxelVolume(const openvdb::GridBase& grid)
{
    const auto map = grid.transform().baseMap();
    const Vec3d x = map->applyJacobian({1, 0, 0}), y = map->applyJacobian({0, 1, 0});
    return std::abs(x.cross(y).dot(map->applyJacobian({0, 0, 1})));
}

/// What is around a box of the input's voxels, in voxels of the result.
openvdb::BBoxd reachOf(const CoordBBox& box, const Transform& from, const Transform& to)
{
    openvdb::BBoxd reach;
    for (int i = 0; i < 8; ++i) {
        const Vec3d corner(i & 1 ? box.max()[0] + 1.0 : box.min()[0] - 1.0,
            i & 2 ? box.max()[1] + 1.0 : box.min()[1] - 1.0,
            i & 4 ? box.max()[2] + 1.0 : box.min()[2] - 1.0);
        reach.expand(to.worldToIndex(from.indexToWorld(corner)));
    }
    return reach;
}

/// The same, and coordinates of 32 bits hold it.
openvdb::BBoxd boundedReachOf(
    const CoordBBox& box, const openvdb::GridBase& grid, const Transform& to)
{
    const openvdb::BBoxd reach = reachOf(box, grid.transform(), to);
    if (reach.min().length() < kFarthest && reach.max().length() < kFarthest) return reach;
    OPENVDB_THROW(openvdb::ValueError,
        detail::describe(grid)
            << " reaches beyond voxel 2^30 at this size: choose a larger voxel, or "
               "move it towards its origin");
}

/// NaN is a background like others.
template <typename ValueT>
bool areSame(const ValueT& a, const ValueT& b)
{
    return a == b || (a != a && b != b);
}

/// The boxes of voxels that are not merely background: leaf nodes, and tiles.
template <typename TreeT>
std::vector<CoordBBox> boxesOf(const TreeT& tree)
{
    std::vector<CoordBBox> boxes;
    auto tile = tree.cbeginValueAll();
    tile.setMaxDepth(TreeT::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (!tile.isValueOn() && areSame(*tile, tree.background())) continue;
        boxes.push_back(tile.getBoundingBox());
    }
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) boxes.push_back(leaf->getNodeBoundingBox());
    return boxes;
}

/// @param bytes  of a voxel of the result
void requireRoom(const openvdb::GridBase& grid, double voxels, double bytes, double voxelSize)
{
    detail::TextStream what;
    what << std::setprecision(3) << detail::describe(grid) << " has " << voxels
         << " voxels of size " << voxelSize << ", which";
    detail::requireMemory(voxels * bytes, what.str(), "choose a larger voxel");
}

/// The origins of leaf nodes of the result.
std::vector<Coord> placesOf(const openvdb::GridBase& grid, const std::vector<CoordBBox>& boxes,
    const Transform& to, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<Coord> places;
    std::size_t sorted = 0;
    const auto unite = [&] {
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        sorted = places.size();
    };
    for (const CoordBBox& box : boxes) {
        detail::checkInterrupt(interrupter);
        const openvdb::BBoxd reach = boundedReachOf(box, grid, to);
        const Coord first = Coord::floor(reach.min()) & ~(kLeafDim - 1);
        const Coord last = Coord::ceil(reach.max());
        for (int x = first[0]; x <= last[0]; x += kLeafDim) {
            for (int y = first[1]; y <= last[1]; y += kLeafDim) {
                for (int z = first[2]; z <= last[2]; z += kLeafDim) places.emplace_back(x, y, z);
            }
        }
        if (places.size() > 2 * sorted + 100000) unite(); // boxes share most of theirs
    }
    unite();
    return places;
}

template <typename ValueT>
struct Sample {
    ValueT value;
    bool isActive;
};

/// @return the nearest integer; the largest for a double next to it that is none.
template <typename ValueT>
ValueT roundedTo(double number)
{
    constexpr ValueT kMost = std::numeric_limits<ValueT>::max();
    return number >= double(kMost) ? kMost : ValueT(std::llround(number));
}

/// Two transforms that agree do so but for rounding, which would let neighbours take part.
Vec3d onCenters(Vec3d at)
{
    constexpr double kRounding = 1e-9; // voxels
    for (int axis = 0; axis < 3; ++axis) {
        const double center = std::round(at[axis]);
        if (std::abs(at[axis] - center) < kRounding) at[axis] = center;
    }
    return at;
}

/// The interpolation between the eight centers around a place.
template <typename Reader>
auto linearSample(const Reader& reader, const Vec3d& at)
{
    using ValueT = typename Reader::ValueType;
    const Coord low = Coord::floor(at);
    const Vec3d share = at - low.asVec3d();
    double sum = 0;
    bool isActive = false;
    for (int i = 0; i < 8; ++i) {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) {
            weight *= i >> axis & 1 ? share[axis] : 1 - share[axis];
        }
        if (weight == 0) continue; // what has no part in it may be a NaN, or active
        ValueT value;
        isActive |= reader.probeValue(low.offsetBy(i & 1, i >> 1 & 1, i >> 2), value);
        sum += weight * double(value);
    }
    if constexpr (!std::is_integral_v<ValueT>) return Sample<ValueT>{ValueT(sum), isActive};
    else return Sample<ValueT>{roundedTo<ValueT>(sum), isActive};
}

template <typename Reader>
auto nearestSample(const Reader& reader, const Vec3d& at)
{
    typename Reader::ValueType value;
    const bool isActive = reader.probeValue(Coord::round(at), value);
    return Sample<typename Reader::ValueType>{value, isActive};
}

template <typename LeafT, typename Reader>
void sampleLeaf(LeafT& leaf, const Reader& reader, Sampling sampling, const Transform& from,
    const Transform& to)
{
    using ValueT = typename LeafT::ValueType;
    constexpr bool isMask = std::is_same_v<ValueT, openvdb::ValueMask>;
    for (openvdb::Index n = 0; n < LeafT::SIZE; ++n) {
        const Vec3d at = onCenters(from.worldToIndex(to.indexToWorld(leaf.offsetToGlobalCoord(n))));
        const auto sample = [&] {
            if constexpr (isMask || std::is_same_v<ValueT, bool>) return nearestSample(reader, at);
            else if (sampling == Sampling::Nearest) return nearestSample(reader, at);
            else return linearSample(reader, at);
        }();
        if constexpr (!isMask) leaf.setValueOnly(n, sample.value);
        leaf.setActiveState(n, sample.isActive);
    }
}

/// The transform of the result.
Transform::Ptr cubesOf(const openvdb::GridBase& grid, double voxelSize)
{
    try {
        const Transform::Ptr cubes = Transform::createLinearTransform(voxelSize);
        cubes->postTranslate(grid.transform().indexToWorld(Coord(0)));
        return cubes;
    } catch (const openvdb::ArithmeticError&) { // OpenVDB takes tiny voxels for none
        OPENVDB_THROW(openvdb::ValueError,
            "a voxel of size " << voxelSize
                               << " is smaller than a transform holds: choose a larger one");
    }
}

template <typename GridT>
typename GridT::Ptr sampled(const GridT& grid, const Transform::Ptr& to, Sampling sampling,
    openvdb::util::NullInterrupter* interrupter)
{
    using TreeT = typename GridT::TreeType;
    using LeafT = typename TreeT::LeafNodeType;
    const auto boxes = boxesOf(grid.tree());
    const double ratio = voxelVolume(grid) / std::pow(to->voxelSize()[0], 3);
    double voxels = 0;
    for (const CoordBBox& box : boxes) {
        const auto sides = detail::sidesOf(box);
        voxels += double(sides[0]) * double(sides[1]) * double(sides[2]) * ratio;
    }
    requireRoom(grid, voxels,
        double(sizeof(LeafT) + sizeof(typename LeafT::Buffer)) / LeafT::SIZE
            + double(sizeof(typename GridT::ValueType)),
        to->voxelSize()[0]);

    const std::vector<Coord> places = placesOf(grid, boxes, *to, interrupter);
    std::vector<std::unique_ptr<LeafT>> leaves(places.size());
    using Reader = openvdb::tree::ValueAccessor<const TreeT>;
    const auto makeReader = [&] { return Reader(grid.tree()); };
    detail::parallelForWith(
        places.size(), interrupter, makeReader, [&](std::size_t i, const Reader& reader) {
            leaves[i] = std::make_unique<LeafT>(places[i], grid.background());
            sampleLeaf(*leaves[i], reader, sampling, grid.transform(), *to);
        });
    const auto result = openvdb::gridPtrCast<GridT>(grid.copyGridWithNewTree());
    for (auto& leaf : leaves) result->tree().addLeaf(leaf.release());
    openvdb::tools::prune(result->tree());
    result->setTransform(to);
    return result;
}

template <typename GridT>
typename GridT::Ptr rebuilt(
    const GridT& grid, const Transform::Ptr& to, openvdb::util::NullInterrupter* interrupter)
{
    if (!std::isfinite(double(grid.background()))) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " is of the class of level sets, and its background is "
                << double(grid.background())
                << ", which is no distance: if it is no level set, change the grid's class");
    }
    // A surface of so much area has a band of that width, of leaf nodes of which a quarter is used.
    const double voxel = to->voxelSize()[0], background = std::abs(double(grid.background()));
    const double volume = double(grid.activeVoxelCount()) * voxelVolume(grid);
    const double area = volume / std::max(background, voxel / kBand);
    requireRoom(
        grid, area / (voxel * voxel) * 2 * kBand, 4 * sizeof(typename GridT::ValueType), voxel);
    const CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (!box.empty()) boundedReachOf(box, grid, *to);
    openvdb::util::NullInterrupter none;
    auto result = openvdb::tools::levelSetRebuild(
        grid, 0.0f, float(kBand), float(kBand), to.get(), interrupter ? interrupter : &none);
    detail::checkInterrupt(interrupter);
    result->insertMeta(*grid.copyMeta());
    return result;
}

} // namespace

double shortestVoxelEdge(const openvdb::GridBase& grid)
{
    requireLinear(grid);
    const double shortest = smallestStretch(grid.transform());
    if (std::isfinite(shortest) && shortest > 0) return shortest;
    OPENVDB_THROW(openvdb::ValueError,
        detail::describe(grid) << " has voxels without a size: give it another transform");
}

openvdb::GridBase::Ptr resampled(const openvdb::GridBase& grid, double voxelSize, Sampling sampling,
    openvdb::util::NullInterrupter* interrupter)
{
    shortestVoxelEdge(grid); // refuses transforms that cannot be sampled
    if (!(voxelSize > 0) || !std::isfinite(voxelSize)) {
        OPENVDB_THROW(
            openvdb::ValueError, "a voxel of size " << voxelSize << " is none: give one above 0");
    }
    const bool isLevelSet = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
    if (isLevelSet && sampling == Sampling::Nearest) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " is a level set, whose surface would get steps if it took the "
                   "nearest voxels: leave out nearest");
    }
    const Transform::Ptr to = cubesOf(grid, voxelSize);
    requireReadableValues(grid, interrupter);
    openvdb::GridBase::Ptr result;
    grid.apply<ResampledGrids>([&](const auto& typed) {
        using ValueT = typename std::decay_t<decltype(typed)>::ValueType;
        if constexpr (std::is_floating_point_v<ValueT>) {
            if (isLevelSet) result = rebuilt(typed, to, interrupter);
        }
        if (!result) result = sampled(typed, to, sampling, interrupter);
    });
    if (result) return result;
    OPENVDB_THROW(openvdb::TypeError,
        detail::describe(grid)
            << " is of type '" << grid.type()
            << "': only grids of numbers, and bool and mask grids, are resampled");
}

void scaleGrid(openvdb::GridBase& grid, double factor)
{
    const Transform::Ptr scaled = grid.transform().copy();
    const auto fail = [&](const char* why) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid) << " has voxels of size " << grid.voxelSize()[0]
                                   << ", and times " << factor << why);
    };
    constexpr auto kNone = " they are of none that a transform holds: choose another scale";
    if (!(factor > 0 && std::isfinite(factor))) fail(kNone);
    try {
        scaled->postScale(factor);
    } catch (const openvdb::ArithmeticError&) { // OpenVDB takes tiny voxels for none
        fail(
            " they are smaller than the cubes of 1.5e-5 that OpenVDB takes: choose another "
            "scale, or leave it as it is and let scale= of -write change the files of other tools");
    }
    if (!scaled->voxelSize().isFinite()) fail(kNone);
    grid.setTransform(scaled);
    if (grid.getGridClass() != openvdb::GRID_LEVEL_SET) return;
    grid.apply<openvdb::RealGridTypes>([&](auto& typed) {
        using ValueT = typename std::decay_t<decltype(typed)>::ValueType;
        requireReadableValues(typed);
        if (!typed.isTreeUnique()) typed.setTree(typed.tree().copy());
        openvdb::tools::foreach (typed.beginValueAll(),
            [&](const auto& value) { value.setValue(ValueT(double(*value) * factor)); });
        const double background = double(typed.background()) * factor;
        typed.tree().root().setBackground(ValueT(background), /*updateChildNodes=*/false);
    });
}

} // namespace openvdb_spheretree
