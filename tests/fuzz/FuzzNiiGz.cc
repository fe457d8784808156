// SPDX-License-Identifier: Apache-2.0
/// @file FuzzNiiGz.cc
/// @brief Fuzz target: NIfTI volumes that are packed. What does not begin as gzip does is packed here: a change behind its
/// checksum would get no further.

#include "FuzzTarget.h"

#include "inputs/SampleBytes.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    using namespace spheretree_test;
    if (size > 0 && data[0] == 0x1f) return readAsFile(".nii.gz", data, size);
    const std::string packed = deflated(textOf(data, size), Deflated::Gzip);
    return readAsFile(".nii.gz", reinterpret_cast<const uint8_t*>(packed.data()), packed.size());
}
