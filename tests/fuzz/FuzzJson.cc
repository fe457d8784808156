// SPDX-License-Identifier: Apache-2.0
/// @file FuzzJson.cc
/// @brief Fuzz target: the reader of `.json` files of spheres.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".json", data, size);
}
