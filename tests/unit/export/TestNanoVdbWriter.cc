// SPDX-License-Identifier: Apache-2.0
// What no reader of NanoVDB sees: refusals, and the same bytes. Readers are in tests/readers.

#include <openvdb_spheretree/export/ExportTree.h>
#include <openvdb_spheretree/export/NanoVdbWriter.h>

#include "support/Messages.h"
#include "support/PointGrids.h"
#include "support/SampleTrees.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>

#include <gtest/gtest.h>

#include <sstream>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

class NanoVdbWriter : public testing::Test {
protected:
    void SetUp() override
    {
        if (!writesNanoVdb()) GTEST_SKIP() << "this build has no NanoVDB";
        openvdb::initialize();
    }
};

std::string written(const std::vector<openvdb::GridBase::Ptr>& grids)
{
    std::ostringstream out;
    writeNanoVdb(grids, out);
    return out.str();
}

TEST_F(NanoVdbWriter, TheSameGridsGiveTheSameBytesAndStayAsTheyWere)
{
    const auto mask = openvdb::BoolGrid::create(false);
    mask->setName("voxels");
    mask->fill(openvdb::CoordBBox(openvdb::Coord(-20), openvdb::Coord(40)), true);
    const auto numbers = openvdb::FloatGrid::create(3);
    for (int i = 0; i < 100; ++i) numbers->tree().setValue({i, 2 * i, 3 * i}, float(i));
    const auto before = numbers->deepCopy();
    const std::string bytes = written({mask, numbers});
    EXPECT_EQ(bytes, written({mask, numbers}));
    EXPECT_TRUE(before->tree().hasSameTopology(numbers->tree()));
    for (auto value = before->cbeginValueOn(); value; ++value) {
        ASSERT_EQ(numbers->tree().getValue(value.getCoord()), *value);
    }
}

TEST_F(NanoVdbWriter, GridsOfOtherTypesAreRefusedByName)
{
    const auto grid = openvdb::Vec3IGrid::create();
    grid->setName("words");
    const std::string why = messageOf<openvdb::ValueError>([&] { written({grid}); });
    EXPECT_TRUE(mentions(why, "vec3i"));
    EXPECT_TRUE(mentions(why, "'words'"));
}

TEST_F(NanoVdbWriter, AttributesOfOtherTypesAreRefusedByType)
{
    const auto points = spheretree_test::pointsAt({{0, 0, 0}, {5, 5, 5}});
    EXPECT_FALSE(written({points}).empty());
    openvdb::points::appendAttribute<double>(points->tree(), "mass");
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { written({points}); }), "double"));
}

TEST_F(NanoVdbWriter, CamerasAreRefused)
{
    const auto grid = openvdb::FloatGrid::create();
    grid->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 10, 1));
    grid->tree().setValue({1, 2, 3}, 1);
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { written({grid}); }), "affine"));
}

TEST_F(NanoVdbWriter, TreesOfAnySizeAreWritten)
{
    SphereTree tree = randomTree(300, 11);
    for (const double voxel : {1e-4, 1.0, 1e6}) {
        tree.transform = openvdb::math::Transform::createLinearTransform(voxel);
        std::ostringstream out;
        exportTree(tree, *findExportFormat(".nvdb"), {}, out);
        EXPECT_GT(out.str().size(), 300u * 28u) << voxel;
    }
    ExportSettings settings;
    for (const double scale : {1e-12, 1e12}) {
        settings.scale = scale;
        std::ostringstream out;
        exportTree(tree, *findExportFormat(".nvdb"), settings, out);
        EXPECT_GT(out.str().size(), 300u * 28u) << scale;
    }
}

} // namespace
