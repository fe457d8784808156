// SPDX-License-Identifier: Apache-2.0
/// @file TestLabelStream.cc
/// @brief Labels and balls slab by slab: the same as voxel by voxel, however few slabs enter at a
/// time.

#include <openvdb_spheretree/slab/LabelStream.h>

#include "../support/BuiltTrees.h"

#include <openvdb_spheretree/Interrupted.h>
#include <openvdb_spheretree/slab/LargestRadius.h>
#include <openvdb_spheretree/slab/StreamWindow.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using slab::LabelStream;
using slab::LevelBalls;

constexpr uint32_t kWindows[] = {1, 2, 3, 7, UINT32_MAX};

/// Voxels of a layout, and those that label them.
struct Labelled {
    explicit Labelled(const LeafLayout& layout)
    {
        forEachVoxel(layout, [&](uint32_t leaf, uint32_t offset, const Coord& voxel) {
            voxels.push_back(voxel);
            asked.push_back({leaf, offset});
        });
    }
    Voxels voxels;
    std::vector<PowerMap::Voxel> asked;
};

/// Balls, answers and kept labels are those of the reference.
void expectReference(const NaiveReference& naive, int dim, uint32_t window)
{
    const LeafLayout layout(*maskOf(naive.voxels()));
    Labelled labelled(layout);
    detail::LabelSteps steps;
    LabelStream stream(layout, dim);
    stream.ask(labelled.asked);
    stream.keepSteps(steps);
    stream.setWindow(window);
    const LevelBalls found = stream.run(nullptr);
    const PowerMap labels(layout, std::move(steps));
    ASSERT_TRUE(agreeOnBalls(naive.balls(), found.balls));
    for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
        ASSERT_EQ(labels.label(naive.voxels()[i]), naive.label(i));
    }
    for (std::size_t i = 0; i < labelled.voxels.size(); ++i) {
        const PowerMap::Voxel& answer = labelled.asked[i];
        ASSERT_EQ(layout.voxel(answer.leaf, answer.offset), labels.label(labelled.voxels[i]));
    }
    for (const MedialBall& ball : found.balls) {
        ASSERT_TRUE(isOn(found.centers[*layout.findLeaf(ball.center)], leafOffset(ball.center)));
    }
}

TEST(LabelStream, IsTheReferenceForAnyWindow)
{
    for (const RandomObject& object : someObjects(0, 22)) {
        for (const int dim : {2, 3}) {
            const NaiveReference naive(object.voxels, dim);
            for (const uint32_t window : kWindows) {
                SCOPED_TRACE(object.name + ", window " + std::to_string(window));
                ASSERT_NO_FATAL_FAILURE(expectReference(naive, dim, window));
            }
        }
    }
}

/// Balls that reach over several slabs, before, behind and across thin ones, with gaps between.
Voxels ballsInARow(const std::vector<std::pair<int, int>>& atAndRadius, int dim = 3)
{
    Voxels voxels;
    for (const auto& [at, radius] : atAndRadius) {
        const int high = dim == 3 ? radius : 0;
        const CoordBBox box(Coord(-radius, -radius, -high), Coord(radius, radius, high));
        for (const Coord& v : voxelsOfBox(box)) {
            const int distSq = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
            if (distSq < radius * radius) voxels.push_back(v.offsetBy(at, 0, 0));
        }
    }
    std::sort(voxels.begin(), voxels.end());
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
    return voxels;
}

TEST(LabelStream, BallsReachOverSlabsBeforeAndBehind)
{
    for (const Voxels& voxels : {ballsInARow({{0, 7}, {10, 4}}), ballsInARow({{0, 4}, {10, 7}}),
             ballsInARow({{-7, 7}, {2, 3}, {7, 3}, {40, 6}, {41, 6}})}) {
        const NaiveReference naive(voxels);
        for (const uint32_t window : kWindows) {
            SCOPED_TRACE(window);
            ASSERT_NO_FATAL_FAILURE(expectReference(naive, 3, window));
        }
    }
}

