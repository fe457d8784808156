// SPDX-License-Identifier: Apache-2.0
// Spheres of other tools: read from tables, JSON and points, held against an object, drawn, written.

#include "CommandRunner.h"

#include "support/PointGrids.h"

#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;

/// Two spheres that cover some of the block: centers are no multiples of 1/16 voxel.
constexpr char kSome[] = "name;z;x;y;r\na;2.01;2.3;2.7;2.9\nb;1.99;5.55;3.1;1.7\n";

class CommandSpheres : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
        writeText(path("some.csv"), kSome);
    }

    nlohmann::json statsOf(const std::string& actions)
    {
        const Result result = run("-quiet " + actions + " -stats json=numbers.json");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return nlohmann::json::parse(readText(path("numbers.json")));
    }

    /// Voxels of the block that lie in the two spheres, and all that do.
    std::pair<int, int> countedByHand()
    {
        EXPECT_EQ(run("-read a.vol -mask -write m.vdb").exitCode, 0);
        const auto mask = openvdb::gridPtrCast<openvdb::BoolGrid>(readGrids("m.vdb").at(0));
        int inBlock = 0, all = 0;
        for (auto q = openvdb::CoordBBox::createCube(openvdb::Coord(-20), 50).begin(); q; ++q) {
            const openvdb::Vec3d p = (*q).asVec3d();
            const bool held = (p - openvdb::Vec3d(2.3, 2.7, 2.01)).length() <= 2.9
                || (p - openvdb::Vec3d(5.55, 3.1, 1.99)).length() <= 1.7;
            all += held;
            inBlock += held && mask->tree().isValueOn(*q);
        }
        return {inBlock, all};
    }
};

TEST_F(CommandSpheres, OtherUnitsAreWarnedOf)
{
    writeText(path("mm.csv"), "x,y,z,r\n2000,2000,2000,6000\n");
    const auto told = [&](const std::string& line) {
        return run("-quiet " + line + " -check").err;
    };
    EXPECT_NE(told("-read a.vol mm.csv").find("in the same unit"), std::string::npos);
    EXPECT_EQ(
        told("-read a.vol -read mm.csv scale=0.001").find("in the same unit"), std::string::npos);
}

TEST_F(CommandSpheres, TheirErrorsAreThoseCountedByHand)
{
    const auto [inBlock, all] = countedByHand();
    for (const char* line : {"-read a.vol some.csv", "-read some.csv -read a.vol"}) {
        const nlohmann::json stats = statsOf(line);
        EXPECT_EQ(stats["object"]["voxels"], kBlockVoxels);
        const nlohmann::json& level = stats["levels"].at(0);
        EXPECT_EQ(level["spheres"], 2);
        EXPECT_EQ(level["covered"], all);
        EXPECT_EQ(level["excess"], all - inBlock);
        EXPECT_EQ(level["missing"], kBlockVoxels - inBlock);
    }
    const nlohmann::json alone = statsOf("-read some.csv");
    EXPECT_TRUE(alone["levels"].at(0)["covered"].is_null());
    const Result table = run("-read some.csv -stats");
    EXPECT_NE(table.out.find("no object"), std::string::npos) << table.out;
}

TEST_F(CommandSpheres, CheckSaysHowManyVoxelsTheyMiss)
{
    const int missed = kBlockVoxels - countedByHand().first;
    const Result some = run("-read a.vol some.csv -check");
    EXPECT_EQ(some.exitCode, 6);
    EXPECT_NE(some.err.find(std::to_string(missed) + " voxels"), std::string::npos) << some.err;
    writeText(path("all.csv"), "4 3 2.5 5.7\n");
    const Result all = run("-read a.vol all.csv -check");
    EXPECT_EQ(all.exitCode, 0) << all.err;
    EXPECT_EQ(all.out, "the spheres cover the object\n");
    EXPECT_NE(all.err.find("note: all.csv: it has no header"), std::string::npos) << all.err;
    const Result none = run("-read all.csv -check");
    EXPECT_EQ(none.exitCode, 3);
}

TEST_F(CommandSpheres, OurOwnTablesAndJsonAreReadLevelByLevel)
{
    ASSERT_EQ(run("-read a.vol -spheretree tree=extended dag=1 -write t.csv t.json").exitCode, 0);
    for (const std::string file : {"t.csv", "t.json"}) {
        for (const std::string level : {"", " level=1"}) {
            const Result check = run("-read a.vol " + file + level + " -check");
            EXPECT_EQ(check.exitCode, 0) << file << level << check.err;
        }
        EXPECT_EQ(run("-read " + file + " level=99").exitCode, 3);
    }
    EXPECT_EQ(statsOf("-read a.vol t.csv")["levels"], statsOf("-read a.vol t.json")["levels"]);
}

