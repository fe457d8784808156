// SPDX-License-Identifier: Apache-2.0
/// @file Points.cc
/// @brief Any point grids of a `.vdb` as arrays of numpy: all attributes that OpenVDB registers, whatever
/// their codec; and groups, as arrays of bool.

#include "Call.h"
#include "Errors.h"
#include "Tree.h"

#include "files/VdbStream.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/points/AttributeArrayString.h>
#include <openvdb/points/AttributeGroup.h>
#include <openvdb/points/PointDataGrid.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace py = pybind11;

namespace binding {

namespace points = openvdb::points;
namespace spheretree = openvdb_spheretree::detail;
using points::PointDataGrid;

namespace {

using Leaf = points::PointDataTree::LeafNodeType;

/// The leaves of a grid, and where the points of each begin. All of them have the same attributes, of as
/// many values as the leaf has points.
struct PointLeaves {
    std::vector<const Leaf*> leaves;
    std::vector<std::size_t> begin;

    /// @throw openvdb::Exception if leaves contradict themselves or each other: handles of OpenVDB would
    ///        read behind their arrays
    explicit PointLeaves(const PointDataGrid& grid) : begin(1, 0)
    {
        for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
            leaf->validateOffsets();
            leaves.push_back(&*leaf);
            begin.push_back(begin.back() + std::size_t(leaf->getLastValue()));
            requireLikeFirst(*leaf);
        }
        // A file may say in a few bytes that many points have one value.
        openvdb_spheretree::detail::requireMemory(
            24.0 * double(size()), "the positions of its points", "split the grid");
    }
    py::ssize_t size() const { return py::ssize_t(begin.back()); }

private:
    void requireLikeFirst(const Leaf& leaf) const
    {
        const auto &own = leaf.attributeSet(), &first = leaves.front()->attributeSet();
        bool isLike = own.descriptor() == first.descriptor() && own.size() == first.size();
        for (std::size_t i = 0; isLike && i < own.size(); ++i) {
            const auto &array = *own.getConst(i), &other = *first.getConst(i);
            isLike = array.hasConstantStride() && other.hasConstantStride()
                && array.stride() == other.stride();
        }
        if (isLike) return;
        OPENVDB_THROW(openvdb::IoError,
            "its points have attributes, or numbers of values, that differ from leaf to leaf, "
            "which "
            "is not read");
    }
};

/// What a value of an attribute is in an array: numbers of one type, `kCount` of them.
template <typename T>
struct Numbers {
    using Type = T;
    static constexpr int kCount = 1;
    static T at(const T& value, int) { return value; }
};
template <typename T>
struct Numbers<openvdb::math::Vec3<T>> {
    using Type = T;
    static constexpr int kCount = 3;
    static T at(const openvdb::math::Vec3<T>& value, int i) { return value[i]; }
};
template <typename T>
struct Numbers<openvdb::math::Quat<T>> {
    using Type = T;
    static constexpr int kCount = 4;
    static T at(const openvdb::math::Quat<T>& value, int i) { return value[i]; }
};
template <typename T>
struct Numbers<openvdb::math::Mat3<T>> {
    using Type = T;
    static constexpr int kCount = 9;
    static T at(const openvdb::math::Mat3<T>& value, int i) { return value(i / 3, i % 3); }
};
template <typename T>
struct Numbers<openvdb::math::Mat4<T>> {
    using Type = T;
    static constexpr int kCount = 16;
    static T at(const openvdb::math::Mat4<T>& value, int i) { return value(i / 4, i % 4); }
};

/// (n,), (n, 3) and so on; with a stride (n, stride, ...).
std::vector<py::ssize_t> shapeOf(py::ssize_t size, openvdb::Index stride, int count)
{
    std::vector<py::ssize_t> shape = {size};
    if (stride > 1) shape.push_back(py::ssize_t(stride));
    if (count == 9 || count == 16) shape.insert(shape.end(), 2, count == 9 ? 3 : 4);
    else if (count > 1) shape.push_back(count);
    return shape;
}

template <typename T>
py::array valuesOf(const PointLeaves& all, std::size_t attribute, openvdb::Index stride)
{
    using Of = Numbers<T>;
    py::array_t<typename Of::Type> array(shapeOf(all.size(), stride, Of::kCount));
    auto* to = array.mutable_data();
    for (std::size_t i = 0; i < all.leaves.size(); ++i) {
        const points::AttributeHandle<T> handle(all.leaves[i]->constAttributeArray(attribute));
        const auto count = openvdb::Index(all.begin[i + 1] - all.begin[i]);
        for (openvdb::Index n = 0; n < count; ++n) {
            for (openvdb::Index m = 0; m < stride; ++m) {
                const T value = handle.get(n, m);
                for (int k = 0; k < Of::kCount; ++k) *to++ = Of::at(value, k);
            }
        }
    }
    return array;
}

/// World space, as doubles.
py::array positionsOf(const PointDataGrid& grid, const PointLeaves& all)
{
    py::array_t<double> array({all.size(), py::ssize_t(3)});
    double* to = array.mutable_data();
    for (const Leaf* leaf : all.leaves) {
        const points::AttributeHandle<openvdb::Vec3f> handle(leaf->constAttributeArray("P"));
        openvdb::Index point = 0;
        for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) { // inactive ones too
            const openvdb::Vec3d center = leaf->offsetToGlobalCoord(n).asVec3d();
            for (const auto end = openvdb::Index(leaf->getValue(n)); point < end; ++point) {
                const openvdb::Vec3d world =
                    grid.transform().indexToWorld(center + openvdb::Vec3d(handle.get(point)));
                to = std::copy_n(world.asPointer(), 3, to);
            }
        }
    }
    return array;
}

