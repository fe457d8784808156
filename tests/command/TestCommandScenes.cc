// SPDX-License-Identifier: Apache-2.0
// -collide scene=1: which of several trees touch, against -collide of every two of them; and every way to name them.

#include "CommandRunner.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using command_test::CommandTest;
using command_test::mentions;
using command_test::readText;
using command_test::Result;
using command_test::writeText;
using nlohmann::json;

/// About z, then a move.
struct Place {
    double x = 0, y = 0, z = 0, angle = 0;

    std::string row() const
    {
        std::ostringstream out;
        out.precision(17);
        out << x << "," << y << "," << z << ",0,0," << angle << "\n";
        return out.str();
    }
    /// The same as body @a first sees it.
    Place seenFrom(const Place& first) const
    {
        const double c = std::cos(first.angle), s = std::sin(first.angle);
        const double dx = x - first.x, dy = y - first.y;
        return {c * dx + s * dy, c * dy - s * dx, z - first.z, angle - first.angle};
    }
};

using Texts = std::vector<std::string>;

const std::vector<std::string> kNames = {"block", "ball", "ring"};

class CommandScenes : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
        const Result made = run("-read a.vol -spheretree name=block -write block.vdb "
                                "-generate ball voxels=1000 -spheretree name=ball -write ball.vdb "
                                "-generate ball voxels=2000 -spheretree name=ring -write ring.vdb");
        ASSERT_EQ(made.exitCode, 0) << made.err;
    }

    Result ask(const std::string& options)
    {
        return run("-quiet -read block.vdb ball.vdb ring.vdb -collide scene=1 " + options);
    }
    json answers(const std::string& options, int exitCode = 0)
    {
        const Result result = ask(options + " json=answers.json");
        EXPECT_EQ(result.exitCode, exitCode) << result.err;
        return json::parse(readText(path("answers.json")))["answers"];
    }
    /// The pairs of all answers, such as `0 block ball`.
    std::vector<std::string> pairs(const std::string& options)
    {
        std::vector<std::string> found;
        for (const json& one : answers(options)) {
            const std::string frame = std::to_string(int(one["frame"]));
            if (one["body_a"].is_null()) found.push_back(frame);
            else
                found.push_back(
                    frame + " " + std::string(one["body_a"]) + " " + std::string(one["body_b"]));
        }
        return found;
    }
    /// Of the second of two trees in each pose, as the first one sees it.
    json pairAnswers(const Texts& names, const std::string& poses, const std::string& options)
    {
        writeText(path("pair.csv"), "x,y,z,rx,ry,rz\n" + poses);
        const Result result = run("-quiet -read " + names[0] + ".vdb " + names[1]
            + ".vdb -collide poses=pair.csv json=pair.json " + options);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return json::parse(readText(path("pair.json")))["answers"];
    }
    /// Holds a scene against what pairs have answered.
    /// @param expected  those that touch, by frame and names
    /// @param exact     columns of which numbers are the same, and @a near within @a tolerance
    /// @param count     how the summary begins
    void expectAnswers(const std::string& options, const std::map<Texts, json>& expected,
        const Texts& exact, const Texts& near, double tolerance, const std::string& count)
    {
        std::size_t found = 0;
        for (const json& one : answers(options)) {
            if (one["body_a"].is_null()) {
                EXPECT_EQ(one["spheres"], "apart");
                continue;
            }
            const Texts key = {std::to_string(int(one["frame"])), one["body_a"], one["body_b"]};
            ASSERT_TRUE(expected.count(key)) << key[0] << " " << key[1] << " " << key[2];
            const json& pair = expected.at(key);
            for (const auto& same : exact) EXPECT_EQ(one[same], pair[same]) << same;
            for (const auto& column : near) {
                EXPECT_NEAR(one[column], double(pair[column]), tolerance) << column;
            }
            ++found;
        }
        EXPECT_EQ(found, expected.size());
        const Result table = ask(options);
        const std::string pairs = std::to_string(expected.size()) + " pairs touching";
        EXPECT_TRUE(mentions(table.out, count)) << table.out;
        EXPECT_TRUE(mentions(table.out, "; 3 trees, " + pairs)) << table.out;
    }
    void expectRefusal(const std::string& options, int exitCode, const std::string& message)
    {
        const Result result = ask(options + " csv=never.csv");
        EXPECT_EQ(result.exitCode, exitCode) << options << ": " << result.err;
        EXPECT_TRUE(mentions(result.err, message)) << options << ": " << result.err;
        EXPECT_FALSE(exists("never.csv"));
    }
};

