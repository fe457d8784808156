// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereTreeJson.cc
/// @brief Trees as JSON, read back by a parser that is not ours: every number is the tree's.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/store/JsonWriter.h>
#include <openvdb_spheretree/store/SphereTreeJson.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/store/SphereTreeCsv.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>

#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

using namespace openvdb_spheretree;
using namespace spheretree_test;
using nlohmann::json;

namespace {

std::string textOf(const SphereTree& tree)
{
    std::ostringstream out;
    writeJson(tree, out);
    return out.str();
}

json coordOf(const openvdb::Coord& ijk) { return {ijk[0], ijk[1], ijk[2]}; }

void expectObject(const json& object, const SphereTree& tree)
{
    EXPECT_EQ(object.size(), 8u);
    EXPECT_EQ(object.at("name"), tree.object.name);
    EXPECT_EQ(object.at("voxels"), tree.object.voxels);
    EXPECT_EQ(object.at("leaves"), tree.object.leaves);
    EXPECT_EQ(object.at("tiles"), tree.object.tiles);
    EXPECT_EQ(object.at("bbox_min"), coordOf(tree.object.bbox.min()));
    EXPECT_EQ(object.at("bbox_max"), coordOf(tree.object.bbox.max()));
    EXPECT_EQ(object.at("voxel_size"), tree.voxelSize());
    EXPECT_EQ(object.at("origin"), coordOf(tree.origin));
}

json orNull(const std::optional<double>& value) { return value ? json(*value) : json(); }

void expectSettings(const json& written, const SphereTree& tree)
{
    const SphereTreeSettings& settings = tree.settings;
    const auto pyramid = optionsOr<PyramidOptions>(settings);
    const auto extended = optionsOr<ExtendedOptions>(settings);
    const auto tight = optionsOr<TightOptions>(settings);
    const json expected = {{"tree", toString(settings.type())}, {"factor", pyramid.factor},
        {"dim", settings.dim}, {"model", modelToString(pyramid)}, {"dist", toString(pyramid.dist)},
        {"parent", toString(pyramid.parent)}, {"final_fit", extended.finalFit},
        {"reconstruct", toString(extended.reconstruct)}, {"scale", toString(pyramid.scale)},
        {"padding", paddingToString(settings.padding)}, {"dag", tree.hasDag},
        {"edges", toString(pyramid.edges)}, {"topology", settings.topology},
        {"center", toString(pyramid.center)}, {"quality", toString(tight.quality)},
        {"spheres", tight.budget.spheres}, {"branching", tight.budget.branching},
        {"error", orNull(tight.budget.error)}, {"distance", orNull(tight.budget.distance)},
        {"bounds", tight.budget.bounds == BoundOf::Stored ? "stored" : "unpadded"},
        {"cover", toString(tight.cover)}, {"leaves", toString(tight.leaves)}, {"side", "outer"},
        {"cuts", tree.hasCuts}, {"name", settings.name},
        {"origin", pyramid.origin ? json(originToString(pyramid.origin)) : json()},
        {"strict", optionsOr<InnerOptions>(settings).strict}};
    EXPECT_EQ(written, expected);
}

json levelOf(const SphereTreeLevel& level)
{
    json result = {{"level", level.level}, {"begin", level.begin}, {"end", level.end},
        {"pyramid_voxels", level.pyramidVoxels}, {"topology", nullptr}, {"covered", nullptr},
        {"excess", nullptr}, {"missing", nullptr}, {"hamming_percent", nullptr},
        {"hausdorff", nullptr}, {"stored_hamming_percent", nullptr}, {"stored_reach", nullptr}};
    if (level.stored) {
        result["stored_hamming_percent"] = level.stored->hammingPercent;
        result["stored_reach"] = level.stored->reachWorld;
    }
    if (!level.storedUnknown.empty()) result["stored_unknown"] = level.storedUnknown;
    if (level.topology) {
        result["topology"] = {{"components", level.topology->components},
            {"tunnels", level.topology->tunnels}, {"cavities", level.topology->cavities}};
    }
    if (level.error) {
        result["covered"] = level.error->covered;
        result["excess"] = level.error->excess;
        result["missing"] = level.error->missing;
        result["hamming_percent"] = level.error->hammingPercent;
        result["hausdorff"] = level.error->hausdorff;
    } else {
        result["error_unknown"] = level.errorUnknown.empty() ? "not computed" : level.errorUnknown;
    }
    return result;
}

/// By name, so that a column and its name cannot part.
void expectNode(const json& columns, const json& row, const SphereTree& tree, int32_t id)
{
    const int level = tree.levelOf(id);
    const openvdb::Vec3d world = tree.transform->indexToWorld(tree.spheres.center[id]);
    const bool levelGrid = level > 0 && tree.radiusSq[id] > 0;
    const openvdb::Coord ijk =
        levelGrid ? tree.ijk[id] : openvdb::Coord::round(tree.spheres.center[id]);
    const json expected = {{"level", level}, {"id", id}, {"parent", tree.spheres.parent[id]},
        {"x", world[0]}, {"y", world[1]}, {"z", world[2]},
        {"radius", double(tree.spheres.radiusWorld[id])}, {"i", ijk[0]}, {"j", ijk[1]},
        {"k", ijk[2]}, {"radius_sq", tree.radiusSq[id]}, {"index_x", tree.spheres.center[id][0]},
        {"index_y", tree.spheres.center[id][1]}, {"index_z", tree.spheres.center[id][2]},
        {"radius_voxels", tree.spheres.radius[id]}, {"cover_sq", tree.spheres.coverRadiusSq[id]}};
    json found = json::object();
    ASSERT_EQ(row.size(), columns.size());
    for (std::size_t i = 0; i < row.size(); ++i) found[columns[i].get<std::string>()] = row[i];
    ASSERT_EQ(found, expected);
}

void expectDag(const json& dag, const SphereTree& tree)
{
    if (!tree.hasDag && tree.dag.empty()) {
        EXPECT_TRUE(dag.is_null());
        return;
    }
    ASSERT_TRUE(dag.is_array());
    ASSERT_EQ(dag.size(), tree.dag.size());
    for (std::size_t i = 0; i < dag.size(); ++i) {
        ASSERT_EQ(dag[i], json({tree.dag[i].parent, tree.dag[i].child}));
    }
}

void expectCuts(const json& written, const SphereTree& tree)
{
    const SphereCuts& cuts = tree.cuts;
    if (cuts.empty()) {
        EXPECT_TRUE(written.is_null());
        return;
    }
    const json& columns = written.at("columns");
    ASSERT_EQ(written.at("nodes").size(), std::size_t(cuts.size()));
    for (int32_t id = 0; id < cuts.size(); ++id) {
        const json& row = written.at("nodes")[std::size_t(id)];
        const openvdb::Vec3d& center = cuts.spheres.center[id];
        const openvdb::Vec3d world = tree.transform->indexToWorld(center);
        const json expected = {{"id", id}, {"parent", cuts.spheres.parent[id]},
            {"first", cuts.first[id]}, {"last", cuts.last[id]}, {"x", world[0]}, {"y", world[1]},
            {"z", world[2]}, {"radius", double(cuts.spheres.radiusWorld[id])},
            {"index_x", center[0]}, {"index_y", center[1]}, {"index_z", center[2]},
            {"radius_voxels", cuts.spheres.radius[id]},
            {"cover_sq", cuts.spheres.coverRadiusSq[id]}};
        json found = json::object();
        ASSERT_EQ(row.size(), columns.size());
        for (std::size_t i = 0; i < row.size(); ++i) found[columns[i].get<std::string>()] = row[i];
        ASSERT_EQ(found, expected);
    }
}

void expectAll(const SphereTree& tree)
{
    const json read = json::parse(textOf(tree));
    EXPECT_EQ(read.size(), 10u);
    EXPECT_EQ(read.at("format"), "vdb_spheretree.tree.1");
    expectObject(read.at("object"), tree);
    expectSettings(read.at("settings"), tree);
    json levels = json::array();
    for (const SphereTreeLevel& level : tree.levels) levels.push_back(levelOf(level));
    EXPECT_EQ(read.at("levels"), levels);
    ASSERT_EQ(read.at("nodes").size(), std::size_t(tree.size()));
    for (int32_t id = 0; id < tree.size(); ++id) {
        expectNode(read.at("columns"), read.at("nodes")[std::size_t(id)], tree, id);
    }
    expectDag(read.at("dag"), tree);
    expectCuts(read.at("cuts"), tree);
    EXPECT_EQ(read.at("subdivision"), tree.subdivision);

    // Rows for row vectors: a point of index space times the matrix is the point of the world.
    const std::vector<double> m = read.at("transform").get<std::vector<double>>();
    ASSERT_EQ(m.size(), 16u);
    const openvdb::Vec3d p(7, -3, 11), world = tree.transform->indexToWorld(p);
    for (int c = 0; c < 3; ++c) {
        const double product = p[0] * m[c] + p[1] * m[4 + c] + p[2] * m[8 + c] + m[12 + c];
        EXPECT_NEAR(product, world[c], 1e-9 * (1 + std::abs(world[c])));
    }
}

/// Refuses everything.
class NoDisk : public std::streambuf {};

} // namespace

