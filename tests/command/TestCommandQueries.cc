// SPDX-License-Identifier: Apache-2.0
// -collide, -distance, -raycast and -contains: answers against loops over the spheres of the written tree and the voxels of the
// block, in every way to ask and to be told.

#include "CommandRunner.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace {

using command_test::CommandTest;
using command_test::mentions;
using command_test::readText;
using command_test::Result;
using command_test::writeText;
using nlohmann::json;
using openvdb::Vec3d;

struct Ball {
    Vec3d center;
    double radius;
};

/// The leaf spheres of a tree that -write has written as JSON.
std::vector<Ball> ballsOf(const json& tree)
{
    std::vector<Ball> balls;
    for (const json& node : tree["nodes"]) {
        if (node[0] == 0) balls.push_back({Vec3d(node[3], node[4], node[5]), node[6]});
    }
    return balls;
}

double gapOf(const std::vector<Ball>& a, const std::vector<Ball>& b)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& p : a) {
        for (const Ball& q : b) {
            least = std::min(least, (p.center - q.center).length() - p.radius - q.radius);
        }
    }
    return least;
}

/// A quarter about z, then by @a move.
std::vector<Ball> turned(std::vector<Ball> balls, const Vec3d& move, double scale = 1)
{
    for (Ball& ball : balls) {
        const Vec3d c = ball.center * scale;
        ball = {Vec3d(-c[1], c[0], c[2]) + move, ball.radius * scale};
    }
    return balls;
}

class CommandQueries : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
        const Result made = run("-read a.vol -spheretree cover=balls -write t.vdb t.json t.csv");
        ASSERT_EQ(made.exitCode, 0) << made.err;
        mBalls = ballsOf(json::parse(readText(path("t.json"))));
        ASSERT_GT(mBalls.size(), 5u);
    }

    /// The answers of one question to the tree and itself.
    json answers(const std::string& question, int exitCode = 0)
    {
        const Result result = run("-quiet -read t.vdb " + question + " json=answers.json");
        EXPECT_EQ(result.exitCode, exitCode) << result.err;
        return json::parse(readText(path("answers.json")))["answers"];
    }
    json answer(const std::string& question) { return answers(question).at(0); }

    std::vector<Ball> mBalls;
};

TEST_F(CommandQueries, DistanceIsThatOfAllPairsOfSpheres)
{
    const json apart = answer("-distance vdb=0,0 translate=20,1,2 rotate=0,0,90deg");
    const double gap = gapOf(mBalls, turned(mBalls, Vec3d(20, 1, 2)));
    ASSERT_GT(gap, 1);
    EXPECT_NEAR(apart["distance"], gap, 1e-4);
    EXPECT_NEAR(apart["lower"], gap, 1e-4);
    EXPECT_LE(double(apart["objects_lower"]), gap + 1e-9);
    EXPECT_GT(double(apart["objects_upper"]), gap);
    const Vec3d a(apart["ax"], apart["ay"], apart["az"]), b(apart["bx"], apart["by"], apart["bz"]);
    EXPECT_NEAR((a - b).length(), gap, 1e-4);
    EXPECT_EQ(apart["decided"], true);

    EXPECT_EQ(answer("-distance vdb=0,0 translate=2,0,0")["distance"], 0);
    const json deep = answer("-distance vdb=0,0 translate=2,0,0 rotate=0,0,90deg signed=1");
    EXPECT_NEAR(deep["distance"], gapOf(mBalls, turned(mBalls, Vec3d(2, 0, 0))), 1e-4);
    EXPECT_TRUE(answer("-distance vdb=0,0 translate=50,0,0 upto=3")["distance"].is_null());
}

TEST_F(CommandQueries, EveryWayToTurnIsTheSame)
{
    const std::string ask = "-distance vdb=0,0 ";
    const json first = answer(ask + "translate=20,1,2 rotate=0,0,1.5707963267948966");
    for (const char* pose : {"translate=20,1,2 rotate=0,0,90deg",
             "translate=20,1,2 axis=z angle=90deg", "translate=20,1,2 axis=0,0,-3 angle=-90deg",
             "matrix=0,-1,0,20,1,0,0,1,0,0,1,2,0,0,0,1", "matrix=0,-1,0,20,1,0,0,1,0,0,1,2"}) {
        const json other = answer(ask + pose);
        EXPECT_NEAR(other["distance"], double(first["distance"]), 1e-9) << pose;
        EXPECT_EQ(other["a"], first["a"]) << pose;
    }
    const json larger = answer(ask + "translate=40,1,2 rotate=0,0,90deg scale=2");
    EXPECT_NEAR(larger["distance"], gapOf(mBalls, turned(mBalls, Vec3d(40, 1, 2), 2)), 1e-4);
}

