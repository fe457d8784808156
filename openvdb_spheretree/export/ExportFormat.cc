// SPDX-License-Identifier: Apache-2.0
#include "ExportFormat.h"

#include "ExportWriters.h"
#include "NanoVdbWriter.h"

#include <algorithm>

namespace openvdb_spheretree {

namespace {

/// What most formats have in common.
ExportFormat format(const std::string& name, const std::vector<std::string>& extensions,
    const std::string& readers, const std::string& keeps, decltype(ExportFormat::write) write)
{
    ExportFormat format;
    format.name = name;
    format.extensions = extensions;
    format.readers = readers;
    format.keeps = keeps;
    format.write = write;
    return format;
}

/// A format whose extensions mean another one, or nothing, without its name.
ExportFormat byName(ExportFormat format)
{
    format.byExtension = false;
    return format;
}

ExportFormat withLevels(ExportFormat format)
{
    format.allLevels = true;
    return format;
}

ExportFormat withMass(ExportFormat format)
{
    format.mass = true;
    return format;
}

ExportFormat withSamples(ExportFormat format)
{
    format.samples = true;
    return format;
}

ExportFormat withIdsInOrder(ExportFormat format)
{
    format.ordersIds = true;
    return format;
}

ExportFormat withPositiveRadii(ExportFormat format)
{
    format.positiveRadii = true;
    return format;
}

ExportFormat nanoVdb(ExportFormat format)
{
    if (!writesNanoVdb()) {
        format.missing = "this build has no NanoVDB (Debian: libnanovdb-dev)";
    }
    return format;
}

ExportFormat in(ExportNumbers numbers, ExportFormat format)
{
    format.numbers = numbers;
    return format;
}

std::vector<ExportFormat> makeFormats()
{
    constexpr auto kFloat = ExportNumbers::Float, kDouble = ExportNumbers::Double;
    const char* const spheres = "a level: centers, radii";
    const char* const massive = "a level: centers, radii; mass, center of mass, inertia";
    const char* const all = "all levels: centers, radii, ids, parents";
    return {
        withMass(withPositiveRadii(
            format("urdf", {".urdf"}, "ROS, MuJoCo, Bullet, Drake", massive, detail::writeUrdf))),
        withMass(withPositiveRadii(
            format("mjcf", {".mjcf", ".xml"}, "MuJoCo, Drake", massive, detail::writeMjcf))),
        withPositiveRadii(format("srdf", {".srdf"}, "MoveIt", spheres, detail::writeSrdf)),
        withPositiveRadii(
            format("curobo", {".yml", ".yaml"}, "cuRobo", spheres, detail::writeCurobo)),
        withPositiveRadii(
            format("xrdf", {".xrdf"}, "cuMotion, Isaac Sim, cuRobo", spheres, detail::writeXrdf)),
        byName(withPositiveRadii(
            format("lula", {".yml", ".yaml"}, "Isaac Sim's Lula", spheres, detail::writeLula))),
        byName(withLevels(
            format("foam", {".json"}, "foam", "all levels: centers, radii", detail::writeFoam))),
        byName(format("morphit", {".json"}, "MorphIt, ballpark", spheres, detail::writeMorphIt)),

        withSamples(withLevels(in(kFloat,
            format("usd", {".usda"}, "Houdini, Blender, Maya, Omniverse",
                std::string(all) + "; samples over time", detail::writeUsda)))),
        withLevels(in(
            kFloat, format("ply", {".ply"}, "Open3D, meshio, Blender 4", all, detail::writePly))),
        byName(withLevels(in(kFloat,
            format("ply-ascii", {".ply"}, "the same, as text", all, detail::writePlyAscii)))),
        withLevels(in(kFloat,
            format("glb", {".glb"}, "three.js, Babylon.js (instances)", all, detail::writeGlb))),

        nanoVdb(withLevels(in(kFloat,
            format("nanovdb", {".nvdb"}, "NanoVDB", std::string(all) + "; or the voxels of grids",
                detail::writeNanoVdbPoints)))),

        in(kFloat,
            format("mesh", {".obj"}, "all that read meshes", "a level as triangles",
                detail::writeMeshObj)),
        in(kFloat,
            format("mesh", {".stl"}, "all that read meshes", "a level as triangles",
                detail::writeMeshStl)),
        byName(in(kFloat,
            format("mesh", {".glb"}, "all that read meshes", "a level as triangles",
                detail::writeMeshGlb))),
        byName(in(kFloat,
            format("unreal", {".obj"}, "Unreal (sphere colliders)",
                "a level as triangles with names", detail::writeUnrealObj))),

        withLevels(in(kDouble, format("vtp", {".vtp"}, "ParaView, VTK", all, detail::writeVtp))),
        withLevels(
            format("vtk", {".vtk"}, "ParaView, VTK, multisphere, GEMSS", all, detail::writeVtk)),
        byName(withPositiveRadii(format(
            "liggghts", {".txt", ".multisphere"}, "LIGGGHTS", spheres, detail::writeLiggghts))),
        byName(withPositiveRadii(format("yade", {".txt"}, "YADE", spheres, detail::writeYade))),
        byName(withPositiveRadii(
            withMass(format("lammps", {".mol", ".txt"}, "LAMMPS", massive, detail::writeLammps)))),
        byName(format(
            "multisphere", {".csv"}, "multisphere, GEMSS", spheres, detail::writeMultisphere)),
        byName(format("deme", {".csv"}, "DEM-Engine, Chrono", spheres, detail::writeDeme)),
        withLevels(format("xyz", {".xyz"}, "ASE, OVITO", all, detail::writeXyz)),
        withIdsInOrder(
            withLevels(format("swc", {".swc"}, "neuron tools, skeletor", all, detail::writeSwc))),
        withIdsInOrder(withLevels(format("sph", {".sph"}, "Bradshaw's sphere-tree toolkit",
            "all levels as a complete tree: centers, radii", detail::writeSph))),
    };
}

} // namespace

const std::vector<ExportFormat>& exportFormats()
{
    static const std::vector<ExportFormat> formats = makeFormats();
    return formats;
}

const ExportFormat* findExportFormat(const std::string& extension, const std::string& name)
{
    for (const ExportFormat& format : exportFormats()) {
        if (name.empty() ? !format.byExtension : format.name != name) continue;
        const auto& known = format.extensions;
        if (std::find(known.begin(), known.end(), extension) != known.end()) return &format;
    }
    return nullptr;
}

} // namespace openvdb_spheretree
