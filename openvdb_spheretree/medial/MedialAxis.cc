// SPDX-License-Identifier: Apache-2.0
#include "MedialAxis.h"

#include "MedialLevel.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/kernel/LabelStepEnds.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>

#include <utility>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;
using Masks = std::vector<LeafMask>;

/// @param from  gives the mask of a leaf's voxels whose steps to follow
template <typename From>
Masks marksAlong(Axis axis, const PowerMap& labels, const From& from, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    Masks marks(layout.leafCount(), LeafMask{});
    detail::parallelFor(layout.runCount(axis), interrupter, [&](std::size_t index) {
        const LeafLayout::Run run = layout.run(axis, uint32_t(index));
        const auto marksOf = [&](uint32_t i) -> LeafMask& { return marks[run.leaves[i]]; };
        for (uint32_t i = 0; i < run.count; ++i) {
            const uint32_t leaf = run.leaves[i];
            const int8_t* narrow = labels.narrowSteps(axis, leaf);
            if (narrow) detail::markEnds(axis, i, narrow, from(leaf), marksOf);
            else detail::markEnds(axis, i, labels.wideSteps(axis, leaf), from(leaf), marksOf);
        }
    });
    return marks;
}

/// Without steps: the voxels that are their own labels, since a label's own label is itself.
Masks ownLabels(const PowerMap& labels, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    Masks marks(layout.leafCount(), LeafMask{});
    detail::parallelFor(marks.size(), interrupter, [&](std::size_t i) {
        const auto leaf = uint32_t(i);
        for (uint32_t offset = 0; offset < kLeafVoxels; ++offset) {
            if (!layout.mask(leaf).isOn(offset)) continue;
            const VoxelRef site = labels.label(VoxelRef{leaf, offset});
            if (site.leaf != leaf || site.index != offset) continue;
            marks[leaf][offset >> 6] |= uint64_t(1) << (offset & 63);
        }
    });
    return marks;
}

Masks endsOfSteps(const PowerMap& labels, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    const auto object = [&](uint32_t leaf) -> const LeafMask& { return layout.mask(leaf); };
    Masks marks = marksAlong(Axis::X, labels, object, interrupter);
    const auto marked = [&](uint32_t leaf) -> const LeafMask& { return marks[leaf]; };
    marks = marksAlong(Axis::Y, labels, marked, interrupter);
    if (labels.usesZ()) marks = marksAlong(Axis::Z, labels, marked, interrupter);
    return marks;
}

std::vector<MedialBall> collectBalls(
    const Masks& marks, const LeafLayout& layout, const DistanceMap& distances)
{
    std::vector<std::size_t> first{0};
    for (uint32_t index = 0; index < layout.slabCount(); ++index) {
        const LeafLayout::Slab slab = layout.slab(index);
        first.push_back(first.back() + detail::countMarks(marks.data() + slab.begin, slab.size()));
    }
    std::vector<MedialBall> balls(first.back());
    const bool squared = distances.distance().isEuclidean();
    detail::parallelFor(layout.slabCount(), nullptr, [&](std::size_t slab) {
        MedialBall* ball = balls.data() + first[slab];
        const LeafMask* own = marks.data() + layout.slab(uint32_t(slab)).begin;
        detail::visitWithPlaces(
            layout, uint32_t(slab), own, [&](uint32_t leaf, uint32_t offset, std::size_t place) {
                const auto value = int32_t(distances.at(leaf, offset));
                ball[place] = {layout.voxel(leaf, offset), squared ? value : value * value};
            });
    });
    return balls;
}

} // namespace

std::vector<MedialBall> medialBalls(
    const PowerMap& labels, const DistanceMap& distances, NullInterrupter* interrupter)
{
    const Masks marks =
        labels.hasSteps() ? endsOfSteps(labels, interrupter) : ownLabels(labels, interrupter);
    return collectBalls(marks, labels.layout(), distances);
}

std::vector<MedialBall> medialBalls(const openvdb::BoolGrid& object, int dim,
    const Distance& distance, NullInterrupter* interrupter)
{
    const FlatAxis flat = flatAxisOf(object, dim);
    const auto voxels = flat.toZ(
        std::make_shared<openvdb::MaskTree>(object.tree(), false, openvdb::TopologyCopy()));
    std::vector<MedialBall> balls = MedialLevel(*voxels, dim, distance, interrupter).balls;
    for (MedialBall& ball : balls) ball.center = flat.fromZ(ball.center);
    return balls;
}

} // namespace openvdb_spheretree