TEST_F(CommandQueries, AnglesThatWereHardlyMeantAsRadiansAreNoted)
{
    const std::string ask = "-read t.vdb -distance vdb=0,0 ";
    for (const char* turn : {"rotate=0,90,0", "rotate=0,0,-7", "axis=z angle=90"}) {
        const Result result = run(ask + turn);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_TRUE(mentions(result.err, "is in radians, and turns by more than once around"))
            << turn;
    }
    for (const char* turn :
        {"rotate=0,90,0deg", "rotate=0,0,6.28", "axis=z angle=90deg", "axis=z angle=90rad"}) {
        EXPECT_FALSE(mentions(run(ask + turn).err, "radians")) << turn;
    }
}

TEST_F(CommandQueries, ContactsOfSpheresThatReachBeyondThoseAboveAreNoted)
{
    ASSERT_EQ(run("-read a.vol -spheretree -write voxels.vdb").exitCode, 0);
    const std::string question = " -collide vdb=0,0 translate=1,0,0 ",
                      ask = "-read voxels.vdb" + question;
    EXPECT_TRUE(mentions(run(ask + "contacts=3").err, "exact=1 has their contacts, too"));
    EXPECT_FALSE(mentions(run("-read t.vdb" + question + "contacts=3").err, "their contacts"));
    EXPECT_FALSE(mentions(run(ask + "contacts=3 exact=1").err, "their contacts"));
    EXPECT_FALSE(mentions(run(ask).err, "their contacts"));
}

TEST_F(CommandQueries, CollideTellsTouchingFromApart)
{
    const json apart = answer("-collide vdb=0,0 translate=20,1,2");
    EXPECT_EQ(apart["spheres"], "apart");
    EXPECT_EQ(apart["objects"], "apart");
    EXPECT_TRUE(apart["distance"].is_null());
    EXPECT_GT(double(apart["lower"]), 0);
    EXPECT_LE(
        double(apart["lower"]), double(answer("-distance vdb=0,0 translate=20,1,2")["distance"]));
    const json deep = answer("-collide vdb=0,0 translate=1,0,0 objects=1");
    EXPECT_EQ(deep["spheres"], "touching");
    EXPECT_EQ(deep["objects"], "touching");
    EXPECT_LT(double(deep["distance"]), 0);

    const double gap = gapOf(mBalls, turned(mBalls, Vec3d(20, 1, 2)));
    const std::string ask = "-collide vdb=0,0 translate=20,1,2 rotate=0,0,90deg margin=";
    EXPECT_EQ(answer(ask + std::to_string(gap - 0.01))["spheres"], "apart");
    EXPECT_EQ(answer(ask + std::to_string(gap + 0.01))["spheres"], "touching");
    EXPECT_EQ(answer("-collide vdb=0,0 translate=1,0,0 blocks=1")["spheres"], "undecided");
}

TEST_F(CommandQueries, PosesOfAFileAreThoseThatAreTyped)
{
    writeText(path("poses.csv"),
        "time,x,y,z,rx,ry,rz\n0,20,1,2,0,0,1.5707963267948966\n1,1,0,0,0,0,0\n2,9.5,0,0,0,0,0\n");
    const json all = answers("-collide vdb=0,0 poses=poses.csv");
    ASSERT_EQ(all.size(), 3u);
    const char* typed[] = {
        "translate=20,1,2 rotate=0,0,90deg", "translate=1,0,0", "translate=9.5,0,0"};
    for (int i = 0; i < 3; ++i) {
        json one = answer("-collide vdb=0,0 " + std::string(typed[i]));
        EXPECT_EQ(all[i]["pose"], i);
        one["pose"] = i;
        EXPECT_EQ(all[i], one);
    }
    const Result table = run("-read t.vdb -collide vdb=0,0 poses=poses.csv");
    EXPECT_TRUE(mentions(table.out, "3 poses: ")) << table.out;
    const Result piped = shell("$VDB_SPHERETREE -quiet -read t.vdb -collide vdb=0,0 "
                               "poses=stdin.csv csv=- < poses.csv");
    EXPECT_EQ(piped.exitCode, 0) << piped.err;
    EXPECT_EQ(std::count(piped.out.begin(), piped.out.end(), '\n'), 4) << piped.out;
    EXPECT_TRUE(mentions(piped.out, "pose,spheres,objects,distance,lower,x,y,z")) << piped.out;
}

