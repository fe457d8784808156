// SPDX-License-Identifier: Apache-2.0
/// @file TestTreeViewer.cc
/// @brief The page as text: its numbers are the tree's, names cannot become HTML, it is small and asks
/// for nothing else. What browsers make of it is in TestCommandViewer.cc.

#include "support/BuiltTrees.h"
#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/viewer/TreeViewer.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <cstring>
#include <regex>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using nlohmann::json;

std::string pageOf(const SphereTree& tree, const openvdb::BoolGrid* object = nullptr,
    const ViewerSettings& settings = {})
{
    detail::TextStream out;
    writeViewer(tree, object, settings, out);
    return out.str();
}

/// The text of the element with this id; nothing if there is none.
std::string elementOf(const std::string& page, const std::string& id)
{
    const std::string start = "id=\"" + id + "\">";
    const size_t at = page.find(start);
    if (at == page.npos) return {};
    const size_t begin = at + start.size();
    return page.substr(begin, page.find("</script>", begin) - begin);
}

json descriptionOf(const std::string& page) { return json::parse(elementOf(page, "tree")); }

template <typename Number>
std::vector<Number> arrayOf(const std::string& page, const std::string& id)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    uint32_t bits = 0;
    int count = 0;
    for (const char c : elementOf(page, id)) {
        if (c == '=') break;
        bits = bits << 6 | uint32_t(digits.find(c));
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes += char(bits >> count & 255);
    }
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
    return numbers;
}

void expectSpheres(const std::string& page, const std::string& name, const Spheres& spheres,
    const openvdb::math::Transform& transform)
{
    std::vector<double> centers;
    for (const auto& center : spheres.center) {
        const auto world = transform.indexToWorld(center);
        centers.insert(centers.end(), {world[0], world[1], world[2]});
    }
    EXPECT_EQ(arrayOf<double>(page, name + "-center"), centers);
    EXPECT_EQ(arrayOf<float>(page, name + "-radius"), spheres.radiusWorld);
    EXPECT_EQ(arrayOf<int32_t>(page, name + "-parent"), spheres.parent);
}

openvdb::BoolGrid::Ptr block()
{
    const auto grid = openvdb::BoolGrid::create(false);
    grid->denseFill(openvdb::CoordBBox(Coord(0), Coord(9, 7, 5)), true);
    grid->setName("block");
    return grid;
}

