// SPDX-License-Identifier: Apache-2.0
// What the actions do, and how they pass things on.

#include "CommandRunner.h"
#include "support/SampleTrees.h"

#include <openvdb_spheretree/input/spheres/SphereFile.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <openvdb/tools/LevelSetUtil.h>

#include <regex>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;

class CommandWork : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
        writeGrids("ball.vdb", {sphereGrid("ball", 8)});
    }

    /// The values of a key in a JSON text, in order.
    static std::vector<std::string> valuesOf(const std::string& json, const std::string& key)
    {
        const std::regex pattern("\"" + key + "\": ([^,\n]*)");
        std::vector<std::string> values;
        for (std::sregex_iterator i(json.begin(), json.end(), pattern), end; i != end; ++i) {
            values.push_back((*i)[1]);
        }
        return values;
    }
};

TEST_F(CommandWork, StatsAsJsonHasAllThatIsPromised)
{
    const Result result = run("-read a.vol -spheretree tree=extended factor=3 -stats json=-");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const std::string& json = result.out;
    EXPECT_EQ(json.front(), '{');
    EXPECT_EQ(valuesOf(json, "format"), std::vector<std::string>{"\"vdb_spheretree.stats.1\""});
    EXPECT_EQ(valuesOf(json, "voxels"), std::vector<std::string>{std::to_string(kBlockVoxels)});
    EXPECT_EQ(valuesOf(json, "factor"), std::vector<std::string>{"3"});
    auto spheres = valuesOf(json, "spheres");
    ASSERT_GE(spheres.size(), 3u);
    EXPECT_EQ(spheres.front(), "[]") << "the setting";
    spheres.erase(spheres.begin());
    EXPECT_EQ(spheres.back(), "1") << "it ends at one sphere";
    EXPECT_EQ(valuesOf(json, "level").front(), "0");
    EXPECT_EQ(valuesOf(json, "excess").front(), "0") << "level 0 is the object";
    for (const std::string& missing : valuesOf(json, "missing")) EXPECT_EQ(missing, "0");
    for (const std::string& parts : valuesOf(json, "components")) EXPECT_EQ(parts, "1");
    EXPECT_EQ(valuesOf(json, "tunnels"), std::vector<std::string>(spheres.size(), "0"));
    EXPECT_EQ(valuesOf(json, "cavities"), std::vector<std::string>(spheres.size(), "0"));
    for (const char* key : {"name", "leaves", "tiles", "bbox_min", "bbox_max", "voxel_size",
             "origin", "tree", "dim", "dist", "parent", "final_fit", "reconstruct", "scale",
             "padding", "dag", "edges", "pyramid_voxels", "radius_min", "radius_max", "covered",
             "hamming_percent", "hausdorff", "read", "mask", "pyramid", "distance", "power",
             "medial", "topology", "error", "write", "total", "peak_bytes"}) {
        EXPECT_NE(json.find("\"" + std::string(key) + "\": "), std::string::npos) << key;
    }
}

TEST_F(CommandWork, StatsAsJsonGoesToAFileToo)
{
    ASSERT_EQ(run("-read a.vol -spheretree -stats json=s.json").exitCode, 0);
    EXPECT_EQ(readText(path("s.json")).front(), '{');
    EXPECT_EQ(run("-read a.vol -spheretree -stats t.json").exitCode, 0);
    EXPECT_TRUE(exists("t.json"));
}

TEST_F(CommandWork, StatsAsATableHasALineALevel)
{
    const Result result = run("-read a.vol -spheretree -stats");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("object 'a'"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("hausdorff"), std::string::npos);
    EXPECT_NE(result.out.find("seconds:"), std::string::npos);
}

TEST_F(CommandWork, ErrorsThatWereNotComputedAreNullWithAReason)
{
    ASSERT_EQ(run("-read a.vol -spheretree errors=0 -write t.vdb").exitCode, 0);
    const Result result = run("-read t.vdb -stats json=-");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(valuesOf(result.out, "excess").front(), "null");
    EXPECT_EQ(valuesOf(result.out, "error_unknown").front(), "\"not computed\"");
    const Result table = run("-read t.vdb -stats");
    EXPECT_NE(table.out.find(" -  "), std::string::npos) << table.out;
}

