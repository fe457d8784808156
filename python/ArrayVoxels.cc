// SPDX-License-Identifier: Apache-2.0
#include "ArrayVoxels.h"

#include "Errors.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/input/MeanOrder.h>
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace binding {

namespace {

using openvdb::Coord;
using openvdb_spheretree::kLeafDim;
using openvdb_spheretree::LeafMask;
using openvdb_spheretree::NumberType;
using openvdb_spheretree::ObjectSettings;
using openvdb_spheretree::detail::HalfSpace;

constexpr std::array<int, 3> kLeafStride = {64, 8, 1}; // of the index in a leaf

/// Calls visit(T()) with the type of the values.
template <typename Visit>
auto visitType(NumberType type, const Visit& visit)
{
    switch (type) {
    case NumberType::Bool: return visit(bool());
    case NumberType::Int8: return visit(int8_t());
    case NumberType::UInt8: return visit(uint8_t());
    case NumberType::Int16: return visit(int16_t());
    case NumberType::UInt16: return visit(uint16_t());
    case NumberType::Int32: return visit(int32_t());
    case NumberType::UInt32: return visit(uint32_t());
    case NumberType::Int64: return visit(int64_t());
    case NumberType::UInt64: return visit(uint64_t());
    case NumberType::Float32: return visit(float());
    default: return visit(double());
    }
}

/// What values of a type are compared and stored as: nothing is lost below 2^63.
template <typename T>
auto widened(T value)
{
    if constexpr (std::is_same_v<T, bool> || std::is_floating_point_v<T>) return value;
    else if constexpr (sizeof(T) < 4 || std::is_same_v<T, int32_t>) return int32_t(value);
    else if constexpr (std::is_same_v<T, uint64_t>)
        return int64_t(std::min(value, uint64_t(std::numeric_limits<int64_t>::max())));
    else return int64_t(value);
}

/// The axes of an array, that of the longest step first.
std::array<int, 3> axesBySteps(const VoxelArray& array)
{
    std::array<int, 3> axes = {0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(),
        [&](int a, int b) { return std::abs(array.stride[a]) > std::abs(array.stride[b]); });
    return axes;
}

/// Walks over an array leaf by leaf.
template <typename T>
class LeafWalk {
public:
    explicit LeafWalk(const VoxelArray& array) : mArray(array), mAxes(axesBySteps(array))
    {
        for (int i = 0; i < 3; ++i) mLeaves[i] = (array.shape[mAxes[i]] + 7) / kLeafDim;
    }

    /// Rows of leaves along the axis of the shortest step.
    std::size_t rows() const { return std::size_t(mLeaves[0] * mLeaves[1]); }

    /// Calls visit(origin) for the leaves of a row.
    template <typename Visit>
    void visitRow(std::size_t row, const Visit& visit) const
    {
        Coord origin;
        origin[mAxes[0]] = int(kLeafDim * (int64_t(row) / mLeaves[1]));
        origin[mAxes[1]] = int(kLeafDim * (int64_t(row) % mLeaves[1]));
        for (int64_t i = 0; i < mLeaves[2]; ++i) {
            origin[mAxes[2]] = int(kLeafDim * i);
            visit(origin);
        }
    }

    /// Calls visit(index in the leaf, value) for the array's voxels of a leaf.
    template <typename Visit>
    void visitLeaf(const Coord& origin, const Visit& visit) const
    {
        const int slow = mAxes[0], middle = mAxes[1], fast = mAxes[2];
        const auto count = [&](int axis) {
            return std::min<int64_t>(kLeafDim, mArray.shape[axis] - origin[axis]);
        };
        const int64_t slowCount = count(slow), middleCount = count(middle), fastCount = count(fast);
        for (int64_t i = 0; i < slowCount; ++i) {
            for (int64_t j = 0; j < middleCount; ++j) {
                const char* at =
                    place(origin) + i * mArray.stride[slow] + j * mArray.stride[middle];
                auto index = uint32_t(i * kLeafStride[slow] + j * kLeafStride[middle]);
                for (int64_t k = 0; k < fastCount; ++k, at += mArray.stride[fast]) {
                    visit(index, valueAt(at));
                    index += uint32_t(kLeafStride[fast]);
                }
            }
        }
    }

private:
    static T valueAt(const char* at)
    {
        if constexpr (std::is_same_v<T, bool>) {
            return *at != 0; // whatever else a byte may be that somebody calls a bool
        } else {
            T value; // which need not be aligned
            std::memcpy(&value, at, sizeof(T));
            return value;
        }
    }

    const char* place(const Coord& origin) const
    {
        const char* at = mArray.data;
        for (int axis = 0; axis < 3; ++axis) at += origin[axis] * mArray.stride[axis];
        return at;
    }

    const VoxelArray& mArray;
    const std::array<int, 3> mAxes;
    std::array<int64_t, 3> mLeaves{};
};

template <typename T>
bool isNan(T value)
{
    if constexpr (std::is_floating_point_v<T>) return value != value;
    else return false;
}

/// @throw InputError for the first NaN of an array that has one
template <typename T>
[[noreturn]] void throwNan(const VoxelArray& array)
{
    const LeafWalk<T> walk(array);
    std::optional<Coord> first;
    for (std::size_t row = 0; row < walk.rows() && !first; ++row) {
        walk.visitRow(row, [&](const Coord& origin) {
            walk.visitLeaf(origin, [&](uint32_t index, T value) {
                if (first || !isNan(value)) return;
                first = origin.offsetBy(int(index >> 6), int(index >> 3 & 7), int(index & 7));
            });
        });
    }
    const Coord ijk = first.value_or(Coord()); // it may have been overwritten meanwhile
    throw InputError("volume has a NaN at x=" + std::to_string(ijk[0])
        + ", y=" + std::to_string(ijk[1]) + ", z=" + std::to_string(ijk[2])
        + ", which is neither inside nor outside: numpy.nan_to_num() replaces them");
}

/// Fills a tree with what make(walk, origin) returns: a leaf, or null.
template <typename T, typename Tree, typename Make>
void fillTree(const VoxelArray& array, Tree& tree, const Make& make,
    openvdb::util::NullInterrupter* interrupter)
{
    using Leaf = typename Tree::LeafNodeType;
    const openvdb_spheretree::detail::Stage stage("Reading array", interrupter, nullptr);
    const LeafWalk<T> walk(array);
    std::vector<std::vector<std::unique_ptr<Leaf>>> rows(walk.rows());
    openvdb_spheretree::detail::parallelFor(rows.size(), interrupter, [&](std::size_t row) {
        walk.visitRow(row, [&](const Coord& origin) {
            if (auto leaf = make(walk, origin)) rows[row].push_back(std::move(leaf));
        });
    });
    openvdb::tree::ValueAccessor<Tree> accessor(tree);
    for (auto& row : rows) {
        for (auto& leaf : row) accessor.addLeaf(leaf.release());
    }
}

// ---- Which values are inside

struct IsTrue {
    bool contains(bool value) const { return value; }
};

struct InRange {
    std::optional<HalfSpace> above, below;

    template <typename T>
    bool contains(T value) const
    {
        return (!above || above->contains(value)) && (!below || below->contains(value));
    }
};

struct IsLabel {
    const std::vector<int64_t>& labels;

    template <typename T>
    bool contains(T value) const
    {
        return std::find(labels.begin(), labels.end(), value) != labels.end();
    }
    bool contains(double value) const
    {
        return std::any_of(labels.begin(), labels.end(), [&](int64_t label) {
            return value == double(label) && int64_t(double(label)) == label;
        });
    }
    bool contains(float value) const { return contains(double(value)); }
};

template <typename T, typename Inside>
openvdb::MaskTree::Ptr maskBy(
    const VoxelArray& array, const Inside& inside, openvdb::util::NullInterrupter* interrupter)
{
    using Leaf = openvdb::MaskTree::LeafNodeType;
    auto mask = std::make_shared<openvdb::MaskTree>();
    std::atomic<bool> anyNan{false};
    const auto make = [&](const LeafWalk<T>& walk, const Coord& origin) {
        LeafMask bits{};
        walk.visitLeaf(origin, [&](uint32_t index, T value) {
            if (isNan(value)) anyNan = true;
            bits[index >> 6] |= uint64_t(inside.contains(widened(value))) << (index & 63);
        });
        std::unique_ptr<Leaf> leaf;
        if (bits.none()) return leaf;
        leaf = std::make_unique<Leaf>(origin);
        Leaf::NodeMaskType active;
        bits.copyTo(active);
        leaf->setValueMask(active);
        return leaf;
    };
    fillTree<T>(array, *mask, make, interrupter);
    if (anyNan) throwNan<T>(array);
    return mask;
}

InRange rangeOf(const ObjectSettings& settings)
{
    if (!settings.above && !settings.below) return {HalfSpace{settings.threshold}, {}};
    InRange range;
    if (settings.above) range.above = HalfSpace{*settings.above};
    if (settings.below) range.below = HalfSpace{*settings.below, /*isBelow=*/true};
    return range;
}

// ---- Grids of values

template <typename Value>
using GridFor = typename openvdb::BoolGrid::ValueConverter<Value>::Type;

template <typename T>
openvdb::GridBase::Ptr valuesOf(
    const VoxelArray& array, double background, openvdb::util::NullInterrupter* interrupter)
{
    using Value = decltype(widened(T()));
    using Grid = GridFor<Value>;
    using Leaf = typename Grid::TreeType::LeafNodeType;
    const auto outside = Value(background);
    auto grid = openvdb_spheretree::detail::makeGrid<Grid>();
    grid->tree().root().setBackground(outside, /*updateChildNodes=*/false);
    std::atomic<bool> anyNan{false};
    const auto make = [&](const LeafWalk<T>& walk, const Coord& origin) {
        std::unique_ptr<Leaf> leaf;
        walk.visitLeaf(origin, [&](uint32_t index, T value) {
            if (isNan(value)) anyNan = true;
            const Value wide = widened(value);
            if (wide == outside) return;
            if (!leaf) leaf = std::make_unique<Leaf>(origin, outside);
            leaf->setValueOn(index, wide);
        });
        return leaf;
    };
    fillTree<T>(array, grid->tree(), make, interrupter);
    if (anyNan) throwNan<T>(array);
    return grid;
}

} // namespace

openvdb::MaskTree::Ptr maskOf(const VoxelArray& array, const ObjectSettings& settings,
    openvdb::util::NullInterrupter* interrupter)
{
    return visitType(array.type, [&](auto type) -> openvdb::MaskTree::Ptr {
        using T = decltype(type);
        if constexpr (std::is_same_v<T, bool>) {
            return maskBy<T>(array, IsTrue(), interrupter);
        } else {
            if (!settings.labels.empty())
                return maskBy<T>(array, IsLabel{settings.labels}, interrupter);
            return maskBy<T>(array, rangeOf(settings), interrupter);
        }
    });
}

openvdb::GridBase::Ptr gridOf(
    const VoxelArray& array, double background, openvdb::util::NullInterrupter* interrupter)
{
    return visitType(array.type,
        [&](auto type) { return valuesOf<decltype(type)>(array, background, interrupter); });
}

} // namespace binding
