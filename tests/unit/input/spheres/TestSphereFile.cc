// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereFile.cc
/// @brief Spheres of others: every way to write them down, and every broken file refused by name and
/// place.

#include <openvdb_spheretree/input/spheres/SphereFile.h>

#include "support/Messages.h"
#include "support/PointGrids.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>

#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using openvdb::Vec3d;
using spheretree_test::mentions;
using spheretree_test::messageOf;

class SphereFile : public testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }

    std::string save(const std::string& name, const std::string& text) const
    {
        const std::string path = mFolder.path() + "/" + name;
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    WorldSpheres read(
        const std::string& name, const std::string& text, std::optional<int> level = {}) const
    {
        return readSphereFile(save(name, text), level);
    }
    std::string whyNot(
        const std::string& name, const std::string& text, std::optional<int> level = {}) const
    {
        const std::string path = save(name, text);
        const std::string why = messageOf<openvdb::IoError>([&] { readSphereFile(path, level); });
        EXPECT_TRUE(mentions(why, path));
        return why;
    }
    /// Two spheres that each file of these tests holds.
    static void expectTheTwo(const WorldSpheres& spheres)
    {
        ASSERT_EQ(spheres.size(), 2u);
        EXPECT_EQ(spheres.center[0], Vec3d(1, 2.5, -3));
        EXPECT_EQ(spheres.radius[0], 0.1);
        EXPECT_EQ(spheres.center[1], Vec3d(4e5, 0, 0.125));
        EXPECT_EQ(spheres.radius[1], 7);
    }

    spheretree_test::TemporaryFolder mFolder;
};

} // namespace

TEST_F(SphereFile, TablesHaveTheirColumnsInAnyOrderAndWithAnySeparator)
{
    for (const char* text : {"x,y,z,radius\n1,2.5,-3,0.1\n4e5,0,0.125,7\n",
             "R;name;Z;y;X\r\n.1;a b;-3;2.5;+1\r\n7;;0.125;0;400000\r\n",
             "id\tx\ty\tz\tdiameter\n0\t1\t2.5\t-3\t0.2\n\n1\t4e5\t0\t0.125\t14",
             "\"a; b\";X;Y;Z;R\n\"c;;d\";1;2.5;-3;0.1\n;4e5;0;0.125;\"7\"\n",
             "# of another tool\n\n   x  y z   d\n 1 2.5   -3 .2 \n4e5 0 0.125 14\n",
             "\xEF\xBB\xBF\"x\", \"y\", \"z\", \"r\"\n1, 2.5, -3, 0.1\n \"4e5\", 0, 0.125, 7\n"}) {
        const WorldSpheres spheres = read("two.csv", text);
        expectTheTwo(spheres);
        EXPECT_EQ(spheres.name, "two");
        EXPECT_EQ(spheres.assumption, "");
    }
}

TEST_F(SphereFile, WithoutAHeaderFourColumnsAreACenterAndARadius)
{
    const WorldSpheres spheres = read("two.csv", "1 2.5 -3 0.1\n4e5 0 0.125 7\n");
    expectTheTwo(spheres);
    EXPECT_TRUE(mentions(spheres.assumption, "no header"));
    EXPECT_TRUE(mentions(whyNot("a.csv", "1,2,3,4,5\n"), "line 1"));
    EXPECT_TRUE(mentions(whyNot("a.csv", "1,2,3\n"), "four columns"));
}

TEST_F(SphereFile, JsonIsAnArrayOfSpheresOrAnObjectThatHoldsOne)
{
    if (!readsSphereJson()) GTEST_SKIP() << "this build reads no .json";
    const std::string entries = R"([{"x": 1, "y": 2.5, "z": -3, "radius": 0.1, "name": [{"x": 9}]},
        {"center": [4e5, 0, 0.125], "color": [1, 2, 3], "r": 7, "on": true, "parent": null}])";
    expectTheTwo(read("two.json", entries));
    expectTheTwo(read("two.json", "{\"unit\": \"m\", \"list\": " + entries + ", \"tags\": [[1]]}"));
    expectTheTwo(read("two.json",
        R"({"columns": ["id", "diameter", "z", "y", "x"], "levels": [{"begin": 0}], "dag": [[0, 1]],
            "nodes": [[0, 0.2, -3, 2.5, 1], [1, 14, 0.125, 0, 4e5]], "cuts": null})"));
}

TEST_F(SphereFile, OfSpheresWithLevelsOneLevelIsTaken)
{
    const std::string text = "level,x,y,z,radius\n2,0,0,0,9\n1,1,2.5,-3,0.1\n1,4e5,0,0.125,7\n";
    const WorldSpheres finest = read("a.csv", text);
    expectTheTwo(finest);
    EXPECT_TRUE(mentions(finest.assumption, "level 1 is taken"));
    const WorldSpheres chosen = read("a.csv", text, 2);
    EXPECT_EQ(chosen.radius, std::vector<double>{9});
    EXPECT_EQ(chosen.assumption, "");
    EXPECT_TRUE(mentions(whyNot("a.csv", text, 0), "level=0"));
    EXPECT_TRUE(mentions(whyNot("a.csv", "1 2 3 4\n", 0), "no levels"));
    EXPECT_TRUE(mentions(whyNot("a.csv", "level x y z r\n0.5 1 2 3 4\n"), "level"));
}

