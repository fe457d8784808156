// SPDX-License-Identifier: Apache-2.0
/// @file FuzzPgm.cc
/// @brief Fuzz target: the reader of gray `.pgm` pictures.

#include "FuzzTarget.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".pgm", data, size);
}
