// SPDX-License-Identifier: Apache-2.0
/// @file ByteWindow.h
/// @brief Bytes of a file between the moment they are read and the moment OpenVDB gets them: the place
/// where they are looked at.
///
/// A window holds as many bytes as have really arrived. A length that a damaged file only claims
/// therefore costs no memory: the file ends before.

#pragma once

#include <cstdint>
#include <cstring>
#include <streambuf>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

class ByteWindow {
public:
    explicit ByteWindow(std::streambuf& source) : mSource(source) {}

    /// Forget the bytes up to here.
    void clear();

    /// @brief The next @a count bytes, which become part of the window. The pointer is good until the
    /// next call.
    /// @throw openvdb::IoError if there are fewer
    const char* take(uint64_t count);

    /// As take(), of a number or of a struct of numbers without padding.
    template <typename T>
    T value()
    {
        T value;
        std::memcpy(&value, take(sizeof(T)), sizeof(T));
        return value;
    }

    /// A string as OpenVDB writes it: its length in 32 bits, then its characters.
    std::string string();

    /// @brief See to it that @a count more bytes have arrived, and stay where we are.
    /// @throw openvdb::IoError if there are fewer
    void require(uint64_t count);

    /// @brief Take the bytes from @a begin on out of the window, as if the file had never had them.
    /// @param begin  of a size() before
    void eraseFrom(size_t begin);

    char* data() { return mBytes.data(); }
    /// Bytes from the start of the window to where we are.
    size_t size() const { return mTaken; }
    /// Bytes from the start of the file to where we are.
    uint64_t position() const { return mStart + mTaken; }

    /// @throw openvdb::IoError: the file is damaged, where we are, and @a what is wrong
    [[noreturn]] void fail(const std::string& what) const;

private:
    std::streambuf& mSource;
    std::vector<char> mBytes; ///< grows only; bytes beyond mArrived mean nothing
    size_t mArrived = 0;
    size_t mTaken = 0;
    uint64_t mStart = 0; ///< of the window, in the file
};

} // namespace openvdb_spheretree::detail
