// SPDX-License-Identifier: Apache-2.0
#include "VdbGrids.h"

#include "VdbGuard.h"

#include <openvdb/io/Stream.h>

#include <istream>

namespace openvdb_spheretree {

openvdb::GridPtrVec readVdbGrids(std::streambuf& source)
{
    detail::VdbGuard guard(source);
    std::istream in(&guard);
    // OpenVDB does not look whether a read succeeded, and goes on with what happens to be in memory.
    in.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
    openvdb::io::Stream stream(in, /*delayLoad=*/false);
    return *stream.getGrids();
}

std::optional<std::vector<std::string>> requireSoundVdb(std::streambuf& source)
{
    detail::VdbGuard guard(source, detail::DelayedMetadata::Keep);
    guard.takeAll();
    if (!guard.hasOffsets()) return std::nullopt;
    return guard.names();
}

} // namespace openvdb_spheretree
