// SPDX-License-Identifier: Apache-2.0
#include "SphereTreeCsv.h"

#include <openvdb_spheretree/tree/LevelFrame.h>

#include <openvdb/Exceptions.h>

#include <array>
#include <charconv>
#include <ostream>
#include <string>

namespace openvdb_spheretree {

namespace {

constexpr std::size_t kFlushBytes = std::size_t(1) << 16;

/// Numbers as std::to_chars writes them: the shortest text that reads back to the same value, in no
/// locale whatever the stream's is.
template <typename Number>
void append(std::string& row, Number value, char separator)
{
    std::array<char, 32> text; // a double takes 24 characters at most, an int32 11
    row.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
    row += separator;
}

/// Called after each row, and at the end.
void write(std::string& text, std::ostream& out, bool atEnd = false)
{
    if (!atEnd && text.size() < kFlushBytes) return;
    out.write(text.data(), std::streamsize(text.size()));
    if (atEnd) out.flush();
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the .csv: is the disk full?");
    text.clear();
}

} // namespace

openvdb::Coord shownVoxel(const SphereTree& tree, int32_t id, int level)
{
    const bool inIndexSpace = level == 0 || tree.radiusSq[id] == -1;
    return inIndexSpace ? openvdb::Coord::round(tree.spheres.center[id]) : tree.ijk[id];
}

ShownGrid shownGrid(const SphereTree& tree, int32_t id, int level)
{
    const auto* pyramid = tree.settings.find<PyramidOptions>();
    if (!pyramid || level == 0 || tree.radiusSq[id] == -1) return {};
    ShownGrid grid{1, tree.origin};
    // No level that is built is wider; a file may name any number.
    for (int k = 0; k < level && grid.scale <= LevelFrame::kMaxScale; ++k) {
        grid.scale *= pyramid->factor;
    }
    return grid;
}

void writeCsv(const SphereTree& tree, std::ostream& out)
{
    const bool hasTracks = !tree.track.empty();
    std::string text = "level,id,parent,x,y,z,radius,i,j,k,radius_sq,scale,origin_i,origin_j,"
                       "origin_k";
    text += hasTracks ? ",track\n" : "\n";
    for (auto level = tree.levels.rbegin(); level != tree.levels.rend(); ++level) {
        for (int32_t id = level->begin; id < level->end; ++id) {
            append(text, level->level, ',');
            append(text, id, ',');
            append(text, tree.spheres.parent[id], ',');
            const openvdb::Vec3d center = tree.centerWorld(id);
            for (int axis = 0; axis < 3; ++axis) append(text, center[axis], ',');
            // Widened: the shortest text of the float could read back to a double just below it.
            append(text, double(tree.spheres.radiusWorld[id]), ',');
            const openvdb::Coord ijk = shownVoxel(tree, id, level->level);
            for (int axis = 0; axis < 3; ++axis) append(text, ijk[axis], ',');
            append(text, tree.radiusSq[id], ',');
            const ShownGrid grid = shownGrid(tree, id, level->level);
            append(text, grid.scale, ',');
            append(text, grid.origin[0], ',');
            append(text, grid.origin[1], ',');
            append(text, grid.origin[2], hasTracks ? ',' : '\n');
            if (hasTracks) append(text, tree.track[std::size_t(id)], '\n');
            write(text, out);
        }
    }
    write(text, out, /*atEnd=*/true);
}

void writeDagCsv(const SphereTree& tree, std::ostream& out)
{
    std::string text = "parent,child\n";
    for (const DagEdge& edge : tree.dag) {
        append(text, edge.parent, ',');
        append(text, edge.child, '\n');
        write(text, out);
    }
    write(text, out, /*atEnd=*/true);
}

} // namespace openvdb_spheretree
