// SPDX-License-Identifier: Apache-2.0
/// @file PictureColors.h
/// @brief Colours of a picture: the coding of sRGB, and which sphere gets which colour.

#pragma once

#include "SpherePicture.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// @return the linear light of an sRGB colour; all components are 0 to 1.
openvdb::Vec3d linearOf(const openvdb::Vec3d& srgb);
/// @return the sRGB byte of a linear value, which is clamped to [0, 1].
uint8_t srgbByte(double linear);

/// @return the colour of every sphere of @a level, in linear light.
/// @throw Interrupted if the interrupter (may be null) said so
std::vector<openvdb::Vec3f> levelColors(const SphereTree& tree, const SphereTreeLevel& level,
    const PictureSettings& settings, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
