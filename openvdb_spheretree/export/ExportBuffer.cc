// SPDX-License-Identifier: Apache-2.0
#include "ExportBuffer.h"

#include <openvdb/Exceptions.h>

#include <ostream>

namespace openvdb_spheretree::detail {

void ExportBuffer::flush()
{
    mOut.write(mBytes.data(), std::streamsize(mBytes.size()));
    if (!mOut) OPENVDB_THROW(openvdb::IoError, "cannot write the file: is the disk full?");
    mBytes.clear();
}

void ExportBuffer::finish()
{
    flush();
    mOut.flush();
    if (!mOut) OPENVDB_THROW(openvdb::IoError, "cannot write the file: is the disk full?");
}

} // namespace openvdb_spheretree::detail
