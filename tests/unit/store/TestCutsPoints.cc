// SPDX-License-Identifier: Apache-2.0
/// @file TestCutsPoints.cc
/// @brief The cuts of a tight tree as a grid of points beside that of the tree.

#include <openvdb_spheretree/store/SphereTreePoints.h>

#include "support/Messages.h"
#include "support/PointsFiles.h"
#include "support/SampleTrees.h"

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(CutsPoints, ATightTreeWithItsCutsComesBack)
{
    const SphereTree tree = tightSampleTree();
    const PointDataGrid::Ptr nodes = toPoints(tree), cuts = cutsToPoints(tree);
    EXPECT_TRUE(isCutsOf(*cuts, "tight tree"));
    EXPECT_FALSE(isCutsOf(*cuts, "tight"));
    EXPECT_FALSE(isCutsOf(*nodes, "tight tree"));
    EXPECT_FALSE(isSphereTree(*cuts));
    EXPECT_FALSE(isDagOf(*cuts, "tight tree"));
    expectSameTree(fromPoints(*nodes, nullptr, cuts.get()), tree);
    const auto grids = throughFile({nodes, cuts});
    ASSERT_EQ(grids.size(), 2u);
    const bool inOrder = isSphereTree(*grids[0]);
    expectSameTree(
        fromPoints(*grids[inOrder ? 0 : 1], nullptr, grids[inOrder ? 1 : 0].get()), tree);
}

TEST(CutsPoints, ATreeReadWithoutItsCutsSaysThatItHasNone)
{
    const SphereTree read = fromPoints(*toPoints(tightSampleTree()));
    EXPECT_TRUE(read.cuts.empty());
    EXPECT_FALSE(read.hasCuts);
    EXPECT_EQ(read.subdivision, 16);
    EXPECT_FALSE(cutsToPoints(read));
}

/// What fromPoints() says of the tight sample tree after one value of its cuts was changed.
template <typename T>
std::string whyCutsDamaged(const char* attribute, int32_t id, const T& value)
{
    const PointDataGrid::Ptr grid = toPoints(tightSampleTree());
    const PointDataGrid::Ptr cuts = cutsToPoints(tightSampleTree());
    damage<T>(*cuts, attribute, id, value);
    const std::string why =
        messageOf<openvdb::ValueError>([&] { fromPoints(*grid, nullptr, cuts.get()); });
    EXPECT_TRUE(mentions(why, "'tight tree_cuts' is a damaged list of cuts"));
    return why;
}

TEST(CutsPoints, DamagedCutsAreErrorsThatNameTheNode)
{
    using Int = int32_t;
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("id", 3, 2), "two points have the id 2"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("id", 3, 6), "there is an id 6"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, 2), "node 3 has the parent 2"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, 3), "node 3 has the parent 3"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, 6), "node 3 has the parent 6"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, -2), "node 3 has the parent -2"));
    EXPECT_TRUE(
        mentions(whyCutsDamaged<Int>("parent", 0, 5), "its parent 5 begins with that of 1"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("first", 2, 0), "cuts of 0 to 4"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("first", 2, 5), "cuts of 5 to 4"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("first", 2, 2), "the cut of 2 spheres has 3"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 2, 3), "node 2 has no child"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 2, 1 << 30), "of 1073741824 spheres, but"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 5, 0), "its parent 5 begins with that of 0"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 4, 4), "node 0 ends with the cut of 4"));
    EXPECT_TRUE(mentions(whyCutsDamaged<double>("radius", 1, -1.0), "node 1 has the radius -1"));
    EXPECT_TRUE(mentions(whyCutsDamaged<float>("pscale", 1, -1.f), "node 1 has the pscale -1"));
    EXPECT_TRUE(mentions(whyCutsDamaged<int64_t>("cover_sq", 1, -1), "node 1 has the cover_sq -1"));
    SphereTree coarse = tightSampleTree();
    for (openvdb::Vec3d& center : coarse.spheres.center) center *= 16;
    coarse.subdivision = 2;
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { cutsToPoints(coarse); }),
        "cannot be stored: in its cuts, node 0 has the position"));
}

TEST(CutsPoints, CutsOfAnotherTreeOrCutShortAreAnError)
{
    const SphereTree tree = tightSampleTree();
    const PointDataGrid::Ptr points = toPoints(tree), cuts = cutsToPoints(tree);
    const auto why = [&] {
        return messageOf<openvdb::ValueError>([&] { fromPoints(*points, nullptr, cuts.get()); });
    };
    removeChecksum(*cuts);
    cuts->insertMeta("spheretree_nodes", openvdb::Int32Metadata(5));
    EXPECT_TRUE(mentions(why(), "beside a tree of 5 nodes"));
    cuts->insertMeta("spheretree_nodes", openvdb::Int32Metadata(4));
    EXPECT_NO_THROW(fromPoints(*points, nullptr, cuts.get()));
    cuts->insertMeta("spheretree_cuts_nodes", openvdb::Int32Metadata(7));
    EXPECT_TRUE(mentions(why(), "7 spheres beside 4 nodes are expected"));
    cuts->insertMeta("spheretree_cuts_format", openvdb::Int32Metadata(kPointsFormat + 1));
    EXPECT_TRUE(mentions(why(), "update openvdb_spheretree"));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { fromPoints(*points, nullptr, points.get()); }),
        "spheretree_cuts_format"));
}

} // namespace
