// SPDX-License-Identifier: Apache-2.0
/// @file PlainCopy.h
/// @brief What stages are compared with, so that figures carry over to other machines: a parallel
/// copy of the int32 values of as many leaves.

#pragma once

#include <cstdint>

namespace spheretree_benchmark {

/// @return seconds of the copy with the threads that there are, the best of five. Of more than
/// 2^16 leaves (128 MiB) that many are copied, and the time is scaled.
double copySeconds(int64_t leaves);

} // namespace spheretree_benchmark
