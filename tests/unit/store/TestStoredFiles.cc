// SPDX-License-Identifier: Apache-2.0
/// @file TestStoredFiles.cc
/// @brief Files that versions wrote (tests/data/<version>/README.md) are read as they were meant, and
/// written again as they were.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/store/SphereTreeCsv.h>
#include <openvdb_spheretree/store/SphereTreeJson.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include "support/DataFolder.h"
#include "support/SampleTrees.h"

#include <openvdb/io/Stream.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using nlohmann::json;
using openvdb::points::PointDataGrid;
using spheretree_test::expectSameTree;

std::string pathOf(const std::string& name) { return spheretree_test::dataPath(name); }

std::string textOf(const std::string& name)
{
    std::ifstream file(pathOf(name), std::ios::binary);
    EXPECT_TRUE(file) << "no file " << pathOf(name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The grids of a tree: its nodes, and its edges and cuts where it has them.
struct StoredTree {
    PointDataGrid::Ptr nodes, dag, cuts;

    /// @param name  with its version, "0.1/tight"
    explicit StoredTree(const std::string& name)
    {
        openvdb::initialize();
        std::istringstream bytes(spheretree_test::unpackedData(name + ".vdb"));
        const auto grids = openvdb::io::Stream(bytes, /*delayLoad=*/false).getGrids();
        const std::string treeName = name.substr(name.find('/') + 1);
        for (const openvdb::GridBase::Ptr& grid : *grids) {
            const auto points = openvdb::gridPtrCast<PointDataGrid>(grid);
            if (isSphereTree(*grid)) nodes = points;
            else if (isDagOf(*grid, treeName)) dag = points;
            else if (isCutsOf(*grid, treeName)) cuts = points;
            else ADD_FAILURE() << grid->getName() << " is no part of a tree";
        }
    }
    SphereTree tree() const { return fromPoints(*nodes, dag.get(), cuts.get()); }
};

/// Every member of @a expected is in @a actual, the same; there may be new ones, in levels too.
void expectMembers(const json& actual, const json& expected, const std::string& path)
{
    if (expected.is_array() && !expected.empty() && expected[0].is_object()) {
        ASSERT_EQ(actual.size(), expected.size()) << path;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            expectMembers(actual[i], expected[i], path + "/" + std::to_string(i));
        }
        return;
    }
    if (!expected.is_object()) {
        EXPECT_EQ(actual, expected) << path;
        return;
    }
    for (const auto& [key, value] : expected.items()) {
        ASSERT_TRUE(actual.contains(key)) << path << "/" << key;
        expectMembers(actual.at(key), value, path + "/" + key);
    }
}

/// Rows begin with the columns of the stored ones; there may be new columns behind them.
void expectColumns(const std::string& actual, const std::string& expected)
{
    std::istringstream rows(actual), stored(expected);
    std::string row, known;
    while (std::getline(stored, known)) {
        ASSERT_TRUE(std::getline(rows, row)) << known;
        ASSERT_EQ((row + ',').substr(0, known.size() + 1), known + ',');
    }
    EXPECT_FALSE(std::getline(rows, row)) << row;
}

/// Leaf nodes, attributes and metadata; but for what io::File itself adds.
void expectSameGrid(const PointDataGrid::Ptr& actual, const PointDataGrid::Ptr& stored)
{
    ASSERT_EQ(bool(actual), bool(stored));
    if (!stored) return;
    EXPECT_EQ(actual->getName(), stored->getName());
    EXPECT_EQ(actual->transform(), stored->transform());
    for (auto it = stored->beginMeta(); it != stored->endMeta(); ++it) {
        if (it->first.rfind("file_", 0) == 0 || it->first == "is_saved_as_half_float") continue;
        const openvdb::Metadata::Ptr meta = (*actual)[it->first];
        ASSERT_TRUE(meta) << it->first;
        EXPECT_TRUE(*meta == *it->second) << it->first << " is " << meta->str();
    }
    ASSERT_EQ(actual->tree().leafCount(), stored->tree().leafCount());
    auto other = actual->tree().cbeginLeaf();
    for (auto leaf = stored->tree().cbeginLeaf(); leaf; ++leaf, ++other) {
        ASSERT_EQ(leaf->origin(), other->origin());
        ASSERT_TRUE(leaf->getValueMask() == other->getValueMask());
        for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
            ASSERT_EQ(int(*voxel), int(other->getValue(voxel.pos())));
        }
        EXPECT_TRUE(leaf->attributeSet() == other->attributeSet()) << leaf->origin();
    }
}

class StoredFiles : public testing::TestWithParam<std::string> {};

TEST_P(StoredFiles, AreReadToEveryNodeLevelAndSetting)
{
    const std::string name = GetParam();
    const SphereTree tree = StoredTree(name).tree();
    std::ostringstream csv, text;
    writeCsv(tree, csv);
    expectColumns(csv.str(), textOf(name + ".csv"));
    writeJson(tree, text);
    expectMembers(json::parse(text.str()), json::parse(textOf(name + ".json")), "");
}