TEST_F(CommandScenes, PairsAreThoseThatTouchWhereEveryTwoAreAsked)
{
    constexpr int kFrames = 60;
    std::string scene = "frame,body,x,y,z,rx,ry,rz\n";
    std::vector<std::array<Place, 3>> places;
    for (int i = 0; i < kFrames; ++i) {
        std::array<Place, 3> all;
        for (int b = 0; b < 3; ++b) {
            const double t = 1.7 * i + 40 * b;
            all[std::size_t(b)] = {
                9 * std::sin(t), 9 * std::sin(1.3 * t), 4 * std::sin(2.1 * t), 0.37 * t};
            scene +=
                std::to_string(i) + "," + kNames[std::size_t(b)] + "," + all[std::size_t(b)].row();
        }
        places.push_back(all);
    }
    writeText(path("scene.csv"), scene);

    std::map<Texts, json> expected; // by frame and names
    for (int a = 0; a < 3; ++a) {
        for (int b = a + 1; b < 3; ++b) {
            const Texts names = {kNames[std::size_t(a)], kNames[std::size_t(b)]};
            std::string poses;
            for (const auto& all : places) {
                poses += all[std::size_t(b)].seenFrom(all[std::size_t(a)]).row();
            }
            const json pair = pairAnswers(names, poses, "margin=0.5");
            for (int i = 0; i < kFrames; ++i) {
                if (pair[std::size_t(i)]["spheres"] == "touching")
                    expected[{std::to_string(i), names[0], names[1]}] = pair[std::size_t(i)];
            }
        }
    }
    ASSERT_GT(expected.size(), 20u);
    ASSERT_LT(expected.size(), 100u);

    expectAnswers("margin=0.5 poses=scene.csv", expected, {"spheres", "objects", "a", "b"},
        {"distance"}, 1e-6, "60 frames: ");
}

/// All trees are named alike unless they are given a name.
TEST_F(CommandScenes, TreesOfOneNameGoByTheirFiles)
{
    for (const auto& name : kNames) {
        ASSERT_EQ(
            run("-read " + name + ".vdb -level 0 name=same -write same_" + name + ".vdb").exitCode,
            0);
    }
    writeText(
        path("scene.csv"), "body,x,y,z\nsame_block,0,0,0\nsame_ball,1,0,0\nsame_ring,500,0,0\n");
    const std::string ask =
        "-quiet -read same_block.vdb same_ball.vdb same_ring.vdb -collide scene=1 ";
    const Result result = run(ask + "poses=scene.csv json=s.json");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const json found = json::parse(readText(path("s.json")))["answers"];
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]["body_a"], "same_block");
    EXPECT_EQ(found[0]["body_b"], "same_ball");
    const Result ignoring = run(ask + "poses=scene.csv ignore=same_block:same_ball expect=apart");
    EXPECT_EQ(ignoring.exitCode, 0) << ignoring.err;
    const Result twins = run(
        "-read same_block.vdb same_block.vdb same_ball.vdb -collide scene=1 ignore=same_block:0");
    EXPECT_EQ(twins.exitCode, 3);
    EXPECT_TRUE(mentions(twins.err, "there is no 'same_block'")) << twins.err;
}

