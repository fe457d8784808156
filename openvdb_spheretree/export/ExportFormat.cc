// SPDX-License-Identifier: Apache-2.0
#include "ExportFormat.h"

#include "ExportWriters.h"
#include "NanoVdbWriter.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <algorithm>

namespace openvdb_spheretree {

namespace {

/// What a format is besides the first columns of its row.
enum Trait : unsigned {
    kFloats = 1,         ///< ExportNumbers::Float
    kDoubles = 2,        ///< ExportNumbers::Double
    kAllLevels = 4,      ///< ExportFormat::allLevels
    kSamples = 8,        ///< ExportFormat::samples
    kMass = 16,          ///< ExportFormat::mass
    kPositiveRadii = 32, ///< ExportFormat::positiveRadii
    kByName = 64,        ///< its extensions mean another format, or nothing, without its name
    kOrdersIds = 128,    ///< ExportFormat::ordersIds
    kMetres = 256,       ///< ExportFormat::metres
    kLink = 512,         ///< ExportFormat::link
    kUtf8 = 1024,        ///< ExportNames::Utf8, and so on
    kXml = 2048,
    kWord = 4096,
    kIdentifier = 8192,
    kEmpty = 16384,      ///< ExportFormat::empty
    kUp = 32768,         ///< ExportFormat::up
    kFloatIds = 65536,   ///< ExportFormat::floatIds
    kLinks = 131072,     ///< ExportFormat::links
    kIds = 262144,       ///< ExportFormat::ids
    kNameless = 524288,  ///< not ExportFormat::named
    kErrors = 1048576,   ///< ExportFormat::errors
    kPrincipal = 2097152 ///< ExportFormat::principal
};

struct Row {
    const char* name;
    const char* extensions; ///< with spaces between
    const char* readers;
    const char* keeps;
    unsigned traits;
    decltype(ExportFormat::write) write;
};

constexpr char kSpheres[] = "a level: centers, radii";
constexpr char kLinkSpheres[] = "a level of each of its links: centers, radii";
constexpr char kBody[] = "a level: centers, radii; mass, center of mass, inertia";
constexpr char kTree[] = "all levels: centers, radii, ids, parents";
constexpr char kTriangles[] = "a level as triangles";

// clang-format off
constexpr Row kRows[] = {
    {"urdf", ".urdf", "ROS, MuJoCo", kBody, kMass | kMetres | kPositiveRadii | kLink | kXml, detail::writeUrdf},
    {"mjcf", ".mjcf .xml", "MuJoCo", kBody, kMass | kMetres | kPositiveRadii | kLink | kXml, detail::writeMjcf},
    {"srdf", ".srdf", "MoveIt", kLinkSpheres, kMetres | kPositiveRadii | kLink | kLinks | kXml, detail::writeSrdf},
    {"curobo", ".yml .yaml", "cuRobo", kLinkSpheres, kMetres | kPositiveRadii | kLink | kLinks | kUtf8, detail::writeCurobo},
    {"xrdf", ".xrdf", "cuMotion, Isaac Sim, cuRobo", kLinkSpheres, kMetres | kPositiveRadii | kLink | kLinks | kUtf8, detail::writeXrdf},
    {"lula", ".yml .yaml", "Isaac Sim's Lula", kLinkSpheres, kMetres | kPositiveRadii | kByName | kNameless | kLink | kLinks | kUtf8, detail::writeLula},
    {"foam", ".json", "foam", "all levels: centers, radii", kAllLevels | kByName | kNameless | kErrors, detail::writeFoam},
    {"morphit", ".json", "MorphIt, ballpark", kSpheres, kByName | kNameless, detail::writeMorphIt},

    {"usd", ".usda", "Houdini, Blender, Maya, Omniverse", "all levels: centers, radii, ids, parents; samples over time",
        kFloats | kAllLevels | kIds | kSamples | kIdentifier | kEmpty | kUp, detail::writeUsda},
    {"ply", ".ply", "Open3D, meshio", kTree, kFloats | kAllLevels | kIds | kWord | kEmpty, detail::writePly},
    {"ply-ascii", ".ply", "the same, as text", kTree, kFloats | kAllLevels | kIds | kByName | kWord | kEmpty, detail::writePlyAscii},
    {"glb", ".glb", "three.js (instances)", kTree, kFloats | kAllLevels | kIds | kUtf8 | kUp | kFloatIds, detail::writeGlb},
    {"nanovdb", ".nvdb", "NanoVDB", "all levels: centers, radii, ids, parents; or the voxels of grids",
        kFloats | kAllLevels | kIds, detail::writeNanoVdbPoints},

    {"mesh", ".obj", "all that read meshes", kTriangles, kFloats | kWord | kEmpty, detail::writeMeshObj},
    {"mesh", ".stl", "all that read meshes", kTriangles, kFloats | kWord, detail::writeMeshStl},
    {"mesh", ".glb", "all that read meshes", kTriangles, kFloats | kByName | kUtf8 | kUp, detail::writeMeshGlb},
    {"unreal", ".obj", "Unreal (sphere colliders)", "a level as triangles with names", kFloats | kByName | kWord,
        detail::writeUnrealObj},

    {"vtp", ".vtp", "ParaView, VTK", kTree, kDoubles | kAllLevels | kIds | kNameless | kEmpty, detail::writeVtp},
    {"vtk", ".vtk", "ParaView, VTK, multisphere, GEMSS", kTree, kAllLevels | kIds | kWord | kEmpty, detail::writeVtk},
    {"liggghts", ".multisphere", "LIGGGHTS", kSpheres, kPositiveRadii | kWord, detail::writeLiggghts},
    {"liggghts", ".txt", "LIGGGHTS", kSpheres, kPositiveRadii | kByName | kWord, detail::writeLiggghts},
    {"yade", ".txt", "YADE", kSpheres, kPositiveRadii | kByName | kWord, detail::writeYade},
    {"lammps", ".mol", "LAMMPS", kBody, kMass | kPositiveRadii | kWord, detail::writeLammps},
    {"lammps", ".txt", "LAMMPS", kBody, kMass | kPositiveRadii | kByName | kWord, detail::writeLammps},
    {"multisphere", ".csv", "multisphere, GEMSS", kSpheres, kByName | kNameless | kEmpty, detail::writeMultisphere},
    {"deme", ".csv", "DEM-Engine, Chrono", kSpheres, kByName | kNameless | kPrincipal | kEmpty, detail::writeDeme},
    {"xyz", ".xyz", "ASE", kTree, kAllLevels | kIds | kNameless | kEmpty, detail::writeXyz},
    {"swc", ".swc", "neuron tools", kTree, kAllLevels | kOrdersIds | kWord, detail::writeSwc},
    {"sph", ".sph", "Bradshaw's sphere-tree toolkit", "all levels as a complete tree: centers, radii",
        kAllLevels | kNameless | kOrdersIds, detail::writeSph},
};
// clang-format on

ExportFormat makeFormat(const Row& row)
{
    const auto has = [&row](Trait trait) { return (row.traits & trait) != 0; };
    ExportFormat format;
    format.name = row.name;
    detail::TextStream words(row.extensions);
    for (std::string word; words >> word;) format.extensions.push_back(word);
    format.byExtension = !has(kByName);
    format.readers = row.readers;
    format.keeps = row.keeps;
    if (has(kFloats)) format.numbers = ExportNumbers::Float;
    if (has(kDoubles)) format.numbers = ExportNumbers::Double;
    if (has(kUtf8)) format.names = ExportNames::Utf8;
    if (has(kXml)) format.names = ExportNames::Xml;
    if (has(kWord)) format.names = ExportNames::Word;
    if (has(kIdentifier)) format.names = ExportNames::Identifier;
    format.link = has(kLink);
    format.links = has(kLinks);
    format.empty = has(kEmpty);
    format.allLevels = has(kAllLevels);
    format.samples = has(kSamples);
    format.mass = has(kMass);
    format.metres = has(kMetres);
    format.up = has(kUp);
    format.positiveRadii = has(kPositiveRadii);
    format.floatIds = has(kFloatIds);
    format.ordersIds = has(kOrdersIds);
    format.ids = has(kIds);
    format.named = !has(kNameless);
    format.errors = has(kErrors);
    format.principal = has(kPrincipal);
    if (format.name == "nanovdb" && !writesNanoVdb()) {
        format.missing = "this build has no NanoVDB (Debian: libnanovdb-dev)";
    }
    format.write = row.write;
    return format;
}

std::vector<ExportFormat> makeFormats()
{
    std::vector<ExportFormat> formats;
    for (const Row& row : kRows) formats.push_back(makeFormat(row));
    return formats;
}

} // namespace

const std::vector<ExportFormat>& exportFormats()
{
    static const std::vector<ExportFormat> formats = makeFormats();
    return formats;
}

const std::vector<ExportOption>& exportOptionsOfSome()
{
    static const std::vector<ExportOption> options = {
        {"link", &ExportFormat::link, "hold no links"},
        {"name", &ExportFormat::named, "hold no name"},
        {"mass", &ExportFormat::mass, "hold no mass"},
        {"density", &ExportFormat::mass, "hold no mass"},
        {"start", &ExportFormat::samples, "hold no samples over time"},
        {"fps", &ExportFormat::samples, "hold no samples over time"},
        {"up", &ExportFormat::up, "say no axis that is up"}};
    return options;
}

std::string idleOptionNote(
    const ExportOption& option, const ExportFormat& format, const std::string& path)
{
    return std::string(option.name) + "= changes nothing, as " + detail::lowerExtension(path)
        + (format.byExtension ? "" : " format=" + format.name) + " files " + option.lacks;
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
