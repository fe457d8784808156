// SPDX-License-Identifier: Apache-2.0
// The spheres of a level as triangles, for what knows no spheres. Corners lie on the spheres, so triangles are
// a little inside: by 4.8 % of a radius where there are many spheres, by 1.3 % where there are few.

#include "ExportBytes.h"
#include "ExportText.h"
#include "ExportWriters.h"
#include "UnitSphere.h"

#include <openvdb/Exceptions.h>

#include <cstdio>
#include <limits>

namespace openvdb_spheretree::detail {

namespace {

/// @param nameOf  std::string(std::size_t): of the object that a sphere is
template <typename NameOf>
void writeObj(const ExportScene& scene, const NameOf& nameOf, const ExportSink& out)
{
    const ExportLevel& level = scene.finest();
    const UnitSphere shape = meshShapeFor(level.size());
    // Points are not rounded to the decimals of lengths: they are on the spheres to six digits of a radius.
    ExportText text(out, scene.decimals);
    text << "# " << level.size() << " spheres of " << oneWord(scene.name) << '\n';
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << "o " << nameOf(i) << '\n';
        for (const openvdb::Vec3d& point : shape.points) {
            text << "v ";
            text.lengths(level.centers[i] + point * level.radii[i], " ") << '\n';
        }
        const std::size_t first = 1 + i * shape.points.size(); // numbers begin with 1
        for (const auto& [a, b, c] : shape.triangles) {
            text << "f " << first + a << ' ' << first + b << ' ' << first + c << '\n';
        }
    }
    text.finish();
}

std::string twoDigits(std::size_t number)
{
    return (number < 10 ? "0" : "") + std::to_string(number);
}

} // namespace

void writeMeshObj(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::string name = oneWord(scene.name);
    writeObj(
        scene, [&](std::size_t i) { return name + "_" + std::to_string(scene.finest().ids[i]); },
        out);
}

/// Unreal takes a mesh of this name for a sphere collider of the mesh `name`:
/// https://dev.epicgames.com/documentation/en-us/unreal-engine/fbx-static-mesh-pipeline-in-unreal-engine
void writeUnrealObj(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::string name = "USP_" + oneWord(scene.name) + "_";
    writeObj(
        scene, [&](std::size_t i) { return name + twoDigits(i + 1); }, out);
}

void requireStlTriangles(uint64_t triangles)
{
    if (triangles > std::numeric_limits<uint32_t>::max()) {
        OPENVDB_THROW(openvdb::ValueError,
            "a .stl counts its triangles in 32 bits, and here are "
                << triangles << ": choose a coarser level with level= or spheres=");
    }
}

/// Binary, as all readers take it: a header of 80 bytes, and 50 bytes a triangle.
void writeMeshStl(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportLevel& level = samples.front().finest();
    const UnitSphere shape = meshShapeFor(level.size());
    const uint64_t triangles = uint64_t(level.size()) * shape.triangles.size();
    requireStlTriangles(triangles);
    ExportBytes bytes(out);
    std::string header = "spheres of " + oneWord(samples.front().name);
    header.resize(80, ' ');
    bytes.put(header);
    bytes.put(uint32_t(triangles));
    const auto put = [&](const openvdb::Vec3d& vector) {
        for (int axis = 0; axis < 3; ++axis) bytes.put(float(vector[axis]));
    };
    for (std::size_t i = 0; i < level.size(); ++i) {
        for (const auto& triangle : shape.triangles) {
            openvdb::Vec3d normal(0, 0, 0);
            for (const uint32_t corner : triangle) normal += shape.points[corner];
            put(normal.unit());
            for (const uint32_t corner : triangle)
                put(level.centers[i] + shape.points[corner] * level.radii[i]);
            bytes.put(uint16_t(0));
        }
    }
    bytes.finish();
}

} // namespace openvdb_spheretree::detail
