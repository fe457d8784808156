// SPDX-License-Identifier: Apache-2.0
/// @file ExportBuffer.h
/// @brief Bytes on their way to a stream, which gets them in pieces.

#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace openvdb_spheretree::detail {

class ExportBuffer {
public:
    /// @throw openvdb::IoError if the stream fails, as from whatever adds to the buffer
    void finish();

protected:
    explicit ExportBuffer(std::ostream& out) : mOut(out) {}

    void flushIfLong()
    {
        if (mBytes.size() >= kFlushBytes) flush();
    }

    std::string mBytes;

private:
    static constexpr std::size_t kFlushBytes = std::size_t(1) << 16;
    void flush();

    std::ostream& mOut;
};

} // namespace openvdb_spheretree::detail