TEST_F(CommandScenes, TreesStayWhereTheyAreUntilALinePlacesThem)
{
    EXPECT_EQ(pairs(""), (Texts{"0 block ball", "0 block ring", "0 ball ring"}));
    writeText(path("one.csv"), "body,x,y,z\nring,90,0,0\n");
    EXPECT_EQ(pairs("poses=one.csv"), (Texts{"0 block ball"}));
    writeText(path("some.csv"),
        "frame;body;x;y;z;note\n-3;ring;90;0;0;a\n5;ball;90;0;0;b\n5;\"block\";180;0;0;c\n"
        "6;ring;0;0;0;d\n");
    EXPECT_EQ(pairs("poses=some.csv"), (Texts{"-3 block ball", "5 ball ring", "6"}));
    // Ages, of which 0 is the newest, do as well as names; and a scene of two is one.
    writeText(path("ages.csv"), "body,x,y,z\n0,90,0,0\n2,90,0,0\n");
    EXPECT_EQ(pairs("poses=ages.csv"), (Texts{"0 block ring"}));
    EXPECT_EQ(pairs("vdb=0,ball"), (Texts{"0 ring ball"}));
    EXPECT_EQ(pairs("vdb=*").size(), 3u);
    // Millimetres, of trees in metres.
    writeText(path("mm.csv"), "body,x,y,z\n0,90,0,0\n");
    EXPECT_EQ(pairs("poses=mm.csv units=mm").size(), 3u);
    const Result piped = shell("$VDB_SPHERETREE -quiet -read block.vdb ball.vdb ring.vdb -collide "
                               "scene=1 poses=stdin.csv csv=- < some.csv");
    EXPECT_EQ(piped.exitCode, 0) << piped.err;
    EXPECT_TRUE(mentions(piped.out, "frame,body_a,body_b,spheres,objects,distance,x,y,z"))
        << piped.out;
    EXPECT_TRUE(mentions(piped.out, "\n6,,,apart,apart,,,,,,,,,,\n")) << piped.out;
}

TEST_F(CommandScenes, PairsThatAreIgnoredAreNotAnswers)
{
    EXPECT_EQ(pairs("ignore=block:ball"), (Texts{"0 block ring", "0 ball ring"}));
    EXPECT_EQ(pairs("ignore=1:2,ring:block"), (Texts{"0 ball ring"}));
    EXPECT_EQ(pairs("ignore=1:2,ring:block,0:1"), Texts{"0"});
    expectRefusal("ignore=block", 2, "a pair is two trees with a colon between");
    expectRefusal("ignore=a:b:c", 2, "a pair is two trees with a colon between");
    expectRefusal("ignore=:ball", 2, "a pair is two trees with a colon between");
    expectRefusal("ignore=block:cup", 3, "there is no 'cup'; on the stack, newest first: ");
    expectRefusal("ignore=block:3", 3, "there is no '3'");
    expectRefusal("ignore=block:2", 3, "that is one tree");
    expectRefusal("vdb=0,1 ignore=0:block", 3, "is not in the scene");
}

TEST_F(CommandScenes, WhatIsNotExpectedIsExitCodeSix)
{
    writeText(
        path("way.csv"), "frame,body,x,y,z\n10,ring,90,0,0\n10,ball,180,0,0\n11,ball,90,0,0\n");
    EXPECT_EQ(ask("expect=touching").exitCode, 0);
    EXPECT_EQ(ask("expect=touching objects=1").exitCode, 0);
    EXPECT_EQ(ask("expect=apart ignore=0:1,0:2,1:2").exitCode, 0);
    const Result apart = ask("poses=way.csv expect=apart answers.csv");
    EXPECT_EQ(apart.exitCode, 6);
    EXPECT_TRUE(mentions(
        apart.err, "expect=apart does not hold in 1 of 2 frames, the first: frame 11 is touching"))
        << apart.err;
    EXPECT_TRUE(mentions(readText(path("answers.csv")), "\n11,ball,ring,touching,touching,"));
    const Result touching = ask("poses=way.csv expect=touching");
    EXPECT_TRUE(mentions(touching.err, "frame 10 is apart")) << touching.err;
    EXPECT_EQ(answers("blocks=1").at(0)["spheres"], "undecided");
    EXPECT_EQ(ask("blocks=1 expect=apart").exitCode, 6);
}

