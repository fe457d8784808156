// SPDX-License-Identifier: Apache-2.0
/// @file TestQueryTables.cc
/// @brief Tables of poses, points and rays: each way to write them down, and every line that is none by file and line.

#include "support/Messages.h"
#include "support/TemporaryFolder.h"

#include <openvdb_spheretree/query/QueryTables.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace {

using namespace openvdb_spheretree;
using openvdb::Vec3d;
using spheretree_test::mentions;
using spheretree_test::messageOf;

class QueryTables : public testing::Test {
protected:
    std::string save(const std::string& text) const
    {
        const std::string path = mFolder.path() + "/table.csv";
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    QueryTable<RigidTransform> poses(const std::string& text) const
    {
        return readPoseTable(save(text));
    }
    template <typename Read>
    std::string whyNot(const Read& read, const std::string& text) const
    {
        const std::string path = save(text);
        const std::string why = messageOf<openvdb::IoError>([&] { read(path, std::string()); });
        EXPECT_TRUE(mentions(why, path));
        return why;
    }
    std::string noPoses(const std::string& text) const { return whyNot(readPoseTable, text); }

    spheretree_test::TemporaryFolder mFolder;
};

void expectNear(const Vec3d& a, const Vec3d& b)
{
    EXPECT_LE((a - b).length(), 1e-12) << a << " and " << b;
}

/// A quarter about z, then a move by 1, 2, 3.
void expectQuarter(const QueryTable<RigidTransform>& table)
{
    ASSERT_EQ(table.rows.size(), 1u);
    expectNear(table.rows[0] * Vec3d(1, 0, 0), Vec3d(1, 3, 3));
    expectNear(table.rows[0] * Vec3d(0, 0, 1), Vec3d(1, 2, 4));
}

TEST_F(QueryTables, APoseIsReadInEveryWayToWriteIt)
{
    const std::string half = std::to_string(M_SQRT1_2), quarter = "1.5707963267948966";
    expectQuarter(poses("1 2 3 0 0 " + half + " " + half));
    expectQuarter(poses("time;qw;qx;qy;qz;X;Y;Z\n7;" + half + ";0;0;" + half + ";1;2;3\n"));
    expectQuarter(poses("# a comment\n\nx,y,z,rx,ry,rz,\"name\"\n1,2,3,0,0," + quarter + ",a\n"));
    expectQuarter(poses("X,Y,Z,Roll,Pitch,Yaw\n1,2,3,0,0," + quarter + "\n"));
    expectQuarter(poses("1305031098.67 1 2 3 0 0 " + half + " " + half));
    expectQuarter(poses("0 -1 0 1  1 0 0 2  0 0 1 3"));
    expectQuarter(poses("0\t-1\t0\t1\t1\t0\t0\t2\t0\t0\t1\t3\t0\t0\t0\t1\r\n"));
    expectQuarter(
        poses("m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23\n0,-1,0,1,1,0,0,2,0,0,1,3"));
    const auto moves = poses("x,y,z\n1,2,3\n\n+4,5e0,6\n");
    ASSERT_EQ(moves.rows.size(), 2u);
    expectNear(moves.rows[1] * Vec3d(0.0), Vec3d(4, 5, 6));
}

TEST_F(QueryTables, APoseOfABodyIsAPoseWithAName)
{
    const auto table = readBodyPoseTable(
        save("# who\nX,Body,y,z,rx,ry,rz,Frame,note\n1,hand,2,3,0,0,1.5707963267948966,-2,7\n"
             "\n4,\"two words\",5,6,0,0,0,-2,x\n4, 0 ,5,6,0,0,0,3,x\n"));
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_TRUE(table.assumption.empty());
    const auto& hand = table.rows[0];
    EXPECT_EQ(hand.body, "hand");
    EXPECT_EQ(hand.frame, -2);
    EXPECT_EQ(hand.line, 3u);
    expectNear(hand.pose * Vec3d(1, 0, 0), Vec3d(1, 3, 3));
    EXPECT_EQ(table.rows[1].body, "two words");
    EXPECT_EQ(table.rows[1].line, 5u);
    EXPECT_EQ(table.rows[2].body, "0");
    EXPECT_EQ(table.rows[2].frame, 3);

    const auto moves = readBodyPoseTable(save("body x y z turn\na 1 2 3 4\n"));
    EXPECT_EQ(moves.rows[0].frame, 0);
    EXPECT_TRUE(mentions(moves.assumption, "moves without a turn")) << moves.assumption;
    EXPECT_TRUE(mentions(moves.assumption, "not used: 'turn'")) << moves.assumption;
    const auto why = [&](const std::string& text) { return whyNot(readBodyPoseTable, text); };
    EXPECT_TRUE(mentions(why("1,2,3\n"), "has a header"));
    EXPECT_TRUE(mentions(why("x,y,z\n1,2,3\n"), "no column 'body', and poses of bodies have body"));
    EXPECT_TRUE(mentions(why("body,Body,x,y,z\na,b,1,2,3\n"), "more than one column 'body'"));
    EXPECT_TRUE(mentions(why("body,x,y,z\na,1,2,3\n,1,2,3\n"), "line 3: the line names no body"));
    EXPECT_TRUE(mentions(
        why("frame,body,x,y,z\n2,a,1,2,3\n1,a,1,2,3\n"), "line 3: frame 1 stands behind frame 2"));
    EXPECT_TRUE(mentions(why("frame,body,x,y,z\n0.5,a,1,2,3\n"), "line 2: frame 0.5"));
    EXPECT_TRUE(mentions(why("frame,body,x,y,z\n1e16,a,1,2,3\n"), "frames are whole numbers"));
    EXPECT_TRUE(mentions(why("body,x,y,z\n"), "holds no poses of bodies"));
}

TEST_F(QueryTables, AQuaternionTurnsAboutItsAxis)
{
    const Vec3d axis = Vec3d(1, -2, 3).unit();
    const double angle = 0.9;
    std::ostringstream text;
    text.precision(17);
    text << "7 8 9 ";
    for (int a = 0; a < 3; ++a) text << axis[a] * std::sin(angle / 2) << " ";
    text << std::cos(angle / 2);
    const auto table = poses(text.str());
    const auto expected = RigidTransform::fromRotation(axis, angle);
    for (const Vec3d p : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0.3, -2, 5)}) {
        expectNear(table.rows.at(0) * p, expected * p + Vec3d(7, 8, 9));
    }
}

