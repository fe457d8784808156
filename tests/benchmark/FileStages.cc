// SPDX-License-Identifier: Apache-2.0
#include "FileStages.h"
#include "TemporaryFile.h"
#include "TreeStages.h"

#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <openvdb/io/File.h>

#include <benchmark/benchmark.h>

namespace spheretree_benchmark {

namespace {

namespace st = openvdb_spheretree;

void writeVdbFile(const openvdb::GridBase::ConstPtr& grid, const std::string& path)
{
    openvdb::io::File(path).write(openvdb::GridCPtrVec{grid});
}

Work readVol(const InputPtr& in)
{
    return [in] {
        benchmark::DoNotOptimize(in->object.makeGrid()); // which reads the file
        return int64_t(0);
    };
}

Work readVdb(const InputPtr& in)
{
    auto file = std::make_shared<const TemporaryFile>(".vdb");
    std::string path = in->object.path;
    if (path.empty() || in->object.isVolume()) {
        path = file->path();
        writeVdbFile(in->grid, path);
    }
    return [file, path] {
        benchmark::DoNotOptimize(readVdbFile(path));
        return int64_t(0);
    };
}

Work makePoints(const InputPtr& in)
{
    const auto tree = extendedTree(*in);
    return [tree] {
        benchmark::DoNotOptimize(st::toPoints(*tree));
        return int64_t(0);
    };
}

Work writePoints(const InputPtr& in)
{
    auto file = std::make_shared<const TemporaryFile>(".vdb");
    const auto points = st::toPoints(*extendedTree(*in));
    return [file, points] {
        writeVdbFile(points, file->path());
        return int64_t(0);
    };
}

Work readPoints(const InputPtr& in)
{
    auto file = std::make_shared<const TemporaryFile>(".vdb");
    writeVdbFile(st::toPoints(*extendedTree(*in)), file->path());
    return [file] {
        const openvdb::GridBase::Ptr grid = readVdbFile(file->path());
        const auto points = openvdb::gridPtrCast<openvdb::points::PointDataGrid>(grid);
        benchmark::DoNotOptimize(st::fromPoints(*points));
        return int64_t(0);
    };
}

/// Of the stage before: all but the file, its checksum included.
Work takePoints(const InputPtr& in)
{
    const auto points = st::toPoints(*extendedTree(*in));
    return [points] {
        benchmark::DoNotOptimize(st::fromPoints(*points));
        return int64_t(0);
    };
}

} // namespace

std::vector<BenchmarkStage> readingStages()
{
    const auto isVolume = [](const BenchmarkObject& object) { return object.isVolume(); };
    return {{"read-vol", readVol, isVolume}, {"read-vdb", readVdb, {}}};
}

std::vector<BenchmarkStage> writingStages()
{
    return {{"points", makePoints, {}}, {"write-points", writePoints, {}},
        {"read-points", readPoints, {}}, {"take-points", takePoints, {}}};
}

} // namespace spheretree_benchmark
