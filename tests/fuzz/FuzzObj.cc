// SPDX-License-Identifier: Apache-2.0
/// @file FuzzObj.cc
/// @brief Fuzz target: the reader of `.obj` meshes.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".obj", data, size);
}
