// SPDX-License-Identifier: Apache-2.0
#include "LevelFrame.h"

namespace openvdb_spheretree {

LevelFrame::LevelFrame(int level, const openvdb::Coord& origin, const SphereTreeSettings& settings)
    : mLevel(level),
      mDim(settings.dim),
      mTight(level == 0 || settings.scale == RadiusScale::Tight),
      mOrigin(level == 0 ? openvdb::Coord() : origin)
{
    for (int k = 0; k < level; ++k) mScale *= settings.factor;
    mGrowthSq = mDim * (mScale - 1) * (mScale - 1);
}

Doubled LevelFrame::center(const openvdb::Coord& ijk) const
{
    const auto along = [&](int axis) {
        const bool scaled = axis < mDim;
        return 2 * int64_t(mOrigin[axis]) +
            (scaled ? 2 * mScale * ijk[axis] + mScale - 1 : 2 * int64_t(ijk[axis]));
    };
    return {along(0), along(1), along(2)};
}

RootSum LevelFrame::radius(int32_t radiusSq) const
{
    const int64_t covered = mTight ? int64_t(radiusSq) - 1 : int64_t(radiusSq);
    return {4 * mScale * mScale * covered, mGrowthSq};
}

} // namespace openvdb_spheretree
