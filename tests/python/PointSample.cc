// SPDX-License-Identifier: Apache-2.0
/// @file PointSample.cc
/// @brief PointSample FILE: five points with an attribute of every type, as OpenVDB's own functions make
/// them. What read_points() of the Python module is tested with.

#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/points/PointGroup.h>

#include <cstdint>
#include <string>
#include <vector>

using namespace openvdb;

namespace {

/// Number n of point n, counted from 1, is kept in `int32`: the others follow from it.
template <typename T, typename Codec, typename Value>
void add(points::PointDataTree& tree, const std::string& name, const Value& value, Index stride = 1)
{
    points::appendAttribute<T, Codec>(tree, name, zeroVal<T>(), stride);
    for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
        const points::AttributeHandle<int32_t> number(leaf->constAttributeArray("int32"));
        points::AttributeWriteHandle<T> handle(leaf->attributeArray(name));
        for (auto point = leaf->beginIndexOn(); point; ++point) {
            for (Index m = 0; m < stride; ++m)
                handle.set(*point, m, T(value(number.get(*point), m)));
        }
    }
}

template <typename T, typename Codec = points::NullCodec>
void addNumber(points::PointDataTree& tree, const std::string& name)
{
    add<T, Codec>(tree, name, [](int n, Index) { return T(n); });
}

template <typename T>
void addVector(points::PointDataTree& tree, const std::string& name)
{
    using Of = typename T::ValueType;
    add<T, points::NullCodec>(
        tree, name, [](int n, Index) { return T(Of(n), Of(2 * n), Of(3 * n)); });
}

void addStrings(points::PointDataTree& tree)
{
    points::appendAttribute<Name>(tree, "string");
    for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
        points::StringMetaInserter inserter(leaf->attributeSet().descriptorPtr()->getMetadata());
        inserter.insert("odd");
        inserter.insert("even");
        points::StringAttributeWriteHandle handle(
            leaf->attributeArray("string"), leaf->attributeSet().descriptor().getMetadata());
        const points::AttributeHandle<int32_t> number(leaf->constAttributeArray("int32"));
        for (auto point = leaf->beginIndexOn(); point; ++point) {
            handle.set(*point, number.get(*point) % 2 ? "odd" : "even");
        }
    }
}

} // namespace

int main(int argc, char* argv[])
{
    if (argc != 2) return 2;
    initialize();
    std::vector<Vec3d> positions;
    std::vector<int32_t> numbers;
    for (int n = 1; n <= 5; ++n) {
        positions.emplace_back(n, 10.0 * n, -0.25 * n);
        numbers.push_back(n);
    }
    const points::PointAttributeVector<Vec3d> places(positions);
    const auto transform = math::Transform::createLinearTransform(0.5);
    const auto indices = tools::createPointIndexGrid<tools::PointIndexGrid>(places, *transform);
    const auto grid = points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(
        *indices, places, *transform);
    grid->setName("sample");
    auto& tree = grid->tree();
    points::appendAttribute<int32_t>(tree, "int32");
    const points::PointAttributeVector<int32_t> values(numbers);
    points::populateAttribute<points::PointDataTree, tools::PointIndexTree,
        points::PointAttributeVector<int32_t>>(tree, indices->tree(), "int32", values);

    add<bool, points::NullCodec>(tree, "bool", [](int n, Index) { return n % 2 == 1; });
    addNumber<int8_t>(tree, "int8");
    addNumber<int16_t>(tree, "int16");
    addNumber<int64_t>(tree, "int64");
    addNumber<float>(tree, "float");
    addNumber<double>(tree, "double");
    addNumber<float, points::TruncateCodec>(tree, "half");
    addVector<Vec3i>(tree, "vec3i");
    addVector<Vec3s>(tree, "vec3s");
    addVector<Vec3d>(tree, "vec3d");
    add<math::Quats, points::NullCodec>(
        tree, "quats", [](int n, Index) { return math::Quats(float(n), 0, 0, float(-n)); });
    add<math::Mat3d, points::NullCodec>(
        tree, "mat3d", [](int n, Index) { return math::Mat3d(n, 1, 0, 0, n, 0, 0, 0, n); });
    add<math::Mat4s, points::NullCodec>(tree, "mat4s",
        [](int, Index) { return math::Mat4s(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1); });
    add<int32_t, points::NullCodec>(
        tree, "pair", [](int n, Index m) { return m == 0 ? n : -n; }, 2);
    points::appendAttribute<int32_t>(tree, "uniform", 4);
    addStrings(tree);
    points::appendGroup(tree, "few");
    for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
        const points::AttributeHandle<int32_t> number(leaf->constAttributeArray("int32"));
        auto group = leaf->groupWriteHandle("few");
        for (auto point = leaf->beginIndexOn(); point; ++point) {
            group.set(*point, number.get(*point) < 3);
        }
    }
    io::File(argv[1]).write({grid});
    return 0;
}
