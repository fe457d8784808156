// SPDX-License-Identifier: Apache-2.0
#include "LeafParts.h"

#include <openvdb_spheretree/voxel/LeafPlanes.h>

namespace openvdb_spheretree::detail {

namespace {

uint64_t withColumnsBeside(uint64_t plane)
{
    return plane | movedPlane(plane, 0, -1) | movedPlane(plane, 0, 1);
}

/// What is connected to voxels of a plane: `inPlane` beside them and themselves, `across` in the
/// planes before and behind.
struct ByFaces {
    static uint64_t inPlane(uint64_t plane)
    {
        return withColumnsBeside(plane) | plane << 8 | plane >> 8;
    }
    static uint64_t across(uint64_t plane) { return plane; }
};

struct ByCorners {
    static uint64_t inPlane(uint64_t plane)
    {
        const uint64_t rows = withColumnsBeside(plane);
        return rows | rows << 8 | rows >> 8;
    }
    static uint64_t across(uint64_t plane) { return inPlane(plane); }
};

template <typename Connected>
uint64_t floodPlane(uint64_t part, uint64_t mask)
{
    for (;;) {
        const uint64_t grown = Connected::inPlane(part) & mask;
        if (grown == part) return part;
        part = grown;
    }
}

/// Floods plane @a x of @a part from the plane beside it. @return whether it grew.
template <typename Connected>
bool floodFrom(int beside, int x, const LeafMask& mask, LeafMask& part)
{
    const uint64_t entered = Connected::across(part[beside]) & mask[x] & ~part[x];
    if (!entered) return false;
    part[x] = floodPlane<Connected>(part[x] | entered, mask[x]);
    return true;
}

/// @return the part of @a mask that has the first voxel of its plane @a x. Up and down the planes
/// until nothing changes; a part turns back at most once a plane it gains voxels in.
template <typename Connected>
LeafMask floodLeaf(const LeafMask& mask, int x)
{
    LeafMask part{};
    part[x] = floodPlane<Connected>(mask[x] & -mask[x], mask[x]);
    for (bool grew = true; grew;) {
        grew = false;
        for (int up = 1; up < 8; ++up) grew |= floodFrom<Connected>(up - 1, up, mask, part);
        for (int down = 6; down >= 0; --down) {
            grew |= floodFrom<Connected>(down + 1, down, mask, part);
        }
    }
    return part;
}

template <typename Connected>
int labelParts(LeafMask left, PartLabels& labels)
{
    int count = 0;
    for (int x = 0; x < 8;) {
        if (!left[x]) {
            ++x;
            continue;
        }
        const LeafMask part = floodLeaf<Connected>(left, x);
        // Labels are 0 to begin with.
        if (count > 0) part.visitOn([&](uint32_t index) { labels[index] = uint8_t(count); });
        ++count;
        left -= part;
    }
    return count;
}

} // namespace

PartCounts leafParts(const LeafMask& mask, PartLabels& labels)
{
    labels.fill(0);
    return {
        labelParts<ByCorners>(mask, labels), labelParts<ByFaces>(LeafMask::full() - mask, labels)};
}

} // namespace openvdb_spheretree::detail
