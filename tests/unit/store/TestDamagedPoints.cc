// SPDX-License-Identifier: Apache-2.0
/// @file TestDamagedPoints.cc
/// @brief Points that are no tree, or a damaged one, are errors that name grid, node and value. (What
/// contradicts nothing but its checksum: TestTreeChecksum.cc.)

#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/SettingsTable.h>

#include "support/Messages.h"
#include "support/PointGrids.h"
#include "support/PointsFiles.h"
#include "support/SampleTrees.h"

#include <openvdb/points/PointAttribute.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
namespace math = openvdb::math;
namespace points = openvdb::points;

std::string whyDamaged(const PointDataGrid& grid, const PointDataGrid* dag = nullptr)
{
    const std::string why = messageOf<openvdb::ValueError>([&] { fromPoints(grid, dag); });
    EXPECT_TRUE(mentions(why, "'" + grid.getName())) << "the message must name the grid";
    return why;
}

/// What fromPoints() says of the sample tree after one value of one node was changed.
template <typename T>
std::string whyDamaged(const char* attribute, int32_t id, const T& value)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    damage<T>(*grid, attribute, id, value);
    return whyDamaged(*grid);
}

template <typename T>
std::string whyDamagedMeta(const char* key, const T& value, const SphereTree& tree = sampleTree())
{
    const PointDataGrid::Ptr grid = toPoints(tree);
    removeChecksum(*grid); // which would find the change before what is wrong with it
    grid->removeMeta(key);
    grid->insertMeta(key, openvdb::TypedMetadata<T>(value));
    return whyDamaged(*grid);
}

TEST(DamagedPoints, OrdinaryPointsAreNoSphereTree)
{
    const auto grid = pointsAt({{1, 2, 3}});
    grid->setName("dust");
    EXPECT_TRUE(mentions(whyDamaged(*grid), "is no sphere-tree"));
}

TEST(DamagedPoints, ANewerFormatIsAnErrorThatSaysToUpdate)
{
    const std::string why = whyDamagedMeta<int32_t>("spheretree_format", 2);
    EXPECT_TRUE(mentions(why, "format 2"));
    EXPECT_TRUE(mentions(why, "update"));
    EXPECT_FALSE(mentions(why, "damaged"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_format", 0), "damaged"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_format", "1"), "type string"));
}

TEST(DamagedPoints, ABoxOfTheObjectThatCannotBeIsNamed)
{
    const auto whyOfMost = [](const openvdb::Vec3i& most, const SphereTree& tree) {
        return whyDamagedMeta("spheretree_object_bbox_max", most, tree);
    };
    const SphereTree tree = sampleTree(); // of 2^40 voxels, from [-15, 9, -1000] on
    EXPECT_TRUE(mentions(whyOfMost({1, 8, 1}, tree), "it ends before it begins"));
    EXPECT_TRUE(mentions(whyOfMost({20, 30, 40}, tree),
        "is of 36 x 22 x 1041 voxels, too small for the 1099511627776 of the object"));
    EXPECT_TRUE(mentions(whyOfMost({INT32_MAX, 1 << 14, 1 << 14}, tree),
        "over 2147483663 voxels along an axis, and trees are built of 2^28 at most"));
    SphereTree full = tree;
    full.object.bbox.reset({0, 0, 0}, {1023, 1023, (1 << 20) - 1});
    EXPECT_EQ(fromPoints(*toPoints(full)).object.voxels, int64_t(1) << 40) << "no voxel is off";
    full.object.bbox.max().x() = 1022;
    EXPECT_THROW(toPoints(full), openvdb::ValueError);
    full.object.bbox.reset({0, 0, 0}, {(1 << 28) - 1, 1 << 14, 1 << 14});
    EXPECT_NO_THROW(toPoints(full));
    full.object.bbox = openvdb::CoordBBox();
    EXPECT_THROW(toPoints(full), openvdb::ValueError) << "an object without a box";
}

TEST(DamagedPoints, AMissingAttributeIsNamed)
{
    for (const char* name :
        {"pscale", "id", "parent", "level", "radius_sq", "ijk", "radius", "cover_sq"}) {
        const PointDataGrid::Ptr grid = toPoints(sampleTree());
        points::dropAttribute(grid->tree(), name);
        EXPECT_TRUE(mentions(whyDamaged(*grid), "no attribute '" + std::string(name) + "'"));
    }
}

