// SPDX-License-Identifier: Apache-2.0
#include "SampledObject.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/ParallelSort.h>

#include <utility>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;

/// The bits 0, 2, 4, 6 of the bytes 0, 2, 4, 6, as the bits 0 to 3 of bytes 0 to 3.
uint64_t everySecond(uint64_t word)
{
    uint64_t bits = 0;
    for (int y = 0; y < 4; ++y) {
        const uint64_t row = word >> (16 * y);
        bits |= ((row & 1) | (row >> 1 & 2) | (row >> 2 & 4) | (row >> 3 & 8)) << (8 * y);
    }
    return bits;
}

/// Adds a leaf's samples of even coordinates to those of a leaf of the coarser level.
/// @param isFlat  the samples of one z, which may be odd, become those of the even z below it
void addEverySecond(const LeafMask& fine, const Coord& origin, bool isFlat, LeafMask& coarse)
{
    const Coord corner = (origin >> 1) & 4;
    for (int x = 0; x < 4; ++x) {
        const uint64_t word = isFlat ? fine[2 * x] | fine[2 * x] >> 1 : fine[2 * x];
        coarse[corner[0] + x] |= everySecond(word) << (8 * corner[1] + corner[2]);
    }
}

/// A leaf, and the one of the coarser level that takes its samples.
struct Child {
    Coord parent;
    uint32_t leaf;

    bool operator<(const Child& o) const
    {
        return parent != o.parent ? parent < o.parent : leaf < o.leaf;
    }
};

SampleLevel coarser(
    const SampleLevel& fine, bool isFlat, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<Child> order(fine.leafCount());
    detail::parallelFor(order.size(), interrupter, [&](std::size_t leaf) {
        order[leaf] = {(fine.origin(leaf) >> 1) & ~7, uint32_t(leaf)};
    });
    detail::parallelSort(order.begin(), order.end(), interrupter);
    std::vector<std::size_t> begin; // in `order`, of each coarser leaf, and the end
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || order[i].parent != order[i - 1].parent) begin.push_back(i);
    }
    begin.push_back(order.size());
    std::vector<LeafMask> all(begin.size() - 1, LeafMask{});
    detail::parallelFor(all.size(), interrupter, [&](std::size_t k) {
        for (std::size_t i = begin[k]; i < begin[k + 1]; ++i) {
            const uint32_t leaf = order[i].leaf;
            addEverySecond(fine.mask(leaf), fine.origin(leaf), isFlat, all[k]);
        }
    });
    std::vector<Coord> origins;
    std::vector<LeafMask> masks;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (all[k].none()) continue;
        origins.push_back(order[begin[k]].parent);
        masks.push_back(all[k]);
    }
    return SampleLevel(std::move(origins), std::move(masks));
}

/// @return the z of the voxels of a flat object.
int32_t planeOf(const SampleLevel& voxels)
{
    constexpr uint64_t kRow = 0x0101010101010101; // voxels of one z
    for (int z = 0; z < kLeafDim; ++z) {
        for (int x = 0; x < kLeafDim; ++x) {
            if (voxels.mask(0)[x] & kRow << z) return voxels.origin(0)[2] + z;
        }
    }
    return voxels.origin(0)[2]; // no leaf is without voxels
}

SampleLevel levelOf(const LeafLayout& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<Coord> origins(object.leafCount());
    std::vector<LeafMask> masks(object.leafCount());
    detail::parallelFor(origins.size(), interrupter, [&](std::size_t leaf) {
        origins[leaf] = object.origin(uint32_t(leaf));
        masks[leaf] = object.mask(uint32_t(leaf));
    });
    return SampleLevel(std::move(origins), std::move(masks));
}

} // namespace

SampleLevel::SampleLevel(std::vector<Coord> origins, std::vector<LeafMask> masks)
    : mOrigins(std::move(origins)), mMasks(std::move(masks))
{
    for (uint32_t leaf = 0; leaf < mOrigins.size(); ++leaf) {
        const bool first = leaf == 0 || mOrigins[leaf][0] != mOrigins[leaf - 1][0]
            || mOrigins[leaf][1] != mOrigins[leaf - 1][1];
        if (first) mColumnBegin.push_back(leaf);
    }
    mColumnBegin.push_back(uint32_t(mOrigins.size()));
}

std::size_t SampleLevel::firstColumn(int64_t x, int32_t y) const
{
    const auto before = [&](uint32_t begin, int) {
        const Coord& at = mOrigins[begin];
        return at[0] != x ? at[0] < x : at[1] < y;
    };
    return std::size_t(std::lower_bound(mColumnBegin.begin(), mColumnBegin.end() - 1, 0, before)
        - mColumnBegin.begin());
}

std::size_t SampleLevel::firstLeaf(std::size_t column, int32_t z) const
{
    const auto begin = mOrigins.begin() + mColumnBegin[column];
    const auto end = mOrigins.begin() + mColumnBegin[column + 1];
    const auto below = [](const Coord& at, int32_t limit) { return at[2] < limit; };
    return std::size_t(std::lower_bound(begin, end, z, below) - mOrigins.begin());
}

SampledObject::SampledObject(
    const LeafLayout& object, bool isFlat, openvdb::util::NullInterrupter* interrupter)
    : SampledObject(levelOf(object, interrupter), isFlat, interrupter)
{}

SampledObject::SampledObject(
    SampleLevel finest, bool isFlat, openvdb::util::NullInterrupter* interrupter)
{
    if (isFlat && finest.leafCount() > 0) mPlane = planeOf(finest);
    mLevels.push_back(std::move(finest));
    constexpr int kMaxLevels = 32; // coordinates have 32 bits
    while (mLevels.back().leafCount() > 0 && levels() < kMaxLevels) {
        mLevels.push_back(coarser(mLevels.back(), isFlat, interrupter));
    }
}

} // namespace openvdb_spheretree::tight