TEST_F(CommandQueries, AnswersAreTheSameForAnyNumberOfThreads)
{
    std::string poses = "x y z qx qy qz qw\n";
    for (int i = 0; i < 300; ++i) {
        const double h = 0.02 * i;
        poses += std::to_string(0.05 * i) + " " + std::to_string(0.01 * i) + " 0 0 0 "
            + std::to_string(std::sin(h)) + " " + std::to_string(std::cos(h)) + "\n";
    }
    writeText(path("poses.csv"), poses);
    for (const std::string ask : {"-collide", "-distance signed=1"}) {
        std::string out[2];
        for (const int threads : {1, 2}) {
            const Result result = run("-quiet -threads " + std::to_string(threads) + " -read t.vdb "
                + ask + " vdb=0,0 poses=poses.csv csv=-");
            EXPECT_EQ(result.exitCode, 0) << result.err;
            out[threads - 1] = result.out;
        }
        EXPECT_EQ(out[0], out[1]);
        EXPECT_EQ(std::count(out[0].begin(), out[0].end(), '\n'), 301);
    }
    const Result table = run("-read t.vdb -collide vdb=0,0 poses=poses.csv");
    EXPECT_TRUE(mentions(table.out, "... and 250 more: csv= and json= have all")) << table.out;
    EXPECT_TRUE(mentions(table.out, "300 poses: ")) << table.out;
}

TEST_F(CommandQueries, WhatIsNotExpectedIsExitCodeSixAndIsStillWritten)
{
    const std::string apart = "-read t.vdb -collide vdb=0,0 translate=20,0,0 ";
    const std::string deep = "-read t.vdb -collide vdb=0,0 translate=1,0,0 ";
    EXPECT_EQ(run(apart).exitCode, 0);
    EXPECT_EQ(run(deep).exitCode, 0);
    EXPECT_EQ(run(apart + "expect=apart").exitCode, 0);
    EXPECT_EQ(run(deep + "expect=touching").exitCode, 0);
    EXPECT_EQ(run(deep + "expect=touching objects=1").exitCode, 0);
    EXPECT_EQ(run(apart + "expect=touching").exitCode, 6);
    const Result failed = run(deep + "expect=apart answers.csv");
    EXPECT_EQ(failed.exitCode, 6);
    EXPECT_TRUE(exists("answers.csv"));
    EXPECT_TRUE(mentions(failed.err, "expect=apart does not hold in 1 of 1 pose")) << failed.err;
    EXPECT_EQ(
        run(apart + "expect=apart blocks=1").exitCode, 0); // their surrounding spheres decide it
    EXPECT_EQ(run(deep + "expect=touching blocks=1").exitCode, 6);
}

TEST_F(CommandQueries, TwoTreesAreTheTwoOfTheStackInTheirOrder)
{
    ASSERT_EQ(run("-generate ball voxels=2000 -spheretree -write b.vdb").exitCode, 0);
    const auto distance = [&](const std::string& read, const std::string& pose) {
        const Result result = run("-quiet " + read + " -distance json=d.json " + pose);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return json::parse(readText(path("d.json")))["answers"].at(0);
    };
    const json ab = distance("-read t.vdb b.vdb", "translate=40,3,0");
    const json ba = distance("-read b.vdb -read t.vdb", "translate=-40,-3,0");
    EXPECT_NEAR(ab["distance"], double(ba["distance"]), 1e-4);
    EXPECT_EQ(ab["a"], ba["b"]);
    const json chosen = distance("-read b.vdb -read t.vdb", "vdb=0,1 translate=40,3,0");
    EXPECT_EQ(chosen, ab);

    EXPECT_TRUE(mentions(run("-read t.vdb -collide").err, "vdb=0,0"));
    EXPECT_EQ(run("-read t.vdb -collide").exitCode, 3);
    EXPECT_TRUE(mentions(run("-read t.vdb t.vdb b.vdb -collide").err, "there are 3"));
    EXPECT_EQ(run("-read a.vol -collide").exitCode, 3);
}

