// SPDX-License-Identifier: Apache-2.0
/// @file FuzzDetached.cc
/// @brief Fuzz target: headers of `.nhdr` and the file of numbers beside them (inputs/VolumeInput.h).

#include "FuzzTarget.h"

#include "inputs/VolumeInput.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".detached", data, size);
}
