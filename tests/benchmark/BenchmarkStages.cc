// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkStages.cc
/// @brief Million active voxels a second of each stage, beside a plain parallel copy of the same
/// leaves' int32 values in the same run, so that figures compare across machines.
///
///     spheretree_benchmark                        all stages, all objects, on 1 and all threads
///     spheretree_benchmark --benchmark_filter=dragon-512
///
/// Columns: `Mvoxel/s` of the stage, `copy` the same of the copy, `of_copy` the one over the other.
/// Tight trees, whose time goes by leaf balls and not by voxels, have `leaves` and `us/leaf` too.
/// Objects are made here, plus volumes of the folder SPHERETREE_DATA where there is one.

#include <openvdb_spheretree/LevelErrors.h>
#include <openvdb_spheretree/LevelTopology.h>
#include <openvdb_spheretree/MedialLevel.h>
#include <openvdb_spheretree/ObjectMask.h>
#include <openvdb_spheretree/OrPyramid.h>
#include <openvdb_spheretree/SphereDag.h>
#include <openvdb_spheretree/SphereTree.h>
#include <openvdb_spheretree/SphereTreePoints.h>
#include <openvdb_spheretree/VolFile.h>
#include <openvdb_spheretree/slab/LabelStream.h>

#include <benchmark/benchmark.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace {

namespace st = openvdb_spheretree;
using Clock = std::chrono::steady_clock;

openvdb::BoolGrid::Ptr ballsApart(int distance)
{
    auto grid = openvdb::BoolGrid::create(false);
    auto accessor = grid->getAccessor();
    for (const int x : {0, distance}) {
        for (int i = -40; i <= 40; ++i) {
            for (int j = -40; j <= 40; ++j) {
                for (int k = -40; k <= 40; ++k) {
                    if (i * i + j * j + k * k < 1600) accessor.setValueOn({x + i, j, k});
                }
            }
        }
    }
    return grid;
}

openvdb::BoolGrid::Ptr levelSetBall()
{
    return st::objectMask(
        *openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(100, openvdb::Vec3f(0), 1));
}

/// Objects by name, each made once.
const openvdb::BoolGrid& object(const std::string& name)
{
    static std::map<std::string, openvdb::BoolGrid::Ptr> made;
    openvdb::BoolGrid::Ptr& grid = made[name];
    if (!grid && name == "balls-100-apart") grid = ballsApart(100);
    if (!grid && name == "balls-1000000-apart") grid = ballsApart(1000000);
    if (!grid && name == "level-set-ball") grid = levelSetBall();
    if (!grid) {
        const std::string folder = std::getenv("SPHERETREE_DATA");
        grid = st::objectMask(*st::readVolFile(folder + "/vol/" + name + ".vol"));
    }
    return *grid;
}

/// Seconds of a parallel copy of as many leaves of int32, the best of five.
double copySeconds(uint32_t leaves)
{
    constexpr std::size_t kLeaf = st::kLeafVoxels;
    std::vector<int32_t> from(leaves * kLeaf, 1), to(leaves * kLeaf, 2);
    double best = 1e9;
    for (int i = 0; i < 5; ++i) {
        const auto start = Clock::now();
        tbb::parallel_for(tbb::blocked_range<uint32_t>(0, leaves, 256), [&](const auto& range) {
            std::copy(from.begin() + range.begin() * kLeaf, from.begin() + range.end() * kLeaf,
                to.begin() + range.begin() * kLeaf);
        });
        best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
        benchmark::DoNotOptimize(to.data());
    }
    return best;
}

/// What the stages of one object work on.
struct Input {
    explicit Input(const std::string& name)
        : grid(object(name)), mask(grid.tree(), false, openvdb::TopologyCopy()), layout(mask),
          distances(st::distanceTransform(layout)), labels(st::powerMap(layout, distances))
    {}
    const openvdb::BoolGrid& grid;
    openvdb::MaskTree mask;
    st::LeafLayout layout;
    st::DistanceMap distances;
    st::PowerMap labels;
};

using Stage = std::function<void(const Input&)>;

