// SPDX-License-Identifier: Apache-2.0
/// @file export/NanoVdbWriter.h
/// @brief Grids as a `.nvdb` file of NanoVDB, which graphics processors read in place.

#pragma once

#include <openvdb/Types.h>
#include <openvdb/util/NullInterrupter.h>

#include <iosfwd>
#include <vector>

namespace openvdb::OPENVDB_VERSION_NAME {
class GridBase;
}

namespace openvdb_spheretree {

/// @return whether this build writes .nvdb, because it has the headers of NanoVDB.
bool writesNanoVdb();

/// @brief Write grids of float, double, int32, int64, Vec3f, bool, masks or points, without compression; of points the
/// attributes that are int32, int64, float, or three floats. Each grid must have a transform that is an affine
/// map, as all but those of cameras are.
///
/// Names longer than 255 bytes are kept by NanoVDB as data of their own. Metadata is not kept: NanoVDB has none.
/// @param grids  none is null; they are changed meanwhile, and are then as before
/// @throw openvdb::ValueError if a grid is of another type, or has other attributes; openvdb::IoError if the
///        stream fails, a grid's values cannot be read from its file, or this build has no NanoVDB
/// @throw Interrupted
/// @note The same grids give the same bytes. Memory: all grids once more.
void writeNanoVdb(const std::vector<openvdb::SharedPtr<openvdb::GridBase>>& grids,
    std::ostream& out, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
