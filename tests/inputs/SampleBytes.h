// SPDX-License-Identifier: Apache-2.0
/// @file SampleBytes.h
/// @brief What samples of files are put together of: numbers as bytes, and deflated streams.

#pragma once

#include <cstring>
#include <string>

namespace spheretree_test {

template <typename Value>
std::string bytesOf(Value value, bool swapped = false)
{
    std::string bytes(sizeof(value), '\0');
    std::memcpy(bytes.data(), &value, sizeof(value));
    return swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

enum class Deflated { Zlib, Gzip };

/// @return @a bytes as a stream of zlib or gzip.
std::string deflated(const std::string& bytes, Deflated stream);

} // namespace spheretree_test