TEST_F(CommandWork, TopologyThatWasNotCountedIsNullOrADash)
{
    ASSERT_EQ(run("-read a.vol -spheretree topology=0 -write t.vdb").exitCode, 0);
    const std::string json = run("-read t.vdb -stats json=-").out;
    EXPECT_EQ(valuesOf(json, "topology").at(1), "null") << json; // after that of the settings
    EXPECT_EQ(json.find("components"), std::string::npos) << json;
    EXPECT_NE(run("-read t.vdb -stats").out.find("topology=0"), std::string::npos);
    EXPECT_EQ(run("-read a.vol -spheretree -stats").out.find("topology=0"), std::string::npos);
}

TEST_F(CommandWork, StatsComputesMissingErrorsWhileTheObjectIsKnown)
{
    const Result result = run("-read a.vol -spheretree errors=0 -stats json=-");
    EXPECT_EQ(valuesOf(result.out, "excess").front(), "0");
}

TEST_F(CommandWork, AStoredTreeIsTheTreeThatWasBuilt)
{
    ASSERT_EQ(
        run("-read ball.vdb -spheretree tree=extended dag=1 name=b -write t.vdb t.csv").exitCode,
        0);
    EXPECT_EQ(readGrids("t.vdb").size(), 2u) << "the tree, and the edges of its DAG";
    ASSERT_EQ(run("-read t.vdb -write u.vdb u.csv").exitCode, 0);
    EXPECT_EQ(readText(path("t.csv")), readText(path("u.csv")));
    EXPECT_EQ(readText(path("t.vdb")), readText(path("u.vdb")));
    ASSERT_EQ(run("-read t.vdb grids=b -write v.vdb").exitCode, 0);
    EXPECT_EQ(readText(path("t.vdb")), readText(path("v.vdb"))) << "a tree brings its edges";
    EXPECT_EQ(
        readText(path("t.csv")).rfind("level,id,parent,x,y,z,radius,i,j,k,radius_sq,scale,", 0),
        0u);
}

TEST_F(CommandWork, CheckPassesWhatIsRightAndFailsWhatIsWrong)
{
    ASSERT_EQ(run("-read a.vol -spheretree -check -write t.vdb").exitCode, 0);
    EXPECT_EQ(run("-read a.vol -read t.vdb -check").exitCode, 0);
    EXPECT_EQ(run("-read a.vol -read t.vdb -check vdb=1").exitCode, 0);
    EXPECT_EQ(run("-read t.vdb -read a.vol -check a").exitCode, 0);
    const Result wrong = run("-read ball.vdb -read t.vdb -check -write u.vdb");
    EXPECT_EQ(wrong.exitCode, 6) << wrong.err;
    EXPECT_NE(wrong.out, "") << "what failed is a result";
    EXPECT_NE(wrong.err.find("-check"), std::string::npos);
    EXPECT_FALSE(exists("u.vdb"));
    EXPECT_EQ(run("-read t.vdb -check").exitCode, 3) << "there is no object";
}

TEST_F(CommandWork, LevelZeroAsAMaskIsTheObject)
{
    ASSERT_EQ(run("-read ball.vdb -mask name=o -write o.vdb").exitCode, 0);
    ASSERT_EQ(
        run("-read ball.vdb -spheretree -spheres2mask level=0 name=o -write m.vdb").exitCode, 0);
    const auto object = openvdb::gridPtrCast<openvdb::BoolGrid>(readGrids("o.vdb").at(0));
    const auto mask = openvdb::gridPtrCast<openvdb::BoolGrid>(readGrids("m.vdb").at(0));
    ASSERT_TRUE(object && mask);
    EXPECT_EQ(object->activeVoxelCount(), mask->activeVoxelCount());
    object->tree().topologyDifference(mask->tree());
    EXPECT_EQ(object->activeVoxelCount(), 0u);
    EXPECT_EQ(object->transform(), mask->transform());
}

