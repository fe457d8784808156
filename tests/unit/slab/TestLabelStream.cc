// SPDX-License-Identifier: Apache-2.0
/// @file TestLabelStream.cc
/// @brief Labels and balls slab by slab: the same as voxel by voxel, in however little memory.

#include <openvdb_spheretree/slab/LabelStream.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"
#include "support/TemporaryFolder.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/slab/LargestRadius.h>
#include <tbb/global_control.h>

#include <cmath>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using slab::LabelStream;
using slab::LevelBalls;

using slab::StreamPlan;

StreamPlan windowOf(uint32_t slabs)
{
    StreamPlan plan;
    plan.slabs = slabs;
    plan.threads = 2;
    return plan;
}

/// @param stored  bytes that stay in memory
StreamPlan packedPlan(int64_t bandBytes, int64_t stored, uint32_t slabs = 2)
{
    StreamPlan plan;
    plan.packed = true;
    plan.slabs = slabs;
    plan.bandBytes = bandBytes;
    plan.storedBytes = stored;
    return plan;
}

/// Windows of few slabs and many, and labels packed: in memory, in a file, and in both.
std::vector<StreamPlan> somePlans()
{
    constexpr int64_t kLeaf = kLeafVoxels * sizeof(int32_t);
    std::vector<StreamPlan> plans;
    for (const uint32_t slabs : {1u, 2u, 3u, 7u, UINT32_MAX}) plans.push_back(windowOf(slabs));
    plans.push_back(packedPlan(1, INT64_MAX, 1)); // a band for every run
    plans.push_back(packedPlan(3 * kLeaf, INT64_MAX));
    plans.push_back(packedPlan(INT64_MAX, 0));
    plans.push_back(packedPlan(2 * kLeaf, 1000));
    return plans;
}

std::string nameOf(const StreamPlan& plan)
{
    if (!plan.packed) return "window " + std::to_string(plan.slabs);
    return "packed, band " + std::to_string(plan.bandBytes) + ", in memory "
        + std::to_string(plan.storedBytes);
}

/// Voxels of a layout, and those that label them.
struct Labelled {
    explicit Labelled(const LeafLayout& layout)
    {
        forEachVoxel(layout, [&](uint32_t leaf, uint32_t offset, const Coord& voxel) {
            voxels.push_back(voxel);
            queried.push_back({leaf, offset});
        });
    }
    Voxels voxels;
    std::vector<VoxelRef> queried;
};

/// Balls, answers and kept labels are those of the reference.
void expectReference(const NaiveReference& naive, int dim, const StreamPlan& plan)
{
    const LeafLayout layout(*maskOf(naive.voxels()));
    Labelled labelled(layout);
    detail::LabelOffsets offsets;
    LabelStream stream(layout, dim);
    stream.query(labelled.queried);
    stream.keepOffsets(offsets);
    stream.setPlan(plan);
    const LevelBalls found = stream.run(nullptr);
    const PowerMap labels(layout, std::move(offsets));
    ASSERT_TRUE(agreeOnBalls(naive.balls(), found.balls));
    for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
        ASSERT_EQ(labels.label(naive.voxels()[i]), naive.label(i));
    }
    for (std::size_t i = 0; i < labelled.voxels.size(); ++i) {
        const VoxelRef& answer = labelled.queried[i];
        ASSERT_EQ(layout.voxel(answer.leaf, answer.index), labels.label(labelled.voxels[i]));
    }
    for (const MedialBall& ball : found.balls) {
        ASSERT_TRUE(found.centers[*layout.findLeaf(ball.center)].isOn(leafIndex(ball.center)));
    }
}

