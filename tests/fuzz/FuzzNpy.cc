// SPDX-License-Identifier: Apache-2.0
/// @file FuzzNpy.cc
/// @brief Fuzz target: the reader of arrays of numpy.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".npy", data, size);
}
