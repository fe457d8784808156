// SPDX-License-Identifier: Apache-2.0
/// @file TestNearestSearch.cc
/// @brief Sets of spheres that change, and the search for the nearest ones: counts against naive ones, and never
/// worse than the start.

#include <openvdb_spheretree/nearest/NearestSearch.h>
#include <openvdb_spheretree/nearest/SphereSet.h>

#include "NaiveSpheres.h"
#include "support/BuiltTrees.h"

#include <openvdb_spheretree/inner/InnerOrder.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <tbb/global_control.h>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::nearest;
using namespace spheretree_test;
using openvdb_spheretree::tight::SampledObject;

/// An object with all that a search asks for.
struct Stage {
    Voxels voxels;
    openvdb::MaskTree::Ptr mask;
    CoreStages stages;
    SampledObject samples;
    NearestObject object;

    Stage(const Voxels& all, int dim)
        : voxels(dim == 2 ? inPlaneZero(all) : all), mask(maskOf(voxels)), stages(*mask, dim),
          samples(stages.layout), object{*mask, samples, int64_t(voxels.size()), dim, 0, nullptr}
    {}

    std::vector<ExactSphere> inner(int64_t most) const
    {
        std::vector<ExactSphere> spheres;
        const auto order = detail::innerOrder(stages.layout, stages.balls, object.dim, most);
        for (const int32_t ball : order.ball) {
            spheres.push_back(tight::fineBall(stages.balls[std::size_t(ball)]));
        }
        return spheres;
    }
};

} // namespace

TEST(NearestSearch, CountsExcessAndMissing)
{
    Random random(11);
    for (const RandomObject& object : someObjects(0, 30)) {
        for (const int dim : {3, 2}) {
            const Stage stage(object.voxels, dim);
            std::vector<ExactSphere> spheres;
            for (int i = 0; i < 3; ++i) {
                spheres.push_back(randomSphere(stage.voxels, random, dim == 2));
            }
            EXPECT_EQ(
                wrongVoxels(stage.object, spheres), naiveWrong(stage.voxels, spheres, dim == 2))
                << object.name;
            // Each ball of what is missing makes less wrong, and all of them leave nothing missing.
            const std::set<Coord> held = naiveVoxels(spheres, dim == 2);
            for (const ExactSphere& ball : missingBalls(stage.object, spheres, INT64_MAX)) {
                for (const Coord& v : naiveVoxels({ball}, dim == 2)) {
                    EXPECT_TRUE(isIn(stage.voxels, v) && !held.count(v)) << object.name;
                }
                spheres.push_back(ball);
            }
            const std::set<Coord> all = naiveVoxels(spheres, dim == 2);
            for (const Coord& v : stage.voxels) EXPECT_TRUE(all.count(v)) << object.name;
        }
    }
}

TEST(NearestSearch, IsNeverWorseThanItsStartAndCountsWhatIsWrong)
{
    bool better = false;
    for (const RandomObject& object : someObjects(30, 40)) {
        for (const int dim : {3, 2}) {
            const Stage stage(object.voxels, dim);
            for (const int64_t count : {1, 3, 8}) {
                const std::vector<ExactSphere> start = stage.inner(count);
                const NearestSpheres found = nearestFrom(stage.object, start);
                const int64_t before = naiveWrong(stage.voxels, start, dim == 2);
                EXPECT_EQ(found.spheres.size(), start.size());
                EXPECT_EQ(found.wrong, naiveWrong(stage.voxels, found.spheres, dim == 2));
                EXPECT_LE(found.wrong, before) << object.name << ", " << count;
                better = better || found.wrong < before;
            }
        }
    }
    EXPECT_TRUE(better);
}

TEST(NearestSearch, FindsTheBallsThatAnObjectIsMadeOf)
{
    Voxels voxels = shapes::ball(40);
    for (const Coord& v : shapes::ball(26)) voxels.push_back(v.offsetBy(30, 0, 0));
    const Stage stage(voxels, 3);
    // Two spheres at one place: one of them has to go all the way.
    const ExactSphere at{{16, 16, 0}, 60 * 60};
    EXPECT_EQ(nearestFrom(stage.object, {at, at}).wrong, 0);
}