TEST_F(QueryTables, WhatIsTakenForGrantedIsSaid)
{
    EXPECT_EQ(poses("x,y,z\n1,2,3").assumption, "");
    EXPECT_TRUE(mentions(poses("1,2,3").assumption, "3 columns are taken as x, y, z"));
    EXPECT_TRUE(mentions(poses("1 1 2 3 0 0 0 1").assumption, "8 columns are taken as time, x"));
    EXPECT_EQ(poses("x,y,z,rx,ry,rz\n1,2,3,6.28,-6.28,0").assumption, "");
    for (const char* angles : {"rx,ry,rz", "roll,pitch,yaw"}) {
        const auto table = poses(std::string("x,y,z,") + angles + "\n1,2,3,0,1,0\n1,2,3,0,-90,0\n");
        EXPECT_TRUE(
            mentions(table.assumption, "radians, and -90 of line 3 is more than once around"))
            << table.assumption;
    }
    EXPECT_EQ(poses("x,y,z,qx,qy,qz,qw\n100,200,300,0,0,0,1").assumption, "");
    EXPECT_TRUE(mentions(
        poses("Body,x,y,z,rx,ry,rz\narm,1,2,3,0,0,0").assumption, "column 'body' is not used"));
    const auto bodies = readBodyPoseTable(save("body,x,y,z,rx,ry,rz\narm,1,2,3,0,0,45"));
    EXPECT_TRUE(mentions(bodies.assumption, "45 of line 2")) << bodies.assumption;
    const std::string moves = poses("time,x,y,z,tilt\n0,1,2,3,90").assumption;
    EXPECT_TRUE(mentions(moves, "table.csv: its poses are moves without a turn")) << moves;
    EXPECT_TRUE(mentions(moves, "not used: 'time', 'tilt'")) << moves;
    EXPECT_TRUE(mentions(poses("a,b,c,x,y,z,d,e,f\n0,0,0,1,2,3,0,0,0").assumption, " and 1 more"));
    EXPECT_EQ(poses("time,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,1").assumption, "");
    EXPECT_TRUE(mentions(readRayTable(save("1 2 3 4 5 6")).assumption, "dx, dy, dz"));
    const std::string path = save("1,2,3");
    EXPECT_TRUE(mentions(readPointTable(path, "stdin.csv").assumption, "stdin.csv: "));
}

