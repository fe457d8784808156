// SPDX-License-Identifier: Apache-2.0
/// @file StoredRadii.h
/// @brief Radii as files hold them: in world units, padded, and rounded up to floats, so that a
/// stored sphere covers what it stands for.

#pragma once

#include "SphereTree.h"

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::detail {

/// @return a radius in world units, rounded up to a float.
/// @throw openvdb::ValueError if no float is that large
float toStoredRadius(double radius);

/// Fills in `radiusWorld` of nodes and cuts from `radius`, the padding of the settings, and the
/// transform.
/// @throw openvdb::ValueError if a radius fits no float
void storeRadii(SphereTree& tree, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