TEST_F(SphereFile, WhatIsWrongIsNamedWithItsLine)
{
    struct Case {
        const char *text, *place, *what;
    };
    const Case cases[] = {{"x,y,z\n1,2,3\n", "line 1", "'radius'"},
        {"x,y,r\n1,2,3\n", "line 1", "'z'"}, {"x,x,y,z,r\n1,1,2,3,4\n", "line 1", "more than one"},
        {"x,y,z,r,d\n1,2,3,4,8\n", "line 1", "more than one"},
        {"\nx,y,z,r\n1,2,3,4\n1,2,3\n", "line 4", "3 columns"},
        {"x,y,z,r\n1,2,3,4,\n", "line 2", "5 columns"},
        {"x,y,z,r\n1,2,3,four\n", "line 2", "'four' is no number"},
        {"x,y,z,r\n1,2,,4\n", "line 2", "column 3 is empty"},
        {"x,y,z,r\n1,2,3,0\n", "line 2", "not above 0"},
        {"x,y,z,r\n1,2,3,-1\n", "line 2", "not above 0"},
        {"x,y,z,r\n1,2,3,nan\n", "line 2", "not finite"},
        {"x,y,z,r\ninf,2,3,1\n", "line 2", "x is not finite"}, {"x,y,z,r\n", "", "holds no sphere"},
        {"# nothing\n", "", "holds no sphere"}};
    for (const Case& broken : cases) {
        const std::string why = whyNot("a.csv", broken.text);
        EXPECT_TRUE(mentions(why, broken.place)) << broken.text;
        EXPECT_TRUE(mentions(why, broken.what)) << broken.text;
    }
    EXPECT_TRUE(mentions(whyNot("a.csv", std::string(1 << 17, ' ')), "65536"));
    EXPECT_TRUE(mentions(whyNot("a.csv", "x" + std::string(5000, ',')), "4096 columns"));
    EXPECT_TRUE(mentions(whyNot("a.csv", ""), "empty"));
}

TEST_F(SphereFile, WhatIsWrongInJsonIsNamedWithItsEntry)
{
    if (!readsSphereJson()) GTEST_SKIP() << "this build reads no .json";
    struct Case {
        const char *text, *place, *what;
    };
    const char first[] = R"([{"x": 1, "y": 2, "z": 3, "r": 4}, )";
    const Case cases[] = {{R"({"x": 1, "y": 2, "z": 3}])", "entry 2", "no radius"},
        {R"({"y": 2, "z": 3, "r": 4}])", "entry 2", "no x"},
        {R"({"center": [1, 2], "r": 4}])", "entry 2", "2 coordinates"},
        {R"({"center": [1, 2, 3, 4], "r": 4}])", "entry 2", "4 coordinates"},
        {R"({"center": [1, 2, "3"], "r": 4}])", "entry 2", "no number"},
        {R"({"x": 1, "y": 2, "z": 3, "r": "4"}])", "entry 2", "number"},
        {R"({"x": 1, "x": 1, "y": 2, "z": 3, "r": 4}])", "entry 2", "twice"},
        {R"({"x": 1, "y": 2, "z": 3, "r": 4, "d": 8}])", "entry 2", "diameter"},
        {R"({"x": 1, "center": [1, 2, 3], "r": 4}])", "entry 2", "centre twice"},
        {R"({"center": [1, 2, 3], "y": 1, "r": 4}])", "entry 2", "twice"},
        {R"(5])", "entry 2", "no sphere"}, {R"(null])", "entry 2", "no sphere"},
        {R"("junk"])", "entry 2", "no sphere"}, {R"([1, 2, 3, 4]])", "entry 2", "no sphere"},
        {R"({"x": 1, "y": 2, "z": 3, "r": -4}])", "entry 2", "not above 0"},
        {R"({"x": 1, "y": 2, "z": 3, "r": 1e999}])", "byte", "JSON"}, {"", "byte", "JSON"}};
    for (const Case& broken : cases) {
        const std::string why = whyNot("a.json", first + std::string(broken.text));
        EXPECT_TRUE(mentions(why, broken.place)) << broken.text;
        EXPECT_TRUE(mentions(why, broken.what)) << broken.text;
    }
    EXPECT_TRUE(mentions(whyNot("a.json", "[]"), "no sphere"));
    EXPECT_TRUE(
        mentions(whyNot("a.json", "[1, {\"x\": 1, \"y\": 2, \"z\": 3, \"r\": 4}]"), "no sphere"));
    EXPECT_TRUE(mentions(whyNot("a.json", R"({"format": "vdb_spheretree.tree.2"})"), "tree.2"));
    EXPECT_TRUE(mentions(whyNot("a.json", "7"), "no sphere"));
    EXPECT_TRUE(mentions(whyNot("a.json", "[[1, 2, 3, 4]]"), "no sphere"));
    EXPECT_TRUE(mentions(whyNot("a.json", std::string(100000, '[')), "nested"));
    const std::string two = R"([{"x": 1, "y": 2, "z": 3, "r": 4}])";
    EXPECT_TRUE(
        mentions(whyNot("a.json", "{\"a\": " + two + ", \"b\": " + two + "}"), "more than one"));
}

