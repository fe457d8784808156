// SPDX-License-Identifier: Apache-2.0
#include "LeafLayout.h"

#include "detail/MaskNodes.h"
#include "detail/Memory.h"

#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace openvdb_spheretree {

namespace {

struct Leaf {
    openvdb::Coord origin;
    LeafMask mask;
};

void appendTile(const openvdb::CoordBBox& tile, std::vector<Leaf>& leaves)
{
    LeafMask full;
    full.fill(~uint64_t(0));
    const openvdb::Coord& lo = tile.min();
    const openvdb::Coord n = tile.extents();
    for (int x = 0; x < n[0]; x += kLeafDim) {
        for (int y = 0; y < n[1]; y += kLeafDim) {
            for (int z = 0; z < n[2]; z += kLeafDim) {
                leaves.push_back({lo.offsetBy(x, y, z), full});
            }
        }
    }
}

/// Leaf nodes, and those that tiles stand for.
int64_t countLeaves(const openvdb::MaskTree& level)
{
    int64_t count = int64_t(level.leafCount());
    detail::forEachTile(level,
        [&](const openvdb::CoordBBox& box) { count += int64_t(box.volume() / kLeafVoxels); });
    return count;
}

/// @throw openvdb::ValueError, before anything is allocated
void requireRoom(int64_t leaves)
{
    if (leaves > std::numeric_limits<uint32_t>::max() / 2) {
        OPENVDB_THROW(openvdb::ValueError,
            "the object has "
                << leaves
                << " leaf nodes, those inside its tiles included, more than 2^31: use a "
                   "larger voxel, or split the object");
    }
    // The layout itself, twice while it is sorted, and at least the distances.
    detail::requireMemory(leaves, 2 * 88 + kLeafVoxels * sizeof(uint16_t));
}

} // namespace

LeafLayout::LeafLayout(const openvdb::MaskTree& level)
{
    collectLeaves(level);
    tbb::parallel_invoke([this] { buildLines(Axis::X); }, [this] { buildLines(Axis::Y); },
        [this] { buildLines(Axis::Z); });
}

void LeafLayout::collectLeaves(const openvdb::MaskTree& level)
{
    const int64_t count = countLeaves(level);
    requireRoom(count);
    std::vector<Leaf> leaves;
    leaves.reserve(std::size_t(count));
    for (auto it = level.cbeginLeaf(); it; ++it) {
        if (it->isEmpty()) continue;
        Leaf leaf{it->origin(), {}};
        for (uint32_t x = 0; x < 8; ++x) leaf.mask[x] = it->getValueMask().getWord<uint64_t>(x);
        leaves.push_back(leaf);
    }
    detail::forEachTile(level, [&](const openvdb::CoordBBox& box) { appendTile(box, leaves); });
    tbb::parallel_sort(leaves.begin(), leaves.end(),
        [](const Leaf& a, const Leaf& b) { return a.origin < b.origin; });

    mOrigins.reserve(leaves.size());
    mMasks.reserve(leaves.size());
    for (const Leaf& leaf : leaves) {
        mOrigins.push_back(leaf.origin);
        mMasks.push_back(leaf.mask);
        for (uint64_t word : leaf.mask) mVoxelCount += openvdb::util::CountOn(word);
    }
}

void LeafLayout::buildLines(Axis axis)
{
    Lines& lines = mLines[int(axis)];
    const uint32_t count = leafCount();
    lines.leaves.resize(count);
    std::iota(lines.leaves.begin(), lines.leaves.end(), 0u);

    // The other two axes tell lines apart, the axis itself orders the leaves of a line.
    const int along = int(axis), first = along == 0 ? 1 : 0, second = along == 2 ? 1 : 2;
    const auto sameLine = [&](const openvdb::Coord& a, const openvdb::Coord& b) {
        return a[first] == b[first] && a[second] == b[second];
    };
    if (axis != Axis::Z) { // along z, leaves are in order already
        tbb::parallel_sort(lines.leaves.begin(), lines.leaves.end(), [&](uint32_t i, uint32_t j) {
            const openvdb::Coord &a = mOrigins[i], &b = mOrigins[j];
            if (a[first] != b[first]) return a[first] < b[first];
            if (a[second] != b[second]) return a[second] < b[second];
            return a[along] < b[along];
        });
    }

    lines.position.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        lines.position[lines.leaves[i]] = i;
        const openvdb::Coord& here = mOrigins[lines.leaves[i]];
        const bool touches = i > 0 && sameLine(mOrigins[lines.leaves[i - 1]], here)
            && mOrigins[lines.leaves[i - 1]][along] + kLeafDim == here[along];
        if (!touches) lines.runBegin.push_back(i);
    }
    lines.runBegin.push_back(count);
}

std::optional<uint32_t> LeafLayout::findLeaf(const openvdb::Coord& ijk) const
{
    const openvdb::Coord origin = ijk & ~7;
    const auto it = std::lower_bound(mOrigins.begin(), mOrigins.end(), origin);
    if (it == mOrigins.end() || *it != origin) return std::nullopt;
    return uint32_t(it - mOrigins.begin());
}

} // namespace openvdb_spheretree