TEST_F(CommandWork, SpheresAsALevelSetHoldTheObject)
{
    ASSERT_EQ(run("-read ball.vdb -spheretree -spheres2ls 0 -write s.vdb").exitCode, 0);
    const auto surface = openvdb::gridPtrCast<openvdb::FloatGrid>(readGrids("s.vdb").at(0));
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->getGridClass(), openvdb::GRID_LEVEL_SET);
    const auto inside = openvdb::tools::sdfInteriorMask(*surface);
    auto object = openvdb::tools::sdfInteriorMask(*sphereGrid("ball", 8));
    const auto voxels = object->activeVoxelCount();
    EXPECT_LT(inside->activeVoxelCount(), voxels * 2);
    object->tree().topologyDifference(inside->tree());
    EXPECT_EQ(object->activeVoxelCount(), 0u);
    ASSERT_EQ(run("-read ball.vdb -spheretree -spheres2ls 0 voxel=0.25 -write f.vdb").exitCode, 0);
    EXPECT_EQ(readGrids("f.vdb").at(0)->voxelSize()[0], 0.25);
}

TEST_F(CommandWork, AnObjectIsGeneratedAsIfItHadBeenRead)
{
    const Result result =
        run("-generate shape=menger voxels=8e3 voxel=0.5 -generate noise voxels=1000 seed=4 "
            "name=dust -write two.vdb");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto grids = readGrids("two.vdb"); // by their names
    ASSERT_EQ(grids.size(), 2u);
    EXPECT_EQ(grids[0]->getName(), "dust");
    EXPECT_NEAR(double(grids[0]->activeVoxelCount()), 1000, 100);
    EXPECT_EQ(grids[1]->getName(), "menger");
    EXPECT_EQ(grids[1]->activeVoxelCount(), 8000u);
    EXPECT_EQ(grids[1]->voxelSize(), openvdb::Vec3d(0.5));

    const Result tree = run("-generate ball voxels=5000 -spheretree -stats -write tree.vdb");
    ASSERT_EQ(tree.exitCode, 0) << tree.err;
    EXPECT_EQ(run("-generate ball voxels=5000 -read tree.vdb -check").exitCode, 0);
}

TEST_F(CommandWork, OneLevelIsKeptByNumberOrBySpheres)
{
    const Result json = run("-read ball.vdb -spheretree reversible -stats json=-");
    auto spheres = valuesOf(json.out, "spheres");
    ASSERT_GE(spheres.size(), 4u);
    spheres.erase(spheres.begin()); // the setting
    ASSERT_EQ(run("-read ball.vdb -spheretree reversible -level 1 -write a.csv").exitCode, 0);
    ASSERT_EQ(
        run("-read ball.vdb -spheretree reversible -level spheres=" + spheres[1] + " -write b.csv")
            .exitCode,
        0);
    const std::string csv = readText(path("a.csv"));
    EXPECT_EQ(csv, readText(path("b.csv")));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + std::stoi(spheres[1]));
    EXPECT_EQ(run("-read ball.vdb -spheretree extended -level 1 -write l.vdb").exitCode, 0);
    EXPECT_EQ(run("-read l.vdb -spheres2mask -write m.vdb").exitCode, 0);
}

TEST_F(CommandWork, InputsAreConsumedUnlessKept)
{
    const Result consumed = run("-read ball.vdb -spheretree -print");
    EXPECT_EQ(consumed.out.find("'ball'"), std::string::npos) << consumed.out;
    const Result kept = run("-read ball.vdb -spheretree keep=1 -print");
    EXPECT_NE(kept.out.find("vdb 1: grid 'ball'"), std::string::npos) << kept.out;
}

