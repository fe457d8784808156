// SPDX-License-Identifier: Apache-2.0
#include "ExportBuffer.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/Exceptions.h>

#include <ostream>

namespace openvdb_spheretree::detail {

void ExportBuffer::flush()
{
    checkInterrupt(mSink.interrupter);
    mSink.stream.write(mBytes.data(), std::streamsize(mBytes.size()));
    if (!mSink.stream) OPENVDB_THROW(openvdb::IoError, "cannot write the file: is the disk full?");
    mBytes.clear();
}

void ExportBuffer::finish()
{
    flush();
    mSink.stream.flush();
    if (!mSink.stream) OPENVDB_THROW(openvdb::IoError, "cannot write the file: is the disk full?");
}

} // namespace openvdb_spheretree::detail
