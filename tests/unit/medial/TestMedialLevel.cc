// SPDX-License-Identifier: Apache-2.0
/// @file TestMedialLevel.cc
/// @brief A level's stages in one piece: the same as one by one, and found again by centre and
/// voxel.

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/medial/MedialLevel.h>

#include "support/BuiltTrees.h"

#include <openvdb_spheretree/base/Interrupted.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(MedialLevel, HasTheBallsOfTheReference)
{
    for (const RandomObject& object : someObjects(0, 22)) {
        for (int dim : {2, 3}) {
            SCOPED_TRACE(object.name + (dim == 2 ? ", dim 2" : ""));
            const NaiveReference naive(object.voxels, dim);
            const MedialLevel level(*maskOf(object.voxels), dim, {}, nullptr);
            EXPECT_EQ(level.layout.voxelCount(), int64_t(naive.voxels().size()));
            EXPECT_TRUE(agreeOnBalls(naive.balls(), level.balls));
        }
    }
}

TEST(MedialLevel, FindsEveryBallByItsCentre)
{
    const MedialLevel level(*maskOf(randomObject(8).voxels), 3, {}, nullptr);
    ASSERT_GT(level.balls.size(), 10u);
    for (std::size_t i = 0; i < level.balls.size(); ++i) {
        EXPECT_EQ(level.ballAt(level.balls[i].center), int32_t(i));
    }
}

TEST(MedialLevel, FindsTheLabelOfEveryVoxel)
{
    const Voxels voxels = randomObject(20).voxels;
    const NaiveReference naive(voxels);
    const MedialLevel level(*maskOf(voxels), 3, {}, nullptr, nullptr, {0, {}, true});
    for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
        EXPECT_EQ(level.balls.at(level.labelOf(naive.voxels()[i])).center, naive.label(i));
    }
}

TEST(MedialLevel, FindsTheLabelsThatAreQueried)
{
    const Voxels voxels = randomObject(20).voxels;
    for (const Distance& distance : {Distance(), Distance::linf()}) {
        const MedialLevel all(*maskOf(voxels), 3, distance, nullptr, nullptr, {0, {}, true});
        Voxels queried(voxels.rbegin(), voxels.rend());
        queried.push_back(voxels.front());
        queried.push_back(Coord(1000, 2, 3)); // off
        LevelQueries queries;
        queries.count = queried.size();
        queries.voxel = [&queried](std::size_t i) { return queried[i]; };
        const MedialLevel level(*maskOf(voxels), 3, distance, nullptr, nullptr, queries);
        ASSERT_EQ(level.queriedLabel.size(), queried.size());
        EXPECT_EQ(level.queriedLabel.back(), -1);
        for (std::size_t i = 0; i + 1 < queried.size(); ++i) {
            EXPECT_EQ(level.queriedLabel[i], all.labelOf(queried[i]));
        }
    }
}

TEST(MedialLevel, MarksTheCentresOfItsBalls)
{
    const MedialLevel level(*maskOf(randomObject(8).voxels), 3, {}, nullptr);
    std::size_t centers = 0;
    for (const LeafMask& mask : level.centers) {
        for (const uint64_t word : mask) centers += openvdb::util::CountOn(word);
    }
    EXPECT_EQ(centers, level.balls.size());
    for (const MedialBall& ball : level.balls) {
        const uint32_t leaf = level.layout.findLeaf(ball.center).value();
        EXPECT_TRUE(level.centers[leaf].isOn(leafIndex(ball.center)));
    }
}

TEST(MedialLevel, RejectsAVoxelThatIsOff)
{
    const MedialLevel level(
        *maskOf(Voxels{Coord(1, 2, 3)}), 3, {}, nullptr, nullptr, {0, {}, true});
    EXPECT_THROW(level.labelOf(Coord(1, 2, 4)), openvdb::LookupError);
    EXPECT_THROW(level.labelOf(Coord(100, 2, 3)), openvdb::LookupError);
}

TEST(MedialLevel, AddsTheTimesOfItsStages)
{
    StageSeconds seconds;
    seconds.distance = seconds.power = seconds.medial = 1000;
    seconds.pyramid = seconds.tree = 7;
    const MedialLevel level(*maskOf(shapes::box(Coord(20, 20, 20))), 3, {}, nullptr, &seconds);
    EXPECT_GT(seconds.distance, 1000);
    EXPECT_GT(seconds.power, 1000);
    EXPECT_GT(seconds.medial, 1000);
    EXPECT_EQ(seconds.pyramid, 7);
    EXPECT_EQ(seconds.tree, 7);
}

TEST(MedialLevel, StopsWhenInterruptedAtAnyStage)
{
    const auto mask = maskOf(shapes::box(Coord(9, 9, 9)));
    int questions = 0;
    for (bool finished = false; !finished; ++questions) {
        ASSERT_LT(questions, 10000);
        StopAfter stop(questions);
        try {
            const MedialLevel level(*mask, 3, {}, &stop);
            finished = true;
        } catch (const Interrupted&) {}
    }
    EXPECT_GT(questions, 4) << "the stages hardly ask";
}

} // namespace
