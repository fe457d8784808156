// SPDX-License-Identifier: Apache-2.0
#include "StatsReport.h"

#include <openvdb_spheretree/store/JsonWriter.h>
#include <openvdb_spheretree/tree/DagAdjacency.h>

namespace command {

using openvdb_spheretree::Degrees;
using openvdb_spheretree::JsonWriter;
using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;

namespace {

void writeVec(JsonWriter& json, const std::string& key, const openvdb::Vec3d& vec)
{
    json.beginArray(key, /*onOneLine=*/true);
    for (int axis = 0; axis < 3; ++axis) json.value("", vec[axis]);
    json.endArray();
}

/// Rows of three.
void writeMat(JsonWriter& json, const std::string& key, const openvdb::Mat3d& matrix)
{
    json.beginArray(key);
    for (int row = 0; row < 3; ++row) writeVec(json, "", matrix.row(row));
    json.endArray();
}

void writeMass(
    JsonWriter& json, const std::optional<openvdb_spheretree::MassProperties>& properties)
{
    if (!properties) return json.null("mass");
    json.beginObject("mass");
    json.value("volume", properties->volume);
    writeVec(json, "center", properties->center);
    writeMat(json, "inertia", properties->inertia);
    writeVec(json, "principal_moments", properties->principalMoments);
    writeMat(json, "principal_axes", properties->principalAxes);
    json.endObject();
}

void writeLevels(JsonWriter& json, const SphereTree& tree, const StatsMass& mass)
{
    json.beginArray("levels");
    for (std::size_t i = 0; i < tree.levels.size(); ++i) {
        const SphereTreeLevel& level = tree.levels[i];
        const LevelRadii radii = radiiOf(tree, level);
        json.beginObject();
        json.value("level", level.level);
        json.value("spheres", level.size());
        json.value("pyramid_voxels", level.pyramidVoxels);
        writeTopology(json, level);
        json.value("radius_min", radii.smallest);
        json.value("radius_max", radii.largest);
        writeError(json, level);
        if (level.error) json.value("dice", diceOf(tree, level));
        else json.null("dice");
        if (tree.settings.isInner()) {
            if (level.error) json.value("covered_percent", coveredPercent(tree, level));
            else json.null("covered_percent");
        }
        if (!mass.levels.empty()) {
            writeMass(json, mass.levels[i].mass);
            if (!mass.levels[i].mass) json.value("mass_unknown", mass.levels[i].unknown);
        }
        json.endObject();
    }
    json.endArray();
}

void writeDegrees(JsonWriter& json, const char* key, const Degrees& degrees)
{
    json.beginObject(key);
    json.value("min", degrees.min);
    json.value("mean", degrees.mean);
    json.value("max", degrees.max);
    json.endObject();
}

void writeDag(JsonWriter& json, const SphereTree& tree)
{
    if (tree.dag.empty()) {
        json.null("dag");
        return;
    }
    json.beginObject("dag");
    json.value("edges", int64_t(tree.dag.size()));
    json.value("kind", toString(tree.settings.pyramid().edges));
    json.beginArray("levels");
    for (const auto& level : dagStats(tree)) {
        json.beginObject();
        json.value("level", level.level);
        json.value("edges", level.edges);
        writeDegrees(json, "children_per_parent", level.childrenPerParent);
        writeDegrees(json, "parents_per_child", level.parentsPerChild);
        json.value("shared_children", level.sharedChildren);
        json.value("tree_edges_in_dag_percent", level.treeEdgesInDagPercent);
        json.endObject();
    }
    json.endArray();
    json.endObject();
}

} // namespace

std::string statsJson(const SphereTree& tree, const StatsMass& mass, const Session& session)
{
    JsonWriter json;
    json.beginObject();
    json.value("format", "vdb_spheretree.stats.1");
    writeObject(json, tree);
    writeMass(json, mass.object);
    json.beginObject("settings");
    writeSettings(json, tree);
    json.value("memory", openvdb_spheretree::memoryToString(tree.settings.memory));
    json.endObject();
    writeLevels(json, tree, mass);
    writeDag(json, tree);
    json.beginObject("seconds");
    for (const auto& [name, seconds] : stageSeconds(session)) json.value(name, seconds);
    json.value("total", session.total.seconds());
    json.endObject();
    json.value("peak_bytes", peakBytes());
    json.endObject();
    return json.text();
}

} // namespace command
