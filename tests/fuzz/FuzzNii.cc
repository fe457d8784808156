// SPDX-License-Identifier: Apache-2.0
/// @file FuzzNii.cc
/// @brief Fuzz target: the reader of NIfTI volumes.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".nii", data, size);
}
