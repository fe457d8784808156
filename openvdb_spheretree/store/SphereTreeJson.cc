// SPDX-License-Identifier: Apache-2.0
#include "SphereTreeJson.h"

#include "JsonWriter.h"
#include "SphereTreeCsv.h"
#include <openvdb_spheretree/tree/SettingsTable.h>

#include <openvdb/math/Transform.h>
#include <openvdb/Exceptions.h>

#include <cstddef>
#include <ostream>

namespace openvdb_spheretree {

namespace {

constexpr const char* kColumns[] = {"level", "id", "parent", "x", "y", "z", "radius", "i", "j", "k",
    "radius_sq", "index_x", "index_y", "index_z", "radius_voxels", "cover_sq"};

void writeCoord(JsonWriter& json, const std::string& key, const openvdb::Coord& ijk)
{
    json.beginArray(key, /*onOneLine=*/true);
    for (int axis = 0; axis < 3; ++axis) json.value("", ijk[axis]);
    json.endArray();
}

void writeVec(JsonWriter& json, const openvdb::Vec3d& vec)
{
    for (int axis = 0; axis < 3; ++axis) json.value("", vec[axis]);
}

void flush(JsonWriter& json, std::ostream& out, std::size_t atLeast = 0)
{
    if (json.text().size() < atLeast) return;
    out.write(json.text().data(), std::streamsize(json.text().size()));
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the .json: is the disk full?");
    json.clearText();
}

/// Called after each row.
void flushOften(JsonWriter& json, std::ostream& out) { flush(json, out, std::size_t(1) << 16); }

void writeTransform(JsonWriter& json, const SphereTree& tree)
{
    const openvdb::Mat4d matrix = tree.transform->baseMap()->getAffineMap()->getMat4();
    json.beginArray("transform", /*onOneLine=*/true);
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) json.value("", matrix(row, column));
    }
    json.endArray();
}

void writeLevels(JsonWriter& json, const SphereTree& tree)
{
    json.beginArray("levels");
    for (const SphereTreeLevel& level : tree.levels) {
        json.beginObject();
        json.value("level", level.level);
        json.value("begin", level.begin);
        json.value("end", level.end);
        json.value("pyramid_voxels", level.pyramidVoxels);
        writeTopology(json, level);
        writeError(json, level);
        json.endObject();
    }
    json.endArray();
}

void writeNode(JsonWriter& json, const SphereTree& tree, int32_t id, int level)
{
    json.beginArray("", /*onOneLine=*/true);
    json.value("", level);
    json.value("", id);
    json.value("", tree.spheres.parent[id]);
    writeVec(json, tree.centerWorld(id));
    json.value("", double(tree.spheres.radiusWorld[id]));
    const openvdb::Coord ijk = shownVoxel(tree, id, level);
    for (int axis = 0; axis < 3; ++axis) json.value("", ijk[axis]);
    json.value("", tree.radiusSq[id]);
    writeVec(json, tree.spheres.center[id]);
    json.value("", tree.spheres.radius[id]);
    json.value("", tree.spheres.coverRadiusSq[id]);
    json.endArray();
}

template <std::size_t N>
void writeColumns(JsonWriter& json, const char* const (&columns)[N])
{
    json.beginArray("columns", /*onOneLine=*/true);
    for (const char* column : columns) json.value("", column);
    json.endArray();
}

void writeNodes(JsonWriter& json, const SphereTree& tree, std::ostream& out)
{
    writeColumns(json, kColumns);
    json.beginArray("nodes");
    for (auto level = tree.levels.rbegin(); level != tree.levels.rend(); ++level) {
        for (int32_t id = level->begin; id < level->end; ++id) {
            writeNode(json, tree, id, level->level);
            flushOften(json, out);
        }
    }
    json.endArray();
}

void writeDag(JsonWriter& json, const SphereTree& tree, std::ostream& out)
{
    if (!hasDag(tree)) {
        json.null("dag");
        return;
    }
    json.beginArray("dag");
    for (const DagEdge& edge : tree.dag) {
        json.beginArray("", /*onOneLine=*/true);
        json.value("", edge.parent);
        json.value("", edge.child);
        json.endArray();
        flushOften(json, out);
    }
    json.endArray();
}

constexpr const char* kCutsColumns[] = {"id", "parent", "first", "last", "x", "y", "z", "radius",
    "index_x", "index_y", "index_z", "radius_voxels", "cover_sq"};

