// SPDX-License-Identifier: Apache-2.0
// Standard input and output in the place of files, the tables of -stats, and what the command says
// before somebody waits for nothing.

#include "CommandRunner.h"

#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>

#include <map>
#include <sstream>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;

class CommandPipes : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
    }

    static bool says(const Result& result, const std::string& text)
    {
        return result.err.find(text) != std::string::npos;
    }
};

TEST_F(CommandPipes, StdoutIsWhatTheFileWouldBe)
{
    for (const std::string extension : {"csv", "json"}) {
        const std::string build = "-quiet -read a.vol -spheretree spheres=4 -write ";
        ASSERT_EQ(run(build + "t." + extension).exitCode, 0);
        const Result result = run(build + "stdout." + extension);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.out, readText(path("t." + extension)));
        EXPECT_FALSE(exists("stdout." + extension));
    }
    const Result picture = run("-quiet -read a.vol -write stdout.png width=40 height=30");
    EXPECT_EQ(picture.out.rfind("\x89PNG", 0), 0u);
}

TEST_F(CommandPipes, ALargeTableComesWholeAndItsReaderMayStop)
{
    const std::string build = "-quiet -generate noise voxels=3e4 -spheretree reversible errors=0 ";
    ASSERT_EQ(run(build + "-write t.csv").exitCode, 0);
    ASSERT_GT(readText(path("t.csv")).size(), size_t(3) << 20) << "more than the buffer";
    const Result whole = shell("$VDB_SPHERETREE " + build + "-write stdout.csv | cmp - t.csv");
    EXPECT_EQ(whole.exitCode, 0) << whole.err;
    const Result head = shell("{ $VDB_SPHERETREE " + build
        + "-write stdout.csv; echo $? > code; } | head -n 1; cat code");
    EXPECT_EQ(head.out,
        "level,id,parent,x,y,z,radius,i,j,k,radius_sq,scale,origin_i,origin_j,origin_k\n0\n")
        << head.err;
}

TEST_F(CommandPipes, TheTableOfStatsGoesToStderrThen)
{
    const Result result = run("-read a.vol -spheretree spheres=4 -stats -write stdout.csv");
    EXPECT_EQ(result.out.rfind("level,id,", 0), 0u);
    EXPECT_TRUE(says(result, "hamming %"));
}

TEST_F(CommandPipes, TheEdgesOfADagNeedAFile)
{
    const Result result = run("-read a.vol -spheretree extended dag=1 -write stdout.csv");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(says(result, "the edges of dag=1")) << result.err;
    EXPECT_FALSE(exists("stdout_dag.csv"));
}