TEST(DamagedPoints, AnAttributeOfAnotherTypeIsNamed)
{
    for (const char* name :
        {"pscale", "id", "parent", "level", "radius_sq", "ijk", "radius", "cover_sq"}) {
        const PointDataGrid::Ptr grid = toPoints(sampleTree());
        points::dropAttribute(grid->tree(), name);
        points::appendAttribute<int16_t>(grid->tree(), name);
        EXPECT_TRUE(
            mentions(whyDamaged(*grid), "attribute '" + std::string(name) + "' is of type"));
    }
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    points::dropAttribute(grid->tree(), "pscale");
    points::appendAttribute<float, points::TruncateCodec>(grid->tree(), "pscale");
    EXPECT_TRUE(mentions(whyDamaged(*grid), "float/trnc"));
    points::dropAttribute(grid->tree(), "pscale");
    points::appendAttribute<float>(grid->tree(), "pscale", 1.0f, /*stride=*/3);
    EXPECT_TRUE(mentions(whyDamaged(*grid), "3 values a point"));
}

TEST(DamagedPoints, CompressedPositionsAreAnError)
{
    SphereTree tree = oneVoxelTree();
    tree.spheres.center[0] = {0, 0, 0};
    const PointDataGrid::Ptr grid = toPoints(tree);
    const auto lossy = packedPointsAt({{0, 0, 0}});
    lossy->setTransform(grid->transformPtr());
    lossy->insertMeta(*grid);
    points::appendAttribute<int32_t>(lossy->tree(), "id", 0);
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { fromPoints(*lossy); }), "'P'"));
}

TEST(DamagedPoints, IdsThatAreNotEachOfThePossibleOnesOnceAreAnError)
{
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, 4), "two points have the id 4"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, 8), "there is an id 8"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, -1), "there is an id -1"));
    const int32_t lowest = std::numeric_limits<int32_t>::min();
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, lowest), "id -2147483648"));
}

TEST(DamagedPoints, AParentThatDoesNotExistIsAnErrorThatNamesNodeAndParent)
{
    for (int32_t parent : {8, -2, -1, 1 << 30}) {
        const std::string why = whyDamaged<int32_t>("parent", 5, parent);
        EXPECT_TRUE(mentions(why, "node 5"));
        EXPECT_TRUE(mentions(why, "parent " + std::to_string(parent)));
        EXPECT_TRUE(mentions(why, "must be a node of the next level up"));
    }
    const std::string why = whyDamaged<int32_t>("parent", 0, -2);
    EXPECT_TRUE(mentions(why, "the top level has no parents"));
}

TEST(DamagedPoints, AParentThatIsNotOnTheNextLevelUpIsAnError)
{
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 5, 0), "on level 2"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 5, 4), "on level 0"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 5, 5), "node 5")) << "its own parent";
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 1, 3), "node 1")) << "a cycle of 1 and 3";
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 0, 1), "top level")) << "a root with parent";
}

TEST(DamagedPoints, ALevelThatIsMissingOrOutOfOrderIsAnError)
{
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("level", 0, 3), "level 3"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("level", 0, -1), "level -1"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("level", 0, 1), "level 1 has 3 nodes"));
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    damage<int32_t>(*grid, "level", 1, 0);
    damage<int32_t>(*grid, "level", 3, 1);
    EXPECT_TRUE(mentions(whyDamaged(*grid), "node 2 is on level 1"));
}

TEST(DamagedPoints, RadiiThatNoSphereHasAreErrorsThatNameTheNode)
{
    const double inf = std::numeric_limits<double>::infinity();
    for (double bad : {std::nan(""), inf, -inf, -1.0}) {
        EXPECT_TRUE(mentions(whyDamaged<float>("pscale", 4, float(bad)), "node 4 has the pscale"));
        EXPECT_TRUE(mentions(whyDamaged<double>("radius", 4, bad), "node 4 has the radius"));
    }
    EXPECT_TRUE(mentions(whyDamaged<int64_t>("cover_sq", 4, -1), "node 4 has the cover_sq -1"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("radius_sq", 4, 0), "node 4 has the radius_sq 0"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("radius_sq", 4, -2), "node 4 has the radius_sq -2"));
    EXPECT_TRUE(
        mentions(whyDamaged<openvdb::Vec3f>("P", 4, openvdb::Vec3f(0, float(std::nan("")), 0)),
            "node 4 has the position"));
}

TEST(DamagedPoints, AnEmptyGridIsNotMistakenForATree)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    grid->clear();
    EXPECT_TRUE(mentions(whyDamaged(*grid), "0 points, by its metadata 8"));
}