/// The levels of the OR pyramid with their medial balls, and the steps between them.
struct Levels {
    explicit Levels(const openvdb::BoolGrid& grid)
    {
        const st::OrPyramid pyramid = st::buildOrPyramid(grid);
        for (const auto& voxels : pyramid.levels) {
            const openvdb::Coord origin = medial.empty() ? pyramid.origin : openvdb::Coord();
            steps.push_back({origin, 2, 3});
            medial.push_back(std::make_unique<st::MedialLevel>(
                *voxels, 3, st::Distance(), nullptr, nullptr, st::LevelWants{{}, true}));
        }
    }
    std::vector<std::unique_ptr<st::MedialLevel>> medial;
    std::vector<st::PyramidStep> steps;
};

const Levels& levelsOf(const Input& in)
{
    static std::map<const openvdb::BoolGrid*, Levels> made;
    return made.try_emplace(&in.grid, in.grid).first->second;
}

/// The balls of the levels below @a count, beside which the edges of the DAG stand.
void labelLevels(const Input& in, std::size_t count)
{
    const Levels& levels = levelsOf(in);
    for (std::size_t k = 0; k < std::min(count, levels.medial.size()); ++k) {
        const st::MedialLevel& level = *levels.medial[k];
        benchmark::DoNotOptimize(st::slab::LabelStream(level.layout, 3).run(nullptr));
    }
}

/// The edges from the levels below @a count to those above them.
void linkLevels(const Input& in, std::size_t count)
{
    const Levels& levels = levelsOf(in);
    for (std::size_t k = 0; k < std::min(count, levels.medial.size() - 1); ++k) {
        benchmark::DoNotOptimize(
            st::sphereDag(*levels.medial[k], *levels.medial[k + 1], levels.steps[k]));
    }
}

void buildTree(const Input& in, st::TreeType type)
{
    st::SphereTreeSettings settings;
    settings.tree = type;
    benchmark::DoNotOptimize(st::buildSphereTree(in.grid, settings));
}

/// @return the number of leaf balls.
int32_t buildTightTree(const Input& in, st::Quality quality)
{
    st::SphereTreeSettings settings;
    settings.tree = st::TreeType::Tight;
    settings.quality = quality;
    settings.topology = false;
    return st::buildSphereTree(in.grid, settings).levels.front().size();
}

void buildPyramid(const Input& in, int factor)
{
    benchmark::DoNotOptimize(st::buildOrPyramid(in.grid, factor));
}

const std::vector<std::pair<std::string, Stage>>& stages()
{
    static const std::vector<std::pair<std::string, Stage>> all{
        {"layout", [](const Input& in) { benchmark::DoNotOptimize(st::LeafLayout(in.mask)); }},
        {"distance",
            [](const Input& in) { benchmark::DoNotOptimize(st::distanceTransform(in.layout)); }},
        {"distance+power+medial",
            [](const Input& in) {
                benchmark::DoNotOptimize(st::slab::LabelStream(in.layout, 3).run(nullptr));
            }},
        {"labels-kept",
            [](const Input& in) {
                benchmark::DoNotOptimize(st::powerMap(in.layout, in.distances));
            }},
        {"medial",
            [](const Input& in) {
                benchmark::DoNotOptimize(st::medialBalls(in.labels, in.distances));
            }},
        {"topology",
            [](const Input& in) { benchmark::DoNotOptimize(st::levelTopology(in.layout)); }},
        {"balls-level-0", [](const Input& in) { labelLevels(in, 1); }},
        {"dag-level-0", [](const Input& in) { linkLevels(in, 1); }},
        {"balls-all-levels", [](const Input& in) { labelLevels(in, 99); }},
        {"dag-all-levels", [](const Input& in) { linkLevels(in, 99); }},
        {"pyramid", [](const Input& in) { buildPyramid(in, 2); }},
        {"pyramid-factor3", [](const Input& in) { buildPyramid(in, 3); }},
        {"pyramid-factor4", [](const Input& in) { buildPyramid(in, 4); }},
        {"pyramid-factor5", [](const Input& in) { buildPyramid(in, 5); }},
        {"pyramid-factor8", [](const Input& in) { buildPyramid(in, 8); }},
        {"reversible", [](const Input& in) { buildTree(in, st::TreeType::Reversible); }},
        {"extended", [](const Input& in) { buildTree(in, st::TreeType::Extended); }},
        {"errors",
            [](const Input& in) {
                static std::map<const openvdb::BoolGrid*, st::SphereTree> trees;
                auto tree = trees.find(&in.grid);
                if (tree == trees.end()) {
                    st::SphereTreeSettings settings;
                    settings.tree = st::TreeType::Extended;
                    tree = trees.emplace(&in.grid, st::buildSphereTree(in.grid, settings)).first;
                }
                st::computeLevelErrors(tree->second, in.grid);
            }},
    };
    return all;
}

