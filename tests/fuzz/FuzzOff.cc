// SPDX-License-Identifier: Apache-2.0
/// @file FuzzOff.cc
/// @brief Fuzz target: the reader of `.off` meshes.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".off", data, size);
}
