// SPDX-License-Identifier: Apache-2.0
#include "VdbSamples.h"

#include <openvdb/io/Stream.h>
#include <openvdb/math/Maps.h>
#include <openvdb/points/AttributeArrayString.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointGroup.h>
#include <openvdb/tools/PointIndexGrid.h>

#include <random>
#include <sstream>

namespace spheretree_test {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;

namespace {

constexpr size_t kHeaderWithoutTag = 21, kTag = 36; // bytes

template <typename Value>
Value valueOf(double x)
{
    return Value(x);
}

/// Leaves by their origin's x: full, few, inactive of the background and its negative, of three values, of
/// many, of two that are not the background, of one that is not, of the background and another; then tiles.
template <typename GridT>
typename GridT::Ptr sampleOf(double background)
{
    using Value = typename GridT::ValueType;
    auto grid = GridT::create(valueOf<Value>(background));
    auto& tree = grid->tree();
    std::mt19937 random(7);
    for (int x = 0; x < 512; ++x)
        tree.setValueOn(Coord(x >> 6, x >> 3 & 7, x & 7), valueOf<Value>(x));
    tree.setValueOn(Coord(8, 0, 0), valueOf<Value>(3));
    for (int i = 0; i < 20; ++i) {
        tree.setValueOff(Coord(16 + i % 8, i / 8, 0), valueOf<Value>(-background));
        tree.setValueOff(Coord(24 + i % 8, i / 8, 0), valueOf<Value>(i % 2 ? 5 : 6));
        tree.setValueOff(Coord(32 + i % 8, i / 8, 0), valueOf<Value>(i));
        tree.setValueOn(Coord(-9000, -1, -1 - i), valueOf<Value>(random() % 100));
    }
    for (int i = 0; i < 512; ++i) {
        const Coord voxel(i >> 6, i >> 3 & 7, i & 7);
        tree.setValueOff(voxel.offsetBy(40, 0, 0), valueOf<Value>(i % 3 ? 5 : 6));
        tree.setValueOff(voxel.offsetBy(48, 0, 0), valueOf<Value>(5));
        if (i % 3) tree.setValueOff(voxel.offsetBy(56, 0, 0), valueOf<Value>(5));
    }
    for (int x : {40, 48, 56}) tree.setValueOn(Coord(x, 0, 0), valueOf<Value>(4));
    tree.addTile(1, Coord(64, 0, 0), valueOf<Value>(1), true);
    tree.addTile(1, Coord(72, 0, 0), valueOf<Value>(2), false);
    tree.addTile(2, Coord(256, 0, 0), valueOf<Value>(1), true);
    tree.addTile(3, Coord(8192, 0, 0), valueOf<Value>(1), true);
    tree.addTile(3, Coord(16384, 0, 0), valueOf<Value>(2), false);
    return grid;
}

template <typename GridT>
void addReal(openvdb::GridPtrVec& grids, const std::string& name, double background)
{
    for (const bool half : {false, true}) {
        auto grid = sampleOf<GridT>(background);
        grid->setSaveFloatAsHalf(half);
        grid->setName(name + (half ? " in half precision" : ""));
        grids.push_back(grid);
    }
}

template <typename GridT>
void add(openvdb::GridPtrVec& grids, const std::string& name, double background)
{
    auto grid = sampleOf<GridT>(background);
    grid->setName(name);
    grids.push_back(grid);
}

std::vector<Vec3d> somePoints()
{
    std::mt19937 random(11);
    std::vector<Vec3d> points;
    for (int i = 0; i < 3000; ++i) {
        points.emplace_back(random() % 40 - 20.0, random() % 10, random() % 10 + 5000 * (i % 2));
    }
    return points;
}

openvdb::GridBase::Ptr pointSample()
{
    namespace points = openvdb::points;
    const auto transform = openvdb::math::Transform::createLinearTransform(1.5);
    auto grid = points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(
        somePoints(), *transform);
    auto& tree = grid->tree();
    points::appendAttribute<float>(tree, "uniform", 2.5f);
    points::appendAttribute<openvdb::Vec3f, points::FixedPointCodec<true>>(tree, "packed");
    points::appendAttribute<int64_t>(tree, "strided", 7, /*stride=*/3);
    points::appendAttribute(tree, "text", points::StringAttributeArray::attributeType());
    points::appendGroup(tree, "some");
    for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
        points::AttributeWriteHandle<int64_t> strided(leaf->attributeArray("strided"));
        for (openvdb::Index i = 0; i < strided.size(); ++i) strided.set(i, i % 3, i);
        points::AttributeWriteHandle<openvdb::Vec3f, points::FixedPointCodec<true>> packed(
            leaf->attributeArray("packed"));
        for (openvdb::Index i = 0; i < packed.size(); ++i) packed.set(i, openvdb::Vec3f(0.1f));
        auto group = leaf->groupWriteHandle("some");
        for (openvdb::Index i = 0; i < group.size(); i += 2) group.set(i, true);
    }
    grid->setName("points");
    return grid;
}

/// What createPointIndexGrid() asks of an array of points.
struct PointArray {
    using PosType = Vec3d;
    explicit PointArray(int count) : all(somePoints()) { all.resize(size_t(count)); }
    std::vector<Vec3d> all;
    size_t size() const { return all.size(); }
    void getPos(size_t i, Vec3d& position) const { position = all[i]; }
};

} // namespace

