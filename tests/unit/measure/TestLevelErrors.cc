// SPDX-License-Identifier: Apache-2.0
/// @file TestLevelErrors.cc
/// @brief Errors of levels against brute force over all voxels and all pairs of them.

#include <openvdb_spheretree/measure/LevelErrors.h>

#include <openvdb_spheretree/sphere/SphereUnion.h>

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/measure/FarthestVoxel.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;

class LevelErrors : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

struct Sphere {
    openvdb::Vec3d center;
    int64_t coverSq;
    int subdivision = 2; ///< of all spheres of a tree
};

/// One level of spheres; the other fields are as the errors need them.
SphereTree treeOf(const std::vector<Sphere>& spheres, const BoolGrid& object, int dim = 3)
{
    SphereTree tree;
    for (const Sphere& s : spheres) {
        tree.spheres.center.push_back(s.center);
        tree.spheres.coverRadiusSq.push_back(s.coverSq);
        tree.subdivision = s.subdivision;
    }
    tree.levels.resize(1);
    tree.levels[0].end = int32_t(spheres.size());
    tree.settings.dim = dim;
    object.tree().evalActiveVoxelBoundingBox(tree.object.bbox);
    return tree;
}

bool inAny(const std::vector<Sphere>& spheres, const Coord& q)
{
    for (const Sphere& s : spheres) {
        if ((s.subdivision * (q.asVec3d() - s.center)).lengthSqr() <= s.coverSq) return true;
    }
    return false;
}

/// Errors by the definition; everything must be inside @a box.
LevelError bruteForce(const std::vector<Sphere>& spheres, const BoolGrid& object, CoordBBox box)
{
    std::vector<Coord> voxels, excess;
    LevelError error;
    const auto inObject = object.getConstAccessor();
    for (auto q = box.begin(); q; ++q) {
        const bool on = inObject.isValueOn(*q), covered = inAny(spheres, *q);
        if (on) voxels.push_back(*q);
        if (covered && !on) excess.push_back(*q);
        error.covered += covered;
        error.missing += on && !covered;
    }
    double farthest = 0;
    for (const Coord& q : excess) {
        double nearest = std::numeric_limits<double>::max();
        for (const Coord& o : voxels) {
            nearest = std::min(nearest, (q - o).asVec3d().lengthSqr());
        }
        farthest = std::max(farthest, nearest);
    }
    error.excess = int64_t(excess.size());
    error.hammingPercent = 100.0 * double(error.excess + error.missing) / double(voxels.size());
    error.hausdorff = std::sqrt(farthest);
    return error;
}

void expectSame(const std::optional<LevelError>& actual, const LevelError& expected)
{
    ASSERT_TRUE(actual.has_value());
    EXPECT_EQ(actual->covered, expected.covered);
    EXPECT_EQ(actual->excess, expected.excess);
    EXPECT_EQ(actual->missing, expected.missing);
    EXPECT_DOUBLE_EQ(actual->hammingPercent, expected.hammingPercent);
    EXPECT_DOUBLE_EQ(actual->hausdorff, expected.hausdorff);
}

LevelError errorOf(const std::vector<Sphere>& spheres, const BoolGrid& object, int dim = 3)
{
    SphereTree tree = treeOf(spheres, object, dim);
    computeLevelErrors(tree, object);
    EXPECT_TRUE(tree.levels[0].error.has_value()) << tree.levels[0].errorUnknown;
    EXPECT_EQ(tree.levels[0].errorUnknown, "");
    return tree.levels[0].error.value_or(LevelError());
}

/// Voxels at random around @a middle, a few or many.
BoolGrid::Ptr randomObject(std::mt19937& random, const Coord& middle, int spread, int count)
{
    BoolGrid::Ptr object = BoolGrid::create();
    std::uniform_int_distribution<int> offset(-spread, spread);
    for (int i = 0; i < count; ++i) {
        const int x = offset(random), y = offset(random), z = offset(random);
        object->tree().setValueOn(middle.offsetBy(x, y, z));
    }
    return object;
}

std::vector<Sphere> randomSpheres(
    std::mt19937& random, const Coord& middle, int spread, int subdivision)
{
    std::uniform_int_distribution<int> offset(-subdivision * spread, subdivision * spread);
    std::uniform_int_distribution<int> count(1, 5), square(0, 100 * subdivision * subdivision);
    std::vector<Sphere> spheres(count(random));
    for (Sphere& s : spheres) {
        const double x = offset(random), y = offset(random), z = offset(random);
        s.center = middle.asVec3d() + openvdb::Vec3d(x, y, z) / subdivision;
        s.coverSq = square(random);
        s.subdivision = subdivision;
    }
    return spheres;
}