TEST_P(StoredFiles, AreWrittenAgainAsTheyWere)
{
    const StoredTree stored(GetParam());
    const SphereTree tree = stored.tree();
    expectSameGrid(toPoints(tree), stored.nodes);
    expectSameGrid(dagToPoints(tree), stored.dag);
    expectSameGrid(cutsToPoints(tree), stored.cuts);
}

TEST_P(StoredFiles, CarryAChecksumSinceVersion02)
{
    const std::string name = GetParam();
    const bool isOld = name.rfind("0.1/", 0) == 0;
    const StoredTree stored(name);
    for (const PointDataGrid::Ptr& grid : {stored.nodes, stored.dag, stored.cuts}) {
        EXPECT_TRUE(!grid || hasChecksum(*grid) != isOld) << grid->getName();
    }
}

std::vector<std::string> filesOf(const std::string& version)
{
    std::vector<std::string> names = {"tight", "tight_balls", "inner", "flat", "extended",
        "miniball", "reversible", "flat_reversible", "norm"};
    if (version != "0.1") {
        names.insert(
            names.end(), {"best", "bounds", "kept", "fit", "strict", "tracks", "given", "placed"});
    }
    for (std::string& name : names) name = version + "/" + name;
    return names;
}

std::string nameOf(const testing::TestParamInfo<std::string>& info)
{
    return info.param.substr(info.param.find('/') + 1);
}

INSTANTIATE_TEST_SUITE_P(Of01, StoredFiles, testing::ValuesIn(filesOf("0.1")), nameOf);
INSTANTIATE_TEST_SUITE_P(Of02, StoredFiles, testing::ValuesIn(filesOf("0.2")), nameOf);

TEST(StoredObjects, AVolumeHasTheTreesThatWereBuiltOfIt)
{
    for (const auto& [object, name] :
        {std::pair{"0.1/ring", "0.1/reversible"}, std::pair{"0.1/ring", "0.1/norm"},
            std::pair{"0.1/ring", "0.1/extended"}, std::pair{"0.1/flat", "0.1/flat_reversible"},
            std::pair{"0.2/handle", "0.2/reversible"}, std::pair{"0.2/handle", "0.2/norm"},
            std::pair{"0.2/handle", "0.2/extended"}, std::pair{"0.2/handle", "0.2/tight_balls"},
            std::pair{"0.2/star", "0.2/flat_reversible"}}) {
        SCOPED_TRACE(name);
        const SphereTree stored = StoredTree(name).tree();
        const auto mask = objectOf(*readVolFile(pathOf(std::string(object) + ".vol")));
        EXPECT_EQ(int64_t(mask->activeVoxelCount()), stored.object.voxels);
        std::ostringstream csv;
        writeCsv(buildSphereTree(*mask, stored.settings), csv);
        expectColumns(csv.str(), textOf(std::string(name) + ".csv"));
    }
}

/// The only grid of a file that is no tree.
openvdb::GridBase::Ptr gridOf(const std::string& name)
{
    openvdb::initialize();
    std::istringstream file(spheretree_test::unpackedData(name + ".vdb"));
    const auto grids = openvdb::io::Stream(file, /*delayLoad=*/false).getGrids();
    EXPECT_EQ(grids->size(), 1u);
    return grids->at(0);
}

TEST(StoredObjects, ALevelSetHasTheInsideThatItHad)
{
    for (const std::string name : {"0.1/levelset", "0.2/levelset"}) {
        SCOPED_TRACE(name);
        const auto object = objectOf(*gridOf(name));
        const SphereTreeSettings settings = ReversibleOptions();
        std::ostringstream csv;
        writeCsv(buildSphereTree(*object, settings), csv);
        expectColumns(csv.str(), textOf(name + ".csv"));
    }
}

TEST(StoredObjects, AMaskHasTheVoxelsThatItHad)
{
    const auto grid = gridOf("0.2/mask");
    EXPECT_EQ(grid->getName(), "mask");
    const auto stored = objectOf(*grid), object = objectOf(*readVolFile(pathOf("0.2/handle.vol")));
    EXPECT_EQ(stored->activeVoxelCount(), 60u);
    EXPECT_TRUE(stored->tree().hasSameTopology(object->tree()));
    EXPECT_EQ(stored->transform(), object->transform());
}

TEST(StoredObjects, ATreeOfNothingIsKnownForOne)
{
    const auto grid = gridOf("0.2/empty");
    EXPECT_TRUE(isEmptyTree(*grid));
    EXPECT_FALSE(isSphereTree(*grid));
    SphereTree tree;
    tree.settings.name = "empty";
    tree.transform = grid->transform().copy();
    expectSameGrid(emptyTreeToPoints(tree), openvdb::gridPtrCast<PointDataGrid>(grid));
}

} // namespace