openvdb::GridPtrVec vdbSamples()
{
    openvdb::GridPtrVec grids;
    addReal<openvdb::FloatGrid>(grids, "float", 3);
    addReal<openvdb::DoubleGrid>(grids, "double", 3);
    addReal<openvdb::Vec3SGrid>(grids, "vec3s", 3);
    addReal<openvdb::Vec3DGrid>(grids, "vec3d", 0);
    add<openvdb::Int32Grid>(grids, "int32", 3);
    add<openvdb::Int64Grid>(grids, "int64", 0);
    add<openvdb::Vec3IGrid>(grids, "vec3i", 1);
    add<openvdb::BoolGrid>(grids, "bool", 0);
    add<openvdb::MaskGrid>(grids, "mask", 0);
    grids.push_back(pointSample());
    for (const openvdb::GridBase::Ptr& empty :
        {openvdb::GridBase::Ptr(openvdb::FloatGrid::create(1)),
            openvdb::GridBase::Ptr(openvdb::points::PointDataGrid::create())}) {
        empty->setName("no nodes of type " + empty->type());
        grids.push_back(empty);
    }

    auto frustum = sampleOf<openvdb::FloatGrid>(1);
    frustum->setName("frustum");
    frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(Vec3d(0), Vec3d(10)), 0.5, 4, 0.1));
    grids.push_back(frustum);
    auto shared = frustum->copy();
    shared->setName("shared nodes");
    shared->setTransform(openvdb::math::Transform::createLinearTransform(3));
    shared->insertMeta("note", openvdb::StringMetadata("a string"));
    shared->insertMeta("matrix", openvdb::Mat4DMetadata(openvdb::Mat4d::identity()));
    grids.push_back(shared);
    return grids;
}

openvdb::GridBase::Ptr pointIndexSample(int count)
{
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    auto grid = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(
        PointArray(count), *transform);
    grid->setName("point indices");
    return grid;
}

std::vector<uint32_t> vdbCompressions()
{
    using namespace openvdb::io;
    return {COMPRESS_NONE, COMPRESS_ACTIVE_MASK, COMPRESS_ZIP, COMPRESS_ZIP | COMPRESS_ACTIVE_MASK,
        COMPRESS_BLOSC, COMPRESS_BLOSC | COMPRESS_ACTIVE_MASK};
}

std::string vdbBytes(const openvdb::GridPtrVec& grids, uint32_t compression)
{
    std::ostringstream out;
    openvdb::io::Stream stream(out);
    stream.setCompression(compression);
    stream.write(grids);
    return out.str();
}

std::string contentOf(const openvdb::GridBase::Ptr& grid)
{
    std::ostringstream out;
    openvdb::io::Stream stream(out);
    stream.setCompression(openvdb::io::COMPRESS_BLOSC);
    stream.setGridStatsMetadataEnabled(false);
    stream.write(openvdb::GridCPtrVec{grid});
    return out.str().erase(kHeaderWithoutTag, kTag);
}

} // namespace spheretree_test
