// SPDX-License-Identifier: Apache-2.0
// The Sphere-DAG and sphere-trees as text: which files there are, all or none; what -stats says.

#include "CommandRunner.h"

#include <nlohmann/json.hpp>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;
using nlohmann::json;

class CommandDag : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
    }
};

TEST_F(CommandDag, EdgesGoToATableBesideThatOfTheNodes)
{
    ASSERT_EQ(run("-read a.vol -spheretree tree=extended dag=1 -write t.csv t.json").exitCode, 0);
    const json tree = json::parse(readText(path("t.json")));
    std::string rows = "parent,child\n";
    for (const json& edge : tree.at("dag")) {
        rows +=
            std::to_string(edge[0].get<int>()) + ',' + std::to_string(edge[1].get<int>()) + '\n';
    }
    EXPECT_GT(tree.at("dag").size(), 1u);
    EXPECT_EQ(readText(path("t_dag.csv")), rows);
    EXPECT_EQ(files(), (std::vector<std::string>{"a.vol", "t.csv", "t.json", "t_dag.csv"}));
}

TEST_F(CommandDag, ATreeWithoutEdgesHasOneTable)
{
    ASSERT_EQ(run("-read a.vol -spheretree -write t.csv t.json").exitCode, 0);
    EXPECT_FALSE(exists("t_dag.csv"));
    EXPECT_TRUE(json::parse(readText(path("t.json"))).at("dag").is_null());
}

TEST_F(CommandDag, BothTablesAreWrittenOrNone)
{
    std::filesystem::create_directory(path("t_dag.csv"));
    const Result result = run("-read a.vol -spheretree tree=extended dag=1 -write t.csv");
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_NE(result.err.find("t_dag.csv"), std::string::npos) << result.err;
    EXPECT_FALSE(exists("t.csv"));
}

TEST_F(CommandDag, ATableMayNotStandWhereTheEdgesGo)
{
    const Result result = run("-read a.vol -spheretree tree=extended dag=1 -write t_dag.csv t.csv");
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_NE(result.err.find("t_dag.csv"), std::string::npos) << result.err;
    EXPECT_EQ(files(), std::vector<std::string>{"a.vol"});
}

TEST_F(CommandDag, AJsonNeedsATree)
{
    const Result result = run("-read a.vol -write t.json");
    EXPECT_EQ(result.exitCode, 3) << result.err;
    EXPECT_NE(result.err.find("t.json"), std::string::npos) << result.err;
    EXPECT_FALSE(exists("t.json"));
}

TEST_F(CommandDag, StatsCountTheEdges)
{
    const Result without = run("-read a.vol -spheretree -stats json=-");
    ASSERT_EQ(without.exitCode, 0) << without.err;
    EXPECT_TRUE(json::parse(without.out).at("dag").is_null());

    ASSERT_EQ(run("-read a.vol -spheretree dag=1 tree=reversible -write t.json").exitCode, 0);
    const json tree = json::parse(readText(path("t.json")));
    const Result with = run("-read a.vol -spheretree dag=1 tree=reversible -stats json=-");
    ASSERT_EQ(with.exitCode, 0) << with.err;
    const json dag = json::parse(with.out).at("dag");
    EXPECT_EQ(dag.at("edges"), tree.at("dag").size());
    EXPECT_EQ(dag.at("kind"), "shared");
    ASSERT_EQ(dag.at("levels").size() + 1, tree.at("levels").size());
    for (std::size_t k = 0; k < dag.at("levels").size(); ++k) {
        const json &level = tree.at("levels")[k], &counted = dag.at("levels")[k];
        int edges = 0, links = 0;
        for (const json& edge : tree.at("dag")) {
            if (edge[1] < level.at("begin") || edge[1] >= level.at("end")) continue;
            ++edges;
            links += tree.at("nodes")[edge[1].get<std::size_t>()][2] == edge[0];
        }
        const double size = level.at("end").get<double>() - level.at("begin").get<double>();
        EXPECT_EQ(counted.at("level"), level.at("level"));
        EXPECT_EQ(counted.at("edges"), edges);
        EXPECT_DOUBLE_EQ(counted.at("parents_per_child").at("mean").get<double>(), edges / size);
        EXPECT_DOUBLE_EQ(counted.at("tree_edges_in_dag_percent").get<double>(), 100 * links / size);
    }
}

} // namespace
