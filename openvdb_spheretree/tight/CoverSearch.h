// SPDX-License-Identifier: Apache-2.0
/// @file tight/CoverSearch.h
/// @brief Makes a cover better without more balls (quality=best): tries changes, keeps those that
/// pay.
///
/// A trial spoils one ball and lets its neighbours make the best of it: the ball grows, or moves,
/// and then each ball near it is placed anew for what it still owes. If the cover costs less in the
/// end, it stays; if not, nothing has happened. A ball can also go elsewhere: a neighbour takes over
/// what it owes, and where a small ball is put in, its neighbours shrink. The
/// cheapest of all removals are paired with the best of many insertions.
///
/// Trials of a batch start from the same cover and run in parallel; of those that pay, the first
/// ones whose surroundings do not meet are kept. What is tried follows from a counter, and the
/// number of trials is bounded by the number of balls: the result is the same for any number of
/// threads, and the time does not decide.

#pragma once

#include "BallFit.h"
#include "CoverDebt.h"
#include "FineBall.h"
#include "SampledObject.h"

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct SearchEffort {
    FitEffort fit;
    int trialsPerBall = 20;
    bool flat = false;
};

/// @param balls   a cover in the sense of @a debt
/// @param leaves  small balls, to be put in where one is to spare: those of the next finer level
/// @return a cover of as many balls, whose excess is not larger.
std::vector<FineBall> improveCover(std::vector<FineBall> balls, const std::vector<FineBall>& leaves,
    const SampledObject& object, const CoverDebt& debt, const SearchEffort& effort,
    openvdb::util::NullInterrupter* interrupter);

} // namespace tight
} // namespace openvdb_spheretree
