// SPDX-License-Identifier: Apache-2.0
#include "MedialAxis.h"

#include "FlatAxis.h"
#include "detail/Parallel.h"
#include "detail/StepBits.h"

#include <utility>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;
using Masks = std::vector<LeafMask>;

/// The voxels of word x of @a mask moved on by one along @a axis.
uint64_t movedOn(Axis axis, const LeafMask& mask, uint32_t x)
{
    switch (axis) {
    case Axis::X: return x > 0 ? mask[x - 1] : 0;
    case Axis::Y: return mask[x] << 8;
    default: return mask[x] << 1;
    }
}

/// Marks where the steps lead along @a axis from the voxels that @a mask has on in leaf i of @a
/// run. Most need no walk: they are 0, or lead where the voxel before led, which has marked that
/// already.
template <typename Step>
void markEnds(Axis axis, LeafLayout::Run run, uint32_t i, const Step* steps, const LeafMask& mask,
    Masks& marks)
{
    const detail::StepBits bits = detail::stepBits(steps, axis);
    const int shift = 6 - 3 * int(axis), position = int(i) * kLeafDim;
    for (uint32_t x = 0; x < 8; ++x) {
        marks[run.leaves[i]][x] |= mask[x] & bits.stays[x];
        const uint64_t done = bits.stays[x] | (bits.asBefore[x] & movedOn(axis, mask, x));
        for (uint64_t word = mask[x] & ~done; word; word &= word - 1) {
            const int offset = int(64 * x + openvdb::util::FindLowestOn(word));
            const int here = offset >> shift & 7, end = position + here + steps[offset];
            const int there = offset + ((end & 7) - here) * (1 << shift);
            marks[run.leaves[end >> 3]][there >> 6] |= uint64_t(1) << (there & 63);
        }
    }
}

/// @param from  gives the mask of a leaf's voxels whose steps to follow
template <typename From>
Masks marksAlong(Axis axis, const PowerMap& labels, const From& from, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    Masks marks(layout.leafCount(), LeafMask{});
    detail::parallelFor(layout.runCount(axis), interrupter, [&](std::size_t index) {
        const LeafLayout::Run run = layout.run(axis, uint32_t(index));
        for (uint32_t i = 0; i < run.count; ++i) {
            const uint32_t leaf = run.leaves[i];
            const int8_t* narrow = labels.narrowSteps(axis, leaf);
            if (narrow) markEnds(axis, run, i, narrow, from(leaf), marks);
            else markEnds(axis, run, i, labels.wideSteps(axis, leaf), from(leaf), marks);
        }
    });
    return marks;
}

using LeafRange = std::pair<uint32_t, uint32_t>;

/// Cuts a range of leaves wherever a coordinate of their origins changes.
std::vector<LeafRange> cutWhereChanges(int axis, LeafRange range, const LeafLayout& layout)
{
    std::vector<LeafRange> parts;
    for (uint32_t leaf = range.first; leaf < range.second; ++leaf) {
        const bool starts =
            leaf == range.first || layout.origin(leaf)[axis] != layout.origin(leaf - 1)[axis];
        if (starts) parts.emplace_back(leaf, leaf);
        parts.back().second = leaf + 1;
    }
    return parts;
}

/// Calls visit(leaf, offset) for the marked voxels of leaves of equal x, ordered by coordinate: x,
/// then the rows of leaves of equal y and y in them, then the leaves of a row and z in them.
template <typename Visit>
void visitInOrder(LeafRange slab, const Masks& marks, const LeafLayout& layout, const Visit& visit)
{
    const std::vector<LeafRange> rows = cutWhereChanges(1, slab, layout);
    std::vector<uint32_t> marked;
    for (uint32_t x = 0; x < 8; ++x) {
        for (const LeafRange& row : rows) {
            marked.clear();
            for (uint32_t leaf = row.first; leaf < row.second; ++leaf) {
                if (marks[leaf][x]) marked.push_back(leaf);
            }
            for (uint32_t y = 0; y < 8; ++y) {
                for (const uint32_t leaf : marked) {
                    for (uint32_t bits = marks[leaf][x] >> 8 * y & 0xff; bits; bits &= bits - 1) {
                        visit(leaf, 64 * x + 8 * y + openvdb::util::FindLowestOn(bits));
                    }
                }
            }
        }
    }
}

/// Without steps: the voxels that are their own labels, since a label's own label is itself.
Masks ownLabels(const PowerMap& labels, NullInterrupter* interrupter)
{
    const LeafLayout& layout = labels.layout();
    Masks marks(layout.leafCount(), LeafMask{});
    detail::parallelFor(marks.size(), interrupter, [&](std::size_t i) {
        const auto leaf = uint32_t(i);
        for (uint32_t offset = 0; offset < kLeafVoxels; ++offset) {
            if (!isOn(layout.mask(leaf), offset)) continue;
            const PowerMap::Voxel site = labels.label(PowerMap::Voxel{leaf, offset});
            if (site.leaf != leaf || site.offset != offset) continue;
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
    const auto slabs = cutWhereChanges(0, {0, layout.leafCount()}, layout);
    std::vector<std::size_t> first{0};
    for (const LeafRange& slab : slabs) {
        std::size_t count = 0;
        for (uint32_t leaf = slab.first; leaf < slab.second; ++leaf) {
            for (const uint64_t word : marks[leaf]) count += openvdb::util::CountOn(word);
        }
        first.push_back(first.back() + count);
    }
    std::vector<MedialBall> balls(first.back());
    const bool squared = distances.distance().isEuclidean();
    detail::parallelFor(slabs.size(), nullptr, [&](std::size_t slab) {
        MedialBall* ball = balls.data() + first[slab];
        visitInOrder(slabs[slab], marks, layout, [&](uint32_t leaf, uint32_t offset) {
            const auto value = int32_t(distances.at(leaf, offset));
            *ball++ = {layout.voxel(leaf, offset), squared ? value : value * value};
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
    NullInterrupter* interrupter, const Distance& distance)
{
    const FlatAxis flat = flatAxisOf(object, dim);
    const LeafLayout layout(*flat.toZ(
        std::make_shared<openvdb::MaskTree>(object.tree(), false, openvdb::TopologyCopy())));
    const DistanceMap distances = distanceTransform(layout, dim, interrupter, distance);
    const PowerMap labels = powerMap(layout, distances, dim, interrupter);
    std::vector<MedialBall> balls = medialBalls(labels, distances, interrupter);
    for (MedialBall& ball : balls) ball.center = flat.fromZ(ball.center);
    return balls;
}

} // namespace openvdb_spheretree
