// SPDX-License-Identifier: Apache-2.0
/// @file VectorTarget.h
/// @brief The instruction set that vector kernels run on, which is otherwise the processor's best one.
///
/// Every test program looks at the environment variable kTargetVariable before its first test: it
/// may name a target to run on (TestMain.cc).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace spheretree_test {

constexpr const char* kTargetVariable = "SPHERETREE_TEST_TARGET";

/// @return the name of the target on which a kernel runs now.
std::string runningTarget();

/// @return those of this program that the processor can run; the plainest one comes last.
std::vector<int64_t> allTargets();

std::string targetName(int64_t target);

/// From now on kernels run on @a target; on the processor's best one where it is 0.
void forceTarget(int64_t target);

} // namespace spheretree_test
