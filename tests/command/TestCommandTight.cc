// SPDX-License-Identifier: Apache-2.0
// Trees by the number of their spheres, inside the object and outside of it, and smallest spheres
// around what is below: as typed, and as -stats tells of them.

#include "CommandRunner.h"

#include <openvdb_spheretree/input/spheres/SphereFile.h>

#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <sstream>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;

class CommandTight : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
    }

    nlohmann::json statsOf(const std::string& options) const
    {
        const Result result = run("-read a.vol -spheretree " + options + " -stats json=-");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return nlohmann::json::parse(result.out);
    }

    /// Spheres of each level, the finest first.
    static std::vector<int> spheresOf(const nlohmann::json& stats)
    {
        std::vector<int> spheres;
        for (const auto& level : stats["levels"]) spheres.push_back(level["spheres"]);
        return spheres;
    }

    /// What was said while the line ran.
    std::string notes(const std::string& line) const
    {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    }
};

TEST_F(CommandTight, InnerSpheresCoverMoreFromLevelToLevelAndNothingElse)
{
    const auto stats = statsOf("tree=tight side=inner branching=2");
    const auto& levels = stats["levels"];
    ASSERT_GT(levels.size(), 2u);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const int covered = levels[k]["covered"], missing = levels[k]["missing"];
        EXPECT_EQ(levels[k]["excess"], 0);
        EXPECT_EQ(levels[k]["hausdorff"], 0);
        EXPECT_EQ(covered + missing, kBlockVoxels);
        EXPECT_NEAR(double(levels[k]["covered_percent"]), 100.0 * covered / kBlockVoxels, 1e-9);
        EXPECT_LT(covered, k == 0 ? kBlockVoxels + 1 : int(levels[k - 1]["covered"]));
    }
    EXPECT_EQ(levels[0]["missing"], 0) << "all leaves are the object";
    EXPECT_EQ(spheresOf(stats).back(), 1);
}

TEST_F(CommandTight, TheTableOfInnerSpheresShowsTheCoveredShare)
{
    const Result result = run("-read a.vol -spheretree tree=tight side=inner spheres=1,3 -stats");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("tight, side inner, 4 spheres"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("covered %"), std::string::npos);
    EXPECT_NE(result.out.find("the level has no voxels of its own"), std::string::npos);
    const Result outer = run("-read a.vol -spheretree -stats");
    EXPECT_EQ(outer.out.find("covered %"), std::string::npos);
    EXPECT_FALSE(statsOf("")["levels"][0].contains("covered_percent"));
}

TEST_F(CommandTight, StrictInnerSpheresLieInTheSolid)
{
    writeGrids("ball.vdb", {sphereGrid("ball", 12)});
    const std::string build = "-read ball.vdb -spheretree side=inner spheres=6 strict=1 keep=1";
    const Result strict = run(build + " -check -write t.csv");
    EXPECT_EQ(strict.exitCode, 0) << strict.err;
    const auto spheres = openvdb_spheretree::readSphereFile(path("t.csv"));
    ASSERT_GT(spheres.size(), 0u);
    double farthest = 0;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const double apart = (spheres.center[i] - openvdb::Vec3d(0.5, 1, -2)).length();
        farthest = std::max(farthest, apart + spheres.radius[i]);
    }
    EXPECT_LE(farthest, 12) << "the radius of the ball";
    EXPECT_GT(farthest, 11);
    const Result outer = run("-read ball.vdb -spheretree strict=1 -write u.vdb");
    EXPECT_EQ(outer.exitCode, 2);
    EXPECT_NE(outer.err.find("strict=1 is for side=inner"), std::string::npos) << outer.err;
    const Result other = run("-read ball.vdb -spheretree extended strict=1 -write u.vdb");
    EXPECT_NE(other.err.find("is for tree=tight"), std::string::npos) << other.err;
}