/// Against the stream of all slabs at once, on discs too large for the reference.
TEST(LabelStream, LargeBallsAreTheSameForAnyWindow)
{
    for (const int radius : {59, 62, 129, 260}) { // keys with steps, plain ones, wide ones
        const LeafLayout layout(*maskOf(ballsInARow({{0, radius}, {radius + 9, radius / 3}}, 2)));
        const LevelBalls all = LabelStream(layout, 2).run(nullptr);
        for (const uint32_t window : {1, 5}) {
            LabelStream stream(layout, 2);
            stream.setWindow(window);
            const LevelBalls some = stream.run(nullptr);
            EXPECT_EQ(some.balls, all.balls) << radius << ", window " << window;
            EXPECT_EQ(some.centers, all.centers) << radius << ", window " << window;
        }
    }
}

TEST(LabelStream, NothingComesOfNothing)
{
    const LeafLayout layout{openvdb::MaskTree(false)};
    EXPECT_TRUE(LabelStream(layout, 3).run(nullptr).balls.empty());
}

TEST(LabelStream, KeepsToTheMemoryItIsGiven)
{
    const LeafLayout layout(*maskOf(ballsInARow({{0, 13}, {40, 9}, {90, 13}, {140, 6}})));
    const LevelBalls all = LabelStream(layout, 3).run(nullptr);
    LabelStream stream(layout, 3);
    stream.setMemory(int64_t(layout.leafCount()) * 3700);
    EXPECT_EQ(stream.run(nullptr).balls, all.balls);
    stream.setMemory(100000);
    EXPECT_THROW(stream.run(nullptr), openvdb::ValueError);
}

TEST(StreamWindow, IsTheLargestThatFits)
{
    Voxels line;
    for (int x = 0; x < 800; ++x) line.push_back(Coord(x, 3, 5));
    const LeafLayout layout(*maskOf(line)); // a hundred slabs of a leaf each
    const slab::StreamMemory memory{10, 1000};
    // Beside those that enter: two and two for the reach of a ball within a voxel of them.
    EXPECT_EQ(slab::slabBytes(layout, memory, 1, 1), 50);
    EXPECT_EQ(slab::slabBytes(layout, memory, 64, 1), 70);
    EXPECT_EQ(slab::slabBytes(layout, memory, 1, 1000), 1000);
    EXPECT_EQ(slab::windowWithin(layout, memory, 1, 2000), 100u);
    EXPECT_EQ(slab::windowWithin(layout, memory, 1, 1999), 50u);
    EXPECT_EQ(slab::windowWithin(layout, memory, 1, 1050), 1u);
    EXPECT_THROW(slab::windowWithin(layout, memory, 1, 1049), openvdb::ValueError);
}

TEST(LabelStream, CanBeInterrupted)
{
    const LeafLayout layout(*maskOf(shapes::box(Coord(60, 20, 20))));
    for (const int after : {0, 1, 3, 6}) {
        StopAfter stop(after);
        LabelStream stream(layout, 3);
        stream.setWindow(2);
        EXPECT_THROW(stream.run(&stop), Interrupted) << after;
    }
}

TEST(LargestDistSq, IsNeverTooSmall)
{
    for (const RandomObject& object : someObjects(0, 40)) {
        for (const int dim : {2, 3}) {
            const LeafLayout layout(*maskOf(object.voxels));
            EXPECT_GE(slab::largestDistSq(layout, dim, nullptr),
                distanceTransform(layout, dim).maxDistSq())
                << object.name;
        }
    }
    for (const int radius : {126, 127, 128, 130, 254, 255, 256, 300}) {
        const LeafLayout layout(*maskOf(ballsInARow({{3, radius}}, 2)));
        const uint32_t bound = slab::largestDistSq(layout, 2, nullptr);
        EXPECT_GE(bound, uint32_t(radius * radius));
        if (radius > 130) { // beyond what runs tell, it is exact
            EXPECT_EQ(bound, uint32_t(radius * radius));
        }
    }
}

} // namespace
