// SPDX-License-Identifier: Apache-2.0
/// @file PairFrame.h
/// @brief Two bodies in each other's frames: what every question to a pair starts with.
///
/// A sphere of one body is brought to the frame of the other one, and tested there against a block of eight as
/// they are stored. The relative pose is computed in doubles and rounded to floats once.
///
/// *Rounding.* Let u = 2^-24. A center p that is rotated and moved by t is a sum of four numbers, each off by
/// at most 4u of its size: it comes to lie within 4u (sqrt(3) |p| + |t|) of its true place. A
/// distance computed of such centers is off by another 4u of itself, and sums of radii by 2u. `pad` is more than
/// all of these together, and more than what doubles lose in poses far from the origin. Spheres that meet are
/// found if sums of their radii are made larger by it: no "apart" is false, and no lower bound of a distance, less
/// `pad`, is too large. Whether two leaves meet is then decided in doubles. Tests: TestCollide.cc, with tangent
/// spheres and poses far from the origin.

#pragma once

#include "QueryData.h"
#include "RigidTransform.h"

#include <array>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// A pose in floats; rows of the rotation, then the translation.
struct FloatPose {
    std::array<float, 9> rotation;
    std::array<float, 3> translation;
};

struct PairFrame {
    const SphereBlocks* a = nullptr;
    const SphereBlocks* b = nullptr;
    RigidTransform pose; ///< of b's blocks in the frame of those of a
    double rounding = 0; ///< what a gap in doubles may be off by
    /// @name In floats, once enterFloats() was called
    /// @{
    FloatPose toA, toB; ///< of spheres of the other body
    float pad = 0;      ///< above, in world units
    /// @}

    PairFrame(const QueryData& dataA, const RigidTransform& poseA, const QueryData& dataB,
        const RigidTransform& poseB);

    /// @throw openvdb::ValueError if the bodies are too far apart to square distances in floats
    void enterFloats();

    /// @return how far apart two spheres are, in doubles; negative is how deep they meet.
    double gap(const FloatSphere& ofA, const FloatSphere& ofB) const;
    double leafGap(int32_t leafA, int32_t leafB) const
    {
        return gap(a->leaf(leafA), b->leaf(leafB));
    }
    /// @return no less than the distance of any two centers.
    double reach() const { return double(a->extent) + b->extent + pose.translation().length(); }
    double rootGap() const { return gap(a->root, b->root); }
};

} // namespace openvdb_spheretree::detail
