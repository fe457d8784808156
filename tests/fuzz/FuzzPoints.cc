// SPDX-License-Identifier: Apache-2.0
/// @file FuzzPoints.cc
/// @brief Fuzz target: the reader of tables of points.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".points", data, size);
}
