// SPDX-License-Identifier: Apache-2.0
#include "ParentLabels.h"

#include "RunLabels.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

using openvdb::Coord;

VoxelBalls::VoxelBalls(const MedialLevel& level, openvdb::util::NullInterrupter* interrupter)
    : mLayout(level.layout), mIndex(mLayout, level.centers, interrupter),
      mRanks(makeLargeArray<int32_t>(std::size_t(mLayout.leafCount()) * kLeafVoxels)),
      mChanged(mLayout.leafCount()), mLikeBeforeY(mLayout.leafCount()),
      mLikeBeforeZ(mLayout.leafCount())
{
    parallelFor(mLayout.runCount(Axis::X), interrupter, [&](std::size_t i) {
        const LeafLayout::Run run = mLayout.run(Axis::X, uint32_t(i));
        RunLabels labels(level.labels, mIndex, run);
        for (uint32_t place = 0; place < run.count; ++place) {
            labels.enterLeaf(place);
            fillLeaf(labels, place == 0 ? nullptr : ranks(run.leaves[place - 1]));
        }
    });
}

void VoxelBalls::fillLeaf(RunLabels& labels, const int32_t* before)
{
    const uint32_t leaf = labels.leaf();
    int32_t* here = mRanks.get() + std::size_t(leaf) * kLeafVoxels;
    std::fill_n(here, kLeafVoxels, -1);
    for (uint32_t x = 0; x < 8; ++x) {
        labels.enterWord(x);
        int32_t* row = here + 64 * x;
        for (uint64_t bits = labels.on(); bits; bits &= bits - 1) {
            const uint32_t lane = openvdb::util::FindLowestOn(bits);
            row[lane] = labels.rank(lane);
        }
        const int32_t* last = x > 0 ? row - 64 : before ? before + 7 * 64 : nullptr;
        mChanged[leaf][x] = last ? ~equalLanes(row, last) : ~uint64_t(0);
        const LikeBefore like = labels.likeBefore();
        mLikeBeforeY[leaf][x] = like.alongY;
        mLikeBeforeZ[leaf][x] = like.alongZ;
    }
}

AxisParents::AxisParents(const PyramidStep& step, const Coord& origin, int axis)
{
    // One division a leaf, not one a voxel.
    const int64_t factor = axis < step.dim ? step.factor : 1;
    int32_t last = step.parentVoxel(origin)[axis];
    int64_t left = factor * (int64_t(last) + 1) - (int64_t(origin[axis]) - step.origin[axis]);
    parent[0] = last;
    for (int i = 0; i < kLeafDim; ++i, --left) {
        if (left == 0) {
            parent[++count] = ++last;
            left = factor;
        }
        placeOf[i] = uint8_t(count);
    }
    ++count;
}

RunParents::RunParents(const VoxelBalls& balls, const PyramidStep& step, const Coord& first)
    : mBalls(balls), mAlongY(step, first, 1), mAlongZ(step, first, 2)
{
    for (uint32_t lane = 0; lane < 64; ++lane) {
        const int y = mAlongY.placeOf[lane >> 3], z = mAlongZ.placeOf[lane & 7];
        mLeafOf[lane] = uint8_t(2 * mAlongY.leafOf(y) + mAlongZ.leafOf(z));
        mIndexOf[lane] = uint16_t(8 * (mAlongY.parent[y] & 7) + (mAlongZ.parent[z] & 7));
        const bool innerY = lane >= 8 && mAlongY.placeOf[(lane >> 3) - 1] == y;
        const bool innerZ = (lane & 7) != 0 && mAlongZ.placeOf[(lane & 7) - 1] == z;
        mInnerY |= uint64_t(innerY) << lane;
        mInnerZ |= uint64_t(innerZ) << lane;
    }
    for (int y = 0; y < kLeafDim; ++y) mRows[mAlongY.placeOf[y]] |= uint64_t(1) << 8 * y;
    for (uint32_t bits = 0; bits < uint32_t(1) << mAlongZ.count; ++bits) {
        for (int z = 0; z < kLeafDim; ++z) {
            mColumns[bits] |= uint8_t((bits >> mAlongZ.placeOf[z] & 1) << z);
        }
    }
}

/// The bits of the parents, one row along z at a time, to bits of their children.
template <typename MaskOf>
uint64_t RunParents::spread(const MaskOf& maskOf) const
{
    std::array<uint64_t, 4> words;
    for (int i = 0; i < 4; ++i) words[i] = mLeaves[i] ? maskOf(*mLeaves[i])[*mX & 7] : 0;
    const uint32_t firstZ = uint32_t(mAlongZ.parent[0] & 7);
    const uint32_t used = (1u << mAlongZ.count) - 1;
    uint64_t result = 0;
    for (int y = 0; y < mAlongY.count; ++y) {
        const int pair = 2 * mAlongY.leafOf(y), shift = 8 * (mAlongY.parent[y] & 7);
        const uint32_t row =
            uint32_t(words[pair] >> shift & 0xff) | uint32_t(words[pair + 1] >> shift & 0xff) << 8;
        result |= mRows[y] * mColumns[row >> firstZ & used];
    }
    return result;
}

void RunParents::moveTo(int32_t x)
{
    if (mX == x) {
        mChanged = 0;
        return;
    }
    const LeafLayout& layout = mBalls.layout();
    if (!mX || *mX >> 3 != x >> 3) {
        const int lastY = mAlongY.leafOf(mAlongY.count - 1);
        const int lastZ = mAlongZ.leafOf(mAlongZ.count - 1);
        for (int i = 0; i < 4; ++i) {
            const int y = i >> 1, z = i & 1;
            if (y > lastY || z > lastZ) continue;
            mLeaves[i] = layout.findLeaf(
                {x, mAlongY.parent[0] + kLeafDim * y, mAlongZ.parent[0] + kLeafDim * z});
        }
    }
    mX = x;
    mOn = spread([&](uint32_t leaf) -> const LeafMask& { return layout.mask(leaf); });
    mChanged = spread([this](uint32_t leaf) -> const LeafMask& { return mBalls.changed(leaf); });
    mLikeBeforeY = mInnerY
        | spread([this](uint32_t leaf) -> const LeafMask& { return mBalls.likeBeforeY(leaf); });
    mLikeBeforeZ = mInnerZ
        | spread([this](uint32_t leaf) -> const LeafMask& { return mBalls.likeBeforeZ(leaf); });
}

} // namespace openvdb_spheretree::detail
