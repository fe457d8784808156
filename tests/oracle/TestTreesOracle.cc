// SPDX-License-Identifier: Apache-2.0
/// @file TestTreesOracle.cc
/// @brief Reversible and extended trees, with every combination of settings, against the dense
/// program of support/DenseTree.h: the same balls on the same levels, the same parents, centres,
/// radii and DAG.

#include "support/DenseAgreement.h"
#include <openvdb_spheretree/build/BuildSphereTree.h>

namespace {

using namespace spheretree_test;

constexpr uint32_t kObjects = 66;
void checkObjects(TreeType type, int dim, uint32_t firstSeed)
{
    std::size_t levels = 0;
    for (const RandomObject& object : someObjects(firstSeed, kObjects)) {
        const Voxels voxels = dim == 2 ? flattened(object.voxels) : object.voxels;
        const auto grid = gridOf(voxels);
        DenseTreeBuilder dense(voxels);
        for (const SphereTreeSettings& settings : allSettings(type, dim)) {
            SCOPED_TRACE(object.name + ": " + describe(settings));
            const SphereTree tree = buildSphereTree(*grid, settings);
            ASSERT_EQ(tree.origin, dense.origin());
            ASSERT_TRUE(agree(dense.build(denseSettings(settings)), tree));
            levels += tree.levels.size();
        }
    }
    // Most objects must be large enough for a tree that can go wrong.
    EXPECT_GT(levels, 3 * kObjects * allSettings(type, dim).size());
}

TEST(TreesOracle, ReversibleTreesMatchTheDenseProgram) { checkObjects(TreeType::Reversible, 3, 0); }

TEST(TreesOracle, ExtendedTreesMatchTheDenseProgram) { checkObjects(TreeType::Extended, 3, 100); }

TEST(TreesOracle, ReversibleTreesMatchTheDenseProgramInTwoDimensions)
{
    checkObjects(TreeType::Reversible, 2, 200);
}

TEST(TreesOracle, ExtendedTreesMatchTheDenseProgramInTwoDimensions)
{
    checkObjects(TreeType::Extended, 2, 300);
}

} // namespace