TEST_F(LevelErrors, MatchBruteForceOnRandomObjectsAndSpheres)
{
    const Coord middles[] = {Coord(0), Coord(-128, 8, 4096), Coord(3, -5, 100)};
    for (unsigned seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const Coord middle = middles[seed % 3];
        const int count = seed % 4 == 0 ? 2 : 60;
        const BoolGrid::Ptr object = randomObject(random, middle, 9, count);
        const std::vector<Sphere> spheres = randomSpheres(random, middle, 8, seed % 2 ? 16 : 2);
        CoordBBox box(middle, middle);
        box.expand(20);
        expectSame(errorOf(spheres, *object), bruteForce(spheres, *object, box));
    }
}

/// Half as large in the world, and a little larger than what is covered exactly.
TEST_F(LevelErrors, OfStoredSpheresMatchBruteForceWithTheirRadii)
{
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const BoolGrid::Ptr object = randomObject(random, Coord(0), 9, 40);
        std::vector<Sphere> spheres = randomSpheres(random, Coord(0), 8, 16);
        SphereTree tree = treeOf(spheres, *object);
        tree.transform = openvdb::math::Transform::createLinearTransform(0.5);
        tree.transform->postRotate(0.3, openvdb::math::Y_AXIS);
        std::vector<double> radii;
        for (Sphere& s : spheres) {
            const double radius = std::sqrt(double(s.coverSq)) / 16 + (seed % 3) * 0.4371;
            tree.spheres.radiusWorld.push_back(float(radius * 0.5));
            radii.push_back(double(tree.spheres.radiusWorld.back()) / tree.voxelSize());
            s.coverSq = int64_t(256 * radii.back() * radii.back() * (1 + 1e-12));
        }
        computeLevelErrors(tree, *object);
        CoordBBox box(Coord(0), Coord(0));
        box.expand(21);
        const LevelError expected = bruteForce(spheres, *object, box);
        ASSERT_TRUE(tree.levels[0].stored.has_value());
        EXPECT_DOUBLE_EQ(tree.levels[0].stored->hammingPercent, expected.hammingPercent);
        EXPECT_EQ(tree.levels[0].storedUnknown, "");
        // A covered voxel's center is a point of a sphere, half a diagonal from its cube's ends.
        const double reach = tree.levels[0].stored->reachWorld / tree.voxelSize();
        EXPECT_GE(reach, expected.hausdorff - std::sqrt(0.75));
        EXPECT_LE(reach, expected.hausdorff + std::sqrt(0.75) + 1);
    }
}

TEST_F(LevelErrors, OfStoredSpheresAreUnknownWithAReasonWhereTheseAreTooLarge)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(0));
    SphereTree tree = treeOf({{{0, 0, 0}, 4}}, *object);
    tree.transform = openvdb::math::Transform::createLinearTransform();
    tree.spheres.radiusWorld = {1e6f};
    computeLevelErrors(tree, *object);
    EXPECT_TRUE(tree.levels[0].error.has_value());
    EXPECT_FALSE(tree.levels[0].stored.has_value());
    EXPECT_NE(
        tree.levels[0].storedUnknown.find("its stored spheres cross more than"), std::string::npos);
}

TEST_F(LevelErrors, FindTheFarthestOfAFewVoxelsAroundTheObject)
{
    // In the order of voxels the nearest comes first; the object is in the middle of them.
    BoolGrid::Ptr dot = BoolGrid::create();
    dot->tree().setValueOn(Coord(4, 4, 4));
    EXPECT_EQ(errorOf({{{3, 4, 4}, 0}, {{5, 2, 2}, 0}, {{5, 6, 6}, 0}}, *dot).hausdorff, 3);
    for (unsigned seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const Coord middle(4, 4, 5);
        const BoolGrid::Ptr object = randomObject(random, middle, 3, 1 + seed % 3);
        std::vector<Sphere> spheres(1 + seed % 5);
        for (Sphere& s : spheres) {
            const double x = random() % 9, y = random() % 9, z = random() % 9;
            s = {openvdb::Vec3d(x, y, z), 0};
        }
        CoordBBox box(middle, middle);
        box.expand(6);
        expectSame(errorOf(spheres, *object), bruteForce(spheres, *object, box));
    }
}

