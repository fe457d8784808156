// SPDX-License-Identifier: Apache-2.0
/// @file TestNormsOracle.cc
/// @brief Everything once more with the balls of norms: distances, labels and medial balls against
/// the O(n^2) definition, trees against the dense program, errors against all voxels of a box.

#include "support/DenseAgreement.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <random>

namespace {

using namespace spheretree_test;
using openvdb_spheretree::Distance;

/// Proper ones, and those at the edges of what is a norm: b = 2 a, b = a, a + c = 2 b, c = b.
const Weights kWeights[] = {{1, 2, 3}, {1, 1, 1}, {3, 4, 5}, {16, 21, 26}, {2, 3, 3}, {2, 4, 6},
    {5, 5, 5}, {255, 255, 255}};

Distance distanceOf(const Weights& w) { return Distance::chamfer(w[0], w[1], w[2]); }

/// With squared radii, as the library has them.
std::vector<NaiveReference::Ball> squaredBalls(const NaiveReference& naive)
{
    std::vector<NaiveReference::Ball> balls = naive.balls();
    for (auto& ball : balls) ball.radiusSq *= ball.radiusSq;
    return balls;
}

void expectTransformsAgree(const RandomObject& object, const Weights& weights, int dim)
{
    SCOPED_TRACE(
        object.name + ", " + toString(distanceOf(weights)) + ", dim " + std::to_string(dim));
    const auto mask = maskOf(object.voxels);
    if (object.voxels.size() % 2) mask->prune();
    const NaiveReference naive(object.voxels, dim, Length(weights));
    const CoreStages stages(*mask, dim, distanceOf(weights));
    ASSERT_EQ(stages.layout.voxelCount(), int64_t(object.voxels.size()));
    ASSERT_TRUE(agreeOnVoxels(naive, stages));
    ASSERT_TRUE(agreeOnBalls(squaredBalls(naive), stages.balls));
}

TEST(NormsOracle, DistancesLabelsAndBallsMatchBruteForceOnRandomObjects)
{
    for (uint32_t seed = 0; seed < 136; ++seed) {
        expectTransformsAgree(randomObject(seed), kWeights[seed % std::size(kWeights)], 3);
        if (testing::Test::HasFailure()) return;
    }
}

TEST(NormsOracle, DistancesLabelsAndBallsMatchBruteForceInTwoDimensions)
{
    for (uint32_t seed = 3000; seed < 3136; ++seed) {
        expectTransformsAgree(randomObject(seed), kWeights[seed % std::size(kWeights)], 2);
        if (testing::Test::HasFailure()) return;
    }
}

TEST(NormsOracle, EveryMaskOf2x2x3AcrossALeafCornerMatchesBruteForce)
{
    const Voxels box = shapes::box(Coord(2, 2, 3));
    for (uint32_t mask = 1; mask < 1 << 12; ++mask) {
        RandomObject object;
        object.name = "mask " + std::to_string(mask);
        for (uint32_t bit = 0; bit < 12; ++bit) {
            if (mask >> bit & 1) object.voxels.push_back(box[bit] + Coord(7, -1, 6));
        }
        expectTransformsAgree(object, kWeights[mask % std::size(kWeights)], 3);
        if (testing::Test::HasFailure()) return;
    }
}

void expectTreesAgree(TreeType type, int dim, uint32_t firstSeed)
{
    for (const RandomObject& object : someObjects(firstSeed, 22)) {
        const Voxels voxels = dim == 2 ? flattened(object.voxels) : object.voxels;
        const auto grid = gridOf(voxels);
        DenseTreeBuilder dense(voxels);
        for (const SphereTreeSettings& settings : normSettings(type, dim)) {
            SCOPED_TRACE(object.name + ": " + describe(settings));
            const SphereTree tree = buildSphereTree(*grid, settings);
            ASSERT_TRUE(agree(dense.build(denseSettings(settings)), tree));
            ASSERT_TRUE(covers(tree, voxels));
        }
    }
}

TEST(NormsOracle, ReversibleTreesMatchTheDenseProgram)
{
    expectTreesAgree(TreeType::Reversible, 3, 0);
}
TEST(NormsOracle, ExtendedTreesMatchTheDenseProgram)
{
    expectTreesAgree(TreeType::Extended, 3, 100);
}
TEST(NormsOracle, ReversibleTreesMatchTheDenseProgramInTwoDimensions)
{
    expectTreesAgree(TreeType::Reversible, 2, 200);
}
TEST(NormsOracle, ExtendedTreesMatchTheDenseProgramInTwoDimensions)
{
    expectTreesAgree(TreeType::Extended, 2, 300);
}

/// Errors by the definition, over a box that holds every ball.
openvdb_spheretree::LevelError naiveError(
    const SphereTree& tree, const SphereTreeLevel& level, const Voxels& voxels)
{
    CoordBBox box = boxOf(voxels);
    double reach = 0;
    for (int32_t id = level.begin; id < level.end; ++id)
        reach = std::max(reach, tree.spheres.radius[id]);
    box.expand(int(reach) * 2 + 2);
    if (tree.settings.dim == 2) box.min()[2] = box.max()[2] = voxels[0][2];
    const auto& dist = tree.settings.dist();
    const Length length({dist.face(), dist.edge(), dist.corner()});
    openvdb_spheretree::LevelError error;
    int64_t farthest = 0;
    for (const Coord& q : voxelsOfBox(box)) {
        bool covered = false;
        for (int32_t id = level.begin; id < level.end && !covered; ++id)
            covered = holds(tree, id, q);
        const bool on = std::binary_search(voxels.begin(), voxels.end(), q);
        error.covered += covered;
        error.excess += covered && !on;
        error.missing += on && !covered;
        if (!covered || on) continue;
        int64_t nearest = std::numeric_limits<int64_t>::max();
        for (const Coord& o : voxels) nearest = std::min(nearest, length(q, o));
        farthest = std::max(farthest, nearest);
    }
    error.hammingPercent = 100.0 * double(error.excess + error.missing) / double(voxels.size());
    error.hausdorff = double(farthest) / dist.face();
    return error;
}

void expectErrorsAgree(int dim, uint32_t firstSeed)
{
    int objects = 0, levels = 0;
    for (const RandomObject& object : someObjects(firstSeed, 11)) {
        Voxels voxels = dim == 2 ? flattened(object.voxels) : object.voxels;
        sortVoxels(voxels);
        if (voxels.size() > 400) continue; // all pairs
        ++objects;
        const auto grid = gridOf(voxels);
        for (const Weights& weights : kWeights) {
            for (SphereTreeSettings settings : bothTypes()) {
                settings.dim = dim;
                settings.pyramid().dist = distanceOf(weights);
                SphereTree tree = buildSphereTree(*grid, settings);
                computeLevelErrors(tree, *grid);
                for (const SphereTreeLevel& level : tree.levels) {
                    if (level.level > 2) continue; // large boxes
                    SCOPED_TRACE(object.name + ": " + describe(settings) + " level "
                        + std::to_string(level.level));
                    const auto expected = naiveError(tree, level, voxels);
                    ASSERT_TRUE(level.error.has_value()) << level.errorUnknown;
                    ASSERT_EQ(level.error->covered, expected.covered);
                    ASSERT_EQ(level.error->excess, expected.excess);
                    ASSERT_EQ(level.error->missing, 0);
                    ASSERT_EQ(expected.missing, 0);
                    ASSERT_DOUBLE_EQ(level.error->hausdorff, expected.hausdorff);
                    ++levels;
                }
            }
        }
    }
    EXPECT_GE(objects, dim == 2 ? 10 : 3);
    EXPECT_GT(levels, 50);
}

TEST(NormsOracle, ErrorsMatchBruteForce) { expectErrorsAgree(3, 400); }
TEST(NormsOracle, ErrorsMatchBruteForceInTwoDimensions) { expectErrorsAgree(2, 500); }

TEST(NormsOracle, UnionsOfBallsMatchBruteForce)
{
    using openvdb_spheretree::ExactSphere;
    std::mt19937 random(5);
    std::uniform_int_distribution<int> center(-60, 60), count(1, 4), corner(-30, 30);
    const CoordBBox all(Coord(-70), Coord(70));
    const Voxels everywhere = voxelsOfBox(all);
    int64_t voxels = 0;
    for (int round = 0; round < 48; ++round) {
        const Weights& weights = kWeights[round % std::size(kWeights)];
        const Length length(weights);
        std::uniform_int_distribution<int64_t> limit(
            0, 70 * weights[0]); // diameters of up to 35 voxels
        std::vector<ExactSphere> balls;
        for (int i = count(random); i > 0; --i) {
            const int64_t x = center(random), y = center(random), z = center(random),
                          r = limit(random);
            balls.push_back({{x, y, z}, r * r + (i % 2)});
        }
        CoordBBox clip = all;
        if (round % 3 == 0) clip.min() = Coord(corner(random), corner(random), corner(random));
        const auto tree = openvdb_spheretree::sphereUnion(balls, clip, distanceOf(weights));
        openvdb::tree::ValueAccessor<const openvdb::MaskTree> on(*tree);
        int64_t expected = 0;
        for (const Coord& q : everywhere) {
            bool inside = false;
            for (const ExactSphere& ball : balls) {
                const Coord c(int(ball.center[0]), int(ball.center[1]), int(ball.center[2]));
                const int64_t d = length(Coord(2 * q[0], 2 * q[1], 2 * q[2]), c);
                inside = inside || d * d <= ball.radiusSq;
            }
            inside = inside && clip.isInside(q);
            ASSERT_EQ(on.isValueOn(q), inside) << q << " round " << round;
            expected += inside;
        }
        ASSERT_EQ(int64_t(tree->activeVoxelCount()), expected);
        voxels += expected;
    }
    EXPECT_GT(voxels, 1000000) << "the balls have become too small to show anything";
}

TEST(NormsOracle, StoredTreesHoldWhatTheyPromiseAlsoInATurnedWorld)
{
    for (const RandomObject& object : someObjects(600, 11)) {
        const auto grid = gridOf(object.voxels);
        const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
        transform->postRotate(0.7, openvdb::math::X_AXIS);
        transform->postTranslate(openvdb::Vec3d(1e5, -1e5, 1e5 / 3));
        grid->setTransform(transform);
        for (const Weights& weights : kWeights) {
            for (SphereTreeSettings settings : bothTypes()) {
                settings.pyramid().dist = distanceOf(weights);
                SCOPED_TRACE(object.name + ": " + describe(settings));
                SphereTree tree = buildSphereTree(*grid, settings);
                computeLevelErrors(tree, *grid);
                const SphereTree read =
                    openvdb_spheretree::fromPoints(*openvdb_spheretree::toPoints(tree));
                ASSERT_TRUE(sameNodes(tree, read));
                ASSERT_TRUE(read.settings.dist() == settings.dist());
                const auto faults = openvdb_spheretree::checkSphereTree(read, *grid);
                ASSERT_TRUE(faults.empty()) << faults.front().sentence;
            }
        }
    }
}

TEST(NormsOracle, ACheckFindsARadiusThatIsTooSmallAndOneThatIsNoSquare)
{
    const RandomObject object = randomObject(7);
    const auto grid = gridOf(object.voxels);
    SphereTreeSettings settings = extendedTree();
    settings.pyramid().dist = Distance::linf();
    const SphereTree tree = buildSphereTree(*grid, settings);
    ASSERT_TRUE(openvdb_spheretree::checkSphereTree(tree, *grid).empty());
    SphereTree smaller = tree;
    smaller.spheres.coverRadiusSq[0] /= 2;
    smaller.spheres.radius[0] /= std::sqrt(2);
    EXPECT_FALSE(openvdb_spheretree::checkSphereTree(smaller, *grid).empty());
    SphereTree noSquare = tree;
    noSquare.radiusSq[0] = 3;
    EXPECT_FALSE(openvdb_spheretree::checkSphereTree(noSquare, *grid).empty());
}

} // namespace
