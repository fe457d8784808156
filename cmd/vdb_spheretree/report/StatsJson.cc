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
        if (level.error) json.value("dice", diceOf(tree, level));
        else json.null("dice");
        if (tree.settings.isInner()) {
            if (level.error) json.value("covered_percent", coveredPercent(tree, level));
            else json.null("covered_percent");
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

std::string statsJson(const SphereTree& tree, const Session& session)
{
    JsonWriter json;
    json.beginObject();
    json.value("format", "vdb_spheretree.stats.1");
    writeObject(json, tree);
    json.beginObject("settings");
    writeSettings(json, tree);
    json.value("memory", openvdb_spheretree::memoryToString(tree.settings.memory));
    json.endObject();
    writeLevels(json, tree);
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
