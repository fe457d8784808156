// SPDX-License-Identifier: Apache-2.0
/// @file FuzzConfig.cc
/// @brief Fuzz target: files of -config, and the actions in them.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".cfg", data, size);
}