TEST_F(CommandQueries, RaysEnterTheNearestSphere)
{
    const json hit = answer("-raycast origin=-10,3.1,2.2 direction=2,0,0");
    double first = std::numeric_limits<double>::infinity();
    const Vec3d origin(-10, 3.1, 2.2);
    for (const Ball& ball : mBalls) {
        const Vec3d off = ball.center - origin;
        const double away = off[1] * off[1] + off[2] * off[2];
        const double half = ball.radius * ball.radius - away;
        if (half >= 0) first = std::min(first, off[0] - std::sqrt(half));
    }
    EXPECT_EQ(hit["hit"], true);
    EXPECT_NEAR(double(hit["t"]), first / 2, 1e-4);
    EXPECT_NEAR(double(hit["x"]), -10 + first, 1e-4);
    EXPECT_NEAR(Vec3d(hit["nx"], hit["ny"], hit["nz"]).length(), 1, 1e-9);
    EXPECT_EQ(answer("-raycast origin=-10,3.1,2.2 direction=-2,0,0")["hit"], false);
    EXPECT_EQ(answer("-raycast origin=-10,3.1,2.2 direction=0,1,0")["t"], nullptr);

    writeText(path("rays.csv"), "-10 3.1 2.2 2 0 0\n-10 3.1 2.2 0 1 0\n");
    EXPECT_EQ(answers("-raycast rays=rays.csv").at(0), hit);
    const json any = answers("-raycast rays=rays.csv any=1");
    EXPECT_EQ(any.at(0)["hit"], true);
    EXPECT_EQ(any.at(1)["hit"], false);
    const Result table = run("-read t.vdb -raycast rays=rays.csv");
    EXPECT_TRUE(mentions(table.out, "2 rays: 1 hit")) << table.out;
    EXPECT_TRUE(mentions(table.err, "no header")) << table.err;

    writeText(path("far.csv"), "0 0 0 1 0 0\n1e100 0 0 -1 0 0\n");
    for (const char* const question : {"-raycast rays=far.csv", "-raycast rays=far.csv any=1"}) {
        const Result far = run("-read t.vdb " + std::string(question));
        EXPECT_EQ(far.exitCode, 3);
        EXPECT_TRUE(mentions(far.err, "far.csv: ray 1 from")) << far.err;
    }
}

TEST_F(CommandQueries, PointsAreInTheObjectExactlyWhereItsVoxelsAre)
{
    ASSERT_EQ(run("-read a.vol -mask -write m.vdb").exitCode, 0);
    const auto mask = openvdb::gridPtrCast<openvdb::BoolGrid>(readGrids("m.vdb").at(0));
    std::ostringstream table;
    std::vector<Vec3d> points;
    for (int i = 0; i < 3000; ++i) {
        const double t = 0.37 * i;
        points.emplace_back(
            std::fmod(t, 11) - 1.5, std::fmod(t * 1.7, 9) - 1.5, std::fmod(t * 2.3, 8) - 1.5);
        table << points.back()[0] << "," << points.back()[1] << "," << points.back()[2] << "\n";
    }
    writeText(path("points.csv"), "x,y,z\n" + table.str());
    const json all = answers("-contains points=points.csv");
    ASSERT_EQ(all.size(), points.size());
    int inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3d index = mask->worldToIndex(points[i]);
        bool isOnBorder = false; // numbers were printed with six digits
        for (int a = 0; a < 3; ++a) {
            isOnBorder |= std::abs(std::abs(index[a] - std::round(index[a])) - 0.5) < 1e-4;
        }
        if (isOnBorder) continue;
        const bool isIn = mask->tree().isValueOn(openvdb::Coord::round(index));
        inside += isIn;
        EXPECT_EQ(all[i]["object"], isIn ? "inside" : "outside") << points[i];
        double least = std::numeric_limits<double>::infinity();
        for (const Ball& ball : mBalls) {
            least = std::min(least, (ball.center - points[i]).length() - ball.radius);
        }
        EXPECT_NEAR(double(all[i]["distance"]), least, 1e-4);
        EXPECT_EQ(bool(all[i]["in_spheres"]), double(all[i]["distance"]) <= 0);
    }
    EXPECT_GT(inside, 300);
    const json far = answer("-contains point=100,0,0 upto=5");
    EXPECT_EQ(far["object"], "outside");
    EXPECT_TRUE(far["distance"].is_null());
    const Result shown = run("-read t.vdb -contains points=points.csv");
    EXPECT_TRUE(mentions(shown.out, "3,000 points: ")) << shown.out;
    EXPECT_TRUE(mentions(shown.out, " inside, ")) << shown.out;
}