TEST_F(CommandScenes, ContactsOfPairsAreThoseOfEveryTwo)
{
    ASSERT_EQ(
        run("-quiet -read block.vdb ring.vdb -collide contacts=4 json=pair.json").exitCode, 0);
    const json pair = json::parse(readText(path("pair.json")))["answers"];
    ASSERT_EQ(pair.size(), 4u);
    std::size_t found = 0;
    for (const json& one : answers("contacts=4")) {
        if (one["body_a"] != "block" || one["body_b"] != "ring") continue;
        ASSERT_LT(found, pair.size());
        EXPECT_EQ(one["contact"], found);
        for (const char* same : {"distance", "x", "nx", "a", "b"}) {
            EXPECT_EQ(one[same], pair[found][same]) << same;
        }
        ++found;
    }
    EXPECT_EQ(found, pair.size());
    // They are lines, and no pairs.
    EXPECT_TRUE(mentions(ask("contacts=4").out, "; 3 trees, 3 pairs touching"));
    writeText(path("one.csv"), "body,x,y,z\nring,90,0,0\nball,190,0,0\n");
    const Result apart = ask("poses=one.csv contacts=4 csv=-");
    EXPECT_TRUE(mentions(apart.out, "\n0,,,apart,apart,,,,,,,,,,,\n")) << apart.out;
}

/// Block stands still, the others go along lines: as one sees the other, one moves.
TEST_F(CommandScenes, WaysFromFrameToFrameAreThoseOfEveryTwo)
{
    // Of ball and ring.
    const std::vector<std::array<Place, 2>> places = {{Place{60, 0, 0}, Place{0, 80, 0}},
        {Place{0, 1, 0}, Place{-60, 0, 3}}, {Place{-60, 2, 1}, Place{0, -2, 3}},
        {Place{-90, 0, 0}, Place{90, 0, 0}}};
    std::string scene = "frame,body,x,y,z,rx,ry,rz\n";
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t b = 0; b < 2; ++b) {
            scene += std::to_string(10 + i) + "," + kNames[b + 1] + "," + places[i][b].row();
        }
    }
    writeText(path("scene.csv"), scene);
    std::map<Texts, json> expected; // by frame and names
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
        const auto at = [&](int body, std::size_t i) {
            return body == 0 ? Place() : places[i][std::size_t(body - 1)];
        };
        std::string poses;
        for (std::size_t i = 0; i < places.size(); ++i) poses += at(b, i).seenFrom(at(a, i)).row();
        const Texts names = {kNames[std::size_t(a)], kNames[std::size_t(b)]};
        const json pair = pairAnswers(names, poses, "motion=1");
        for (const json& one : pair) {
            if (one["spheres"] != "touching") continue;
            expected[{std::to_string(10 + int(one["motion"])), names[0], names[1]}] = one;
        }
    }
    ASSERT_GE(expected.size(), 4u);
    expectAnswers("motion=1 poses=scene.csv", expected, {"spheres", "a", "b"},
        {"time", "free_until"}, 1e-5, "3 motions: ");
    // Between frames all are apart: only the ways tell.
    EXPECT_EQ(ask("poses=scene.csv vdb=ball,ring expect=apart").exitCode, 0);
    const Result meets = ask("motion=1 poses=scene.csv vdb=ball,ring expect=apart");
    EXPECT_EQ(meets.exitCode, 6);
    EXPECT_TRUE(mentions(meets.err, "the first: motion 11 is touching")) << meets.err;
    EXPECT_EQ(answers("motion=1 poses=scene.csv blocks=1").at(0)["spheres"], "undecided");
}

TEST_F(CommandScenes, WaysNeedFrames)
{
    expectRefusal("motion=1", 2, "motion=1 of a scene needs poses=");
    writeText(path("one.csv"), "body,x,y,z\nring,90,0,0\n");
    expectRefusal("motion=1 poses=one.csv", 3, "goes from frame to frame, and the file holds one");
    for (const char* other : {"contacts=2", "objects=1"}) {
        expectRefusal(std::string("motion=1 poses=one.csv ") + other, 2, "motion and ");
    }
    expectRefusal("poses=one.csv tolerance=1", 2, "add motion=1");
}

