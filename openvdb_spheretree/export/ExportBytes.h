// SPDX-License-Identifier: Apache-2.0
/// @file ExportBytes.h
/// @brief Writes numbers as little-endian bytes to a stream.

#pragma once

#include "ExportBuffer.h"

#include <cstring>
#include <string>
#include <type_traits>

namespace openvdb_spheretree::detail {

class ExportBytes : public ExportBuffer {
public:
    explicit ExportBytes(const ExportSink& out) : ExportBuffer(out) {}

    template <typename Number>
    void put(Number number)
    {
        static_assert(std::is_arithmetic_v<Number>);
        char bytes[sizeof(Number)];
        std::memcpy(
            bytes, &number, sizeof(Number)); // of a little-endian machine, as OpenVDB's files are
        mBytes.append(bytes, sizeof(Number));
        flushIfLong();
    }
    void put(const std::string& text)
    {
        mBytes += text;
        flushIfLong();
    }
};

} // namespace openvdb_spheretree::detail
