// SPDX-License-Identifier: Apache-2.0
/// @file ExportBytes.h
/// @brief Writes numbers as little-endian bytes to a stream, in pieces.

#pragma once

#include <cstdint>
#include <cstring>
#include <iosfwd>
#include <string>
#include <type_traits>

namespace openvdb_spheretree::detail {

class ExportBytes {
public:
    explicit ExportBytes(std::ostream& out) : mOut(out) {}

    template <typename Number>
    void put(Number number)
    {
        static_assert(std::is_arithmetic_v<Number>);
        char bytes[sizeof(Number)];
        std::memcpy(
            bytes, &number, sizeof(Number)); // of a little-endian machine, as OpenVDB's files are
        mBytes.append(bytes, sizeof(Number));
        if (mBytes.size() >= kFlushBytes) flush();
    }
    void put(const std::string& text)
    {
        mBytes += text;
        if (mBytes.size() >= kFlushBytes) flush();
    }
    /// @throw openvdb::IoError if the stream fails, as from put()
    void finish();

private:
    static constexpr std::size_t kFlushBytes = std::size_t(1) << 16;
    void flush();

    std::ostream& mOut;
    std::string mBytes;
};

} // namespace openvdb_spheretree::detail
