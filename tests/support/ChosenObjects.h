// SPDX-License-Identifier: Apache-2.0
/// @file ChosenObjects.h
/// @brief Those of the random objects that suit a test. A test of none would pass, so too few of
/// them are a failure.

#pragma once

#include "RandomObjects.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace spheretree_test {

/// @return the objects of the seeds in [first, last) that @a suits(seed, object).
/// @param least  a failure if there are fewer
template <typename Suits>
std::vector<RandomObject> chosenObjects(
    uint32_t first, uint32_t last, std::size_t least, const Suits& suits)
{
    std::vector<RandomObject> chosen;
    for (uint32_t seed = first; seed < last; ++seed) {
        RandomObject object = randomObject(seed);
        if (suits(seed, object)) chosen.push_back(std::move(object));
    }
    EXPECT_GE(chosen.size(), least) << "objects of the seeds " << first << " to " << last;
    return chosen;
}

/// Those of at most so many voxels.
std::vector<RandomObject> objectsOfAtMost(
    std::size_t voxels, uint32_t first, uint32_t last, std::size_t least);

/// Those whose box is no longer than that from corner to corner.
std::vector<RandomObject> objectsNoWiderThan(
    int diagonal, uint32_t first, uint32_t last, std::size_t least);

} // namespace spheretree_test
