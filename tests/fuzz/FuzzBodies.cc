// SPDX-License-Identifier: Apache-2.0
/// @file FuzzBodies.cc
/// @brief Fuzz target: the reader of tables of poses of several bodies.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".bodies", data, size);
}
