// SPDX-License-Identifier: Apache-2.0
/// @file GridSamples.cc
/// @brief Samples of grids that an object is made of, and of others: each type, each codec.

#include "SampleFiles.h"
#include "VdbSamples.h"

#include <openvdb/points/AttributeArrayString.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointGroup.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/PointIndexGrid.h>

namespace spheretree_test {

namespace {

namespace points = openvdb::points;
using openvdb::Vec3d;

/// About x = 0, and with y and z from 0: in two nodes of each kind. Without a codec each two take 160 kB.
openvdb::FloatGrid::Ptr levelSet()
{
    openvdb::initialize();
    const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        /*radius=*/2.5f, openvdb::Vec3f(0.5f, 5, 5), /*voxelSize=*/1.f, /*halfWidth=*/2.f);
    grid->setName("ball");
    grid->insertMeta("note", openvdb::StringMetadata("a small ball"));
    return grid;
}

openvdb::FloatGrid::Ptr fog()
{
    const auto grid = levelSet();
    openvdb::tools::sdfToFogVolume(*grid);
    return grid;
}

template <typename GridT>
typename GridT::Ptr half(typename GridT::Ptr grid)
{
    grid->setSaveFloatAsHalf(true);
    return grid;
}

/// The voxels of the object with values of their own, and a tile.
template <typename GridT>
typename GridT::Ptr numbers()
{
    openvdb::initialize();
    using Value = typename GridT::ValueType;
    const auto grid = GridT::create(Value(0));
    int number = 0;
    const auto object = sampleObject();
    for (auto voxel = object->cbeginValueOn(); voxel; ++voxel) {
        grid->tree().setValue(voxel.getCoord(), Value(++number));
    }
    grid->tree().addTile(/*level=*/1, openvdb::Coord(64, 0, 0), Value(1), /*active=*/true);
    grid->setName("numbers");
    return grid;
}

/// As a camera sees it: its voxels are of many sizes.
openvdb::FloatGrid::Ptr frustum()
{
    const auto grid = fog();
    grid->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(Vec3d(0), Vec3d(10)), /*taper=*/0.5, /*depth=*/4, /*voxelSize=*/0.1));
    grid->setName("view");
    return grid;
}

struct Places {
    using PosType = Vec3d;
    std::vector<Vec3d> all;
    std::size_t size() const { return all.size(); }
    void getPos(std::size_t i, Vec3d& place) const { place = all[i]; }
};

/// In one leaf: OpenVDB 10 cannot read more of them.
openvdb::tools::PointIndexGrid::Ptr pointIndices()
{
    openvdb::initialize();
    Places places;
    for (int i = 0; i < 12; ++i) places.all.emplace_back(0.6 * i, 0.3 * i, i % 5);
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    const auto grid =
        openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(places, *transform);
    grid->setName("indices");
    return grid;
}

openvdb::MaskGrid::Ptr mask()
{
    const auto grid = openvdb::MaskGrid::create();
    grid->topologyUnion(*sampleObject());
    grid->setName("mask");
    return grid;
}

/// Points as another program makes them: positions in 16 bits, velocities, a group, names.
points::PointDataGrid::Ptr dust()
{
    openvdb::initialize();
    std::vector<Vec3d> positions;
    for (int i = 0; i < 40; ++i) positions.emplace_back(0.3 * i, 0.1 * (i % 5), -0.2 * (i % 7));
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    const auto grid =
        points::createPointDataGrid<points::FixedPointCodec<false>, points::PointDataGrid>(
            positions, *transform);
    auto& tree = grid->tree();
    points::appendAttribute<openvdb::Vec3f>(tree, "v", openvdb::Vec3f(1, 2, 3));
    points::appendAttribute<float>(tree, "pscale", 0.5f);
    points::appendAttribute(tree, "from", points::StringAttributeArray::attributeType());
    points::appendGroup(tree, "chosen");
    points::setGroup(tree, "chosen", true);
    float size = 0;
    for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
        points::AttributeWriteHandle<float> sizes(leaf->attributeArray("pscale"));
        for (openvdb::Index i = 0; i < sizes.size(); ++i) sizes.set(i, size += 0.25f);
    }
    grid->setName("dust");
    return grid;
}