TEST_F(LevelErrors, AreZeroWhereTheSpheresAreTheObject)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(-1, 2, 3));
    object->tree().setValueOn(Coord(7, 8, 9));
    const LevelError error = errorOf({{{-1, 2, 3}, 0}, {{7, 8, 9}, 3}}, *object);
    EXPECT_EQ(error.covered, 2);
    EXPECT_EQ(error.excess, 0);
    EXPECT_EQ(error.missing, 0);
    EXPECT_EQ(error.hammingPercent, 0);
    EXPECT_EQ(error.hausdorff, 0);
}

TEST_F(LevelErrors, FindTheFarthestVoxelInsideAHole)
{
    // A hollow cube: the middle of the hole is farther than anything outside.
    BoolGrid::Ptr object = BoolGrid::create();
    object->fill(CoordBBox(Coord(-12), Coord(12)), true, true);
    object->fill(CoordBBox(Coord(-10), Coord(10)), false, false);
    const std::vector<Sphere> spheres{{{0, 0, 0}, 4 * 22 * 22}};
    const LevelError error = errorOf(spheres, *object);
    EXPECT_EQ(error.hausdorff, 11);
    expectSame(error, bruteForce(spheres, *object, CoordBBox(Coord(-24), Coord(24))));
}

TEST_F(LevelErrors, FindTheFarthestVoxelWhereverItIsInATile)
{
    // Of the ball that six voxels at its poles span, the middle is farthest from them.
    for (int i = 0; i < 8; ++i) {
        const Coord middle(i & 4 ? 40 : 90, i & 2 ? 40 : 90, i & 1 ? 40 : 90);
        BoolGrid::Ptr object = BoolGrid::create();
        for (int axis = 0; axis < 3; ++axis) {
            for (int step : {-300, 300}) {
                Coord pole = middle;
                pole[axis] += step;
                object->tree().setValueOn(pole);
            }
        }
        const LevelError error = errorOf({{middle.asVec3d(), int64_t(4) * 300 * 300}}, *object);
        EXPECT_EQ(error.hausdorff, 300) << middle;
        EXPECT_EQ(error.missing, 0);
    }
}

TEST_F(LevelErrors, CountTilesOnBothSides)
{
    // Object: tiles of 8 and of 128 voxels; spheres large enough to make tiles of 8 and 128.
    BoolGrid::Ptr object = BoolGrid::create();
    object->sparseFill(CoordBBox(Coord(0), Coord(127)), true, true);
    object->sparseFill(CoordBBox(Coord(128, 0, 0), Coord(151, 15, 15)), true, true);
    ASSERT_GT(object->tree().activeTileCount(), 1u);
    const std::vector<Sphere> spheres{{{63.5, 63.5, 63.5}, 4 * 112 * 112}};
    BoolGrid::Ptr voxels = object->deepCopy();
    voxels->tree().voxelizeActiveTiles();
    const LevelError error = errorOf(spheres, *object);
    expectSame(error, errorOf(spheres, *voxels));
    EXPECT_EQ(error.covered - error.excess + error.missing, int64_t(object->activeVoxelCount()));
    // The sphere holds the whole cube. Its poles on the axes are farthest: doubled coordinates are
    // odd, so 63.5 + 111.5 = 175 is the last x, 48 beyond the cube, and y = 63 is in the cube.
    EXPECT_EQ(error.hausdorff, 48);
}

TEST_F(LevelErrors, ASphereWithinATileOfTheObjectHasNoExcess)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().addTile(2, Coord(0), true, true); // 128^3
    const LevelError error = errorOf({{{64, 64, 64}, 4 * 100}}, *object);
    EXPECT_EQ(error.excess, 0);
    EXPECT_EQ(error.hausdorff, 0);
    EXPECT_EQ(error.missing, 128 * 128 * 128 - error.covered);
}

