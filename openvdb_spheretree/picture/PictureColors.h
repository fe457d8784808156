// SPDX-License-Identifier: Apache-2.0
/// @file PictureColors.h
/// @brief Colours of a picture: how sRGB is coded, and which colour a sphere gets.

#pragma once

#include "SpherePicture.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// @return linear light of a colour coded as sRGB, 0 to 1 each.
openvdb::Vec3d linearOf(const openvdb::Vec3d& srgb);
/// @return the sRGB byte of a linear value; what is out of [0, 1] is clamped.
uint8_t srgbByte(double linear);

/// @return the colour of every sphere of @a level, in linear light.
/// @throw Interrupted if the interrupter (may be null) said so
std::vector<openvdb::Vec3f> levelColors(const SphereTree& tree, const SphereTreeLevel& level,
    const PictureSettings& settings, openvdb::util::NullInterrupter* interrupter);

} // namespace detail
} // namespace openvdb_spheretree