TEST_F(CommandQueries, WithoutMedialBallsPointsAreKnownWithinBounds)
{
    ASSERT_EQ(run("-read a.vol -spheretree spheres=4 -write few.vdb").exitCode, 0);
    const Result few =
        run("-read few.vdb -contains point=4,3,2 csv=- -contains point=30,3,2 -verbose");
    EXPECT_EQ(few.exitCode, 0) << few.err;
    EXPECT_TRUE(mentions(few.out, "0,undecided,1,")) << few.out;
    const Result out = run("-quiet -read few.vdb -contains point=30,3,2 csv=-");
    EXPECT_TRUE(mentions(out.out, "0,outside,0,")) << out.out;
    const Result none = run("-quiet -read few.vdb -contains point=30,3,2 upto=0 csv=-");
    EXPECT_TRUE(mentions(none.out, "0,outside,0,,")) << none.out;
    const Result table = run("-read few.vdb -contains point=4,3,2");
    EXPECT_TRUE(mentions(table.out, "1 point: 1 undecided")) << table.out;
}

TEST_F(CommandQueries, UnitsAreThoseOfAllNumbers)
{
    const json metres = answer("-distance vdb=0,0 translate=20,1,2");
    const json mm = answer("-distance vdb=0,0 translate=20000,1000,2000 units=mm");
    EXPECT_NEAR(mm["distance"], 1000 * double(metres["distance"]), 1e-3);
    EXPECT_NEAR(mm["ax"], 1000 * double(metres["ax"]), 1e-3);
    const json ray = answer("-raycast origin=-10,3.1,2.2 direction=1,0,0");
    const json mmRay = answer("-raycast origin=-10000,3100,2200 direction=1,0,0 units=mm");
    EXPECT_NEAR(mmRay["x"], 1000 * double(ray["x"]), 1e-2);
    EXPECT_NEAR(mmRay["t"], 1000 * double(ray["t"]), 1e-2);
    const std::string ask = "-collide vdb=0,0 translate=20000,0,0 units=mm margin=";
    EXPECT_EQ(answer(ask + "20000")["spheres"], "touching");
    EXPECT_EQ(answer(ask + "20")["spheres"], "apart");
    EXPECT_EQ(answer(ask + "20m")["spheres"], "touching");
    EXPECT_EQ(answer(ask + "20cm")["spheres"], "apart");
    const Result unknown = run("-read t.vdb -collide vdb=0,0 margin=5mm");
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_TRUE(mentions(unknown.err, "say so by units=mm beside it")) << unknown.err;
}

TEST_F(CommandQueries, TreesWithoutAnswersAreRefusedWithTheReason)
{
    ASSERT_EQ(run("-read a.vol -spheretree reversible -write r.vdb").exitCode, 0);
    const Result reversible = run("-read r.vdb -collide vdb=0,0");
    EXPECT_EQ(reversible.exitCode, 3);
    EXPECT_TRUE(mentions(reversible.err, "add exact=1")) << reversible.err;
    EXPECT_EQ(run("-read r.vdb -collide vdb=0,0 exact=1").exitCode, 0);
    ASSERT_EQ(run("-read a.vol -spheretree extended dist=l1 -write n.vdb").exitCode, 0);
    const Result norm = run("-read n.vdb -contains point=0,0,0 exact=1");
    EXPECT_EQ(norm.exitCode, 3);
    EXPECT_TRUE(mentions(norm.err, "l1")) << norm.err;
    EXPECT_EQ(run("-read t.vdb -contains point=0,0,0 level=99").exitCode, 3);
    EXPECT_EQ(run("-read t.vdb -contains point=0,0,0 level=1").exitCode, 0);
}