TEST_F(CommandSpheres, AreDrawnAndWrittenAndReadBack)
{
    const Result made = run("-read a.vol some.csv -stats -write s.vdb s.csv s.json vdb=some");
    ASSERT_EQ(made.exitCode, 0) << made.err;
    const auto before = statsOf("-read a.vol some.csv")["levels"];
    for (const char* file : {"s.vdb", "s.csv", "s.json"}) {
        EXPECT_EQ(statsOf("-read a.vol " + std::string(file))["levels"].at(0)["missing"],
            before.at(0)["missing"]);
    }
    EXPECT_EQ(run("-read a.vol s.vdb -check").exitCode, 6);
    EXPECT_EQ(run("-read some.csv -write p.png width=40 height=30").exitCode, 0);
    EXPECT_EQ(run("-read some.csv -spheres2ls -write l.vdb").exitCode, 0);
    ASSERT_EQ(run("-read a.vol some.csv -spheres2mask -write v.vdb").exitCode, 0);
    EXPECT_EQ(int(readGrids("v.vdb").back()->activeVoxelCount()), countedByHand().second);
}

TEST_F(CommandSpheres, PointsAreSpheresWhereThatIsAskedFor)
{
    using namespace openvdb::points;
    const auto grid = spheretree_test::pointsAt({{4, 3, 2.5}, {1, 1, 1}}, /*voxelSize=*/0.5);
    grid->setName("dots");
    appendAttribute<float>(grid->tree(), "pscale", 5.7f);
    writeGrids("p.vdb", {grid});
    EXPECT_EQ(run("-read a.vol p.vdb spheres=1 -check").exitCode, 0);
    EXPECT_NE(run("-read p.vdb spheres=1 -print").out.find("spheres 'dots'"), std::string::npos);
    EXPECT_NE(run("-read p.vdb -print").out.find("grid 'dots'"), std::string::npos);
    dropAttribute(grid->tree(), "pscale");
    writeGrids("p.vdb", {grid});
    const Result none = run("-read p.vdb spheres=1");
    EXPECT_EQ(none.exitCode, 3);
    EXPECT_NE(none.err.find("'pscale'"), std::string::npos) << none.err;
}

TEST_F(CommandSpheres, AreTheLeavesOfATightTree)
{
    std::string table = "x,y,z,radius\n";
    for (int x = 0; x < 8; x += 2) {
        for (int y = 0; y < 6; y += 2) {
            table += std::to_string(x + 0.53) + "," + std::to_string(y + 0.47) + ",1.5,3.1\n";
        }
    }
    table += "40,40,40,2\n"; // holds no voxel
    writeText(path("cover.csv"), table);
    for (const char* options : {"", " quality=fast", " quality=best", " cover=balls", " cuts=1"}) {
        const std::string build =
            "-read a.vol cover.csv -spheretree leaves=given spheres=12,4,1 keep=1"
            + std::string(options);
        const Result result = run(build + " -check -write t.vdb vdb=0");
        EXPECT_EQ(result.exitCode, 0) << options << result.err;
        const nlohmann::json tree = statsOf("-read t.vdb");
        EXPECT_EQ(tree["settings"]["leaves"], "given") << options;
        EXPECT_EQ(tree["levels"].at(0)["spheres"], 12) << options;
        EXPECT_EQ(tree["levels"].back()["spheres"], 1) << options;
        EXPECT_EQ(run("-quiet -read a.vol t.vdb -check").exitCode, 0) << options;
    }
    const Result bare = run("-read a.vol some.csv -spheretree leaves=given -write u.vdb");
    EXPECT_EQ(bare.exitCode, 3);
    EXPECT_NE(bare.err.find("voxels of the object, such as"), std::string::npos) << bare.err;
    const Result none = run("-read a.vol -spheretree leaves=given -write u.vdb");
    EXPECT_EQ(none.exitCode, 3);
    EXPECT_NE(none.err.find("put -read spheres.csv before"), std::string::npos) << none.err;
    EXPECT_EQ(
        run("-read a.vol some.csv -spheretree extended leaves=given -write u.vdb").exitCode, 2);
    EXPECT_FALSE(exists("u.vdb"));
}

TEST_F(CommandSpheres, WhatIsWrongIsAnErrorOfTheInputOrOfTheLine)
{
    writeText(path("bad.csv"), "x,y,z,r\n1,2,3,-4\n");
    const Result bad = run("-read bad.csv");
    EXPECT_EQ(bad.exitCode, 3);
    EXPECT_NE(bad.err.find("bad.csv: line 2"), std::string::npos) << bad.err;
    writeText(path("far.csv"), "x,y,z,r\n1e9,2,3,4\n");
    const Result far = run("-read a.vol far.csv -stats");
    EXPECT_EQ(far.exitCode, 3);
    EXPECT_NE(far.err.find("too far away"), std::string::npos) << far.err;
    EXPECT_EQ(run("-read a.vol level=1").exitCode, 2);
    EXPECT_EQ(run("-read a.vol spheres=1").exitCode, 2);
    EXPECT_EQ(run("-read some.csv -spheretree").exitCode, 3);
    EXPECT_EQ(run("-read some.csv level=2").exitCode, 3);
}

} // namespace
