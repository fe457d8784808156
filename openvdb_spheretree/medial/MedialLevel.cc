// SPDX-License-Identifier: Apache-2.0
#include "MedialLevel.h"

#include "BallIndex.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/slab/LabelStream.h>
#include <openvdb_spheretree/voxel/LeafFinder.h>

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
            const uint32_t offset = leafIndex(voxel);
            const bool on = leaf && layout.mask(*leaf).isOn(offset);
            places[i] = {on ? *leaf : kNoLeaf, offset};
        });
    return places;
}

/// @return the balls that are centred at @a labels; -1 where there is no label.
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

} // namespace

int64_t normBytes(const LeafLayout& layout)
{
    constexpr int64_t kDistance = sizeof(uint32_t), kSite = sizeof(uint32_t);
    const int64_t perLeaf = kLeafVoxels * (kDistance + kSite) + int64_t(sizeof(LeafMask));
    return layout.bytes() + int64_t(layout.leafCount()) * perLeaf;
}

MedialLevel::MedialLevel(const openvdb::MaskTree& voxels, int dim, const Distance& distance,
    NullInterrupter* interrupter, StageSeconds* seconds, const LevelWants& wants)
    : layout(detail::timed("layout of leaves", interrupter, seconds ? &seconds->distance : nullptr,
        [&] { return LeafLayout(voxels); }))
{
    if (!distance.isEuclidean()) {
        findNormBalls(dim, distance, wants, interrupter, seconds);
        return;
    }
    findBalls(dim, wants, interrupter, seconds);
}

void MedialLevel::findBalls(
    int dim, const LevelWants& wants, NullInterrupter* interrupter, StageSeconds* seconds)
{
    std::vector<VoxelRef> asked = placesOf(wants.count, wants.voxel, layout, interrupter);
    slab::LabelStream stream(layout, dim);
    stream.ask(asked);
    stream.setMemory(wants.memory);
    detail::LabelSteps steps;
    if (wants.allLabels) stream.keepSteps(steps);
    slab::LevelBalls found = stream.run(interrupter);
    if (seconds) {
        seconds->distance += found.seconds.distance;
        seconds->power += found.seconds.power;
        seconds->medial += found.seconds.medial;
    }
    if (wants.allLabels) labels = PowerMap(layout, std::move(steps));
    balls = std::move(found.balls);
    centers = std::move(found.centers);
    wantedLabel = ballsAt(asked, layout, centers, interrupter);
}

/// Norms have no stream: everything is in memory.
void MedialLevel::findNormBalls(int dim, const Distance& distance, const LevelWants& wants,
    NullInterrupter* interrupter, StageSeconds* seconds)
{
    detail::requireAllowed(
        layout.leafCount(), normBytes(layout), detail::allowedMemory(wants.memory));
    const DistanceMap distances =
        detail::timed("distance transform", interrupter, seconds ? &seconds->distance : nullptr,
            [&] { return distanceTransform(layout, dim, distance, interrupter); });
    labels = detail::timed("power labels", interrupter, seconds ? &seconds->power : nullptr,
        [&] { return powerMap(layout, distances, dim, interrupter); });
    balls = detail::timed("medial balls", interrupter, seconds ? &seconds->medial : nullptr,
        [&] { return medialBalls(labels, distances, interrupter); });
    centers.resize(layout.leafCount());
    for (const VoxelRef& place : placesOf(
             balls.size(), [&](std::size_t i) { return balls[i].center; }, layout, interrupter)) {
        centers[place.leaf][place.index >> 6] |= uint64_t(1) << (place.index & 63);
    }
    std::vector<VoxelRef> asked = placesOf(wants.count, wants.voxel, layout, interrupter);
    for (VoxelRef& voxel : asked) {
        if (voxel.leaf != kNoLeaf) voxel = labels.label(voxel);
    }
    wantedLabel = ballsAt(asked, layout, centers, interrupter);
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
