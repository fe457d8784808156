// SPDX-License-Identifier: Apache-2.0
#include "StatsReport.h"

#include "JsonWriter.h"

namespace command {

using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;
using openvdb_spheretree::SphereTreeSettings;

namespace {

void writeCoord(JsonWriter& json, const std::string& key, const openvdb::Coord& ijk)
{
    json.beginArray(key, /*onOneLine=*/true);
    for (int axis = 0; axis < 3; ++axis) json.value("", ijk[axis]);
    json.endArray();
}

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

void writeSettings(JsonWriter& json, const SphereTreeSettings& settings)
{
    json.beginObject("settings");
    json.value("tree", toString(settings.tree));
    json.value("factor", settings.factor);
    json.value("dim", settings.dim);
    json.value("model", modelToString(settings));
    json.value("dist", openvdb_spheretree::toString(settings.dist));
    json.value("parent", toString(settings.parent));
    json.value("final_fit", settings.finalFit);
    json.value("reconstruct", toString(settings.reconstruct));
    json.value("scale", toString(settings.scale));
    json.value("padding", openvdb_spheretree::paddingToString(settings.padding));
    json.value("dag", settings.dag);
    json.value("edges", toString(settings.edges));
    json.value("topology", settings.topology);
    json.value("name", settings.name);
    json.endObject();
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
    if (!level.error) {
        for (const char* key : {"covered", "excess", "missing", "hamming_percent", "hausdorff"}) {
            json.null(key);
        }
        const bool tried = !level.errorUnknown.empty();
        json.value("error_unknown", tried ? level.errorUnknown : "not computed");
        return;
    }
    json.value("covered", level.error->covered);
    json.value("excess", level.error->excess);
    json.value("missing", level.error->missing);
    json.value("hamming_percent", level.error->hammingPercent);
    json.value("hausdorff", level.error->hausdorff);
}

void writeLevels(JsonWriter& json, const SphereTree& tree)
{
    json.beginArray("levels");
    for (const SphereTreeLevel& level : tree.levels) {
        const LevelRadii radii = radiiOf(tree, level);
        json.beginObject();
        json.value("level", level.level);
        json.value("spheres", level.size());
        json.value("pyramid_voxels", level.pyramidVoxels);
        writeTopology(json, level);
        json.value("radius_min", radii.smallest);
        json.value("radius_max", radii.largest);
        writeError(json, level);
        json.endObject();
    }
    json.endArray();
}

void writeSeconds(JsonWriter& json, const Session& session)
{
    const StageSeconds& seconds = session.seconds;
    json.beginObject("seconds");
    json.value("read", seconds.read);
    json.value("mask", seconds.mask);
    json.value("pyramid", seconds.build.pyramid);
    json.value("distance", seconds.build.distance);
    json.value("power", seconds.build.power);
    json.value("medial", seconds.build.medial);
    json.value("tree", seconds.build.tree);
    json.value("topology", seconds.build.topology);
    json.value("error", seconds.error);
    json.value("write", seconds.write);
    json.value("total", session.total.seconds());
    json.endObject();
}

} // namespace

std::string statsJson(const SphereTree& tree, const Session& session)
{
    JsonWriter json;
    json.beginObject();
    json.value("format", "vdb_spheretree.stats.1");
    writeObject(json, tree);
    writeSettings(json, tree.settings);
    writeLevels(json, tree);
    writeSeconds(json, session);
    json.value("peak_bytes", peakBytes());
    json.endObject();
    return json.text();
}

} // namespace command
