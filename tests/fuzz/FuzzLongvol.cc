// SPDX-License-Identifier: Apache-2.0
/// @file FuzzLongvol.cc
/// @brief Fuzz target: the reader of `.longvol` volumes.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".longvol", data, size);
}
