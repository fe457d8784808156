// SPDX-License-Identifier: Apache-2.0
#include "MedialLevel.h"

#include "BallIndex.h"
#include "DistanceMap.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/slab/LabelStream.h>
#include <openvdb_spheretree/voxel/LeafFinder.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;

using slab::kNoLeaf;

/// @return the places of voxels; those that are off have no leaf.
template <typename VoxelOf>
std::vector<VoxelRef> placesOf(std::size_t count, const VoxelOf& voxelOf, const LeafLayout& layout,
    NullInterrupter* interrupter)
{
    std::vector<VoxelRef> places;
    detail::resizeLarge(places, count);
    detail::parallelForWith(
        count, interrupter, [&] { return detail::LeafFinder(layout); },
        [&](std::size_t i, detail::LeafFinder& finder) {
            const openvdb::Coord voxel = voxelOf(i);
            const auto leaf = finder.find(voxel);
            const uint32_t index = leafIndex(voxel);
            const bool on = leaf && layout.mask(*leaf).isOn(index);
            places[i] = {on ? *leaf : kNoLeaf, index};
        });
    return places;
}

/// @return the balls with their centers at @a labels; -1 where there is no label.
std::vector<int32_t> ballsAt(const std::vector<VoxelRef>& labels, const LeafLayout& layout,
    const std::vector<LeafMask>& centers, NullInterrupter* interrupter)
{
    std::vector<int32_t> balls;
    if (labels.empty()) return balls;
    detail::resizeLarge(balls, labels.size());
    const detail::BallIndex index(layout, centers, interrupter);
    detail::parallelFor(labels.size(), interrupter, [&](std::size_t i) {
        const bool none = labels[i].leaf == kNoLeaf;
        balls[i] = none ? -1 : index.ballOf(index.rankAt(labels[i]));
    });
    return balls;
}

/// @return the voxels that are their own labels: a label's own label is itself.
std::vector<LeafMask> ownLabels(const PowerMap& labels, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    std::vector<LeafMask> centers(layout.leafCount(), LeafMask{});
    detail::parallelFor(centers.size(), interrupter, [&](std::size_t i) {
        const auto leaf = uint32_t(i);
        layout.mask(leaf).visitOn([&](uint32_t index) {
            const VoxelRef site = labels.label(VoxelRef{leaf, index});
            if (site.leaf == leaf && site.index == index) centers[i].setOn(index);
        });
    });
    return centers;
}

/// @return the balls of a norm with these centers.
std::vector<MedialBall> normBalls(
    const std::vector<LeafMask>& centers, const LeafLayout& layout, const DistanceMap& distances)
{
    std::vector<std::size_t> first{0}; // of each slab
    for (uint32_t index = 0; index < layout.slabCount(); ++index) {
        const LeafLayout::Slab slab = layout.slab(index);
        first.push_back(
            first.back() + detail::countMarks(centers.data() + slab.begin, slab.size()));
    }
    std::vector<MedialBall> balls(first.back());
    detail::parallelFor(layout.slabCount(), nullptr, [&](std::size_t slab) {
        MedialBall* ball = balls.data() + first[slab];
        const LeafMask* own = centers.data() + layout.slab(uint32_t(slab)).begin;
        detail::visitWithPlaces(
            layout, uint32_t(slab), own, [&](uint32_t leaf, uint32_t index, std::size_t place) {
                const auto radius = int32_t(distances.at(leaf, index));
                ball[place] = {layout.voxel(leaf, index), radius * radius};
            });
    });
    return balls;
}

} // namespace

int64_t normBytes(const LeafLayout& layout)
{
    constexpr int64_t kDistance = sizeof(uint32_t), kSite = sizeof(uint32_t);
    const int64_t perLeaf = kLeafVoxels * (kDistance + kSite) + int64_t(sizeof(LeafMask));
    return layout.bytes() + int64_t(layout.leafCount()) * perLeaf;
}

MedialLevel::MedialLevel(const openvdb::MaskTree& voxels, int dim, const Distance& distance,
    NullInterrupter* interrupter, StageSeconds* seconds, const LevelQueries& queries)
    : layout(detail::timed("layout of leaves", interrupter, seconds ? &seconds->distance : nullptr,
        [&] { return LeafLayout(voxels); }))
{
    if (distance.isEuclidean()) findBalls(dim, queries, interrupter, seconds);
    else findNormBalls(dim, distance, queries, interrupter, seconds);
}

void MedialLevel::findBalls(
    int dim, const LevelQueries& queries, NullInterrupter* interrupter, StageSeconds* seconds)
{
    std::vector<VoxelRef> queried = placesOf(queries.count, queries.voxel, layout, interrupter);
    slab::LabelStream stream(layout, dim);
    stream.query(queried);
    stream.setMemory(queries.memory);
    detail::LabelOffsets offsets;
    if (queries.allLabels) stream.keepOffsets(offsets);
    slab::LevelBalls found = stream.run(interrupter);
    if (seconds) {
        seconds->distance += found.seconds.distance;
        seconds->power += found.seconds.power;
        seconds->medial += found.seconds.medial;
    }
    if (queries.allLabels) labels = PowerMap(layout, std::move(offsets));
    balls = std::move(found.balls);
    centers = std::move(found.centers);
    queriedLabel = ballsAt(queried, layout, centers, interrupter);
}

/// Norms have no stream: everything is in memory.
void MedialLevel::findNormBalls(int dim, const Distance& distance, const LevelQueries& queries,
    NullInterrupter* interrupter, StageSeconds* seconds)
{
    detail::requireAllowed(
        layout.leafCount(), normBytes(layout), detail::allowedMemory(queries.memory));
    const DistanceMap distances =
        detail::timed("distance transform", interrupter, seconds ? &seconds->distance : nullptr,
            [&] { return distanceTransform(layout, dim, distance, interrupter); });
    labels = detail::timed("power labels", interrupter, seconds ? &seconds->power : nullptr,
        [&] { return normLabels(layout, distances, dim, interrupter); });
    detail::timed("medial balls", interrupter, seconds ? &seconds->medial : nullptr, [&] {
        centers = ownLabels(labels, interrupter);
        balls = normBalls(centers, layout, distances);
    });
    std::vector<VoxelRef> queried = placesOf(queries.count, queries.voxel, layout, interrupter);
    for (VoxelRef& voxel : queried) {
        if (voxel.leaf != kNoLeaf) voxel = labels.label(voxel);
    }
    queriedLabel = ballsAt(queried, layout, centers, interrupter);
}

int32_t MedialLevel::ballAt(const openvdb::Coord& center) const
{
    const auto it = std::lower_bound(balls.begin(), balls.end(), center,
        [](const MedialBall& ball, const openvdb::Coord& c) { return ball.center < c; });
    if (it == balls.end() || it->center != center) {
        OPENVDB_THROW(openvdb::LookupError, "voxel " << center << " is no centre of a medial ball");
    }
    return int32_t(it - balls.begin());
}

} // namespace openvdb_spheretree
