// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/export/VolWriter.h>

#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>

#include "support/Messages.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <fstream>
#include <sstream>

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Coord;

namespace {

TEST(VolWriter, WhatIsWrittenIsReadBack)
{
    const auto object = openvdb::BoolGrid::create();
    object->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    object->fill({Coord(-9, 3, 100), Coord(20, 18, 130)}, true); // tiles, too
    object->tree().setValueOff(Coord(-9, 3, 100));
    object->tree().setValueOn(Coord(21, 2, 99));
    TemporaryFolder folder;
    const std::string path = folder.path() + "/object.vol";
    {
        std::ofstream out(path, std::ios::binary);
        writeVolFile(*object, out);
    }
    const auto read = openvdb::gridPtrCast<openvdb::Int32Grid>(readVolFile(path));
    EXPECT_EQ(read->activeVoxelCount(), object->activeVoxelCount());
    EXPECT_EQ(read->voxelSize(), object->voxelSize());
    for (auto voxel = read->cbeginValueOn(); voxel; ++voxel) {
        EXPECT_EQ(*voxel, 255);
        EXPECT_TRUE(object->tree().isValueOn(voxel.getCoord() + Coord(-9, 2, 99)));
    }
}

TEST(VolWriter, ATurnedObjectFarAwayHasOneVoxelSize)
{
    openvdb::Mat4d matrix = openvdb::Mat4d::identity();
    matrix.postRotate(openvdb::math::X_AXIS, 0.4);
    matrix.postTranslate(openvdb::Vec3d(1e8, 2e8, 3e8));
    const auto object = openvdb::BoolGrid::create();
    object->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    object->tree().setValueOn(Coord(0), true);
    std::ostringstream out;
    writeVolFile(*object, out);
    EXPECT_NE(out.str().find("\nVoxel-Size: 1\n"), std::string::npos) << out.str();
}

TEST(VolWriter, WhatHasNoBoxOrTooLargeAOneIsRefused)
{
    const auto object = openvdb::BoolGrid::create();
    std::ostringstream out;
    const auto why = [&] {
        return messageOf<openvdb::ValueError>([&] { writeVolFile(*object, out); });
    };
    EXPECT_TRUE(mentions(why(), "empty"));
    object->tree().setValueOn(Coord(-(1 << 20), 0, 0));
    object->tree().setValueOn(Coord(1 << 20, 0, 0));
    EXPECT_TRUE(mentions(why(), "too many"));
    EXPECT_TRUE(out.str().empty());
}

} // namespace