int countOf(const std::string& text, const std::string& part)
{
    int count = 0;
    for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(TreeViewer, HasTheNumbersOfTheTree)
{
    for (const SphereTree& tree : {sampleTree(), tightSampleTree(), oneVoxelTree()}) {
        const std::string page = pageOf(tree);
        expectSpheres(page, "nodes", tree.spheres, *tree.transform);
        const json description = descriptionOf(page);
        EXPECT_EQ(description.at("name"), tree.settings.name);
        EXPECT_EQ(description.at("object").at("name"), tree.object.name);
        ASSERT_EQ(description.at("levels").size(), tree.levels.size());
        for (size_t k = 0; k < tree.levels.size(); ++k) {
            const json& level = description.at("levels").at(k);
            EXPECT_EQ(level.at("level"), tree.levels[k].level);
            EXPECT_EQ(level.at("begin"), tree.levels[k].begin);
            EXPECT_EQ(level.at("end"), tree.levels[k].end);
            const auto& error = tree.levels[k].error;
            EXPECT_EQ(level.at("hamming_percent"), error ? json(error->hammingPercent) : json());
        }
        EXPECT_EQ(description.at("surface"), json());
    }
}

TEST(TreeViewer, HasCutsWhereTheTreeHasThem)
{
    const SphereTree tree = tightSampleTree();
    const std::string page = pageOf(tree);
    expectSpheres(page, "cuts", tree.cuts.spheres, *tree.transform);
    EXPECT_EQ(arrayOf<int32_t>(page, "cuts-first"), tree.cuts.first);
    EXPECT_EQ(arrayOf<int32_t>(page, "cuts-last"), tree.cuts.last);
    EXPECT_TRUE(descriptionOf(page).at("has_cuts"));
    const std::string without = pageOf(sampleTree());
    EXPECT_FALSE(descriptionOf(without).at("has_cuts"));
    EXPECT_EQ(elementOf(without, "cuts-first"), "");
}

TEST(TreeViewer, HasTheSurfaceOfTheObject)
{
    const auto object = block();
    const SphereTree tree = buildSphereTree(*object, extendedTree());
    const std::string page = pageOf(tree, object.get());
    const json surface = descriptionOf(page).at("surface");
    EXPECT_EQ(surface.at("factor"), 1);
    EXPECT_EQ(surface.at("origin"), (json{4.5, 3.5, 2.5}));
    const auto quads = arrayOf<uint32_t>(page, "surface-quads");
    EXPECT_EQ(quads.size(), 4u * 2 * (10 * 8 + 8 * 6 + 10 * 6));
    EXPECT_EQ(surface.at("triangles"), quads.size() / 2);
    const size_t points = arrayOf<float>(page, "surface-points").size() / 3;
    for (const uint32_t point : quads) ASSERT_LT(point, points);

    ViewerSettings none;
    none.triangles = 0;
    const json without = descriptionOf(pageOf(tree, object.get(), none));
    EXPECT_EQ(without.at("surface"), json());
    EXPECT_TRUE(mentions(without.at("surface_missing"), "triangles=0"));
}

TEST(TreeViewer, NamesAreTextWhateverTheyAre)
{
    SphereTree tree = sampleTree();
    const std::string usual = pageOf(tree);
    const std::string evil = "</script><img src=x onerror=alert(1)><!--<script>\"'&\xff\n";
    tree.settings.name = tree.object.name = evil;
    tree.levels[0].errorUnknown = evil;
    tree.levels[0].error.reset();
    const std::string page = pageOf(tree);
    for (const char* tag : {"<script", "</script", "<img", "<!--"}) {
        EXPECT_EQ(countOf(page, tag), countOf(usual, tag)) << tag;
    }
    const std::string name = descriptionOf(page).at("name");
    EXPECT_TRUE(mentions(name, "</script><img src=x onerror=alert(1)><!--<script>"));
}

TEST(TreeViewer, IsSmallWithoutItsData)
{
    std::string page = pageOf(tightSampleTree());
    const std::regex data("<script type=\"(text/plain|application/json)\"[^]*?</script>");
    const std::string rest = std::regex_replace(page, data, "");
    EXPECT_LT(rest.size(), 150000u);
    EXPECT_GT(rest.size(), 50000u);
}

TEST(TreeViewer, AsksForNothingElse)
{
    const std::string page = pageOf(tightSampleTree());
    EXPECT_EQ(countOf(page, "://"), 1) << "the name space of SVG, which nobody fetches";
    EXPECT_EQ(countOf(page, "http://www.w3.org/2000/svg"), 1);
    for (const char* way : {"src=", "@import", "url(", "fetch(", "XMLHttpRequest", "<link"}) {
        EXPECT_EQ(countOf(page, way), 0) << way;
    }
    EXPECT_EQ(countOf(page, "default-src 'none'"), 1);
}

TEST(TreeViewer, TellsWhatBallsOfNormsAndFlatTreesAre)
{
    const auto object = block();
    SphereTreeSettings settings = extendedTree();
    EXPECT_EQ(descriptionOf(pageOf(buildSphereTree(*object, settings))).at("faces").size(), 0u);
    const std::vector<std::pair<const char*, size_t>> faces = {
        {"l1", 4}, {"linf", 3}, {"chamfer:3,4,5", 12}};
    for (const auto& [name, count] : faces) {
        settings.pyramid().dist = distanceFromString(name);
        const json norm = descriptionOf(pageOf(buildSphereTree(*object, settings)));
        EXPECT_EQ(norm.at("faces").size(), count) << name;
        EXPECT_EQ(norm.at("flat_axis"), json());
    }
    const auto sheet = openvdb::BoolGrid::create(false);
    sheet->denseFill(openvdb::CoordBBox(Coord(0), Coord(9, 0, 5)), true);
    settings = extendedTree();
    settings.dim = 2;
    EXPECT_EQ(descriptionOf(pageOf(buildSphereTree(*sheet, settings))).at("flat_axis"), 1);
}

TEST(TreeViewer, IsTheSameForAnyNumberOfThreads)
{
    const auto object = block();
    const SphereTree tree = buildSphereTree(*object, extendedTree());
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const std::string alone = pageOf(tree, object.get());
    const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 4);
    EXPECT_TRUE(pageOf(tree, object.get()) == alone);
}

TEST(TreeViewer, RefusesTooManySpheresAndSettingsOutOfRange)
{
    SphereTree large = sampleTree();
    large.spheres.resize(kMaxViewerSpheres + 1);
    const std::string message = messageOf<openvdb::ValueError>([&] { pageOf(large); });
    EXPECT_TRUE(mentions(message, "2000001") && mentions(message, "spheres="));
    for (const int64_t triangles : {int64_t(-1), ViewerSettings::kMaxTriangles + 1}) {
        ViewerSettings settings;
        settings.triangles = triangles;
        EXPECT_TRUE(mentions(
            messageOf<openvdb::ValueError>([&] { pageOf(sampleTree(), nullptr, settings); }),
            "triangles=" + std::to_string(triangles)));
    }
}

class Stopped : public openvdb::util::NullInterrupter {
public:
    bool wasInterrupted(int = -1) override { return true; }
};

TEST(TreeViewer, StopsWhenToldToAndWhereNothingCanBeWritten)
{
    const SphereTree tree = sampleTree();
    detail::TextStream out;
    Stopped stopped;
    EXPECT_THROW(writeViewer(tree, nullptr, {}, out, &stopped), Interrupted);
    std::ostream full(nullptr);
    EXPECT_TRUE(mentions(
        messageOf<openvdb::IoError>([&] { writeViewer(tree, nullptr, {}, full); }), "disk full"));
}

} // namespace
