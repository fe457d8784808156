// SPDX-License-Identifier: Apache-2.0
#include "CostWindow.h"

#include "BallRows.h"

#include <cmath>
#include <limits>

namespace openvdb_spheretree::tight {

namespace {

/// A window may reach beyond the ends of coordinates; samples do not.
int32_t toCoordinate(int64_t sample)
{
    constexpr int64_t kFirst = std::numeric_limits<int32_t>::min();
    constexpr int64_t kLast = std::numeric_limits<int32_t>::max();
    return int32_t(std::max(kFirst, std::min(sample, kLast)));
}

} // namespace

int CostWindow::levelFor(double radius, int samples)
{
    int level = 0;
    while (radius > double((kFine * samples) << level)) ++level;
    return level;
}

void CostWindow::reset(const SampledObject& object, const FineBox& box, int level)
{
    mLevel = level;
    mToLocal = std::ldexp(1.0, -level);
    const int shift = level + 4; // 16 = 2^4 units a voxel
    int64_t origin[3];
    for (int a = 0; a < 3; ++a) {
        origin[a] = box.lo[a] >> shift;
        if (a == 2) origin[a] &= ~int64_t(7); // bytes of leaves are bytes of rows
        mSize[a] = int32_t((box.hi[a] >> shift) + 2 - origin[a]);
        mFineOrigin[a] = origin[a] * (int64_t(1) << shift);
    }
    mWords = (mSize[2] + 63) / 64;
    mSize[2] = 64 * mWords;
    fill(object.plane(level), origin[2]);
    clear(object.level(level), origin);
}

void CostWindow::fill(const std::optional<int32_t>& plane, int64_t originZ)
{
    mDim = plane ? 2 : 3;
    mBits.assign(std::size_t(mSize[0]) * mSize[1] * mWords, plane ? 0 : ~uint64_t(0));
    if (!plane) return;
    const int64_t z = *plane - originZ;
    if (z < 0 || z >= mSize[2]) return;
    for (std::size_t row = 0; row < mBits.size(); row += std::size_t(mWords)) {
        mBits[row + std::size_t(z >> 6)] = uint64_t(1) << (z & 63);
    }
}

void CostWindow::clear(const SampleLevel& samples, const int64_t (&origin)[3])
{
    openvdb::CoordBBox met; // of the window, where there can be samples
    for (int a = 0; a < 3; ++a) {
        met.min()[a] = toCoordinate(origin[a]);
        met.max()[a] = toCoordinate(origin[a] + mSize[a] - 1);
    }
    samples.forEachLeaf(met, [&](std::size_t leaf) {
        openvdb::Coord at;
        for (int a = 0; a < 3; ++a) at[a] = int32_t(samples.origin(leaf)[a] - origin[a]);
        const LeafMask& mask = samples.mask(leaf);
        const int x0 = std::max(0, at[0]), x1 = std::min(mSize[0], at[0] + 8);
        const int y0 = std::max(0, at[1]), y1 = std::min(mSize[1], at[1] + 8);
        // At the end of coordinates, leaves are met by windows that lie beyond it.
        if (y0 >= y1 || at[2] < 0 || at[2] >= mSize[2]) return;
        for (int x = x0; x < x1; ++x) {
            uint64_t* row = &mBits[(std::size_t(x) * mSize[1] + y0) * mWords + (at[2] >> 6)];
            uint64_t rows = mask[x - at[0]] >> (8 * (y0 - at[1]));
            for (int y = y0; y < y1; ++y, row += mWords, rows >>= 8) {
                *row &= ~((rows & 0xff) << (at[2] & 63));
            }
        }
    });
}

LocalBall CostWindow::toLocal(const ExactSphere& ball) const
{
    const auto rounded = [&](int axis) {
        return std::rint(float(double(ball.center[axis] - mFineOrigin[axis]) * mToLocal));
    };
    const double radiusSq = std::floor(double(ball.radiusSq) * mToLocal * mToLocal);
    return {rounded(0), rounded(1), rounded(2), float(radiusSq)};
}

ExactSphere CostWindow::centerOf(const LocalBall& ball) const
{
    const float center[3] = {ball.x, ball.y, ball.z};
    ExactSphere fine;
    for (int a = 0; a < 3; ++a) {
        fine.center[a] = mFineOrigin[a] + int64_t(center[a]) * (int64_t(1) << mLevel);
    }
    return fine;
}

int64_t CostWindow::count(const LocalBall& ball) const
{
    return countBits({mBits.data(), {mSize[0], mSize[1], mSize[2]}, mWords}, ball);
}

void CostWindow::collect(const LocalBall& ball, std::vector<CostRun>& found) const
{
    collectBits({mBits.data(), {mSize[0], mSize[1], mSize[2]}, mWords}, ball, found);
}

void CostWindow::cover(const LocalBall& ball) { clearBits(mBits.data(), mSize, mWords, ball); }

} // namespace openvdb_spheretree::tight