TEST_F(CommandPipes, StdinIsReadAsItsExtensionSays)
{
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    writeText(path("a.obj"), points + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    writeText(path("a.off"),
        "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
    for (const std::string extension : {"vol", "obj", "off"}) {
        const Result file = run("-quiet -read a." + extension + " -print");
        const Result pipe = shell("cat a." + extension + " | $VDB_SPHERETREE -quiet -read stdin."
            + extension + " -print");
        EXPECT_EQ(pipe.exitCode, 0) << pipe.err;
        std::string expected = file.out;
        for (size_t at; (at = expected.find("'a'")) != expected.npos;) {
            expected.replace(at, 3, "'stdin'");
        }
        for (size_t at; (at = expected.find("from a.")) != expected.npos;) {
            expected.replace(at, 7, "from stdin.");
        }
        EXPECT_EQ(pipe.out, expected);
    }
    const auto before = files();
    EXPECT_EQ(before, (std::vector<std::string>{"a.obj", "a.off", "a.vol"}));
}

TEST_F(CommandPipes, AWholeMeshComesThroughInPieces)
{
    // More than any pipe holds at once.
    std::ostringstream mesh;
    for (int i = 0; i < 100000; ++i) mesh << "v " << i % 317 << ' ' << i / 317 << " 0\n";
    for (int i = 1; i + 318 < 100000; ++i)
        mesh << "f " << i << ' ' << i + 1 << ' ' << i + 317 << "\n";
    writeText(path("a.obj"), mesh.str());
    const Result file = run("-quiet -read a.obj -print");
    const Result pipe = shell("cat a.obj | $VDB_SPHERETREE -quiet -read stdin.obj -print");
    const auto numbers = [](const std::string& out) { return out.substr(out.find("), ")); };
    EXPECT_EQ(numbers(pipe.out), numbers(file.out)) << pipe.err;
}

TEST_F(CommandPipes, AnEmptyInputSaysThatNothingCame)
{
    for (const std::string extension : {"vdb", "vol", "longvol", "obj", "off", "ply", "stl"}) {
        const Result result =
            shell("true | $VDB_SPHERETREE -read stdin." + extension + " -mesh2ls -print");
        EXPECT_EQ(result.exitCode, 3) << extension;
        EXPECT_TRUE(says(result, "stdin." + extension + ": the input is empty")) << result.err;
    }
}

TEST_F(CommandPipes, DamageOfStdinIsNamedAsSuch)
{
    const Result mesh = shell("echo f 1 2 3 | $VDB_SPHERETREE -read stdin.obj -print");
    EXPECT_EQ(mesh.exitCode, 3);
    EXPECT_TRUE(says(mesh, "-read: stdin.obj: ")) << mesh.err;
    const Result volume = shell("head -c 120 a.vol | $VDB_SPHERETREE -read stdin.vol -print");
    EXPECT_EQ(volume.exitCode, 3);
    EXPECT_TRUE(says(volume, "-read: stdin.vol: ")) << volume.err;
    const Result noRoom =
        shell("cat a.vol | TMPDIR=/nowhere $VDB_SPHERETREE -read stdin.vol -print");
    EXPECT_EQ(noRoom.exitCode, 4);
    EXPECT_TRUE(says(noRoom, "/nowhere: No such file")) << noRoom.err;
}

TEST_F(CommandPipes, PicturesAndArraysAreNoMeshes)
{
    for (const std::string name : {"a.bin", "a.jpg", "a.tif", "a.mha", "a.gz", "a.npz"}) {
        writeText(path(name), std::string(1000, '\1'));
        const Result result = run("-read " + name + " -print");
        EXPECT_EQ(result.exitCode, 3) << name;
        EXPECT_TRUE(says(result, "pictures and arrays of this kind are not read")) << result.err;
    }
}

/// Lines of a CSV by the names of their columns.
std::vector<std::map<std::string, std::string>> table(const std::string& csv)
{
    const auto cellsOf = [](const std::string& line) {
        std::vector<std::string> cells(1);
        for (const char c : line) {
            if (c == ',') cells.emplace_back();
            else cells.back() += c;
        }
        return cells;
    };
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> names = cellsOf(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(in, line)) {
        const std::vector<std::string> cells = cellsOf(line);
        EXPECT_EQ(cells.size(), names.size()) << line;
        rows.emplace_back();
        for (size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = cells.at(i);
    }
    return rows;
}

TEST_F(CommandPipes, LevelsAsCsvHaveTheNamesAndNumbersOfTheJson)
{
    for (const char* kind : {"reversible", "side=inner spheres=8,2", "side=fit spheres=8,2",
             "spheres=8,2", "reversible topology=0"}) {
        SCOPED_TRACE(kind);
        const Result result =
            run(std::string("-read a.vol -spheretree ") + kind + " -stats lev.csv lev.json");
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.out, "") << "a file is in place of the table";
        const auto json = nlohmann::json::parse(readText(path("lev.json")));
        const auto rows = table(readText(path("lev.csv")));
        ASSERT_EQ(rows.size(), json["levels"].size());
        for (size_t i = 0; i < rows.size(); ++i) {
            auto expected = json["levels"][i];
            const auto topology = expected["topology"];
            for (const char* key : {"components", "tunnels", "cavities"}) {
                expected[key] = topology.is_null() ? topology : topology[key];
            }
            EXPECT_EQ(rows[i].count("covered_percent"), expected.count("covered_percent"));
            for (const auto& [name, cell] : rows[i]) {
                ASSERT_EQ(expected.count(name), 1u) << name;
                if (expected[name].is_null()) EXPECT_EQ(cell, "") << name;
                else EXPECT_EQ(std::stod(cell), expected[name].get<double>()) << name;
            }
        }
    }
}

TEST_F(CommandPipes, CellsOfErrorsThatWereNotCountedAreEmpty)
{
    for (const char* side : {"outer", "inner", "fit"}) {
        const std::string build = std::string("-read a.vol -spheretree errors=0 side=") + side;
        ASSERT_EQ(run(build + " spheres=4 -write t.vdb").exitCode, 0);
        ASSERT_EQ(run("-read t.vdb -stats lev.csv").exitCode, 0);
        for (auto row : table(readText(path("lev.csv")))) {
            EXPECT_EQ(row["spheres"], "4");
            EXPECT_NE(row["radius_max"], "");
            for (const char* name :
                {"covered", "missing", "hausdorff", "dice", "covered_percent"}) {
                EXPECT_EQ(row[name], "") << name;
            }
        }
    }
}

TEST_F(CommandPipes, TablesOfStatsGoWhereTheyAreSent)
{
    const std::string build = "-quiet -read a.vol -spheretree spheres=4 ";
    ASSERT_EQ(run(build + "-stats lev.csv").exitCode, 0);
    const std::string table = readText(path("lev.csv"));
    EXPECT_EQ(run(build + "-stats csv=-").out, table);
    EXPECT_EQ(run(build + "-stats stdout.csv").out, table);
    EXPECT_EQ(run(build + "-stats csv=all.txt").exitCode, 0);
    EXPECT_EQ(readText(path("all.txt")), table);
    const Result both = run(build + "-stats csv=both.csv json=-");
    EXPECT_EQ(both.out.rfind("{", 0), 0u);
    EXPECT_EQ(readText(path("both.csv")), table);
    EXPECT_EQ(run(build + "-stats lev").exitCode, 0);
    EXPECT_EQ(readText(path("lev")).rfind("{", 0), 0u) << "without an extension it is JSON";
}

TEST_F(CommandPipes, ATreeThatNobodyKeepsIsNotedBeforeTheWork)
{
    const Result lost = run("-read a.vol -spheretree");
    EXPECT_EQ(lost.exitCode, 0);
    const size_t note = lost.err.find("note: nothing of -spheretree will be kept");
    ASSERT_NE(note, std::string::npos) << lost.err;
    EXPECT_LT(note, lost.err.find("-spheretree ... completed"));
    EXPECT_TRUE(says(run("-read a.vol -print -spheretree -level 0"), "will be kept"));
    for (const char* kept :
        {"-stats", "-write t.vdb", "-check", "-print", "-level 0 -write t.csv"}) {
        EXPECT_FALSE(says(run(std::string("-read a.vol -spheretree ") + kept), "will be kept"))
            << kept;
    }
    EXPECT_EQ(run("-quiet -generate ball voxels=1e4 -spheretree reversible").err, "");
}

TEST_F(CommandPipes, WhatAFileGetsBesidesTheTreeIsNoted)
{
    writeGrids("two.vdb", {sphereGrid("body", 2), sphereGrid("head", 2)});
    const std::string build = "-read two.vdb -spheretree vdb=body spheres=4 -write ";
    EXPECT_TRUE(says(run(build + "t.vdb"), "t.vdb gets grid 'head'"));
    EXPECT_FALSE(says(run(build + "t.vdb vdb=sphere_tree"), "gets grid"));
    EXPECT_FALSE(says(run(build + "t.csv"), "gets grid"));
    EXPECT_FALSE(says(run("-read two.vdb -write u.vdb"), "gets grid"));
    EXPECT_TRUE(says(run(build + "two.vdb"), "warning: two.vdb, which was read, is replaced"));
    EXPECT_FALSE(says(run("-read two.vdb -spheretree vdb=0 -write t.vdb"), "is replaced"));
}

/// The next file that is opened would have the number of a closed one, and get what is meant for a person.
TEST_F(CommandPipes, ClosedStandardStreamsAreNoFiles)
{
    const std::string build = "$VDB_SPHERETREE -read a.vol -spheretree spheres=4 -write ";
    ASSERT_EQ(shell(build + "t.vdb c.csv").exitCode, 0);
    ASSERT_EQ(shell(build + "no_err.vdb no_err.csv 2>&-").exitCode, 0);
    EXPECT_EQ(readText(path("no_err.csv")), readText(path("c.csv")));
    EXPECT_EQ(run("-read a.vol no_err.vdb -check").exitCode, 0);
    const Result mute = shell("$VDB_SPHERETREE -read t.vdb -write out.vdb -stats >&-");
    EXPECT_EQ(mute.exitCode, 4);
    EXPECT_TRUE(says(mute, "cannot write to stdout")) << mute.err;
    EXPECT_EQ(run("-read a.vol out.vdb -check").exitCode, 0);
    for (const char* name : {"stdin.vdb", "stdin.stl"}) {
        const Result deaf = shell(std::string("$VDB_SPHERETREE -read ") + name + " <&-");
        EXPECT_EQ(deaf.exitCode, 3);
        EXPECT_TRUE(says(deaf, "standard input is closed")) << deaf.err;
    }
}

TEST_F(CommandPipes, TwoGridsOfOneNameAreChosenByAge)
{
    writeGrids("two.vdb", {sphereGrid("dup", 2), sphereGrid("dup", 3)});
    const Result byName = run("-read two.vdb -spheretree vdb=dup spheres=4 -stats");
    EXPECT_EQ(byName.exitCode, 3);
    EXPECT_TRUE(says(byName, "two are named 'dup': choose by age")) << byName.err;
    EXPECT_EQ(run("-read two.vdb -spheretree vdb=1 spheres=4 -stats").exitCode, 0);
}

TEST_F(CommandPipes, AGridThatBoundsNothingIsToldWhatWould)
{
    auto velocity = openvdb::Vec3SGrid::create();
    velocity->setName("vel");
    velocity->tree().setValue(openvdb::Coord(0), openvdb::Vec3s(1));
    writeGrids("smoke.vdb", {sphereGrid("density", 2), velocity});
    const Result result = run("-read smoke.vdb -spheretree vdb=vel -stats");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(says(result, "grid 'vel'")) << result.err;
    EXPECT_TRUE(says(result, "needs a grid that bounds an object (a level set")) << result.err;
    EXPECT_TRUE(says(result, "grid 'density'")) << "what there is: " << result.err;
}

TEST_F(CommandPipes, OneIsSingular)
{
    writeVol("one.vol", openvdb::Coord(1), "\1");
    const Result result = run("-read one.vol -print -spheretree spheres=1 -print");
    EXPECT_NE(result.out.find(" 1 active voxel of"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find(" 1 sphere on 1 level\n"), std::string::npos) << result.out;
    const Result verbose = run("-verbose -read one.vol -spheretree spheres=2 -stats");
    EXPECT_TRUE(says(verbose, "1 sphere on 1 level")) << verbose.err;
    EXPECT_TRUE(says(verbose, "the only one is taken")) << verbose.err;
}

TEST_F(CommandPipes, VectorsMayBeWrittenAsInVdbTool)
{
    const std::string draw = "-read a.vol -write ";
    ASSERT_EQ(run(draw + "a.png eye=20,20,20 lookat=4,3,2 width=40 height=30").exitCode, 0);
    const Result result = runWords({"-read", "a.vol", "-write", "b.png", "eye=(20,20,20)",
        "lookat=(4,3,2)", "width=40", "height=30"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readText(path("a.png")), readText(path("b.png")));
}

TEST_F(CommandPipes, ATreeOfOneLevelIsDrawnInManyColours)
{
    const std::string size = " width=60 height=40";
    ASSERT_EQ(run("-read a.vol -spheretree spheres=6 -write t.png" + size + " -write i.png color=id"
                  + size + " -write p.png color=parent" + size + " -write l.png color=level" + size)
                  .exitCode,
        0);
    EXPECT_EQ(readText(path("t.png")), readText(path("i.png")));
    EXPECT_EQ(readText(path("t.png")), readText(path("p.png"))) << "there are no parents";
    EXPECT_NE(readText(path("t.png")), readText(path("l.png")));
}

} // namespace