TEST_F(CommandScenes, QuestionsThatAreNoneAreRefusedWithTheReason)
{
    for (const char* other : {"translate=1,0,0", "scale=2"}) expectRefusal(other, 2, "scene and ");
    const std::string read = "-read block.vdb ball.vdb ring.vdb -collide ";
    EXPECT_TRUE(mentions(run(read + "ignore=0:1 vdb=0,1").err, "ignore is of a scene"));
    EXPECT_TRUE(mentions(run(read).err, "or ask all with scene=1"));
    const Result one = run("-read block.vdb -collide scene=1");
    EXPECT_EQ(one.exitCode, 3);
    EXPECT_TRUE(mentions(one.err, "asks two sphere-trees or more, and there is one")) << one.err;
    EXPECT_TRUE(mentions(run("-read a.vol -collide scene=1").err, "there is none"));
    expectRefusal("vdb=0,0", 3, "is named twice by vdb=");
    expectRefusal("level=0,0,0,0", 3, "names more levels than there are trees");
    EXPECT_EQ(ask("level=0,0,0").exitCode, 0);

    const std::vector<std::pair<std::string, std::string>> tables = {
        {"0 0 0\n", "line 1: a table of poses of bodies has a header"},
        {"x,y,z\n1,2,3\n", "line 1: the header names no column 'body'"},
        {"body,x,y\nball,1,2\n", "line 1: the header names no column 'z'"},
        {"body,x,y,z\nball,1,2,3\n\ncup,1,2,3\n", "line 4: there is no 'cup'"},
        {"body,x,y,z\n,1,2,3\n", "line 2: the line names no body"},
        {"body,x,y,z\nball,1,2,3\n1,4,5,6\n", "line 3: the tree '1' is placed twice in frame 0"},
        {"frame,body,x,y,z\n1,ball,1,2,3\n0,ring,1,2,3\n", "line 3: frame 0 stands behind frame 1"},
        {"frame,body,x,y,z\n0.5,ball,1,2,3\n", "line 2: frame 0.5: frames are whole numbers"},
        {"frame,body,x,y,z\nx,ball,1,2,3\n", "line 2: 'x' is no number"},
        {"body,m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23\nball,-1,0,0,0,0,1,0,0,0,0,1,0\n",
            "mirrors"},
        {"body,x,y,z,qx,qy,qz,qw\nball,1,2,3,0,0,0,2\n", "line 2: the quaternion"},
        {"body,x,y,z\n", "holds no poses of bodies"}};
    for (const auto& [text, message] : tables) {
        writeText(path("bad.csv"), text);
        expectRefusal("poses=bad.csv", 3, message);
        expectRefusal("poses=bad.csv", 3, "bad.csv: ");
    }
    writeText(path("bad.csv"), "body,x,y,z\nblock,1,2,3\n");
    expectRefusal("vdb=0,1 poses=bad.csv", 3, "bad.csv: line 2: sphere-tree 'block'");
}

TEST_F(CommandScenes, NamesThatAreNotEnoughGiveWayToAges)
{
    ASSERT_EQ(run("-read a.vol -spheretree name=a,\"b -write odd.vdb").exitCode, 0);
    const Result csv =
        run("-quiet -read ball.vdb -read ball.vdb -read odd.vdb -collide scene=1 csv=-");
    EXPECT_EQ(csv.exitCode, 0) << csv.err;
    EXPECT_TRUE(mentions(csv.out, "\n0,2,1,touching,")) << csv.out;
    EXPECT_TRUE(mentions(csv.out, "\n0,2,\"a,\"\"b\",touching,")) << csv.out;
    const Result help = run("-help collide");
    for (const char* part : {"scene=", "ignore=", "of scenes"}) {
        EXPECT_TRUE(mentions(help.out, part)) << help.out;
    }
}

} // namespace