TEST_F(CommandWork, WhatIsWrittenLeavesWhenTheNextThingArrives)
{
    ASSERT_EQ(run("-read a.vol -spheretree name=one -write one.vdb -stats -write one.csv"
                  " -read ball.vdb -spheretree name=two -write two.vdb")
                  .exitCode,
        0);
    EXPECT_TRUE(exists("one.csv"));
    EXPECT_EQ(readGrids("two.vdb").size(), 1u);
    ASSERT_EQ(run("-read a.vol -spheretree name=one -write one.vdb keep=1"
                  " -read ball.vdb -spheretree name=two -write two.vdb")
                  .exitCode,
        0);
    EXPECT_EQ(readGrids("two.vdb").size(), 2u);
}

TEST_F(CommandWork, WhatIsWrittenLastIsTheSameAsWhatIsStillNeeded)
{
    const std::string tree = "-read ball.vdb -spheretree tree=extended dag=1";
    ASSERT_EQ(run(tree + " -write last.vdb").exitCode, 0);
    ASSERT_EQ(run(tree + " -write needed.vdb -stats").exitCode, 0);
    ASSERT_EQ(run(tree + " -write beside.vdb beside.csv").exitCode, 0);
    using command_test::readText;
    EXPECT_EQ(readText(path("last.vdb")), readText(path("needed.vdb")));
    EXPECT_EQ(readText(path("last.vdb")), readText(path("beside.vdb")));
    EXPECT_GT(readText(path("beside.csv")).size(), 200u);
    EXPECT_EQ(run("-read ball.vdb last.vdb -check").exitCode, 0);
}

TEST_F(CommandWork, TwoTreesOfOneNameAreNotWrittenToOneFile)
{
    const Result result = run("-read a.vol -spheretree -read ball.vdb -spheretree -write t.vdb");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_NE(result.err.find("'spheretree'"), std::string::npos);
    EXPECT_FALSE(exists("t.vdb"));
}

TEST_F(CommandWork, ClearEmptiesTheStack)
{
    const Result result = run("-read a.vol ball.vdb -clear -print");
    EXPECT_EQ(result.out, "the stack is empty\n");
}

TEST_F(CommandWork, MaskSettingsChooseTheObject)
{
    std::string values;
    for (int i = 0; i < 27; ++i) values += char(i);
    writeVol("grey.vol", {3, 3, 3}, values);
    for (const auto& [threshold, voxels] : {std::pair(0, 26), std::pair(20, 6)}) {
        const Result result = run("-read grey.vol -mask threshold=" + std::to_string(threshold)
            + " -spheretree -stats json=-");
        EXPECT_EQ(valuesOf(result.out, "voxels"), std::vector<std::string>{std::to_string(voxels)});
    }
}

TEST_F(CommandWork, AGridReadFromAFileIsWrittenBack)
{
    ASSERT_EQ(run("-read ball.vdb -write b.vdb").exitCode, 0);
    const auto ball = openvdb::gridPtrCast<openvdb::FloatGrid>(readGrids("b.vdb").at(0));
    ASSERT_TRUE(ball);
    EXPECT_EQ(ball->activeVoxelCount(), sphereGrid("ball", 8)->activeVoxelCount());
    EXPECT_EQ(ball->getName(), "ball");
}

TEST_F(CommandWork, AGridWhoseValuesStayInTheFileBecomesTheSameTreeAndIsWrittenBackTheSame)
{
    writeGrids("two.vdb", {sphereGrid("second", 7), sphereGrid("first")});
    for (const char* delayed : {"0", "1"}) {
        const std::string in = std::string("-read two.vdb delayed=") + delayed;
        const std::string out = std::string(" -write ") + delayed;
        EXPECT_EQ(run(in + out + "-grids.vdb").exitCode, 0);
        EXPECT_EQ(run(in + " -spheretree vdb=first" + out + "-tree.vdb").exitCode, 0);
    }
    using command_test::readText;
    EXPECT_EQ(readText(path("0-grids.vdb")), readText(path("1-grids.vdb")));
    EXPECT_EQ(readText(path("0-tree.vdb")), readText(path("1-tree.vdb")));
}