TEST_F(LevelErrors, TheDifferenceOfMasksIsOpenVdbsForNodesOfEveryLevelAgainstEachOther)
{
    using openvdb::MaskTree;
    // Every way to have something at the origin: nothing, voxels, and tiles of 8, 128 and 4096.
    std::vector<MaskTree> masks(5);
    for (openvdb::Index level = 1; level <= 3; ++level) {
        masks[level].addTile(level, Coord(0), true, true);
    }
    for (int i = 0; i < 40; ++i) masks[4].setValueOn(Coord(i * 37 % 200, i * 11 % 13, i));
    for (const MaskTree& a : masks) {
        for (const MaskTree& b : masks) {
            MaskTree expected(a);
            expected.topologyDifference(b);
            const detail::MaskDifference actual = detail::maskDifference(a, b, nullptr);
            EXPECT_EQ(actual.voxels, int64_t(expected.activeVoxelCount()));
            int64_t voxels = 0;
            for (const detail::VoxelCube& cube : actual.cubes) {
                voxels += cube.voxels();
                EXPECT_TRUE(expected.isValueOn(cube.first()));
            }
            EXPECT_EQ(voxels, actual.voxels);
        }
    }
}

TEST_F(LevelErrors, FindTheFarthestOfManyBlocksOfALargeTile)
{
    openvdb::MaskTree tile(false);
    tile.addTile(3, Coord(0), true, true); // of 4096
    openvdb::MaskTree object(tile);
    const auto hole = [&](const Coord& middle, int reach) {
        CoordBBox box(middle, middle);
        box.expand(reach);
        object.fill(box, false, false);
    };
    hole(Coord(20, 20, 20), 1);
    hole(Coord(1300, 20, 30), 2);
    hole(Coord(1300, 700, 30), 5); // over several leaves
    hole(Coord(4000, 4000, 4000), 3);
    const detail::MaskMinus holes(tile, object);
    const detail::VoxelCount count = detail::countVoxels(holes, nullptr);
    EXPECT_EQ(count.voxels, 27 + 125 + 1331 + 343);
    EXPECT_EQ(
        detail::farthestDistSq(holes, count.samples, object, detail::NearestVoxel(object), nullptr),
        36);
}

TEST_F(LevelErrors, CompareWholeSphereTilesWithAnObjectFarSmaller)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(2, 0, 0));
    const int64_t radius = 300;
    const LevelError error = errorOf({{{0, 0, 0}, 4 * radius * radius}}, *object);
    EXPECT_EQ(error.excess, error.covered - 1);
    EXPECT_EQ(error.missing, 0);
    EXPECT_EQ(error.hausdorff, 302); // (-300, 0, 0)
}

TEST_F(LevelErrors, MeasureBetweenTwoFarVoxels)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(-1000, 0, 0));
    object->tree().setValueOn(Coord(1000, 0, 0));
    const LevelError error = errorOf({{{0, 0, 0}, 4000000}}, *object);
    // On the sphere's equator x = 0: 1000 from the centre, 1000 from both voxels' plane.
    EXPECT_EQ(error.hausdorff, std::sqrt(2e6));
    EXPECT_EQ(error.missing, 0);
}

TEST_F(LevelErrors, CountMissingVoxels)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->fill(CoordBBox(Coord(0), Coord(9)), true, true);
    const LevelError error = errorOf({{{0, 0, 0}, 0}, {{50, 0, 0}, 0}}, *object);
    EXPECT_EQ(error.covered, 2);
    EXPECT_EQ(error.excess, 1);
    EXPECT_EQ(error.missing, 999);
    EXPECT_DOUBLE_EQ(error.hammingPercent, 100);
    EXPECT_EQ(error.hausdorff, 41);
}

TEST_F(LevelErrors, InTwoDimensionsOnlyThePlaneCounts)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->fill(CoordBBox(Coord(0, 0, -7), Coord(3, 3, -7)), true, true);
    const std::vector<Sphere> spheres{{{1.5, 1.5, -7}, 100}};
    const LevelError error = errorOf(spheres, *object, 2);
    const CoordBBox plane(Coord(-10, -10, -7), Coord(15, 15, -7));
    expectSame(error, bruteForce(spheres, *object, plane));
    EXPECT_LT(error.covered, 100);
}