TEST_F(CommandQueries, TreesWithoutSpheresAreLeftOutAndNamed)
{
    ASSERT_EQ(run("-read a.vol -mask below=0 -spheretree empty=write -write e.vdb").exitCode, 0);
    for (const char* trees : {"e.vdb t.vdb", "t.vdb e.vdb", "e.vdb"}) {
        for (const char* ask : {"-collide", "-collide motion=1 translate=1,0,0", "-distance",
                 "-collide scene=1", "-collide scene=1 motion=1 poses=m.csv"}) {
            writeText(path("m.csv"), "frame,body,x,y,z\n0,0,0,0,0\n1,0,1,0,0\n");
            const Result result = run(std::string("-read ") + trees + " " + ask);
            EXPECT_EQ(result.exitCode, 3) << trees << ask;
            EXPECT_TRUE(mentions(result.err, "asks two sphere-trees")) << result.err;
            EXPECT_TRUE(mentions(
                result.err, "left out: sphere-tree without spheres 'spheretree' (from e.vdb)"))
                << result.err;
        }
    }
    for (const char* ask : {"-contains point=0,0,0", "-raycast origin=9,9,9 direction=1,0,0",
             "-collide vdb=0,0", "-distance vdb=0,0"}) {
        const Result result = run(std::string("-read e.vdb ") + ask);
        EXPECT_EQ(result.exitCode, 3) << ask;
        EXPECT_TRUE(mentions(result.err, "without spheres")) << result.err;
    }
    // Beside others it touches nothing.
    const Result scene = run("-quiet -read t.vdb t.vdb e.vdb -collide scene=1 csv=-");
    EXPECT_EQ(scene.exitCode, 0) << scene.err;
    EXPECT_TRUE(mentions(scene.out, "touching")) << scene.out;
}

TEST_F(CommandQueries, FilesOfQuestionsAreNamedWithTheirLine)
{
    writeText(path("short.csv"), "x,y,z\n1,2,3\n4,5\n");
    for (const char* ask : {"-collide vdb=0,0 poses=", "-distance vdb=0,0 poses=",
             "-contains points=", "-raycast rays="}) {
        const Result result = run("-read t.vdb " + std::string(ask) + "short.csv csv=never.csv");
        EXPECT_EQ(result.exitCode, 3) << ask;
        const bool isRay = mentions(ask, "rays");
        EXPECT_TRUE(
            mentions(result.err, isRay ? "short.csv: line 1" : "short.csv: line 3: it has 2"))
            << result.err;
        EXPECT_FALSE(exists("never.csv"));
        EXPECT_EQ(run("-read t.vdb " + std::string(ask) + "none.csv").exitCode, 3) << ask;
    }
    writeText(path("far.csv"), "0,0,0\n1e150,0,0\n");
    const Result far = run("-read t.vdb -distance vdb=0,0 poses=far.csv");
    EXPECT_EQ(far.exitCode, 3);
    EXPECT_TRUE(mentions(far.err, "-distance: pose 1: ")) << far.err;
    std::string table(400, '\n');
    for (int i = 0; i < 400; ++i) table += i < 200 ? "0,0,0\n" : "1e150,0,0\n";
    writeText(path("far.csv"), table);
    for (int run = 0; run < 5; ++run) { // whichever thread finds one first
        const Result first = this->run("-read t.vdb -distance vdb=0,0 poses=far.csv");
        EXPECT_TRUE(mentions(first.err, "-distance: pose 200: ")) << first.err;
    }
    writeText(path("mirror.csv"), "-1 0 0 0 0 1 0 0 0 0 1 0\n");
    EXPECT_TRUE(mentions(run("-read t.vdb -collide vdb=0,0 poses=mirror.csv").err, "mirrors"));
}

