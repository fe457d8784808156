// SPDX-License-Identifier: Apache-2.0
// Trees by the number of their spheres, inside the object and outside of it, and smallest spheres
// around what is below: as typed, and as -stats tells of them.

#include "CommandRunner.h"

#include <nlohmann/json.hpp>

namespace {

using command_test::CommandTest;
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

} // namespace
