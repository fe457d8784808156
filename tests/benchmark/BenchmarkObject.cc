// SPDX-License-Identifier: Apache-2.0
#include "BenchmarkObject.h"

#include <openvdb_spheretree/input/shapes/GeneratedObject.h>
#include <openvdb_spheretree/input/vol/VolFile.h>

#include <openvdb/io/File.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace spheretree_benchmark {

namespace {

namespace st = openvdb_spheretree;

void fillBall(openvdb::BoolGrid& grid, const openvdb::Coord& center)
{
    auto accessor = grid.getAccessor();
    const openvdb::CoordBBox box(openvdb::Coord(-40), openvdb::Coord(40));
    for (auto q = box.begin(); q; ++q) {
        if ((*q).asVec3i().lengthSqr() < 1600) accessor.setValueOn(center + *q);
    }
}

openvdb::GridBase::Ptr ballsApart()
{
    auto grid = openvdb::BoolGrid::create(false);
    for (const int x : {0, 1000000}) fillBall(*grid, {x, 0, 0});
    return grid;
}

openvdb::GridBase::Ptr levelSetBall()
{
    return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(100, openvdb::Vec3f(0), 1);
}

/// @return the shape and size that a name such as `gyroid-1e6` stands for, if it is one.
std::optional<st::GeneratedObjectSettings> settingsByName(const std::string& name)
{
    const std::size_t dash = name.rfind('-');
    if (dash == std::string::npos) return std::nullopt;
    st::GeneratedObjectSettings settings;
    char* end = nullptr;
    settings.voxels = int64_t(std::strtod(name.c_str() + dash + 1, &end));
    if (*end || end == name.c_str() + dash + 1) return std::nullopt;
    try {
        settings.shape = st::shapeFromString(name.substr(0, dash));
    } catch (const openvdb::ValueError&) {
        return std::nullopt; // dragon-512
    }
    settings.validate();
    return settings;
}

BenchmarkObject objectByRule(const std::string& name, const st::GeneratedObjectSettings& settings)
{
    return {name, toString(settings.shape), "", [=] { return st::generateObject(settings); }};
}

std::filesystem::path dataFolder()
{
    const char* folder = std::getenv("SPHERETREE_DATA");
    return folder ? folder : ".";
}

BenchmarkObject objectInFile(const std::string& name)
{
    const std::filesystem::path vol = dataFolder() / "vol" / (name + ".vol");
    if (exists(vol)) return {name, "", vol, [=] { return st::readVolFile(vol); }};
    const std::filesystem::path vdb = dataFolder() / "vdb" / (name + ".vdb");
    if (exists(vdb)) return {name, "", vdb, [=] { return readVdbFile(vdb); }};
    OPENVDB_THROW(openvdb::ValueError,
        "no object '" << name << "': neither " << vol << " nor " << vdb << " is there");
}

} // namespace

bool BenchmarkObject::isVolume() const { return st::isVolFileName(path); }

std::vector<std::string> namesOfObjects(bool largest)
{
    std::vector<std::string> names{"level-set-ball", "balls-1e6-apart", "dragon-128", "dragon-512",
        "fandisk-512", "hairball-256", "lucy-boundary-512", "geb079", "gyroid-1e5", "gyroid-1e6",
        "gyroid-1e7", "gyroid-1e8", "menger-1e5", "menger-1e6", "menger-1e7", "menger-1e8",
        "terrain-1e5", "terrain-1e6", "terrain-1e7", "terrain-1e8", "noise-1e5", "noise-1e6"};
    if (largest) names.insert(names.end(), {"noise-1e7", "gyroid-1e9"});
    return names;
}

BenchmarkObject objectByName(const std::string& name)
{
    if (name == "level-set-ball") return {name, "", "", levelSetBall};
    if (name == "balls-1e6-apart") return {name, "", "", ballsApart};
    if (const auto settings = settingsByName(name)) return objectByRule(name, *settings);
    return objectInFile(name);
}

openvdb::GridBase::Ptr readVdbFile(const std::string& path)
{
    openvdb::io::File file(path);
    file.open(/*delayLoad=*/false);
    const openvdb::GridPtrVecPtr grids = file.getGrids();
    if (grids->size() != 1) {
        OPENVDB_THROW(openvdb::IoError, path << " holds " << grids->size() << " grids, not one");
    }
    return grids->front();
}

} // namespace spheretree_benchmark
