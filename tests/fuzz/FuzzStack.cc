// SPDX-License-Identifier: Apache-2.0
/// @file FuzzStack.cc
/// @brief Fuzz target: stacks of slices (inputs/VolumeInput.h).

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".stack", data, size);
}