TEST(SphereTreeJson, HoldsEveryNumberOfTheTree)
{
    for (const SphereTree& tree :
        {oneVoxelTree(), sampleTree(), tightSampleTree(), randomTree(3000, 7)}) {
        expectAll(tree);
    }
}

TEST(SphereTreeJson, HoldsTreesThatWereBuilt)
{
    for (uint32_t seed = 0; seed < 12; ++seed) {
        const auto object = gridOf(randomObject(seed).voxels);
        object->setTransform(openvdb::math::Transform::createLinearTransform(0.3));
        object->transform().postRotate(0.7, openvdb::math::Y_AXIS);
        object->transform().postTranslate({1e3, -0.1, 5});
        SphereTreeSettings settings;
        setType(settings, seed % 2 ? TreeType::Extended : TreeType::Reversible);
        settings.pyramid().dag = seed % 3 != 0;
        settings.topology = seed % 4 != 0;
        SphereTree tree = buildSphereTree(*object, settings);
        if (seed % 5 != 0) computeLevelErrors(tree, *object);
        expectAll(tree);
    }
}

TEST(SphereTreeJson, ADagWithoutEdgesIsAnEmptyArray)
{
    SphereTree tree = oneVoxelTree();
    EXPECT_TRUE(json::parse(textOf(tree)).at("dag").is_null());
    tree.hasDag = true;
    EXPECT_EQ(json::parse(textOf(tree)).at("dag"), json::array());
}

