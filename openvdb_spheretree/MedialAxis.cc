// SPDX-License-Identifier: Apache-2.0
#include "MedialAxis.h"

#include "detail/Parallel.h"

#include <tbb/parallel_sort.h>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;
using Masks = std::vector<LeafMask>;

/// Marks the ends of the steps along @a axis of the voxels that @a from( leaf ) has on.
template <typename From>
Masks marksAlong(
    Axis axis, const PowerMap& labels, const From& from, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    Masks marks(layout.leafCount(), LeafMask{});
    detail::parallelFor(layout.runCount(axis), interrupter, [&](std::size_t index) {
        const LeafLayout::Run run = layout.run(axis, uint32_t(index));
        for (uint32_t i = 0; i < run.count; ++i) {
            const LeafMask& mask = from(run.leaves[i]);
            for (uint32_t x = 0; x < 8; ++x) {
                for (uint64_t word = mask[x]; word; word &= word - 1) {
                    const uint32_t offset = 64 * x + openvdb::util::FindLowestOn(word);
                    const PowerMap::Voxel end = labels.step(axis, {run.leaves[i], offset});
                    marks[end.leaf][end.offset >> 6] |= uint64_t(1) << (end.offset & 63);
                }
            }
        }
    });
    return marks;
}

std::vector<MedialBall> collectBalls(
    const Masks& marks, const LeafLayout& layout, const DistanceMap& distances)
{
    std::vector<MedialBall> balls;
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        for (uint32_t x = 0; x < 8; ++x) {
            for (uint64_t word = marks[leaf][x]; word; word &= word - 1) {
                const uint32_t offset = 64 * x + openvdb::util::FindLowestOn(word);
                balls.push_back(
                    {layout.voxel(leaf, offset), int32_t(distances.at(leaf, offset))});
            }
        }
    }
    tbb::parallel_sort(balls.begin(), balls.end(),
        [](const MedialBall& a, const MedialBall& b) { return a.center < b.center; });
    return balls;
}

} // namespace

std::vector<MedialBall> medialBalls(
    const PowerMap& labels, const DistanceMap& distances, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    const auto object = [&](uint32_t leaf) -> const LeafMask& { return layout.mask(leaf); };
    Masks marks = marksAlong(Axis::X, labels, object, interrupter);
    const auto marked = [&](uint32_t leaf) -> const LeafMask& { return marks[leaf]; };
    marks = marksAlong(Axis::Y, labels, marked, interrupter);
    if (labels.usesZ()) marks = marksAlong(Axis::Z, labels, marked, interrupter);
    return collectBalls(marks, layout, distances);
}

std::vector<MedialBall> medialBalls(
    const openvdb::BoolGrid& object, int dim, NullInterrupter* interrupter)
{
    const openvdb::MaskTree mask(object.tree(), false, openvdb::TopologyCopy());
    const LeafLayout layout(mask);
    const DistanceMap distances = distanceTransform(layout, dim, interrupter);
    const PowerMap labels = powerMap(layout, distances, dim, interrupter);
    return medialBalls(labels, distances, interrupter);
}

} // namespace openvdb_spheretree