template <uint32_t compression, typename Make>
std::string bytesOf(Make make)
{
    return vdbBytes({make()}, compression);
}

std::string levelSetBlosc() { return bytesOf<kBlosc>(levelSet); }
std::string levelSetZip() { return bytesOf<kZip>(levelSet); }
std::string levelSetNone() { return bytesOf<kNone>(levelSet); }
std::string levelSetHalf() { return vdbBytes({half<openvdb::FloatGrid>(levelSet())}, kBlosc); }
std::string levelSetPiped() { return vdbBytes({levelSet()}, kBlosc, false); }
std::string fogBlosc() { return bytesOf<kBlosc>(fog); }
std::string fogHalfZip() { return vdbBytes({half<openvdb::FloatGrid>(fog())}, kZip); }
std::string maskBlosc() { return bytesOf<kBlosc>(mask); }
std::string maskNone() { return bytesOf<kNone>(mask); }
std::string boolZip() { return bytesOf<kZip>(sampleObject); }
std::string int32Zip() { return bytesOf<kZip>(numbers<openvdb::Int32Grid>); }
std::string int32Active() { return bytesOf<kActive>(numbers<openvdb::Int32Grid>); }
std::string int64Blosc() { return bytesOf<kBlosc>(numbers<openvdb::Int64Grid>); }
std::string doubleZip() { return bytesOf<kZip>(numbers<openvdb::DoubleGrid>); }
std::string vectorBlosc() { return bytesOf<kBlosc>(numbers<openvdb::Vec3SGrid>); }
std::string pointsBlosc() { return bytesOf<kBlosc>(dust); }
std::string pointsZip() { return bytesOf<kZip>(dust); }
std::string vectorDoubles() { return bytesOf<kZip>(numbers<openvdb::Vec3DGrid>); }
std::string vectorIntegers() { return bytesOf<kActive>(numbers<openvdb::Vec3IGrid>); }
std::string frustumZip() { return bytesOf<kZip>(frustum); }
std::string pointIndicesBlosc() { return bytesOf<kBlosc>(pointIndices); }
std::string twoGrids() { return vdbBytes({levelSet(), numbers<openvdb::Int32Grid>()}, kBlosc); }

} // namespace

const std::vector<SampleMaker>& gridSamples()
{
    static const std::vector<SampleMaker> samples = {
        {"levelset_blosc", ".vdb", levelSetBlosc},
        {"levelset_zip", ".vdb", levelSetZip},
        {"levelset_none", ".vdb", levelSetNone},
        {"levelset_half", ".vdb", levelSetHalf},
        {"levelset_piped", ".vdb", levelSetPiped},
        {"fog_blosc", ".vdb", fogBlosc},
        {"fog_half_zip", ".vdb", fogHalfZip},
        {"mask_blosc", ".vdb", maskBlosc},
        {"mask_none", ".vdb", maskNone},
        {"bool_zip", ".vdb", boolZip},
        {"int32_zip", ".vdb", int32Zip},
        {"int32_active", ".vdb", int32Active},
        {"int64_blosc", ".vdb", int64Blosc},
        {"double_zip", ".vdb", doubleZip},
        {"vector_blosc", ".vdb", vectorBlosc},
        {"vector_doubles", ".vdb", vectorDoubles, true, kOfOneMore},
        {"vector_integers", ".vdb", vectorIntegers, true, kOfOneMore},
        {"frustum_zip", ".vdb", frustumZip, true, kOfOneMore},
        {"point_indices", ".vdb", pointIndicesBlosc, true, kOfOneMore},
        {"points_blosc", ".vdb", pointsBlosc},
        {"points_zip", ".vdb", pointsZip},
        {"two_grids", ".vdb", twoGrids},
    };
    return samples;
}

} // namespace spheretree_test