TEST_F(SphereFile, ATreeOfOursHasAsManySpheresAsItAnnounces)
{
    if (!readsSphereJson()) GTEST_SKIP() << "this build reads no .json";
    const std::string levels =
        R"("levels": [{"level": 0, "begin": 1, "end": 3, "topology": {"end": 9}},
        {"level": 1, "begin": 0, "end": 1}], )";
    const std::string columns = R"("columns": ["level", "x", "y", "z", "radius"], )";
    const std::string rows[] = {"[1, 0, 0, 0, 9]", "[0, 1, 2.5, -3, 0.1]", "[0, 4e5, 0, 0.125, 7]"};
    const auto tree = [&](const std::string& format, const std::string& announced,
                          const std::string& nodes) {
        return "{\"format\": \"" + format + "\", " + announced + columns + "\"nodes\": [" + nodes
            + "]}";
    };
    const std::string ours = "vdb_spheretree.tree.1";
    const std::string all = rows[0] + ", " + rows[1] + ", " + rows[2];
    expectTheTwo(read("a.json", tree(ours, levels, all)));
    EXPECT_TRUE(mentions(whyNot("a.json", tree(ours, levels, rows[0] + ", " + rows[1])),
        "level 0 has 1 spheres in the file, and 'levels' announces 2"));
    EXPECT_TRUE(mentions(whyNot("a.json", tree(ours, levels, rows[1] + ", " + rows[2])),
        "level 1 has 0 spheres in the file, and 'levels' announces 1"));
    EXPECT_TRUE(mentions(whyNot("a.json", tree(ours, levels, "")), "announces 2"));
    EXPECT_TRUE(mentions(whyNot("a.json", tree(ours, levels, all + ", [2, 0, 0, 0, 1]")),
        "level 2 has 1 spheres in the file, and 'levels' announces 0"));
    EXPECT_TRUE(mentions(whyNot("a.json", tree(ours, "", all)), "announces 0"));
    for (const char* const damaged :
        {R"({"level": 0, "begin": 1})", R"({"level": 0, "begin": 1, "end": 1e30})",
            R"({"level": 0, "begin": 1, "end": "3"})", R"({"level": 0.5, "begin": 0, "end": 3})"}) {
        const std::string announced = "\"levels\": [" + std::string(damaged) + "], ";
        EXPECT_TRUE(mentions(whyNot("a.json", tree(ours, announced, all)), "level, begin and end"))
            << damaged;
    }
    // Those of others may mean anything by it.
    EXPECT_EQ(read("a.json", tree("theirs", levels, rows[1])).size(), 1u);
    EXPECT_EQ(read("a.json", tree("theirs", R"("levels": [{"level": 0, "begin": -1}], )", rows[1]))
                  .size(),
        1u);
}

TEST_F(SphereFile, PointsAreSpheresByTheirRadius)
{
    using namespace openvdb::points;
    const std::vector<Vec3d> places = {{1, 2.5, -3}, {0.25, 0, 8}};
    const auto grid = spheretree_test::pointsAt(places, /*voxelSize=*/0.5);
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { spheresOfPoints(*grid); }), "neither"));
    appendAttribute<float>(grid->tree(), "radius", 0.5f);
    WorldSpheres spheres = spheresOfPoints(*grid);
    ASSERT_EQ(spheres.size(), 2u);
    EXPECT_EQ(spheres.radius, std::vector<double>(2, 0.5));
    for (const Vec3d& place : places) {
        EXPECT_TRUE(spheres.center[0] == place || spheres.center[1] == place);
    }
    appendAttribute<double>(grid->tree(), "pscale", 0.25);
    EXPECT_EQ(spheresOfPoints(*grid).radius, std::vector<double>(2, 0.25));
    dropAttribute(grid->tree(), "pscale");
    appendAttribute<float>(grid->tree(), "pscale", -1.0f);
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { spheresOfPoints(*grid); }), "not above 0"));
    dropAttribute(grid->tree(), "pscale");
    appendAttribute<int32_t>(grid->tree(), "pscale", 1);
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { spheresOfPoints(*grid); }), "'int32'"));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([] { spheresOfPoints(*openvdb::FloatGrid::create()); }),
        "no grid of points"));
}
