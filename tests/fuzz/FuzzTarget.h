// SPDX-License-Identifier: Apache-2.0
/// @file FuzzTarget.h
/// @brief What fuzz targets share. A target is a file that defines LLVMFuzzerTestOneInput(); an
/// exception that leaves it, a report of a sanitizer, a hang or a request for too much memory is a
/// finding. CONTRIBUTING.md says how to run them.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size);

namespace spheretree_test {

/// The input as text, or as bytes.
inline std::string textOf(const uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

/// @brief What the target of a reader of files does (InputReader.h). One thread at work: the same input
/// takes the same way each time.
/// @param extension  the same at every call of a program
/// @param delayed    of a `.vdb`: values are read as they are used
/// @return 0, which is what libFuzzer wants
int readAsFile(const char* extension, const uint8_t* data, std::size_t size, bool delayed = false);

/// Fails if it does not hold, with assertions on or off.
void require(bool holds, const char* what);

} // namespace spheretree_test
