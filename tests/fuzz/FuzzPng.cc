// SPDX-License-Identifier: Apache-2.0
/// @file FuzzPng.cc
/// @brief Fuzz target: the reader of gray `.png` pictures.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".png", data, size);
}
