// SPDX-License-Identifier: Apache-2.0
// K. Museth, "NanoVDB: A GPU-friendly and portable VDB data structure for real-time rendering and simulation", 2021. Its own
// headers make the grids. Its own writer wants to go back in the file, which a pipe cannot; but without
// compression all sizes are known before.

#include "NanoVdbWriter.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/input/DelayedValues.h>

#include <openvdb/Exceptions.h>

#include <ostream>

#ifdef SPHERETREE_WITH_NANOVDB
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include <cstring>
#include <memory>
#endif

namespace openvdb_spheretree {

#ifdef SPHERETREE_WITH_NANOVDB

namespace {

/// NanoVDB leaves gaps between its fields; these are to be the same bytes every time.
class ZeroedBuffer : public nanovdb::HostBuffer {
public:
    explicit ZeroedBuffer(uint64_t size = 0) : nanovdb::HostBuffer(size)
    {
        if (size > 0) std::memset(data(), 0, size);
    }
    static ZeroedBuffer create(uint64_t size, const ZeroedBuffer* = nullptr)
    {
        return ZeroedBuffer(size);
    }
};

using Handle = nanovdb::GridHandle<ZeroedBuffer>;
using GridPtr = openvdb::SharedPtr<openvdb::GridBase>;

/// @return nothing if the grid is of another type.
template <typename Grid>
bool convert(const GridPtr& grid, Handle& handle)
{
    const auto typed = openvdb::GridBase::grid<Grid>(grid);
    if (!typed) return false;
    handle = nanovdb::openToNanoVDB<ZeroedBuffer, typename Grid::TreeType>(*typed);
    return true;
}

Handle converted(const GridPtr& grid)
{
    Handle handle;
    const bool done = convert<openvdb::FloatGrid>(grid, handle)
        || convert<openvdb::DoubleGrid>(grid, handle) || convert<openvdb::Int32Grid>(grid, handle)
        || convert<openvdb::Int64Grid>(grid, handle) || convert<openvdb::Vec3SGrid>(grid, handle)
        || convert<openvdb::BoolGrid>(grid, handle) || convert<openvdb::MaskGrid>(grid, handle)
        || convert<openvdb::points::PointDataGrid>(grid, handle);
    if (done) return handle;
    OPENVDB_THROW(openvdb::ValueError,
        "NanoVDB has no grids of type " << grid->type() << ", as "
                                        << detail::inQuotes(grid->getName()) << " is");
}

/// Its errors name attributes and transforms; all are about what a grid holds.
Handle convertedOrRefused(const GridPtr& grid)
{
    try {
        return converted(grid);
    } catch (const openvdb::Exception&) {
        throw;
    } catch (const std::runtime_error& error) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::inQuotes(grid->getName()) << " cannot become NanoVDB: " << error.what());
    }
}

} // namespace

bool writesNanoVdb() { return true; }

void writeNanoVdb(const std::vector<openvdb::SharedPtr<openvdb::GridBase>>& grids,
    std::ostream& out, openvdb::util::NullInterrupter* interrupter)
{
    constexpr auto kCodec = nanovdb::io::Codec::NONE;
    std::vector<Handle> handles;
    nanovdb::io::Segment segment(kCodec);
    for (const GridPtr& grid : grids) {
        requireReadableValues(*grid, interrupter);
        detail::checkInterrupt(interrupter);
        handles.push_back(convertedOrRefused(grid));
        segment.add(handles.back());
        segment.meta.back().fileSize = handles.back().size();
    }
    try {
        segment.write(out);
    } catch (const std::runtime_error&) { // of a stream that fails, which it still does below
    }
    for (const Handle& handle : handles) {
        out.write(reinterpret_cast<const char*>(handle.data()), std::streamsize(handle.size()));
    }
    out.flush();
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the file: is the disk full?");
}

#else

bool writesNanoVdb() { return false; }

void writeNanoVdb(const std::vector<openvdb::SharedPtr<openvdb::GridBase>>&, std::ostream&,
    openvdb::util::NullInterrupter*)
{
    OPENVDB_THROW(openvdb::IoError,
        "this build writes no .nvdb; for that install NanoVDB (Debian: libnanovdb-dev) and "
        "configure with -DSPHERETREE_WITH_NANOVDB=ON");
}

#endif

} // namespace openvdb_spheretree
