// SPDX-License-Identifier: Apache-2.0
#include "LevelStages.h"

#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/paper/SphereDag.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/slab/LabelStream.h>

#include <benchmark/benchmark.h>

namespace spheretree_benchmark {

namespace {

namespace st = openvdb_spheretree;

/// The levels of the OR pyramid with their medial balls, and the steps between them.
struct Levels {
    explicit Levels(const openvdb::BoolGrid& grid)
    {
        const st::OrPyramid pyramid = st::buildOrPyramid(grid);
        for (const auto& voxels : pyramid.levels) {
            const openvdb::Coord origin = medial.empty() ? pyramid.origin : openvdb::Coord();
            steps.push_back({origin, 2, 3});
            medial.push_back(std::make_unique<st::MedialLevel>(
                *voxels, 3, st::Distance(), nullptr, nullptr, st::LevelQueries{0, {}, true}));
        }
    }
    std::vector<std::unique_ptr<st::MedialLevel>> medial;
    std::vector<st::PyramidStep> steps;
};

std::function<Work(const InputPtr&)> pyramid(int factor)
{
    return [factor](const InputPtr& in) -> Work {
        return [in, factor] {
            benchmark::DoNotOptimize(st::buildOrPyramid(*in->grid, factor));
            return int64_t(0);
        };
    };
}

/// The edges between all levels.
Work dag(const InputPtr& in)
{
    auto levels = std::make_shared<const Levels>(*in->grid);
    return [levels] {
        const auto& medial = levels->medial;
        for (std::size_t k = 0; k + 1 < medial.size(); ++k) {
            benchmark::DoNotOptimize(st::sphereDag(*medial[k], *medial[k + 1], levels->steps[k]));
        }
        return int64_t(0);
    };
}

/// The balls of all levels, beside which the edges of the DAG stand.
Work ballsOfLevels(const InputPtr& in)
{
    auto levels = std::make_shared<const Levels>(*in->grid);
    return [levels] {
        for (const auto& level : levels->medial) {
            benchmark::DoNotOptimize(st::slab::LabelStream(level->layout, 3).run(nullptr));
        }
        return int64_t(0);
    };
}

} // namespace

std::vector<BenchmarkStage> levelStages(bool more)
{
    std::vector<BenchmarkStage> stages{{"pyramid", pyramid(2), {}}, {"dag", dag, {}}};
    if (!more) return stages;
    stages.push_back({"balls-all-levels", ballsOfLevels, {}});
    for (const int factor : {3, 4, 5, 8}) {
        stages.push_back({"pyramid-factor" + std::to_string(factor), pyramid(factor), {}});
    }
    return stages;
}

} // namespace spheretree_benchmark
