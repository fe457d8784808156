// SPDX-License-Identifier: Apache-2.0
/// @file Base64.h
/// @brief Numbers as base64 (RFC 4648) of their little-endian bytes, written as they come.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iosfwd>
#include <string>

namespace openvdb_spheretree::detail {

class Base64 {
public:
    /// @param out  must outlive this
    explicit Base64(std::ostream& out) : mOut(out) {}

    /// @param number  of 4 or 8 bytes
    template <typename Number>
    void add(Number number)
    {
        static_assert(sizeof(Number) == 4 || sizeof(Number) == 8);
        uint64_t bits = 0;
        if constexpr (sizeof(Number) == 4) {
            uint32_t word;
            std::memcpy(&word, &number, sizeof(word));
            bits = word;
        } else {
            std::memcpy(&bits, &number, sizeof(bits));
        }
        for (std::size_t i = 0; i < sizeof(Number); ++i) addByte(uint8_t(bits >> 8 * i));
    }

    /// Writes what is left, with its padding. Nothing can be added after it.
    /// @throw openvdb::IoError if the stream fails
    void finish();

private:
    void addByte(uint8_t byte)
    {
        mGroup = mGroup << 8 | byte;
        if (++mBytes == 3) putGroup();
    }
    void putGroup();
    void write();

    std::ostream& mOut;
    std::string mText;
    uint32_t mGroup = 0; ///< up to three bytes, the first one highest
    int mBytes = 0;      ///< of them
};

} // namespace openvdb_spheretree::detail
