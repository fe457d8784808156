// SPDX-License-Identifier: Apache-2.0
#include "SphereTreeJson.h"

#include "JsonWriter.h"
#include "SphereTreeCsv.h"
#include <openvdb_spheretree/base/FormatNames.h>
#include <openvdb_spheretree/tree/SettingsTable.h>

#include <openvdb/math/Transform.h>
#include <openvdb/Exceptions.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <ostream>

namespace openvdb_spheretree {

namespace {

/// An array on one line.
template <typename Values>
void writeArray(JsonWriter& json, const std::string& key, const Values& values)
{
    json.beginArray(key, /*onOneLine=*/true);
    for (const auto& value : values) json.value("", value);
    json.endArray();
}

void writeCoord(JsonWriter& json, const std::string& key, const openvdb::Coord& ijk)
{
    writeArray(json, key, std::array<int, 3>{ijk[0], ijk[1], ijk[2]});
}

void writeVec(JsonWriter& json, const openvdb::Vec3d& vec)
{
    for (int axis = 0; axis < 3; ++axis) json.value("", vec[axis]);
}

/// Called after each row, and at the end.
void flush(JsonWriter& json, std::ostream& out, bool atEnd = false)
{
    if (!atEnd && json.text().size() < std::size_t(1) << 16) return;
    out.write(json.text().data(), std::streamsize(json.text().size()));
    if (atEnd) out.flush();
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the .json: is the disk full?");
    json.clearText();
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

/// The last columns of nodes and of cuts: the sphere in index space.
void writeSphere(JsonWriter& json, const Spheres& spheres, int32_t id)
{
    writeVec(json, spheres.center[id]);
    json.value("", spheres.radius[id]);
    json.value("", spheres.coverRadiusSq[id]);
}

void writeNodes(JsonWriter& json, const SphereTree& tree, std::ostream& out)
{
    constexpr const char* kColumns[] = {"level", "id", "parent", "x", "y", "z", "radius", "i", "j",
        "k", "radius_sq", "index_x", "index_y", "index_z", "radius_voxels", "cover_sq", "track"};
    std::vector<std::string> columns(std::begin(kColumns), std::end(kColumns));
    if (tree.track.empty()) columns.pop_back();
    writeArray(json, "columns", columns);
    json.beginArray("nodes");
    for (auto level = tree.levels.rbegin(); level != tree.levels.rend(); ++level) {
        for (int32_t id = level->begin; id < level->end; ++id) {
            json.beginArray("", /*onOneLine=*/true);
            json.value("", level->level);
            json.value("", id);
            json.value("", tree.spheres.parent[id]);
            writeVec(json, tree.centerWorld(id));
            json.value("", double(tree.spheres.radiusWorld[id]));
            const openvdb::Coord ijk = shownVoxel(tree, id, level->level);
            for (int axis = 0; axis < 3; ++axis) json.value("", ijk[axis]);
            json.value("", tree.radiusSq[id]);
            writeSphere(json, tree.spheres, id);
            if (!tree.track.empty()) json.value("", tree.track[std::size_t(id)]);
            json.endArray();
            flush(json, out);
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
        writeArray(json, "", std::array<int32_t, 2>{edge.parent, edge.child});
        flush(json, out);
    }
    json.endArray();
}

void writeCuts(JsonWriter& json, const SphereTree& tree, std::ostream& out)
{
    if (tree.cuts.empty()) {
        json.null("cuts");
        return;
    }
    constexpr const char* kColumns[] = {"id", "parent", "first", "last", "x", "y", "z", "radius",
        "index_x", "index_y", "index_z", "radius_voxels", "cover_sq"};
    const SphereCuts& cuts = tree.cuts;
    json.beginObject("cuts");
    writeArray(json, "columns", kColumns);
    json.beginArray("nodes");
    for (int32_t id = 0; id < cuts.size(); ++id) {
        json.beginArray("", /*onOneLine=*/true);
        for (const int32_t value : {id, cuts.spheres.parent[id], cuts.first[id], cuts.last[id]}) {
            json.value("", value);
        }
        writeVec(json, tree.transform->indexToWorld(cuts.spheres.center[id]));
        json.value("", double(cuts.spheres.radiusWorld[id]));
        writeSphere(json, cuts.spheres, id);
        json.endArray();
        flush(json, out);
    }
    json.endArray();
    json.endObject();
}

void writeExactError(JsonWriter& json, const SphereTreeLevel& level)
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
    using detail::SettingType;
    const SphereTreeSettings settings = detail::recordedSettings(tree);
    for (const detail::Setting* setting : detail::settingsInJson()) {
        const std::string& name = setting->name;
        const std::string text = setting->get(settings);
        switch (setting->type) {
        case SettingType::Flag: json.value(name, text == "1"); break;
        case SettingType::Integer: json.value(name, std::stoi(text)); break;
        case SettingType::Real:
        case SettingType::Length:
            if (text.empty()) json.null(name);
            else json.value(name, detail::realOf(text));
            break;
        case SettingType::Counts:
            writeArray(json, name, text.empty() ? std::vector<int64_t>() : countsFromString(text));
            break;
        default:
            if (text.empty() && setting->isOptional) json.null(name);
            else json.value(name, text);
        }
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
    writeExactError(json, level);
    if (level.stored) {
        json.value("stored_hamming_percent", level.stored->hammingPercent);
        json.value("stored_reach", level.stored->reachWorld);
    } else {
        json.null("stored_hamming_percent");
        json.null("stored_reach");
    }
    if (!level.storedUnknown.empty()) json.value("stored_unknown", level.storedUnknown);
}

void writeJson(const SphereTree& tree, std::ostream& out)
{
    JsonWriter json;
    json.beginObject();
    json.value("format", detail::treeJsonFormat());
    writeObject(json, tree);
    json.beginObject("settings");
    writeSettings(json, tree);
    json.endObject();
    const openvdb::Mat4d matrix = tree.transform->baseMap()->getAffineMap()->getMat4();
    json.beginArray("transform", /*onOneLine=*/true);
    for (int i = 0; i < 16; ++i) json.value("", matrix(i / 4, i % 4));
    json.endArray();
    json.value("subdivision", tree.subdivision);
    writeLevels(json, tree);
    writeNodes(json, tree, out);
    writeDag(json, tree, out);
    writeCuts(json, tree, out);
    json.endObject();
    flush(json, out, /*atEnd=*/true);
}

} // namespace openvdb_spheretree