/// @return the best of all times.
double bestSeconds(benchmark::State& state, const Input& input, const Stage& stage)
{
    double best = 1e9;
    for (auto _ : state) {
        const auto start = Clock::now();
        stage(input);
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        best = std::min(best, seconds);
        state.SetIterationTime(seconds);
    }
    return best;
}

void countVoxels(benchmark::State& state, const Input& input, double seconds, double copy)
{
    const double voxels = 1e-6 * double(input.layout.voxelCount());
    state.counters["Mvoxel/s"] = voxels / seconds;
    state.counters["copy"] = voxels / copy;
    state.counters["of_copy"] = copy / seconds;
}

void run(benchmark::State& state, const std::string& name, const Stage& stage, int threads)
{
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Input input(name);
    const double copy = copySeconds(input.layout.leafCount());
    stage(input); // what a stage makes once for all of its calls
    countVoxels(state, input, bestSeconds(state, input, stage), copy);
}

void runTight(benchmark::State& state, const std::string& name, st::Quality quality, int threads)
{
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Input input(name);
    const double copy = copySeconds(input.layout.leafCount());
    int32_t leaves = 0;
    const double seconds =
        bestSeconds(state, input, [&](const Input& in) { leaves = buildTightTree(in, quality); });
    countVoxels(state, input, seconds, copy);
    state.counters["leaves"] = double(leaves);
    state.counters["us/leaf"] = 1e6 * seconds / double(leaves);
}

/// On one thread, and on all.
std::vector<int> threadCounts()
{
    std::vector<int> threads{1};
    if (tbb::info::default_concurrency() > 1) threads.push_back(tbb::info::default_concurrency());
    return threads;
}

void registerTight(const std::string& name)
{
    for (const st::Quality quality : {st::Quality::Fast, st::Quality::Normal}) {
        for (const int n : threadCounts()) {
            const std::string title =
                name + "/tight-" + toString(quality) + "/threads:" + std::to_string(n);
            benchmark::RegisterBenchmark(title.c_str(),
                [name, quality, n](benchmark::State& state) { runTight(state, name, quality, n); })
                ->UseManualTime()
                ->Iterations(1) // seconds to minutes each
                ->Unit(benchmark::kMillisecond);
        }
    }
}

void registerAll(const std::string& name)
{
    for (const auto& [label, stage] : stages()) {
        for (const int n : threadCounts()) {
            const std::string title = name + "/" + label + "/threads:" + std::to_string(n);
            benchmark::RegisterBenchmark(title.c_str(),
                [name, stage = stage, n](benchmark::State& state) { run(state, name, stage, n); })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
        }
    }
}

} // namespace

int main(int argc, char** argv)
{
    openvdb::initialize();
    for (const char* name : {"level-set-ball", "balls-100-apart", "balls-1000000-apart"}) {
        registerAll(name);
    }
    const char* folder = std::getenv("SPHERETREE_DATA");
    for (const char* name : {"Al.100", "dragon-128", "dragon-512", "fandisk-128", "fandisk-512",
             "hairball-256", "lucy-boundary-512"}) {
        if (!folder) continue;
        const std::string file = std::string(folder) + "/vol/" + name + ".vol";
        if (!std::filesystem::exists(file)) continue;
        registerAll(name);
        if (std::string(name).rfind("dragon", 0) == 0) registerTight(name);
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
