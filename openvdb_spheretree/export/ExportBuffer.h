// SPDX-License-Identifier: Apache-2.0
/// @file ExportBuffer.h
/// @brief Bytes on their way to a stream, which gets them in pieces. Between these the work may be interrupted.

#pragma once

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <iosfwd>
#include <string>

namespace openvdb_spheretree::detail {

/// Where a file goes.
struct ExportSink {
    // A stream alone will do, where files are small.
    ExportSink(std::ostream& to, openvdb::util::NullInterrupter* listener = nullptr)
        : stream(to), interrupter(listener)
    {}

    std::ostream& stream;
    openvdb::util::NullInterrupter* interrupter; ///< asked at every piece; may be null
};

class ExportBuffer {
public:
    /// @throw openvdb::IoError if the stream fails, as from whatever adds to the buffer; what checkInterrupt() throws
    void finish();

protected:
    explicit ExportBuffer(const ExportSink& sink) : mSink(sink) {}

    void flushIfLong()
    {
        if (mBytes.size() >= kFlushBytes) flush();
    }

    std::string mBytes;

private:
    static constexpr std::size_t kFlushBytes = std::size_t(1) << 16;
    void flush();

    const ExportSink mSink;
};

} // namespace openvdb_spheretree::detail