TEST_F(QueryTables, AnglesTurnAboutXThenYThenZ)
{
    const Vec3d angles(0.3, -1.1, 2.5);
    const auto axis = [&](int a) {
        Vec3d unit(0.0);
        unit[a] = 1;
        return RigidTransform::fromRotation(unit, angles[a]);
    };
    const RigidTransform one(rotationOfAngles(angles), Vec3d(0.0));
    const Vec3d p(0.2, -3, 0.7);
    expectNear(one * p, axis(2) * (axis(1) * (axis(0) * p)));
}

TEST_F(QueryTables, PointsAndRaysAreRead)
{
    const auto points = readPointTable(save("z y x\n3 2 1\n"));
    ASSERT_EQ(points.rows.size(), 1u);
    EXPECT_EQ(points.rows[0], Vec3d(1, 2, 3));
    const auto rays = readRayTable(save("x,y,z,dx,dy,dz,tfar,tnear\n1,2,3,0,0,-2,9,0.5\n"));
    ASSERT_EQ(rays.rows.size(), 1u);
    EXPECT_EQ(rays.rows[0].origin, Vec3d(1, 2, 3));
    EXPECT_EQ(rays.rows[0].direction, Vec3d(0, 0, -2));
    EXPECT_EQ(rays.rows[0].tNear, 0.5);
    EXPECT_EQ(rays.rows[0].tFar, 9);
    EXPECT_TRUE(std::isinf(readRayTable(save("1 2 3 0 0 1")).rows[0].tFar));
}

TEST_F(QueryTables, AShortOrWrongLineIsNamed)
{
    EXPECT_TRUE(mentions(noPoses("x,y,z\n1,2,3\n1,2\n"), "line 3: it has 2 columns"));
    EXPECT_TRUE(mentions(noPoses("x,y,z\n1,2,3\n1,2,ab\n"), "line 3: 'ab' is no number"));
    EXPECT_TRUE(mentions(noPoses("x,y,z\n1,nan,3\n"), "line 2: 'nan' is not finite"));
    EXPECT_TRUE(mentions(noPoses("x,y,z\n1,inf,3\n"), "is not finite"));
    EXPECT_TRUE(mentions(noPoses("x,y\n1,2\n"), "no column 'z'"));
    EXPECT_TRUE(mentions(noPoses("x,y,z,x\n1,2,3,4\n"), "more than one column 'x'"));
    EXPECT_TRUE(mentions(noPoses("x,y,z,qx,qy,qz\n1,2,3,0,0,0\n"), "no column 'qw'"));
    EXPECT_TRUE(mentions(noPoses("1,2,3,4,5\n"), "and this one has 5"));
    EXPECT_TRUE(mentions(noPoses("0 0 0 1 0 0 0 0 0\n"), "and this one has 9"));
    EXPECT_TRUE(mentions(noPoses("x,y,z,qx,qy,qz,qw,roll,pitch,yaw\n1,2,3,0,0,0,1,0,0,0\n"),
        "names two rotations, by qx, qy, qz, qw and by roll, pitch, yaw"));
    EXPECT_TRUE(mentions(noPoses("x,y,z,yaw\n1,2,3,0\n"), "no column 'roll'"));
    EXPECT_TRUE(mentions(noPoses("# nothing\n"), "the file holds no poses"));
    EXPECT_TRUE(mentions(noPoses("x,y,z\n"), "the file holds no poses"));
    EXPECT_TRUE(mentions(noPoses(""), "the file is empty"));
    EXPECT_TRUE(mentions(whyNot(readPointTable, "1 2\n"), "has 3 columns, x, y, z"));
    EXPECT_TRUE(mentions(whyNot(readRayTable, "1 2 3\n"), "has 6 columns"));
    EXPECT_TRUE(mentions(whyNot(readRayTable, "1 2 3 0 0 0\n"), "line 1: the ray's direction"));
    EXPECT_TRUE(mentions(whyNot(readRayTable, "x y z dx dy dz tnear\n1 2 3 1 0 0 0"), "'tfar'"));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::IoError>([] { readPoseTable("/nowhere/x.csv"); }), "no such file"));
}

