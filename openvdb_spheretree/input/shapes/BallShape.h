// SPDX-License-Identifier: Apache-2.0
/// @file BallShape.h
/// @brief The digital ball { q : |q|^2 < radiusSq } around the origin. Nodes inside it are tiles, so
/// that time and memory are proportional to its surface.

#pragma once

#include "VoxelRule.h"

#include <cstdint>

namespace openvdb_spheretree::detail {

class SolidBall : public LeafwiseRule {
public:
    /// The largest ball whose volume is no more than @a voxels.
    explicit SolidBall(int64_t voxels);

    int64_t radiusSq() const { return mRadiusSq; }

    openvdb::CoordBBox box() const override;
    /// Exact.
    Filling filling(const openvdb::CoordBBox& cube) const override;
    LeafMask leaf(const openvdb::Coord& origin) const override;

private:
    int64_t mRadiusSq;
};

} // namespace openvdb_spheretree::detail
