// SPDX-License-Identifier: Apache-2.0
/// @file FuzzCsv.cc
/// @brief Fuzz target: the reader of `.csv` files of spheres.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".csv", data, size);
}
