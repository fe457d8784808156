// SPDX-License-Identifier: Apache-2.0
/// @file CoverSearch.h
/// @brief Makes a cover better without more balls (quality=best): tries changes, keeps those that
/// pay.
///
/// Most trials spoil one ball and let its neighbours make the best of it (CoverTrial.h); six times in
/// a search balls go elsewhere (CoverRelocation.h); before and after, every ball is placed anew.
///
/// Trials of a batch start from the same cover and run in parallel; of those that pay, the first
/// ones whose surroundings do not meet are kept. What is tried follows from a counter, and the
/// number of trials is bounded by the number of balls: the result is the same for any number of
/// threads, and the time does not decide.

#pragma once

#include "CoverDebt.h"
#include "CoverPart.h"
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct SearchedCover {
    std::vector<CoverBall> balls; ///< empty ones where balls went, if none put in would pay
    double change = 0;            ///< of the cost, voxels, counted on samples: not above 0
};

/// @param balls  a cover in the sense of @a debt
/// @param finer  small balls, to be put in where one is to spare: leaves, or those of a finer level.
///               If there are none, balls stay where they are, and go if they owe nothing.
SearchedCover improveCover(std::vector<CoverBall> balls, const std::vector<CoverBall>& finer,
    const SampledObject& object, const CoverDebt& debt, const SearchEffort& effort,
    openvdb::util::NullInterrupter* interrupter);

} // namespace tight
} // namespace openvdb_spheretree