TEST_F(QueryTables, ADamagedFirstLineIsNotTakenForAHeader)
{
    const auto why = [this](const std::string& text) { return whyNot(readPointTable, text); };
    EXPECT_TRUE(mentions(why("1e999,0,0\n"), "line 1: '1e999' is beyond the range"));
    EXPECT_TRUE(mentions(why("1,,0\n1,2,3\n"), "line 1: column 2 is empty"));
    EXPECT_TRUE(mentions(why("0x1p3 0 0\n"), "line 1: '0x1p3' is no number"));
    EXPECT_TRUE(mentions(why("x,y,z\n1,,0\n"), "line 2: column 2 is empty"));
    EXPECT_TRUE(mentions(why(std::string("\xff\xfe") + "1\0,\0"), "UTF-16"));
    EXPECT_TRUE(mentions(whyNot(readRayTable, "0,0,0,1,,0\n"), "line 1: column 5 is empty"));
    EXPECT_TRUE(mentions(noPoses("0,0,1e-999\n"), "line 1: '1e-999' is beyond the range"));
}

TEST_F(QueryTables, APlaceBesideAMatrixIsRefused)
{
    const std::string matrix = "m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23";
    const std::string row = "1,0,0,5,0,1,0,6,0,0,1,7";
    EXPECT_EQ(poses(matrix + "\n" + row).rows.size(), 1u);
    EXPECT_TRUE(mentions(noPoses("x,y,z," + matrix + "\n1,2,3," + row),
        "line 1: the header names two places, by x, y, z and by m03, m13, m23"));
    EXPECT_TRUE(mentions(noPoses(matrix + ",Y\n" + row + ",1"), "leave one of them out"));
}

TEST_F(QueryTables, AMatrixThatIsNotRigidIsRefusedAtItsLine)
{
    EXPECT_TRUE(mentions(noPoses("1 0 0 0 0 1 0 0 0 0 1 0\n2 0 0 0 0 2 0 0 0 0 2 0\n"),
        "line 2: the transform is not rigid"));
    EXPECT_TRUE(mentions(noPoses("-1 0 0 0 0 1 0 0 0 0 1 0\n"), "mirrors"));
    EXPECT_TRUE(mentions(noPoses("1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\n"), "line 1"));
    EXPECT_TRUE(mentions(noPoses("0 0 0 0 0 0 0\n"), "line 1: the quaternion"));
    EXPECT_TRUE(mentions(noPoses("0 0 0 0 0 0 1.02\n"), "has length 1.02"));
    EXPECT_EQ(poses("0 0 0 0 0 0 1.009").rows.size(), 1u);
}

TEST_F(QueryTables, EveryPartOfATableIsReadOrRefused)
{
    const std::string all = "x,y,z,qx,qy,qz,qw\n1,2,3,0,0,0,1\n4,5,6,0,1,0,0\n";
    for (std::size_t size = 0; size < all.size(); ++size) {
        try {
            EXPECT_LE(poses(all.substr(0, size)).rows.size(), 2u);
        } catch (const openvdb::IoError& error) {
            EXPECT_TRUE(mentions(error.what(), "table.csv"));
        }
    }
}

} // namespace