TEST(NearestSearch, IsTheSameForAnyNumberOfThreads)
{
    using Control = tbb::global_control;
    Random random(1);
    const Stage stage(shapes::noise(Coord(40, 30, 20), 0.9, random), 3);
    std::vector<NearestSpheres> found;
    for (const std::size_t threads : {1, 2, 5}) {
        const Control control(Control::max_allowed_parallelism, threads);
        found.push_back(nearestFrom(stage.object, stage.inner(40)));
    }
    for (const NearestSpheres& other : found) {
        EXPECT_EQ(other.spheres, found[0].spheres);
        EXPECT_EQ(other.wrong, found[0].wrong);
    }
}

TEST(SphereSet, DescentsOnlyLessenWhatIsWrong)
{
    Random random(21);
    for (const RandomObject& object : someObjects(70, 20)) {
        const Stage stage(object.voxels, 3);
        std::vector<ExactSphere> spheres;
        for (int i = 0; i < 6; ++i) spheres.push_back(randomSphere(stage.voxels, random, false));
        SphereSet set(stage.samples, false, spheres, nullptr);
        int64_t before = naiveWrong(stage.voxels, spheres, false);
        for (int round = 0; round < 3; ++round) {
            set.descend(1, 48);
            const int64_t now = naiveWrong(stage.voxels, set.spheres(), false);
            EXPECT_LE(now, before) << object.name;
            before = now;
        }
    }
}

TEST(SphereSet, DropsWhatIsWorthLeast)
{
    Random random(22);
    for (const RandomObject& object : someObjects(90, 20)) {
        const Stage stage(object.voxels, 3);
        std::vector<ExactSphere> spheres;
        for (int i = 0; i < 5; ++i) spheres.push_back(randomSphere(stage.voxels, random, false));
        SphereSet set(stage.samples, false, spheres, nullptr);
        set.dropLeast(4);
        int64_t least = INT64_MAX;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            std::vector<ExactSphere> others = spheres;
            others.erase(others.begin() + std::ptrdiff_t(i));
            least = std::min(least, naiveWrong(stage.voxels, others, false));
        }
        ASSERT_EQ(set.spheres().size(), 4u);
        EXPECT_EQ(naiveWrong(stage.voxels, set.spheres(), false), least) << object.name;
    }
}

/// What two spheres hold is worth nothing until one of them goes.
TEST(SphereSet, DropsByWhatSpheresAreWorthAfterOthersWent)
{
    Voxels voxels = shapes::ball(50);
    for (const Coord& v : shapes::ball(5)) voxels.push_back(v.offsetBy(30, 0, 0));
    const Stage stage(voxels, 3);
    const std::vector<ExactSphere> twice{{{0, 0, 0}, 256 * 50}, {{4, 0, 0}, 256 * 50}};
    const ExactSphere small{{480, 0, 0}, 256 * 5};
    SphereSet set(stage.samples, false, {twice[0], twice[1], small}, nullptr);
    set.dropLeast(2);
    EXPECT_EQ(set.spheres().back(), small);
    set.dropLeast(1);
    EXPECT_FALSE(set.spheres().back() == small);
    SphereSet atOnce(stage.samples, false, {twice[0], twice[1], small}, nullptr);
    atOnce.dropLeast(1);
    EXPECT_EQ(atOnce.spheres(), set.spheres());
}

TEST(SphereSet, ASphereThatIsAddedIsVisited)
{
    const Stage stage(shapes::ball(50), 3);
    SphereSet set(stage.samples, false, {}, nullptr);
    set.add({{24, 0, 0}, 80 * 80});
    set.descend(12, 48);
    EXPECT_EQ(naiveWrong(stage.voxels, set.spheres(), false), 0);
}