TEST_F(LevelErrors, ALevelOfTooManyRowsIsLeftOutWithTheReason)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(0));
    object->tree().setValueOn(Coord(1000000, 1000000, 0));
    SphereTree tree = treeOf({{{0, 0, 0}, 0}, {{1000000, 1000000, 0}, 0},
                                 {{500000, 500000, 0}, int64_t(2) * 1000000 * 1000000}},
        *object);
    tree.levels[0].end = 2;
    tree.levels.push_back(tree.levels[0]);
    tree.levels[1].begin = 2;
    tree.levels[1].end = 3;
    tree.levels[1].error = LevelError(); // from before
    computeLevelErrors(tree, *object);
    ASSERT_TRUE(tree.levels[0].error.has_value());
    EXPECT_EQ(tree.levels[0].error->hammingPercent, 0);
    EXPECT_FALSE(tree.levels[1].error.has_value());
    EXPECT_EQ(tree.levels[1].errorUnknown,
        "its spheres cross more than the 16777216 rows of voxels that are counted");
    tree.settings.dim = 2;
    computeLevelErrors(tree, *object);
    EXPECT_TRUE(tree.levels[0].error.has_value());
    EXPECT_FALSE(tree.levels[1].error.has_value()) << "the plane has as many rows as space";
}

TEST_F(LevelErrors, ALevelOfJustTheRowsOfTheLimitIsCounted)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(0));
    // Two discs of a radius of 2048 (4096 x 4096 rows from pole to pole) on one another; in 2-D.
    ASSERT_EQ(kMaxUnionRows, 4096 * 4096);
    const std::vector<Sphere> spheres(2, Sphere{{0.5, 0.5, 0}, int64_t(4095) * 4095 + 1});
    const LevelError error = errorOf(spheres, *object, 2);
    EXPECT_EQ(error.missing, 0);
    EXPECT_NEAR(error.hausdorff, 2048, 1);
}

TEST_F(LevelErrors, AreUnknownOfAnEmptyObject)
{
    const BoolGrid::Ptr object = BoolGrid::create();
    for (int64_t coverSq : {int64_t(-1), int64_t(100)}) {
        SphereTree tree = treeOf({{{0, 0, 0}, coverSq}}, *object);
        computeLevelErrors(tree, *object);
        EXPECT_FALSE(tree.levels[0].error.has_value());
        EXPECT_EQ(tree.levels[0].errorUnknown, "the object is empty");
    }
}

TEST_F(LevelErrors, TakeThePlaceOfWhatWasRecordedBefore)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(0));
    SphereTree tree = treeOf({{{0, 0, 0}, 0}}, *object);
    tree.levels[0].errorUnknown = "not asked for";
    computeLevelErrors(tree, *object);
    EXPECT_TRUE(tree.levels[0].error.has_value());
    EXPECT_EQ(tree.levels[0].errorUnknown, "");
}

TEST_F(LevelErrors, ManySpheresOnTopOfEachOtherAreNoMoreThanTheRowsOfTheirBox)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->fill(CoordBBox(Coord(-5, -5, 0), Coord(5, 5, 0)), true, true);
    // Each crosses 31,416 rows, all of them 157 million; the box has 201 x 201. (2-D, for speed.)
    SphereTree tree = treeOf(std::vector<Sphere>(5000, Sphere{{0, 0, 0}, 40000}), *object, 2);
    computeLevelErrors(tree, *object);
    EXPECT_TRUE(tree.levels[0].error.has_value());
}

TEST_F(LevelErrors, SpheresTooFarToMeasureAreLeftOutWithTheReason)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(-2000000000, 0, 0));
    SphereTree tree = treeOf({{{2e9, 0, 0}, 0}}, *object);
    computeLevelErrors(tree, *object);
    EXPECT_FALSE(tree.levels[0].error.has_value());
    EXPECT_EQ(tree.levels[0].errorUnknown,
        "its spheres reach farther from the object than the 2^29 voxels that are measured");
}

TEST_F(LevelErrors, DoNotDependOnThreads)
{
    std::mt19937 random(11);
    const BoolGrid::Ptr object = randomObject(random, Coord(0), 60, 400);
    std::vector<Sphere> spheres;
    for (int i = 0; i < 40; ++i) {
        for (const Sphere& s : randomSpheres(random, Coord(0), 70, 2)) spheres.push_back(s);
    }
    const auto compute = [&](int threads) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return errorOf(spheres, *object);
    };
    const LevelError one = compute(1);
    for (int i = 0; i < 5; ++i) expectSame(compute(2), one);
}

TEST_F(LevelErrors, AnInterruptedCallLeavesTheTreeAsItWas)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(0));
    SphereTree tree = treeOf({{{0, 0, 0}, 16}}, *object);
    EXPECT_THROW(computeLevelErrors(tree, *object, &stop), Interrupted);
    EXPECT_FALSE(tree.levels[0].error.has_value());
}

} // namespace