py::list stringsOf(const PointLeaves& all, std::size_t attribute)
{
    py::list strings;
    for (std::size_t i = 0; i < all.leaves.size(); ++i) {
        const points::StringAttributeHandle handle(all.leaves[i]->constAttributeArray(attribute),
            all.leaves[i]->attributeSet().descriptor().getMetadata());
        const auto count = openvdb::Index(all.begin[i + 1] - all.begin[i]);
        for (openvdb::Index n = 0; n < count; ++n) strings.append(textOf(handle.get(n)));
    }
    return strings;
}

py::array groupOf(const PointLeaves& all, const std::string& name)
{
    py::array_t<bool> array(all.size());
    bool* to = array.mutable_data();
    for (std::size_t i = 0; i < all.leaves.size(); ++i) {
        const auto handle = all.leaves[i]->groupHandle(name);
        const auto count = openvdb::Index(all.begin[i + 1] - all.begin[i]);
        for (openvdb::Index n = 0; n < count; ++n) *to++ = handle.get(n);
    }
    return array;
}

/// @return None for a type that is not known.
py::object arrayOf(
    const PointLeaves& all, std::size_t attribute, const std::string& type, openvdb::Index stride)
{
    using namespace openvdb;
    const auto values = [&](auto zero) -> py::object {
        return valuesOf<decltype(zero)>(all, attribute, stride);
    };
    if (type == typeNameAsString<bool>()) return values(bool());
    if (type == typeNameAsString<int8_t>()) return values(int8_t());
    if (type == typeNameAsString<int16_t>()) return values(int16_t());
    if (type == typeNameAsString<int32_t>()) return values(int32_t());
    if (type == typeNameAsString<int64_t>()) return values(int64_t());
    if (type == typeNameAsString<float>()) return values(float());
    if (type == typeNameAsString<double>()) return values(double());
    if (type == typeNameAsString<Vec3i>()) return values(Vec3i());
    if (type == typeNameAsString<Vec3s>()) return values(Vec3s());
    if (type == typeNameAsString<Vec3d>()) return values(Vec3d());
    if (type == typeNameAsString<math::Quat<float>>()) return values(math::Quat<float>());
    if (type == typeNameAsString<math::Quat<double>>()) return values(math::Quat<double>());
    if (type == typeNameAsString<math::Mat3<float>>()) return values(math::Mat3<float>());
    if (type == typeNameAsString<math::Mat3<double>>()) return values(math::Mat3<double>());
    if (type == typeNameAsString<math::Mat4<float>>()) return values(math::Mat4<float>());
    if (type == typeNameAsString<math::Mat4<double>>()) return values(math::Mat4<double>());
    return py::none();
}

py::dict attributesOf(const PointDataGrid& grid)
{
    const PointLeaves all(grid);
    py::dict arrays;
    if (all.leaves.empty()) return arrays;
    const auto& set = all.leaves.front()->attributeSet();
    for (const auto& [name, position] : set.descriptor().map()) {
        const points::AttributeArray& array = *set.getConst(position);
        const std::string type = array.valueType();
        if (points::isGroup(array)) continue; // eight groups in one
        if (name == "P") arrays["P"] = positionsOf(grid, all);
        else if (points::isString(array)) arrays[textOf(name)] = stringsOf(all, position);
        else {
            const py::object values = arrayOf(all, position, type, array.stride());
            if (!values.is_none()) arrays[textOf(name)] = values;
        }
    }
    for (const auto& [name, index] : set.descriptor().groupMap()) {
        arrays[textOf("group:" + name)] = groupOf(all, name);
    }
    return arrays;
}

py::dict readPoints(const std::string& path, const py::object& progress)
{
    const auto grids = resultOfCall(CallSettings{progress},
        [&](Interrupter*) { return command::readVdb(path, command::Loading::Whole); });
    py::dict result;
    for (const auto& grid : grids) {
        const auto pointGrid = openvdb::gridPtrCast<PointDataGrid>(grid);
        if (!pointGrid) continue;
        try {
            result[textOf(grid->getName())] = attributesOf(*pointGrid);
        } catch (const openvdb::Exception& error) { // the file's fault
            OPENVDB_THROW(openvdb::IoError,
                path << ": points " << spheretree::inQuotes(grid->getName()) << ": "
                     << spheretree::messageOf(error));
        }
    }
    return result;
}

} // namespace

void bindPoints(py::module_& module) { module.def("read_points", readPoints); }

} // namespace binding