void writeCutsNode(JsonWriter& json, const SphereTree& tree, int32_t id)
{
    const SphereCuts& cuts = tree.cuts;
    json.beginArray("", /*onOneLine=*/true);
    for (int32_t value : {id, cuts.spheres.parent[id], cuts.first[id], cuts.last[id]})
        json.value("", value);
    writeVec(json, tree.transform->indexToWorld(cuts.spheres.center[id]));
    json.value("", double(cuts.spheres.radiusWorld[id]));
    writeVec(json, cuts.spheres.center[id]);
    json.value("", cuts.spheres.radius[id]);
    json.value("", cuts.spheres.coverRadiusSq[id]);
    json.endArray();
}

void writeCuts(JsonWriter& json, const SphereTree& tree, std::ostream& out)
{
    if (tree.cuts.empty()) {
        json.null("cuts");
        return;
    }
    json.beginObject("cuts");
    writeColumns(json, kCutsColumns);
    json.beginArray("nodes");
    for (int32_t id = 0; id < tree.cuts.size(); ++id) {
        writeCutsNode(json, tree, id);
        flushOften(json, out);
    }
    json.endArray();
    json.endObject();
}

void writeSetting(JsonWriter& json, const detail::Setting& setting, const std::string& text)
{
    using detail::SettingType;
    switch (setting.type) {
    case SettingType::Flag: json.value(setting.name, text == "1"); break;
    case SettingType::Integer: json.value(setting.name, std::stoi(text)); break;
    case SettingType::Real:
        if (text.empty()) json.null(setting.name);
        else json.value(setting.name, detail::realOf(text));
        break;
    case SettingType::Counts:
        json.beginArray(setting.name, /*onOneLine=*/true);
        if (!text.empty()) {
            for (const int64_t count : countsFromString(text)) json.value("", count);
        }
        json.endArray();
        break;
    default: json.value(setting.name, text);
    }
}

} // namespace

void writeObject(JsonWriter& json, const SphereTree& tree)
{
    json.beginObject("object");
    json.value("name", tree.object.name);
    json.value("voxels", tree.object.voxels);
    json.value("leaves", tree.object.leaves);
    json.value("tiles", tree.object.tiles);
    writeCoord(json, "bbox_min", tree.object.bbox.min());
    writeCoord(json, "bbox_max", tree.object.bbox.max());
    json.value("voxel_size", tree.voxelSize());
    writeCoord(json, "origin", tree.origin);
    json.endObject();
}

void writeSettings(JsonWriter& json, const SphereTree& tree)
{
    const SphereTreeSettings settings = detail::recordedSettings(tree);
    for (const detail::Setting* setting : detail::settingsInJson()) {
        writeSetting(json, *setting, setting->get(settings));
    }
}

void writeTopology(JsonWriter& json, const SphereTreeLevel& level)
{
    if (!level.topology) {
        json.null("topology");
        return;
    }
    json.beginObject("topology");
    json.value("components", level.topology->components);
    json.value("tunnels", level.topology->tunnels);
    json.value("cavities", level.topology->cavities);
    json.endObject();
}

void writeError(JsonWriter& json, const SphereTreeLevel& level)
{
    const std::optional<LevelError>& error = level.error;
    if (!error) {
        for (const char* key : {"covered", "excess", "missing", "hamming_percent", "hausdorff"}) {
            json.null(key);
        }
        const bool tried = !level.errorUnknown.empty();
        json.value("error_unknown", tried ? level.errorUnknown : "not computed");
        return;
    }
    json.value("covered", error->covered);
    json.value("excess", error->excess);
    json.value("missing", error->missing);
    json.value("hamming_percent", error->hammingPercent);
    json.value("hausdorff", error->hausdorff);
}

void writeJson(const SphereTree& tree, std::ostream& out)
{
    JsonWriter json;
    json.beginObject();
    json.value("format", "vdb_spheretree.tree.1");
    writeObject(json, tree);
    json.beginObject("settings");
    writeSettings(json, tree);
    json.endObject();
    writeTransform(json, tree);
    json.value("subdivision", tree.subdivision);
    writeLevels(json, tree);
    writeNodes(json, tree, out);
    writeDag(json, tree, out);
    writeCuts(json, tree, out);
    json.endObject();
    flush(json, out);
    out.flush();
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the .json: is the disk full?");
}

} // namespace openvdb_spheretree