bool isOptional(const std::string& key)
{
    const auto& table = detail::settingsTable();
    return std::any_of(table.begin(), table.end(),
        [&](const auto& setting) { return setting.isOptional && setting.key == key; });
}

int expectMissingMetadataIsNamed(const SphereTree& tree)
{
    const PointDataGrid::Ptr complete = toPoints(tree);
    removeChecksum(*complete);
    const bool tight = tree.settings.type() == TreeType::Tight;
    int keys = 0;
    for (auto it = complete->beginMeta(); it != complete->endMeta(); ++it) {
        const std::string key = it->first;
        const bool optional = key == "spheretree_level_1_error_unknown"
            || key == "spheretree_level_2_stored_unknown" || isOptional(key)
            || (!tight && (key == "spheretree_quality" || key == "spheretree_subdivision"))
            || key.rfind("spheretree_", 0) != 0;
        if (optional || key == "spheretree_format") continue;
        const PointDataGrid::Ptr grid = toPoints(tree);
        removeChecksum(*grid);
        grid->removeMeta(key);
        EXPECT_TRUE(mentions(whyDamaged(*grid), "'" + key + "'"));
        ++keys;
    }
    return keys;
}

TEST(DamagedPoints, MissingMetadataIsNamed)
{
    SphereTree coarse = sampleTree(); // without its subdivision it is one in halves
    for (openvdb::Vec3d& center : coarse.spheres.center) center *= 8;
    EXPECT_GE(expectMissingMetadataIsNamed(coarse), 25);
    EXPECT_GE(expectMissingMetadataIsNamed(tightSampleTree()), 30);
}

TEST(DamagedPoints, MetadataOutOfRangeIsAnError)
{
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_factor", 1), "factor=1"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_dim", 4), "dim=4"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_subdivision", 3), "units of 1/3"));
    EXPECT_TRUE(
        mentions(whyDamagedMeta<std::string>("spheretree_spheres", "8,x"), "spheres='8,x'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_side", "left"), "side='left'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_branching", 1), "branching=1"));
    EXPECT_TRUE(mentions(whyDamagedMeta<bool>("spheretree_cuts", true), "cuts"));
    EXPECT_TRUE(mentions(
        whyDamagedMeta<int32_t>("spheretree_branching", 1, tightSampleTree()), "branching=1"));
    EXPECT_TRUE(mentions(
        whyDamagedMeta<int32_t>("spheretree_factor", 3, tightSampleTree()), "factor=3 is not for"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_tree", "oak"), "tree='oak'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_padding", "x"), "padding='x'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<bool>("spheretree_factor", true), "of type bool"));
    for (int32_t scale : {0, -1, 3, 8192}) {
        EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_point_scale", scale), "power of"));
    }
    for (int32_t count : {0, -1, 4, 1 << 30}) {
        EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_levels", count),
            count == 4 ? "level_3" : "it has " + std::to_string(count) + " levels"));
    }
    for (int32_t lowest : {-1, 1025}) {
        const PointDataGrid::Ptr grid = toPoints(oneLevelOf(sampleTree(), 0));
        removeChecksum(*grid);
        grid->insertMeta("spheretree_lowest_level", openvdb::Int32Metadata(lowest));
        EXPECT_TRUE(mentions(whyDamaged(*grid), "from level " + std::to_string(lowest) + " on"));
    }
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_levels", 2), "by its metadata 7"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_lowest_level", 1), "from level 1 on"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_level_0_spheres", 0), "level 0"));
    for (int32_t above : {0, 2}) { // three spheres stand on the levels above
        const int32_t spheres = std::numeric_limits<int32_t>::max() - above;
        EXPECT_TRUE(mentions(
            whyDamagedMeta<int32_t>("spheretree_level_0_spheres", spheres), "more than 2^31"));
    }
}

TEST(DamagedPoints, AFrustumIsNoTransformOfATree)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    removeChecksum(*grid);
    grid->setTransform(math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 10.0, 1.0));
    EXPECT_TRUE(mentions(whyDamaged(*grid), "its transform is a frustum"));
}

TEST(DamagedPoints, AMessageStaysOnOneShortLine)
{
    const std::string junk = std::string(100000, 'x') + "\n\n";
    const std::string why = whyDamagedMeta<std::string>("spheretree_tree", junk);
    EXPECT_LT(why.size(), 600u);
    EXPECT_EQ(why.find('\n'), std::string::npos);
}

} // namespace
