// SPDX-License-Identifier: Apache-2.0
/// @file FuzzRaw.cc
/// @brief Fuzz target: plain numbers, with settings from their first bytes (inputs/VolumeInput.h).

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".raw", data, size);
}