TEST_F(CommandQueries, WhatMayBeAMistakeIsNoted)
{
    const std::string ask = "-read t.vdb -collide vdb=0,0 ";
    const auto noteOf = [&](const std::string& line) {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    EXPECT_FALSE(mentions(noteOf(ask + "translate=20,0,0"), "note:"));
    const std::string far = noteOf(ask + "translate=20000,0,0");
    EXPECT_TRUE(mentions(far, "more than a hundred times their size apart")) << far;
    const std::string large = noteOf(ask + "scale=1000");
    EXPECT_TRUE(mentions(large, "times as large as")) << large;

    ASSERT_EQ(run("-read a.vol -spheretree side=inner -write i.vdb").exitCode, 0);
    const std::string inner = noteOf("-read i.vdb -collide vdb=0,0 translate=20,0,0 expect=apart");
    EXPECT_TRUE(mentions(inner, "do not hold the object")) << inner;
    ASSERT_EQ(run("-read a.vol -spheretree spheres=4 -write few.vdb").exitCode, 0);
    const std::string few = noteOf("-read few.vdb -collide vdb=0,0 objects=1");
    EXPECT_TRUE(mentions(few, "are not known to hold a part of the object")) << few;
    EXPECT_FALSE(mentions(noteOf(ask + "objects=1 expect=touching"), "note:"));
}

TEST_F(CommandQueries, ATableThatIsAskedIsNotTakenForOneOfAnswers)
{
    writeText(path("poses.csv"), "x,y,z\n1,2,3\n");
    for (const char* ask : {"-collide vdb=0,0", "-distance vdb=0,0", "-contains point=0,0,0",
             "-raycast origin=0,0,9 direction=0,0,-1"}) {
        const std::string line = "-read t.vdb " + std::string(ask);
        const Result mistaken = run(line + " poses.csv");
        EXPECT_EQ(mistaken.exitCode, 2);
        EXPECT_TRUE(mentions(mistaken.err, "poses.csv is there, and holds no answers"))
            << mistaken.err;
        EXPECT_EQ(readText(path("poses.csv")), "x,y,z\n1,2,3\n");
        EXPECT_EQ(run(line + " answers.csv").exitCode, 0);
        EXPECT_EQ(run(line + " answers.csv").exitCode, 0) << "answers are replaced by answers";
        std::filesystem::remove(path("answers.csv"));
    }
    const Result same = run("-read t.vdb -collide vdb=0,0 poses=poses.csv csv=poses.csv");
    EXPECT_EQ(same.exitCode, 0) << same.err;
    EXPECT_TRUE(mentions(same.err, "poses.csv, which was read, is replaced")) << same.err;
    EXPECT_TRUE(mentions(readText(path("poses.csv")), "pose,spheres"));
}

TEST_F(CommandQueries, ExpressionsAndLoopsAskPoseByPose)
{
    const Result loop = runWords({"-read", "t.vdb", "-for", "x=1,21,10", "-collide", "vdb=0,0",
        "translate={$x},0,0", "csv=pose_{$x}.csv", "-end"});
    EXPECT_EQ(loop.exitCode, 0) << loop.err;
    EXPECT_TRUE(mentions(readText(path("pose_1.csv")), "touching"));
    EXPECT_TRUE(mentions(readText(path("pose_11.csv")), "0,apart,apart,,"));
    writeText(path("actions.txt"), "read t.vdb\ncollide vdb=0,0 translate=20,0,0 expect=apart\n");
    EXPECT_EQ(run("-config actions.txt").exitCode, 0);
}

TEST_F(CommandQueries, ContactsAreTheDeepestPairsOfSpheres)
{
    writeText(path("poses.csv"), "x,y,z\n12,1,2\n1,0,0\n");
    const json all = answers("-collide vdb=0,0 poses=poses.csv contacts=5");
    ASSERT_EQ(all.size(), 6u);
    EXPECT_EQ(all[0]["spheres"], "apart");
    EXPECT_TRUE(all[0]["contact"].is_null());
    EXPECT_EQ(all[0]["lower"], answer("-collide vdb=0,0 translate=12,1,2")["lower"]);
    EXPECT_GT(double(all[0]["lower"]), 0);
    std::vector<double> gaps;
    for (const Ball& a : mBalls) {
        for (const Ball& b : mBalls) {
            gaps.push_back((a.center - b.center - Vec3d(1, 0, 0)).length() - a.radius - b.radius);
        }
    }
    std::sort(gaps.begin(), gaps.end());
    for (int k = 0; k < 5; ++k) {
        EXPECT_EQ(all[k + 1]["pose"], 1);
        EXPECT_EQ(all[k + 1]["contact"], k);
        EXPECT_NEAR(double(all[k + 1]["distance"]), gaps[std::size_t(k)], 1e-4);
    }
    const Result table = run("-read t.vdb -collide vdb=0,0 poses=poses.csv contacts=5");
    EXPECT_TRUE(mentions(table.out, "2 poses: 1 apart, 1 touching")) << table.out;
    EXPECT_EQ(run("-read t.vdb -collide vdb=0,0 contacts=1").exitCode, 2);
}

TEST_F(CommandQueries, AMotionTouchesWhereItsSpheresFirstMeet)
{
    writeText(path("way.csv"), "x,y,z,rx,ry,rz\n40,1,2,0,0,0\n-40,1,2,0,0,0\n-40,30,2,0,0,1\n");
    const json hit = answer("-collide vdb=0,0 motion=1 poses=way.csv");
    EXPECT_EQ(hit["spheres"], "touching");
    const double time = hit["time"];
    const auto gapAt = [&](double t) {
        std::vector<Ball> moved = mBalls;
        for (Ball& ball : moved) ball.center += Vec3d(40 - 80 * t, 1, 2);
        return gapOf(mBalls, moved);
    };
    EXPECT_NEAR(gapAt(time), 0, 2e-3);
    for (int i = 0; i < 100; ++i) EXPECT_GT(gapAt(time * i / 100), 0);
    EXPECT_EQ(hit["free_until"], time);
    const double early = answer("-collide vdb=0,0 motion=1 poses=way.csv margin=3")["time"];
    EXPECT_LT(early, time);
    EXPECT_NEAR(gapAt(early), 3, 2e-3);

    const json all = answers("-collide vdb=0,0 motion=1 poses=way.csv");
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[1]["spheres"], "apart");
    EXPECT_TRUE(all[1]["time"].is_null());
    EXPECT_EQ(all[1]["free_until"], 1);
    const Result table = run("-read t.vdb -collide vdb=0,0 motion=1 poses=way.csv expect=apart");
    EXPECT_EQ(table.exitCode, 6);
    EXPECT_TRUE(
        mentions(table.out, "2 motions: 1 apart, 1 touching; the first contact is in motion 0"))
        << table.out;
    EXPECT_TRUE(mentions(table.err, "in 1 of 2 motions, the first: motion 0 is touching"))
        << table.err;
    EXPECT_EQ(answer("-collide vdb=0,0 motion=1 translate=1,0,0")["time"], 0);
    const Result few =
        run("-quiet -read t.vdb -collide vdb=0,0 motion=1 poses=way.csv blocks=1 csv=-");
    EXPECT_TRUE(mentions(few.out, "motion,spheres,time,free_until,")) << few.out;
    EXPECT_TRUE(mentions(few.out, "0,undecided,,")) << few.out;
}

