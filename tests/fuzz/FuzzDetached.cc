// SPDX-License-Identifier: Apache-2.0
/// @file FuzzDetached.cc
/// @brief Fuzz target: headers of `.nhdr` and the file of numbers beside them (inputs/VolumeInput.h).

#include "FuzzTarget.h"

#include "inputs/VolumeInput.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    // Its header names a file, which is to be in its folder.
    const std::string header = spheretree_test::textOf(data, size);
    if (header.substr(0, header.find(spheretree_test::kPartEnd)).find('/') != header.npos) return 0;
    return spheretree_test::readAsFile(".detached", data, size);
}
