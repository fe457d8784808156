// SPDX-License-Identifier: Apache-2.0
/// @file TestDagPoints.cc
/// @brief The edges of a Sphere-DAG as a grid of points beside that of the tree.

#include <openvdb_spheretree/store/SphereTreePoints.h>

#include "support/Messages.h"
#include "support/PointsFiles.h"
#include "support/SampleTrees.h"

#include <openvdb/points/PointCount.h>

#include <algorithm>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
namespace points = openvdb::points;
using openvdb::points::PointDataGrid;

TEST(DagPoints, ATreeWithoutEdgesHasNoDagGrid) { EXPECT_FALSE(dagToPoints(oneVoxelTree())); }

TEST(DagPoints, TheDagGridIsNamedAfterTheTreeAndHoldsAPointAnEdge)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr dag = dagToPoints(tree);
    EXPECT_EQ(dag->getName(), "sample tree_dag");
    EXPECT_EQ(points::pointCount(dag->tree()), tree.dag.size());
}

TEST(DagPoints, ATreeReadWithoutItsDagGridSaysThatItHasNoEdges)
{
    const SphereTree tree = sampleTree();
    ASSERT_FALSE(tree.dag.empty());
    ASSERT_TRUE(tree.hasDag);
    const SphereTree read = fromPoints(*toPoints(tree));
    EXPECT_TRUE(read.dag.empty());
    EXPECT_FALSE(read.hasDag);
    EXPECT_EQ(read.size(), tree.size());
}

TEST(DagPoints, ADagOfAnotherTreeIsAnError)
{
    const PointDataGrid::Ptr dag = dagToPoints(sampleTree());
    const std::string why =
        messageOf<openvdb::ValueError>([&] { fromPoints(*toPoints(oneVoxelTree()), dag.get()); });
    EXPECT_TRUE(mentions(why, "sample tree_dag"));
    EXPECT_TRUE(mentions(why, "8 nodes"));
}

/// Puts @a edge in the place of the first one that is another.
void replaceOneEdge(PointDataGrid& dag, const DagEdge& edge)
{
    for (auto leaf = dag.tree().beginLeaf(); leaf; ++leaf) {
        points::AttributeWriteHandle<int32_t> parents(leaf->attributeArray("parent"));
        points::AttributeWriteHandle<int32_t> children(leaf->attributeArray("child"));
        for (openvdb::Index n = 0; n < parents.size(); ++n) {
            if (parents.get(n) == edge.parent && children.get(n) == edge.child) continue;
            parents.set(n, edge.parent);
            children.set(n, edge.child);
            return;
        }
    }
}

TEST(DagPoints, ADagEdgeThatSkipsALevelOrRepeatsIsAnError)
{
    for (const DagEdge& edge : {DagEdge{0, 3}, DagEdge{1, 2}, DagEdge{3, 1}, DagEdge{0, 8},
             DagEdge{0, -1}, DagEdge{0, 1}}) {
        SphereTree tree = sampleTree();
        const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
        replaceOneEdge(*dag, edge);
        const std::string read =
            messageOf<openvdb::ValueError>([&] { fromPoints(*points, dag.get()); });
        EXPECT_TRUE(mentions(read, "damaged Sphere-DAG"));
        EXPECT_TRUE(mentions(read, "from node " + std::to_string(edge.parent) + " to node "));
        tree.dag.push_back(edge);
        const std::string write = messageOf<openvdb::ValueError>([&] { dagToPoints(tree); });
        EXPECT_TRUE(mentions(write, "from node " + std::to_string(edge.parent) + " to node "));
    }
    const PointDataGrid::Ptr points = toPoints(sampleTree());
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { fromPoints(*points, points.get()); }),
        "spheretree_dag_format"));
}

TEST(DagPoints, ADagEdgeFromANodeThatDoesNotExistIsAnError)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr points = toPoints(tree);
    for (int32_t parent : {-1, 8, 1 << 30, std::numeric_limits<int32_t>::min()}) {
        const PointDataGrid::Ptr dag = dagToPoints(tree);
        for (auto leaf = dag->tree().beginLeaf(); leaf; ++leaf) {
            points::AttributeWriteHandle<int32_t> parents(leaf->attributeArray("parent"));
            for (openvdb::Index n = 0; n < parents.size(); ++n) parents.set(n, parent);
        }
        const std::string why =
            messageOf<openvdb::ValueError>([&] { fromPoints(*points, dag.get()); });
        EXPECT_TRUE(mentions(why, "from node " + std::to_string(parent) + " to node "));
    }
}

TEST(DagPoints, ADagThatWasCutShortIsAnError)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
    removeChecksum(*dag);
    dag->removeMeta("spheretree_edges");
    dag->insertMeta("spheretree_edges", openvdb::Int32Metadata(int32_t(tree.dag.size()) + 1));
    const std::string why = messageOf<openvdb::ValueError>([&] { fromPoints(*points, dag.get()); });
    EXPECT_TRUE(mentions(why, "9 edges of 8 nodes are expected"));
}

TEST(DagPoints, AnEdgeThatIsNotAtItsParentIsAnError)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
    for (auto leaf = dag->tree().beginLeaf(); leaf; ++leaf) {
        points::AttributeWriteHandle<openvdb::Vec3f> places(leaf->attributeArray("P"));
        places.set(0, places.get(0) + openvdb::Vec3f(0, 0.0625f, 0));
    }
    EXPECT_TRUE(mentions(messageOf<openvdb::IoError>([&] { fromPoints(*points, dag.get()); }),
        "an edge from node 0 is not at the centre of that node"));
    for (const char* key :
        {"spheretree_checksum", "spheretree_checksum_transform", "spheretree_point_scale"}) {
        dag->removeMeta(key); // as in version 0.1
    }
    EXPECT_EQ(fromPoints(*points, dag.get()).dag, tree.dag);
}

TEST(DagPoints, ANewerFormatIsAnErrorThatSaysToUpdate)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
    dag->insertMeta("spheretree_dag_format", openvdb::Int32Metadata(kPointsFormat + 1));
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { fromPoints(*points, dag.get()); }),
        "newer than this version reads (1): update openvdb_spheretree"));
}

TEST(DagPoints, DagEdgesComeBackSortedWhereverTheirPointsAre)
{
    SphereTree tree = sampleTree();
    std::reverse(tree.spheres.center.begin(), tree.spheres.center.end());
    const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
    EXPECT_EQ(fromPoints(*points, dag.get()).dag, tree.dag);
}

} // namespace