TEST_F(CommandQueries, MotionsThatAreNoneAreRefused)
{
    for (const char* other : {"objects=1", "contacts=3"}) {
        const Result both = run("-read t.vdb -collide vdb=0,0 motion=1 " + std::string(other));
        EXPECT_EQ(both.exitCode, 2);
        EXPECT_TRUE(mentions(both.err, "motion and ")) << both.err;
    }
    EXPECT_EQ(run("-read t.vdb -collide vdb=0,0 tolerance=0.1").exitCode, 2);
    EXPECT_EQ(run("-read t.vdb -collide vdb=0,0 motion=1 tolerance=-1").exitCode, 2);
    writeText(path("one.csv"), "x,y,z\n1,2,3\n");
    const Result one = run("-read t.vdb -collide vdb=0,0 motion=1 poses=one.csv csv=never.csv");
    EXPECT_EQ(one.exitCode, 3);
    EXPECT_TRUE(mentions(one.err, "one.csv: motion=1 goes from pose to pose")) << one.err;
    writeText(path("short.csv"), "x,y,z\n1,2,3\n4,5\n");
    const Result cut = run("-read t.vdb -collide vdb=0,0 motion=1 poses=short.csv csv=never.csv");
    EXPECT_EQ(cut.exitCode, 3);
    EXPECT_TRUE(mentions(cut.err, "short.csv: line 3")) << cut.err;
    EXPECT_FALSE(exists("never.csv"));
}

TEST_F(CommandQueries, HelpHasOptionsAndColumns)
{
    const Result help = run("-help collide distance raycast contains");
    for (const char* part : {"translate=", "rotate=", "matrix=", "expect=", "contacts=", "motion=",
             "tolerance=", "qx,qy,qz,qw", "rays=", "x,y,z,dx,dy,dz", "points="}) {
        EXPECT_TRUE(mentions(help.out, part)) << part;
    }
}

} // namespace
