// SPDX-License-Identifier: Apache-2.0
/// @file FuzzGltf.cc
/// @brief Fuzz target: the reader of `.gltf` scenes, by assimp in a child process, which may crash: this one must not. What the
/// child reaches is not seen, so inputs are changed blindly.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".gltf", data, size);
}