TEST_F(CommandWork, AFileThatDoesNotSayWhereItsGridsAreIsReadWhole)
{
    writeGrids("whole.vdb", {sphereGrid("ball")});
    EXPECT_EQ(shell("$VDB_SPHERETREE -read whole.vdb -write stdout.vdb > piped.vdb").exitCode, 0);
    const Result result = run("-read piped.vdb delayed=1 -spheretree -write tree.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
}

TEST_F(CommandWork, AFileWrittenOnTheLineCanBeReadOnIt)
{
    EXPECT_EQ(run("-read a.vol -spheretree -write t.vdb -clear -read t.vdb -stats").exitCode, 0);
}

TEST_F(CommandWork, AStrangeGridNameDoesNotBreakJson)
{
    writeGrids("odd.vdb", {sphereGrid("a\"b\\c\n\xff", 3)});
    const Result result = run("-read odd.vdb -spheretree -stats json=-");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("\"a\\\"b\\\\c\\u000a\\ufffd\""), std::string::npos) << result.out;
}

TEST_F(CommandWork, FileNamesMayHoldCommasAndEqualsSigns)
{
    for (const std::string name : {"a,b.vol", "c=d.vol", "e,f=g.vol"}) {
        writeBlock(name);
        EXPECT_EQ(runWords({"-read", name, "-spheretree", "-write", "t.vdb"}).exitCode, 0) << name;
    }
    EXPECT_EQ(runWords({"-read", "a.vol,a,b.vol", "-print"}).exitCode, 3) << "no such files";
    EXPECT_EQ(runWords({"-read", "files=a.vol,c=d.vol", "-print"}).exitCode, 0);
}

TEST_F(CommandWork, AnOpenMeshIsWarnedOf)
{
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    command_test::writeText(path("open.obj"), points + "f 1 3 2\nf 1 2 4\nf 2 3 4\n");
    command_test::writeText(path("closed.obj"), points + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    EXPECT_NE(
        run("-read open.obj -mesh2ls dim=20").err.find("not closed: 3 edges"), std::string::npos);
    EXPECT_EQ(run("-read closed.obj -mesh2ls dim=20").err.find("warning"), std::string::npos);
    EXPECT_NE(
        run("-quiet -read open.obj -mesh2ls dim=20").err.find("not closed"), std::string::npos);
    EXPECT_EQ(run("-quiet -read closed.obj -mesh2ls dim=20").err, "");
}

TEST_F(CommandWork, AReaderThatHasSeenEnoughLosesNoTree)
{
    // The pipe is closed before anything is printed.
    const Result result =
        shell("{ \"$VDB_SPHERETREE\" -quiet -read a.vol -spheretree -stats -write t.vdb; "
              "echo $? > code; } | true; cat code");
    EXPECT_EQ(result.out, "0\n") << result.err;
    EXPECT_TRUE(exists("t.vdb"));
}

TEST_F(CommandWork, APointGridNamedLikeEdgesIsReadAsPoints)
{
    ASSERT_EQ(run("-read a.vol -spheretree tree=extended dag=1 name=a -write t.vdb").exitCode, 0);
    auto grids = readGrids("t.vdb");
    ASSERT_EQ(grids.size(), 2u);
    for (auto& grid : grids) {
        if (grid->getName() == "a_dag") grid->removeMeta("spheretree_dag_format");
    }
    writeGrids("u.vdb", grids);
    const Result result = run("-read u.vdb -print");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("'a_dag'"), std::string::npos) << result.out;
}

TEST_F(CommandWork, EdgesWithADamagedFormatAreNoPoints)
{
    ASSERT_EQ(run("-read a.vol -spheretree tree=extended dag=1 name=a -write t.vdb").exitCode, 0);
    auto grids = readGrids("t.vdb");
    for (auto& grid : grids) {
        if (grid->getName() != "a_dag") continue;
        grid->insertMeta("spheretree_dag_formap", *(*grid)["spheretree_dag_format"]);
        grid->removeMeta("spheretree_dag_format");
    }
    writeGrids("u.vdb", grids);
    const Result result = run("-read u.vdb -print");
    EXPECT_EQ(result.exitCode, 3) << result.out;
    EXPECT_NE(result.err.find("'a_dag' is a damaged sphere-tree"), std::string::npos) << result.err;
}

