// SPDX-License-Identifier: Apache-2.0
#include "TreeDescription.h"

#include <openvdb_spheretree/picture/RayShapes.h>
#include <openvdb_spheretree/store/JsonWriter.h>

#include <openvdb/math/Transform.h>

#include <array>

namespace openvdb_spheretree::detail {

namespace {

void writeVec(JsonWriter& json, const std::string& key, const openvdb::Vec3d& vec)
{
    json.beginArray(key, /*onOneLine=*/true);
    for (int axis = 0; axis < 3; ++axis) json.value("", vec[axis]);
    json.endArray();
}

/// @return the axes of index space as unit vectors of world space.
std::array<openvdb::Vec3d, 3> axesOf(const SphereTree& tree)
{
    std::array<openvdb::Vec3d, 3> axes;
    for (int axis = 0; axis < 3; ++axis) {
        openvdb::Vec3d along(0.0);
        along[axis] = 1;
        axes[std::size_t(axis)] = tree.transform->baseMap()->applyJacobian(along).unit();
    }
    return axes;
}

/// What the spheres are drawn as: discs in the plane of a flat object, the polyhedra of a norm, or
/// spheres.
void writeShape(JsonWriter& json, const SphereTree& tree)
{
    const auto axes = axesOf(tree);
    json.beginArray("axes");
    for (const openvdb::Vec3d& axis : axes) writeVec(json, "", axis);
    json.endArray();
    const Distance& dist = tree.settings.dist();
    const bool areDiscs = tree.settings.dim == 2 && dist.isEuclidean();
    if (areDiscs) json.value("flat_axis", tree.flatAxis);
    else json.null("flat_axis");
    double reach = 1;
    json.beginArray("faces");
    if (!dist.isEuclidean()) {
        const NormFaces faces(dist);
        reach = faces.reach;
        for (const openvdb::Vec3d& normal : faces.normals) {
            writeVec(json, "", normal[0] * axes[0] + normal[1] * axes[1] + normal[2] * axes[2]);
        }
    }
    json.endArray();
    json.value("reach", reach);
}

void writeLevels(JsonWriter& json, const SphereTree& tree)
{
    json.beginArray("levels");
    for (const SphereTreeLevel& level : tree.levels) {
        json.beginObject();
        json.value("level", level.level);
        json.value("begin", level.begin);
        json.value("end", level.end);
        writeError(json, level);
        json.endObject();
    }
    json.endArray();
}

void writeSurface(JsonWriter& json, const ObjectSurface* surface, const std::string& missing)
{
    if (!surface) {
        json.null("surface");
        json.value("surface_missing", missing);
        return;
    }
    json.beginObject("surface");
    json.value("factor", surface->factor);
    json.value("growth", surface->growth);
    json.value("triangles", 2 * int64_t(surface->quads.size()));
    writeVec(json, "origin", surface->originWorld);
    json.endObject();
}

/// JSON has `<` in its strings alone, and there an escape means the same. Without it nothing ends the
/// element that the text stands in.
std::string withoutTags(const std::string& json)
{
    std::string text;
    text.reserve(json.size());
    for (const char c : json) {
        if (c == '<') text += "\\u003c";
        else text += c;
    }
    return text;
}

} // namespace

std::string treeDescription(
    const SphereTree& tree, const ObjectSurface* surface, const std::string& missing)
{
    JsonWriter json;
    json.beginObject();
    json.value("format", "vdb_spheretree.viewer.1");
    json.value("name", tree.settings.name);
    writeObject(json, tree);
    json.beginObject("settings");
    writeSettings(json, tree);
    json.endObject();
    writeShape(json, tree);
    writeLevels(json, tree);
    json.value("has_cuts", !tree.cuts.empty());
    json.value(
        "may_have_cuts", tree.settings.find<BudgetOptions>() != nullptr && !tree.settings.isFit());
    writeSurface(json, surface, missing);
    json.endObject();
    return withoutTags(json.text());
}

} // namespace openvdb_spheretree::detail