TEST(LabelStream, IsTheReferenceForAnyPlan)
{
    for (const RandomObject& object : someObjects(0, 22)) {
        for (const int dim : {2, 3}) {
            const NaiveReference naive(object.voxels, dim);
            for (const StreamPlan& plan : somePlans()) {
                SCOPED_TRACE(object.name + ", " + nameOf(plan));
                ASSERT_NO_FATAL_FAILURE(expectReference(naive, dim, plan));
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
        for (const StreamPlan& plan : somePlans()) {
            SCOPED_TRACE(nameOf(plan));
            ASSERT_NO_FATAL_FAILURE(expectReference(naive, 3, plan));
        }
    }
}

/// Balls, and the answers to all voxels.
struct Streamed {
    Streamed(const LeafLayout& layout, int dim, const StreamPlan& plan) : labelled(layout)
    {
        LabelStream stream(layout, dim);
        stream.query(labelled.queried);
        stream.setPlan(plan);
        level = stream.run(nullptr);
    }
    Labelled labelled;
    LevelBalls level;
};

void expectSame(const Streamed& some, const Streamed& all)
{
    EXPECT_EQ(some.level.balls, all.level.balls);
    EXPECT_EQ(some.level.centers, all.level.centers);
    ASSERT_EQ(some.labelled.queried.size(), all.labelled.queried.size());
    for (std::size_t i = 0; i < all.labelled.queried.size(); ++i) {
        const VoxelRef &one = some.labelled.queried[i], &other = all.labelled.queried[i];
        ASSERT_TRUE(one.leaf == other.leaf && one.index == other.index) << i;
    }
}

/// Against the stream of all slabs at once, on discs too large for the reference.
TEST(LabelStream, LargeBallsAreTheSameForAnyPlan)
{
    for (const int radius : {59, 62, 129, 260}) { // keys with steps, plain ones, wide ones
        const LeafLayout layout(*maskOf(ballsInARow({{0, radius}, {radius + 9, radius / 3}}, 2)));
        const Streamed all(layout, 2, windowOf(UINT32_MAX));
        for (const int threads : {1, 2}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            for (const StreamPlan& plan : somePlans()) {
                SCOPED_TRACE(std::to_string(radius) + ", " + nameOf(plan));
                ASSERT_NO_FATAL_FAILURE(expectSame(Streamed(layout, 2, plan), all));
            }
        }
    }
}

/// A solid, with blocks of more leaves than are packed together, and one that is wide.
TEST(LabelStream, LargeSolidsAreTheSameForAnyPlan)
{
    for (const Coord size : {Coord(20, 290, 270), Coord(280, 260, 262)}) {
        const LeafLayout layout(*maskOf(CoordBBox(Coord(3, -5, 1), size)));
        LabelStream stream(layout, 3);
        stream.setPlan(windowOf(UINT32_MAX));
        const LevelBalls all = stream.run(nullptr);
        for (const StreamPlan& plan :
            {windowOf(1), packedPlan(10 << 20, 100000), packedPlan(1 << 20, INT64_MAX, 1)}) {
            stream.setPlan(plan);
            const LevelBalls some = stream.run(nullptr);
            EXPECT_EQ(some.balls, all.balls) << size << nameOf(plan);
            EXPECT_EQ(some.centers, all.centers) << size << nameOf(plan);
        }
    }
}

TEST(LabelStream, NothingComesOfNothing)
{
    const LeafLayout layout{openvdb::MaskTree(false)};
    EXPECT_TRUE(LabelStream(layout, 3).run(nullptr).balls.empty());
    LabelStream stream(layout, 3);
    stream.setPlan(packedPlan(1, 0));
    EXPECT_TRUE(stream.run(nullptr).balls.empty());
}

/// A ball, for which all slabs are open at once.
LeafLayout ballLayout() { return LeafLayout(*maskOf(ballsInARow({{0, 45}}))); }

TEST(LabelStream, KeepsToTheMemoryItIsGiven)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
    const LeafLayout layout = ballLayout();
    LabelStream stream(layout, 3);
    const StreamPlan all = stream.plan(nullptr);
    EXPECT_FALSE(all.packed);
    EXPECT_GE(all.slabs, layout.slabCount());
    const LevelBalls expected = stream.run(nullptr);
    bool isPacked = false;
    for (int64_t memory = all.bytes; memory > all.bytes / 5 * 2; memory -= all.bytes / 12) {
        stream.setMemory(memory);
        const StreamPlan plan = stream.plan(nullptr);
        EXPECT_LE(plan.bytes, memory);
        EXPECT_GE(plan.packed, isPacked) << "more memory, but packed";
        isPacked = plan.packed;
        EXPECT_EQ(stream.run(nullptr).balls, expected.balls) << memory;
    }
    EXPECT_TRUE(isPacked);
    stream.setMemory(100000);
    const std::string why = messageOf<openvdb::ValueError>([&] { stream.run(nullptr); });
    EXPECT_TRUE(mentions(why, "the object's " + std::to_string(layout.leafCount())));
    EXPECT_TRUE(mentions(why, " MiB for their power labels, and memory= allows 97.6 KiB"));
}

TEST(LabelStream, SaysWhenThereIsNoRoomForItsFile)
{
    const LeafLayout layout = ballLayout();
    const TemporaryFolder folder;
    LabelStream stream(layout, 3);
    stream.setPlan(packedPlan(1 << 20, 10000));
    {
        const FileSizeLimit full(4096);
        EXPECT_THROW(stream.run(nullptr), openvdb::IoError);
    }
    EXPECT_EQ(folder.openFiles(), 0);
    EXPECT_NO_THROW(stream.run(nullptr));
    EXPECT_EQ(folder.openFiles(), 0);
    const TemporaryDirectory none(folder.path() + "/nowhere");
    EXPECT_THROW(stream.run(nullptr), openvdb::IoError);
    StreamPlan inMemory = packedPlan(1 << 20, INT64_MAX);
    stream.setPlan(inMemory);
    EXPECT_NO_THROW(stream.run(nullptr)) << "a file that is not needed";
    inMemory.packedBytes = INT64_MAX; // it is about to be
    inMemory.storedBytes = 100 << 20;
    stream.setPlan(inMemory);
    EXPECT_THROW(stream.run(nullptr), openvdb::IoError);
}

TEST(LabelStream, CanBeInterrupted)
{
    const TemporaryFolder folder;
    const LeafLayout layout(*maskOf(shapes::box(Coord(60, 20, 20))));
    for (const StreamPlan& plan : {windowOf(2), packedPlan(1, 0)}) {
        for (const int after : {0, 1, 3, 6, 12, 20}) {
            StopAfter stop(after);
            LabelStream stream(layout, 3);
            stream.setPlan(plan);
            EXPECT_THROW(stream.run(&stop), Interrupted) << after << nameOf(plan);
            EXPECT_EQ(folder.openFiles(), 0);
            EXPECT_EQ(folder.files(), 0);
        }
    }
}

TEST(LargestDistSq, IsNeverTooSmall)
{
    for (const RandomObject& object : someObjects(0, 40)) {
        for (const int dim : {2, 3}) {
            const LeafLayout layout(*maskOf(object.voxels));
            EXPECT_GE(slab::largestDistSq(layout, dim, 2, nullptr),
                distanceTransform(layout, dim).largest())
                << object.name;
        }
    }
    for (const int radius : {126, 127, 128, 130, 254, 255, 256, 300}) {
        const LeafLayout layout(*maskOf(ballsInARow({{3, radius}}, 2)));
        const uint32_t bound = slab::largestDistSq(layout, 2, 2, nullptr);
        EXPECT_GE(bound, uint32_t(radius * radius));
        if (radius > 130) { // beyond what runs tell, it is exact
            EXPECT_EQ(bound, uint32_t(radius * radius));
        }
    }
}

/// Bars that cross: the runs through their middle are long, though nothing is far from the background.
TEST(LargestDistSq, IsCloseWhereRunsAreLong)
{
    for (const int dim : {2, 3}) {
        for (const int half : {20, 31, 64}) {
            openvdb::MaskTree voxels(false);
            for (int axis = 0; axis < dim; ++axis) {
                openvdb::CoordBBox bar(openvdb::Coord(-37 - half), openvdb::Coord(-37 + half));
                bar.min()[axis] -= 200;
                bar.max()[axis] += 200;
                if (dim == 2) bar.min()[2] = bar.max()[2] = 5;
                voxels.fill(bar, true);
            }
            const LeafLayout layout(voxels);
            const uint32_t bound = slab::largestDistSq(layout, dim, 2, nullptr);
            const uint32_t largest = distanceTransform(layout, dim).largest();
            EXPECT_GE(bound, largest) << half;
            EXPECT_LE(std::sqrt(bound), std::sqrt(largest) + 2 * 8 * std::sqrt(dim)) << half;
        }
    }
}

TEST(LargestDistSq, BeyondWhatLabelsHoldIsAnError)
{
    EXPECT_NO_THROW(slab::requireRadius(32767u * 32767u));
    const std::string why =
        messageOf<openvdb::ValueError>([] { slab::requireRadius(32767u * 32767u + 1); });
    EXPECT_TRUE(mentions(why, "more than 32767 voxels radius"));
    EXPECT_TRUE(mentions(why, "use a larger voxel"));
}

} // namespace