TEST_F(CommandWork, ATightTreeKeepsItsCutsFromFileToFile)
{
    const auto tree = spheretree_test::tightSampleTree();
    writeGrids(
        "t.vdb", {openvdb_spheretree::toPoints(tree), openvdb_spheretree::cutsToPoints(tree)});
    const Result copied = run("-read t.vdb -print -write u.vdb u.json");
    EXPECT_EQ(copied.exitCode, 0) << copied.err;
    EXPECT_EQ(copied.out.find("tight tree_cuts"), std::string::npos) << "part of the tree";
    const auto grids = readGrids("u.vdb");
    ASSERT_EQ(grids.size(), 2u);
    using openvdb::points::PointDataGrid;
    const auto points = openvdb::gridPtrCast<PointDataGrid>(grids[0]);
    const auto cuts = openvdb::gridPtrCast<PointDataGrid>(grids[1]);
    spheretree_test::expectSameTree(
        openvdb_spheretree::fromPoints(*points, nullptr, cuts.get()), tree);
    EXPECT_NE(readText(path("u.json")).find("\"cuts\": {"), std::string::npos);
    EXPECT_EQ(run("-read t.vdb -write u.csv").exitCode, 0);
    EXPECT_NE(readText(path("u.csv")).find(",-1,11,-1000,-1,1,0,0,0\n"), std::string::npos);
}

TEST_F(CommandWork, AFlatTreeAsAMaskIsTheObject)
{
    writeVol("flat.vol", {20, 20, 1}, std::string(400, '\1'));
    ASSERT_EQ(run("-read flat.vol -spheretree dim=2 -spheres2mask -write m.vdb").exitCode, 0);
    EXPECT_EQ(readGrids("m.vdb").at(0)->activeVoxelCount(), 400u);
}

TEST_F(CommandWork, AChamferDistanceOfThePlaneHasTwoCosts)
{
    std::string disc;
    for (int y = -12; y <= 12; ++y) {
        for (int x = -12; x <= 12; ++x) disc += char(x * x + y * y <= 140);
    }
    writeVol("flat.vol", {25, 25, 1}, disc);
    for (const char* tree : {"reversible", "extended"}) {
        const std::string line =
            std::string("-read flat.vol -spheretree ") + tree + " dim=2 keep=1 dist=chamfer:3,4";
        const Result flat = run(line + " -check -write t.csv u.vdb vdb=0");
        EXPECT_EQ(flat.exitCode, 0) << flat.err;
        EXPECT_EQ(run("-read flat.vol u.vdb -check").exitCode, 0);
        EXPECT_EQ(run(line + ",5 -check -write s.csv").exitCode, 0);
        const auto plane = openvdb_spheretree::readSphereFile(path("t.csv"));
        const auto space = openvdb_spheretree::readSphereFile(path("s.csv"));
        EXPECT_EQ(plane.center, space.center) << "in the plane, the corner is not used";
        double smaller = 0;
        for (std::size_t i = 0; i < plane.size(); ++i) {
            EXPECT_LE(plane.radius[i], space.radius[i]);
            smaller = std::max(smaller, space.radius[i] - plane.radius[i]);
        }
        EXPECT_NEAR(smaller, 1.0 / 3, 1e-6) << "5 is the cost of no path in it";
    }
    const Result solid = run("-read a.vol -spheretree reversible dist=chamfer:3,4 -write t.vdb");
    EXPECT_EQ(solid.exitCode, 2);
    EXPECT_NE(solid.err.find("is for a plane (dim=2)"), std::string::npos) << solid.err;
}

TEST_F(CommandWork, TheEdgesOfMeetingSpheresAreStoredAndChecked)
{
    ASSERT_EQ(
        run("-read a.vol -spheretree tree=extended dag=1 edges=intersecting -write t.vdb").exitCode,
        0);
    EXPECT_EQ(run("-read a.vol t.vdb -check").exitCode, 0);
}

} // namespace
