// SPDX-License-Identifier: Apache-2.0
// Binary glTF: instances of one small mesh (EXT_mesh_gpu_instancing), a scene a level; or the meshes of all
// spheres of a level, for what knows no instances.

#include "ExportWriters.h"
#include "GlbFile.h"
#include "UnitSphere.h"

namespace openvdb_spheretree::detail {

namespace {

void putFloats(ExportBytes& bytes, const openvdb::Vec3d& vector)
{
    for (int axis = 0; axis < 3; ++axis) bytes.put(float(vector[axis]));
}

openvdb::BBoxd boxOf(const std::vector<openvdb::Vec3d>& points)
{
    openvdb::BBoxd box;
    for (const openvdb::Vec3d& point : points) {
        // glTF wants those of the floats.
        box.expand(openvdb::Vec3d(float(point[0]), float(point[1]), float(point[2])));
    }
    return box;
}

void writeMesh(JsonWriter& json, int points, int indices)
{
    json.beginArray("meshes");
    json.beginObject();
    json.beginArray("primitives");
    json.beginObject();
    json.beginObject("attributes");
    json.value("POSITION", points);
    json.endObject();
    json.value("indices", indices);
    json.endObject();
    json.endArray();
    json.endObject();
    json.endArray();
}

/// Accessors of the instances of a level.
struct Instances {
    int translation, scale;
    std::vector<std::pair<std::string, int>>
        numbers; ///< names and accessors of what else they have
};

Instances addInstances(GlbFile& file, const ExportLevel& level)
{
    const std::size_t count = level.size();
    Instances instances;
    instances.translation =
        file.addArray("VEC3", GlbFile::Float, count, [&level](ExportBytes& bytes) {
            for (const openvdb::Vec3d& center : level.centers) putFloats(bytes, center);
        });
    instances.scale = file.addArray("VEC3", GlbFile::Float, count, [&level](ExportBytes& bytes) {
        for (const double radius : level.radii) putFloats(bytes, openvdb::Vec3d(radius));
    });
    if (!level.idsAreFloats()) return instances; // and attributes are floats in glTF
    for (const auto& [name, ids] :
        {std::pair("_ID", &level.ids), std::pair("_PARENT", &level.parents)}) {
        const int accessor =
            file.addArray("SCALAR", GlbFile::Float, count, [ids = ids](ExportBytes& bytes) {
                for (const int32_t id : *ids) bytes.put(float(id));
            });
        instances.numbers.emplace_back(name, accessor);
    }
    return instances;
}

void writeInstanceNode(JsonWriter& json, const ExportLevel& level, const Instances& instances)
{
    json.beginObject();
    json.value("name", "level_" + std::to_string(level.number));
    json.value("mesh", 0);
    json.beginObject("extensions");
    json.beginObject("EXT_mesh_gpu_instancing");
    json.beginObject("attributes");
    json.value("TRANSLATION", instances.translation);
    json.value("SCALE", instances.scale);
    for (const auto& [name, accessor] : instances.numbers) json.value(name, accessor);
    json.endObject();
    json.endObject();
    json.endObject();
    json.endObject();
}

/// A root with one node of instances below it is a scene, so that a viewer shows one level; the finest first.
void writeScenes(
    JsonWriter& json, const ExportScene& scene, const std::vector<Instances>& instances)
{
    const int levels = int(scene.levels.size());
    json.value("scene", 0);
    json.beginArray("scenes");
    for (int k = 0; k < levels; ++k) {
        json.beginObject();
        json.value(
            "name", "level_" + std::to_string(scene.levels[std::size_t(levels - 1 - k)].number));
        json.beginArray("nodes", /*onOneLine=*/true);
        json.value({}, 2 * k);
        json.endArray();
        json.endObject();
    }
    json.endArray();
    json.beginArray("nodes");
    for (int k = 0; k < levels; ++k) {
        const auto level = std::size_t(levels - 1 - k);
        writeRootNode(json, scene, {2 * k + 1});
        writeInstanceNode(json, scene.levels[level], instances[level]);
    }
    json.endArray();
}

} // namespace

void writeGlb(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const UnitSphere shape = unitSphere(2);
    GlbFile file;
    const int points =
        file.addPoints(shape.points.size(), boxOf(shape.points), [&](ExportBytes& bytes) {
            for (const openvdb::Vec3d& point : shape.points) putFloats(bytes, point);
        });
    const int indices = file.addIndices(3 * shape.triangles.size(), [&](ExportBytes& bytes) {
        for (const auto& triangle : shape.triangles) {
            for (const uint32_t corner : triangle) bytes.put(corner);
        }
    });
    std::vector<Instances> instances;
    for (const ExportLevel& level : scene.levels) instances.push_back(addInstances(file, level));
    file.write(
        [&](JsonWriter& json) {
            writeScenes(json, scene, instances);
            writeMesh(json, points, indices);
        },
        "EXT_mesh_gpu_instancing", out);
}

void writeMeshGlb(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const ExportLevel& level = scene.finest();
    const UnitSphere shape = meshShapeFor(level.size());
    const auto cornerOf = [&](std::size_t sphere, const openvdb::Vec3d& point) {
        return level.centers[sphere] + point * level.radii[sphere];
    };
    openvdb::BBoxd box;
    for (std::size_t i = 0; i < level.size(); ++i) {
        for (const openvdb::Vec3d& point : shape.points) {
            const openvdb::Vec3d corner = cornerOf(i, point);
            box.expand(openvdb::Vec3d(float(corner[0]), float(corner[1]), float(corner[2])));
        }
    }
    GlbFile file;
    const int points =
        file.addPoints(level.size() * shape.points.size(), box, [&](ExportBytes& bytes) {
            for (std::size_t i = 0; i < level.size(); ++i) {
                for (const openvdb::Vec3d& point : shape.points)
                    putFloats(bytes, cornerOf(i, point));
            }
        });
    const int indices =
        file.addIndices(3 * level.size() * shape.triangles.size(), [&](ExportBytes& bytes) {
            for (std::size_t i = 0; i < level.size(); ++i) {
                for (const auto& triangle : shape.triangles) {
                    for (const uint32_t corner : triangle)
                        bytes.put(uint32_t(i * shape.points.size() + corner));
                }
            }
        });
    file.write(
        [&](JsonWriter& json) {
            json.value("scene", 0);
            json.beginArray("scenes");
            json.beginObject();
            json.beginArray("nodes", /*onOneLine=*/true);
            json.value({}, 0);
            json.endArray();
            json.endObject();
            json.endArray();
            json.beginArray("nodes");
            writeRootNode(json, scene, {1});
            json.beginObject();
            json.value("name", "level_" + std::to_string(level.number));
            json.value("mesh", 0);
            json.endObject();
            json.endArray();
            writeMesh(json, points, indices);
        },
        "", out);
}

} // namespace openvdb_spheretree::detail