TEST(SphereTreeJson, NumbersThatJsonDoesNotHaveAreNull)
{
    JsonWriter json;
    json.beginArray("", /*onOneLine=*/true);
    for (const double number : {1.5, std::nan(""), HUGE_VAL, -HUGE_VAL}) json.value("", number);
    json.endArray();
    EXPECT_EQ(nlohmann::json::parse(json.text()).dump(), "[1.5,null,null,null]");
}

TEST(SphereTreeJson, TextComesBackWhateverItHolds)
{
    std::string text;
    for (int byte = 0; byte < 128; ++byte) text.push_back(char(byte));
    JsonWriter json;
    json.beginArray("", /*onOneLine=*/true);
    json.value("", text);
    json.endArray();
    EXPECT_EQ(nlohmann::json::parse(json.text()).at(0).get<std::string>(), text);
}

TEST(SphereTreeJson, AFullDiskIsAnError)
{
    for (const SphereTree& tree : {oneVoxelTree(), randomTree(5000, 8)}) {
        NoDisk disk;
        std::ostream out(&disk);
        messageOf<openvdb::IoError>([&] { writeJson(tree, out); });
    }
}

TEST(SphereTreeCsv, TheEdgesAreARowEach)
{
    for (const SphereTree& tree : {oneVoxelTree(), sampleTree()}) {
        std::ostringstream out;
        writeDagCsv(tree, out);
        std::string expected = "parent,child\n";
        for (const DagEdge& edge : tree.dag) {
            expected += std::to_string(edge.parent) + ',' + std::to_string(edge.child) + '\n';
        }
        EXPECT_EQ(out.str(), expected);
    }
    NoDisk disk;
    std::ostream out(&disk);
    messageOf<openvdb::IoError>([&] { writeDagCsv(sampleTree(), out); });
}