TEST_F(CommandTight, NearestSpheresHaveTheErrorsThatTheyAreStoredWith)
{
    const Result built = run("-read a.vol -spheretree side=fit spheres=5,2 keep=1 -stats "
                             "json=s.json -check -write t.vdb");
    EXPECT_EQ(built.exitCode, 0) << built.err;
    const auto stats = nlohmann::json::parse(readText(path("s.json")));
    EXPECT_EQ(stats["settings"]["side"], "fit");
    EXPECT_EQ(spheresOf(stats), (std::vector<int>{5, 2}));
    const double voxels = stats["object"]["voxels"];
    for (const auto& level : stats["levels"]) {
        EXPECT_EQ(level["stored_hamming_percent"], level["hamming_percent"]);
        const double covered = level["covered"], excess = level["excess"];
        EXPECT_NEAR(level["dice"], 2 * (covered - excess) / (voxels + covered), 1e-12);
    }
    EXPECT_LE(double(stats["levels"][0]["hamming_percent"]),
        double(stats["levels"][1]["hamming_percent"]));
    const Result checked = run("-read a.vol -read t.vdb -check");
    EXPECT_EQ(checked.exitCode, 0) << checked.err;
    const Result table = run("-read t.vdb -stats");
    EXPECT_NE(table.out.find("side fit"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("  dice\n"), std::string::npos) << table.out;
    EXPECT_EQ(run("-read a.vol -spheretree -stats").out.find("dice"), std::string::npos);
}

TEST_F(CommandTight, ABoundOnTheErrorIsKeptByTheFewestNearestSpheres)
{
    const Result built = run("-read a.vol -spheretree side=fit error=20 -stats json=s.json");
    EXPECT_EQ(built.exitCode, 0) << built.err;
    const auto level = nlohmann::json::parse(readText(path("s.json")))["levels"][0];
    EXPECT_LE(double(level["stored_hamming_percent"]), 20);
    const int spheres = level["spheres"];
    ASSERT_GT(spheres, 1);
    const auto fewer = statsOf("side=fit spheres=" + std::to_string(spheres - 1))["levels"][0];
    EXPECT_GT(double(fewer["stored_hamming_percent"]), 20);
    const Result few = run("-read a.vol -spheretree side=fit error=0.1 spheres=1 -stats");
    EXPECT_EQ(few.exitCode, 3) << few.err;
    EXPECT_NE(few.err.find("error=0.1 cannot be reached with spheres=1"), std::string::npos)
        << few.err;
}

TEST_F(CommandTight, LevelsHaveTheSpheresAskedFor)
{
    EXPECT_EQ(spheresOf(statsOf("tree=tight side=inner spheres=2,5")), (std::vector<int>{5, 2}));
    EXPECT_EQ(spheresOf(statsOf("tree=tight side=inner spheres=5,2,5")), (std::vector<int>{5, 2}));
    const auto all = spheresOf(statsOf("tree=tight side=inner"));
    EXPECT_EQ(spheresOf(statsOf("tree=tight side=inner branching=8")), all);
}

TEST_F(CommandTight, MoreSpheresThanThereAreLeavesGivesAllOfThemAndSaysSo)
{
    const std::string all = std::to_string(spheresOf(statsOf("tree=tight side=inner"))[0]);
    const std::string tree = "-read a.vol -spheretree tree=tight side=inner ";
    const std::string said = "spheres=9999 is more than there are: all " + all + " are";
    EXPECT_NE(notes(tree + "spheres=2,9999").find(said), std::string::npos);
    EXPECT_EQ(notes(tree + "spheres=2").find("more than there are"), std::string::npos);
    EXPECT_EQ(spheresOf(statsOf("tree=tight side=inner spheres=9999"))[0], std::stoi(all));
    EXPECT_NE(notes(tree + "-level spheres=9999").find(said), std::string::npos);
    EXPECT_NE(notes(tree + "cuts=1 -level spheres=9999").find(said), std::string::npos);
    EXPECT_EQ(notes(tree + "cuts=1 -level spheres=3").find("more than"), std::string::npos);
}

TEST_F(CommandTight, ALevelByItsSpheresIsACutWhereTheTreeHasThem)
{
    EXPECT_EQ(spheresOf(statsOf("tree=tight side=inner spheres=2 cuts=1 -level spheres=3")),
        std::vector<int>{3});
    EXPECT_EQ(spheresOf(statsOf("tree=tight side=inner spheres=2,5 -level spheres=3")),
        std::vector<int>{2})
        << "without cuts: the finest level with at most as many";
    const std::string said =
        notes("-read a.vol -spheretree side=inner spheres=2,5 -level spheres=3");
    EXPECT_NE(said.find("spheres=3: the level with at most as many has 2"), std::string::npos);
    const Result none =
        run("-read a.vol -spheretree tree=tight side=inner spheres=5 -level spheres=3");
    EXPECT_EQ(none.exitCode, 3);
    EXPECT_NE(none.err.find("no level has at most 3 spheres"), std::string::npos) << none.err;
}

TEST_F(CommandTight, ABoundIsOneOfStoredSpheres)
{
    writeGrids("ball.vdb", {sphereGrid("ball", 12)});
    const std::string make = "-read ball.vdb -spheretree quality=fast ";
    const auto levelOf = [&](const std::string& options) {
        const Result result = run(make + options + " -stats json=-");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return nlohmann::json::parse(result.out)["levels"][0];
    };
    EXPECT_LE(double(levelOf("distance=3vox")["stored_reach"]), 3.0);
    EXPECT_LE(double(levelOf("error=60")["stored_hamming_percent"]), 60.0);
    EXPECT_LE(double(levelOf("error=0 bounds=unpadded")["hamming_percent"]), 0.0);
    const Result loose = run(make + "distance=0.1 -write t.vdb");
    EXPECT_EQ(loose.exitCode, 3) << loose.err;
    EXPECT_NE(loose.err.find("distance=0.1 cannot be reached: padding=cubes"), std::string::npos)
        << loose.err;
    const Result unit = run(make + "distance=5mm -write t.vdb");
    EXPECT_EQ(unit.exitCode, 2) << unit.err;
    EXPECT_NE(unit.err.find("units=mm, or write the number alone"), std::string::npos) << unit.err;
    const Result none = run(make + "bounds=unpadded -write t.vdb");
    EXPECT_EQ(none.exitCode, 2) << none.err;
    EXPECT_NE(none.err.find("add error= or distance="), std::string::npos) << none.err;
}

TEST_F(CommandTight, ADistanceHasAUnitWhereTheObjectHasOne)
{
    writeGrids("ball.vdb", {sphereGrid("ball", 12)});
    const auto settingOf = [&](const std::string& read, const std::string& distance) {
        const Result result = run("-quiet -read ball.vdb" + read
            + " -spheretree distance=" + distance + " -stats json=-");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return nlohmann::json::parse(result.out)["settings"]["distance"];
    };
    EXPECT_EQ(settingOf(" units=mm", "3mm"), settingOf(" units=mm", "0.003"));
    EXPECT_EQ(settingOf(" units=m", "300cm"), settingOf(" units=m", "3"));
    EXPECT_EQ(settingOf(" units=m", "3e2cm"), settingOf("", "3"));
    for (const char* line : {"-generate ball voxels=1e4 -spheretree distance=5mm -write t.vdb",
             "-read ball.vdb units=mm -read ball.vdb -spheretree distance=5mm -write t.vdb",
             "-read ball.vdb scale=0.001 -spheretree distance=5mm -write t.vdb"}) {
        EXPECT_EQ(run(line).exitCode, 2) << line;
    }
    EXPECT_EQ(run("-read ball.vdb units=m -resample voxel=50cm -write v.vdb").exitCode, 0);
    EXPECT_EQ(readGrids("v.vdb").at(0)->voxelSize()[0], 0.5);
    EXPECT_EQ(run("-read ball.vdb -resample voxel=50cm -write v.vdb").exitCode, 2);
    EXPECT_EQ(run("-read ball.vdb units=mm -spheretree distance=5mi -write t.vdb").exitCode, 2);
}

TEST_F(CommandTight, StatsSayWhatPaddingAdds)
{
    const Result padded = run("-read a.vol -spheretree -stats");
    EXPECT_NE(padded.out.find("stored radii are 0.87 voxel (0.866 world units) larger"),
        std::string::npos)
        << padded.out;
    EXPECT_NE(padded.out.find("stored %"), std::string::npos);
    const Result bare = run("-read a.vol -spheretree padding=voxels -stats");
    EXPECT_EQ(bare.out.find("stored radii"), std::string::npos) << bare.out;
    const auto level = statsOf("padding=voxels")["levels"][0];
    EXPECT_EQ(level["stored_hamming_percent"], level["hamming_percent"]);
    EXPECT_GT(double(statsOf("")["levels"][0]["stored_hamming_percent"]), 0.0);
}

TEST_F(CommandTight, ErrorsOfALevelThatWasTakenOutAreCountedWithTheObjectAtHand)
{
    ASSERT_EQ(run("-read a.vol -spheretree quality=fast cuts=1 -write cuts.vdb").exitCode, 0);
    const std::string level = " cuts.vdb -level spheres=3 -stats";
    const Result alone = run("-read" + level);
    EXPECT_NE(
        alone.out.find("-stats counts them where the object is on the stack"), std::string::npos)
        << alone.out;
    const Result both = run("-read a.vol" + level);
    EXPECT_EQ(both.exitCode, 0) << both.err;
    EXPECT_EQ(both.out.find("not counted"), std::string::npos) << both.out;
    writeGrids("ball.vdb", {sphereGrid("ball", 12)});
    const Result other = run("-read ball.vdb" + level);
    EXPECT_EQ(other.exitCode, 0) << other.err;
    EXPECT_NE(other.out.find("errors were not counted"), std::string::npos)
        << "of another object: " << other.out;
}

/// `script` runs its command in a terminal of its own.
TEST_F(CommandTight, TablesFitATerminal)
{
    if (!isInstalled("script")) GTEST_SKIP() << "needs script";
    const auto linesOf = [&](int columns) {
        const Result result = shell("script -qec \"stty cols " + std::to_string(columns)
            + "; $VDB_SPHERETREE -quiet -read a.vol -spheretree -stats\" /dev/null");
        std::vector<std::string> lines;
        std::istringstream text(result.out);
        for (std::string line; std::getline(text, line);) {
            while (!line.empty() && line.back() == '\r') line.pop_back();
            if (line.find("level  ") == 0) lines.push_back(line);
        }
        return lines;
    };
    const auto narrow = linesOf(80), wide = linesOf(200);
    ASSERT_EQ(wide.size(), 1u);
    EXPECT_GT(wide[0].size(), 80u);
    ASSERT_EQ(narrow.size(), 2u);
    for (const std::string& line : narrow) EXPECT_LE(line.size(), 80u) << line;
    EXPECT_NE(narrow[1].find("hausdorff"), std::string::npos) << narrow[1];
    EXPECT_GT(linesOf(40).size(), 2u);
    const Result piped = run("-read a.vol -spheretree -stats");
    EXPECT_NE(piped.out.find(wide[0]), std::string::npos) << piped.out;
}

TEST_F(CommandTight, SmallestSpheresCoverTheObjectWithLessExcess)
{
    for (const std::string tree : {"extended", "reversible"}) {
        const auto medial = statsOf(tree), miniball = statsOf(tree + " center=miniball");
        EXPECT_EQ(spheresOf(miniball), spheresOf(medial));
        for (std::size_t k = 0; k < medial["levels"].size(); ++k) {
            EXPECT_EQ(miniball["levels"][k]["missing"], 0);
        }
        EXPECT_LT(double(miniball["levels"].back()["hamming_percent"]),
            double(medial["levels"].back()["hamming_percent"]));
        const Result table =
            run("-read a.vol -spheretree " + tree + " center=miniball -stats -write t.csv");
        EXPECT_NE(table.out.find("center miniball"), std::string::npos) << table.out;
        EXPECT_EQ(table.exitCode, 0) << table.err;
    }
}

TEST_F(CommandTight, HelpNamesEveryOptionAndTheTreesThatItIsFor)
{
    const std::string help = run("-help spheretree").out;
    for (const char* option : {"quality=", "spheres=", "branching=", "error=", "distance=",
             "cover=", "leaves=", "cuts=", "side=", "center=", "memory="}) {
        EXPECT_NE(help.find("    " + std::string(option)), std::string::npos) << option;
    }
}

/// The finest level may lack one sphere, a coarser one a quarter of them.
TEST_F(CommandTight, LevelsOfFewerSpheresThanWereAskedForAreTold)
{
    const Result result =
        run("-generate noise voxels=3000 -spheretree spheres=24,8,3 quality=fast -stats json=-");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const std::vector<int> asked{24, 8, 3};
    const std::vector<int> there = spheresOf(nlohmann::json::parse(result.out));
    ASSERT_EQ(there.size(), asked.size());
    int told = 0;
    for (std::size_t k = 0; k < asked.size(); ++k) {
        const bool isShort = k == 0 ? there[k] < asked[k] : there[k] < asked[k] - asked[k] / 4;
        const std::string note = "note: " + std::to_string(there[k]) + " sphere"
            + (there[k] == 1 ? " does" : "s do") + " for spheres=" + std::to_string(asked[k])
            + ": with more, nothing better was found";
        EXPECT_EQ(result.err.find(note) != std::string::npos, isShort) << result.err;
        told += isShort;
    }
    EXPECT_GT(told, 0);
}

} // namespace
