// SPDX-License-Identifier: Apache-2.0
/// @file VolumeFile.cc
/// @brief Files to volumes, by the steps that the command takes: -read, -mesh2ls, -resample, -mask.

#include "Errors.h"
#include "Volume.h"

#include "base/NotNumbers.h"
#include "files/ScaleMesh.h"
#include "files/VdbStream.h"
#include "line/Length.h"
#include "line/Plan.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/Resample.h>
#include <openvdb_spheretree/input/array/ArrayGrid.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/mesh/MeshLevelSet.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/input/volume/VolumeFile.h>
#include <openvdb_spheretree/solid/MeshSolid.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/topology/ObjectParts.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/Count.h>

#include <algorithm>

namespace binding {

namespace spheretree = openvdb_spheretree;
using openvdb::GridBase;
using openvdb_spheretree::Coverage;
using openvdb_spheretree::detail::inQuotes;
using openvdb_spheretree::detail::shortNumber;

namespace {

bool asksFor(const ObjectRequest& request, const char* name)
{
    return std::count(request.given.begin(), request.given.end(), name) > 0;
}

/// A keyword that says nothing about this kind of grid would be passed over in silence.
void requireRelevant(const ObjectRequest& request, const GridBase& grid)
{
    const bool levelSet = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
    const bool hasNumbers = !grid.isType<openvdb::BoolGrid>() && !grid.isType<openvdb::MaskGrid>()
        && !grid.isType<openvdb::points::PointDataGrid>();
    const std::string which = ", and " + inQuotes(grid.getName()) + " is none";
    if (asksFor(request, "iso") && !levelSet) {
        throw InputError("iso is for level sets" + which + (hasNumbers ? ": use threshold" : ""));
    }
    for (const char* name : {"threshold", "above", "below", "label"}) {
        if (!asksFor(request, name) || (hasNumbers && !levelSet)) continue;
        throw InputError(std::string(name) + " is for volumes of numbers that are no level sets"
            + which + (levelSet ? ": use iso" : ""));
    }
    if (asksFor(request, "coverage") && !hasNumbers) {
        throw InputError("coverage is for volumes of numbers and level sets" + which);
    }
}

GridBase::ConstPtr withCubes(const GridBase::ConstPtr& grid, const ObjectRequest& request,
    openvdb::util::NullInterrupter* interrupter)
{
    if (spheretree::hasCubicVoxels(grid->transform()) || !spheretree::isObjectGrid(*grid))
        return grid;
    const bool nearest = !request.settings.labels.empty();
    try {
        return spheretree::resampled(*grid, spheretree::shortestVoxelEdge(*grid),
            nearest ? spheretree::Sampling::Nearest : spheretree::Sampling::Linear, interrupter);
    } catch (const openvdb::ArithmeticError&) {
        return grid; // too far away for any transform; whoever builds from it says so
    }
}

/// Grids of a sphere-tree are points, and so might be taken for an object.
bool isOfTree(const GridBase& grid)
{
    if (spheretree::isSphereTree(grid)) return true;
    const std::string name = grid.getName();
    const auto stem = [&](const char* suffix) { return name.substr(0, name.rfind(suffix)); };
    return spheretree::isDagOf(grid, stem("_dag")) || spheretree::isCutsOf(grid, stem("_cuts"));
}

std::string namesOf(const openvdb::GridPtrVec& grids)
{
    std::string names;
    for (const auto& grid : grids) names += (names.empty() ? "" : ", ") + inQuotes(grid->getName());
    return names;
}

GridBase::Ptr chosenGrid(
    const openvdb::GridPtrVec& grids, const std::string& path, const std::string& name)
{
    openvdb::GridPtrVec suitable;
    for (const auto& grid : grids) {
        if (!name.empty() && grid->getName() != name) continue;
        if (spheretree::isObjectGrid(*grid) && !isOfTree(*grid)) suitable.push_back(grid);
    }
    if (suitable.size() == 1) return suitable.front();
    if (suitable.size() > 1) {
        throw InputError(path + " holds several grids" + (name.empty() ? "" : " of that name")
            + ": choose one of " + namesOf(grids) + " with grid=");
    }
    const bool isTree = std::any_of(grids.begin(), grids.end(),
        [](const auto& grid) { return spheretree::isSphereTree(*grid); });
    throw InputError(path + " holds no grid "
        + (name.empty() ? "" : "named " + inQuotes(name) + " ") + "that bounds an object, but "
        + namesOf(grids) + (isTree ? "; spheretree.load() reads sphere-trees" : ""));
}

void warnIfOpen(const spheretree::TriangleMesh& mesh, Volume& volume,
    openvdb::util::NullInterrupter* interrupter)
{
    const int64_t open = spheretree::openEdges(mesh, interrupter);
    if (open == 0) return;
    volume.warnings.push_back("mesh " + inQuotes(mesh.name) + " is not closed ("
        + std::to_string(open)
        + " open edges): where it is open by more than a voxel it has no inside; gap= closes "
          "holes");
}

void warnOfMissed(const spheretree::TriangleMesh& mesh, const openvdb::BoolGrid& object,
    Volume& volume, openvdb::util::NullInterrupter* interrupter)
{
    const std::string name = "mesh " + inQuotes(mesh.name);
    const auto missed = spheretree::missedSurface(mesh, object, interrupter);
    if (missed.voxels == 0) return;
    volume.warnings.push_back("the object of " + name + " lacks thin parts, by up to "
        + shortNumber(missed.distance)
        + " (world units): coverage=\"cubes\" takes every voxel that the mesh meets");
}

/// @return how many metres a unit of the mesh is; 1 where none is named.
double metresOf(const std::string& units)
{
    if (units.empty()) return 1;
    if (const auto metres = command::metresOfUnit(units)) return *metres;
    std::string known;
    for (const auto& unit : command::unitsOfLength())
        known += (known.empty() ? "" : ", ") + unit.first;
    throw InputError("units=" + inQuotes(units) + " is unknown: it takes one of " + known);
}

Volume volumeOfMesh(const std::string& path, const FileRequest& file, const ObjectRequest& request,
    openvdb::util::NullInterrupter* interrupter)
{
    const spheretree::TriangleMesh mesh = meshOfFile(path, file.units, interrupter);
    const double voxel =
        file.voxel ? *file.voxel : spheretree::voxelSizeForDim(mesh, file.resolution);
    const Coverage coverage = request.settings.coverage;
    Volume volume;
    if (!file.gap) warnIfOpen(mesh, volume, interrupter);
    ObjectRequest rest = request; // of an object that is there
    rest.settings = {};
    if (file.gap || coverage != Coverage::Centers) {
        for (const char* name : {"iso", "threshold", "above", "below", "label"}) {
            if (asksFor(request, name))
                throw InputError(std::string(name) + " is for volumes, not for meshes");
        }
        rest.given.clear();
        spheretree::MeshSolidSettings settings;
        settings.coverage = coverage == Coverage::Whole ? Coverage::Whole : Coverage::Cubes;
        settings.gap = file.gap.value_or(0);
        volume.object = objectOfGrid(
            spheretree::meshToObject(mesh, voxel, settings, interrupter), rest, interrupter);
        if (file.gap) {
            const std::string hollow =
                spheretree::hollowWarning(mesh, *volume.object, *file.gap, interrupter);
            if (!hollow.empty()) volume.warnings.push_back(hollow);
        }
    } else {
        rest.settings.iso = request.settings.iso;
        const auto levelSet = spheretree::meshToLevelSet(mesh, voxel, 3, interrupter);
        levelSet->setName(mesh.name);
        volume.object = objectOfGrid(levelSet, rest, interrupter);
        warnOfMissed(mesh, *volume.object, volume, interrupter);
    }
    return volume;
}

/// @throw InputError for a .raw, which says nothing of its numbers
GridBase::Ptr gridOfArrayFile(const std::string& path, const spheretree::VolumeSettings& settings,
    openvdb::util::NullInterrupter* interrupter)
{
    if (spheretree::volumeExtension(path) == ".raw") {
        throw InputError(path
            + ": a .raw does not say what it holds: numpy.memmap(path, dtype, \"r\", "
              "shape=(z, y, x)), or numpy.fromfile(path, dtype).reshape(z, y, x), is an array of "
              "it, for axes=\"zyx\"");
    }
    return spheretree::readVolumeFile(path, settings, interrupter);
}

/// A file of bools has no room for a value that is outside of all labels: it is read for the refusal of
/// labels that follows.
GridBase::Ptr numbersOfArrayFile(const std::string& path,
    const spheretree::VolumeSettings& settings, const ObjectRequest& request,
    openvdb::util::NullInterrupter* interrupter)
{
    try {
        return gridOfArrayFile(path, settings, interrupter);
    } catch (const openvdb::IoError&) {
        if (!asksFor(request, "label")) throw;
        return gridOfArrayFile(path, {}, interrupter); // what is damaged throws again
    }
}

Volume volumeOfArrayFile(const std::string& path, const FileRequest& file,
    const ObjectRequest& request, openvdb::util::NullInterrupter* interrupter)
{
    const GridBase::Ptr grid = numbersOfArrayFile(path, file.array, request, interrupter);
    Volume volume;
    try {
        volume.object = objectOfGrid(grid, request, interrupter);
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    } catch (const openvdb::ValueError& error) {
        throw InputError(path + ": " + spheretree::detail::messageOf(error));
    }
    const auto notNumbers =
        grid->getMetadata<openvdb::Int64Metadata>(spheretree::detail::kNotNumbersMeta);
    if (notNumbers) {
        volume.warnings.push_back(path + ": " + command::notNumbersText(notNumbers->value()));
    }
    return volume;
}

} // namespace

std::string kindOfFile(const std::string& path)
{
    if (spheretree::volumeExtension(path) == ".npy") return "npy";
    if (spheretree::isVolumeFileName(path)) return "array";
    switch (command::fileKind(path)) {
    case command::FileKind::Vdb: return "vdb";
    case command::FileKind::Vol: return "vol";
    case command::FileKind::Mesh: return "mesh";
    default: return "";
    }
}

std::optional<std::pair<double, double>> valueRangeOfFile(
    const std::string& path, openvdb::util::NullInterrupter* interrupter)
{
    const GridBase::Ptr grid = gridOfArrayFile(path, {}, interrupter);
    std::optional<std::pair<double, double>> range;
    grid->apply<openvdb::NumericGridTypes>([&](const auto& numbers) {
        const auto found = openvdb::tools::minMax(numbers.tree());
        range.emplace(double(found.min()), double(found.max()));
    });
    return range;
}

openvdb::BoolGrid::Ptr objectOfGrid(const GridBase::ConstPtr& grid, const ObjectRequest& request,
    openvdb::util::NullInterrupter* interrupter, int64_t* notNumbers)
{
    requireRelevant(request, *grid);
    auto object = spheretree::objectOf(
        *withCubes(grid, request, interrupter), request.settings, interrupter, notNumbers);
    if (request.largest) object = spheretree::largestPart(*object, interrupter);
    if (request.fill) object = spheretree::filledCavities(*object, interrupter);
    return object;
}

spheretree::TriangleMesh meshOfFile(
    const std::string& path, const std::string& units, openvdb::util::NullInterrupter* interrupter)
{
    const double metres = metresOf(units);
    spheretree::TriangleMesh mesh = spheretree::readMeshFile(path, {}, interrupter);
    if (!units.empty()) command::scaleMesh(mesh, metres);
    return mesh;
}

Volume volumeOfFile(const std::string& path, const FileRequest& file, const ObjectRequest& request,
    openvdb::util::NullInterrupter* interrupter)
{
    const std::string kind = kindOfFile(path);
    Volume volume;
    if (kind == "vdb") {
        int64_t notNumbers = 0;
        volume.object = objectOfGrid(
            chosenGrid(command::readVdb(path), path, file.grid), request, interrupter, &notNumbers);
        if (notNumbers) {
            volume.warnings.push_back(path + ": " + command::notNumbersText(notNumbers));
        }
    } else if (kind == "vol") {
        volume.object =
            objectOfGrid(spheretree::readVolFile(path, interrupter), request, interrupter);
    } else if (kind == "npy" || kind == "array") {
        volume = volumeOfArrayFile(path, file, request, interrupter);
    } else if (kind == "mesh") {
        volume = volumeOfMesh(path, file, request, interrupter);
    } else {
        throw InputError(path
            + ": volumes are read from .vdb, .vol, .longvol, .npy, .nrrd, .nhdr, .nii, .nii.gz, "
              "gray "
              "pictures (.png, .pgm) and mesh files (.obj, .ply, .stl, .off ...); other formats as "
              "arrays");
    }
    volume.box = volume.object->evalActiveVoxelBoundingBox();
    return volume;
}

} // namespace binding
