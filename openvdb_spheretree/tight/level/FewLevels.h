// SPDX-License-Identifier: Apache-2.0
/// @file FewLevels.h
/// @brief Levels of few balls, none of which costs more than with less quality.
///
/// Levels of the next lower quality come first, and are given to those that are made from the top
/// (TopDownLevels.h). More effort alone would not do: where it makes a coarse level better, the
/// finer ones are bound to that, and may be worse.
///
/// Cost: as of all qualities up to this one. The lower ones take less than a fourth of it. Costs
/// are counted on samples.

#pragma once

#include "FreeCovers.h"
#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param counts        of balls, finest first, falling; at most kFewOnCoarse of them
/// @param free          of the object, with @a maker
/// @param withClusters  try balls around clusters, too
/// @param quality       that of @a maker
std::vector<TightLevel> fewLevels(const std::vector<int64_t>& counts, FreeCovers& free,
    bool withClusters, Quality quality, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
