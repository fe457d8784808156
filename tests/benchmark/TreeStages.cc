// SPDX-License-Identifier: Apache-2.0
#include "TreeStages.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include <benchmark/benchmark.h>

namespace spheretree_benchmark {

namespace {

namespace st = openvdb_spheretree;

st::SphereTree buildTree(const BenchmarkInput& in, st::SphereTreeSettings settings)
{
    settings.topology = false;
    return st::buildSphereTree(*in.grid, settings);
}

std::function<Work(const InputPtr&)> paperTree(const st::SphereTreeSettings& settings)
{
    return [settings](const InputPtr& in) -> Work {
        return [in, settings] {
            benchmark::DoNotOptimize(buildTree(*in, settings));
            return int64_t(0);
        };
    };
}

std::function<Work(const InputPtr&)> tightTree(st::Quality quality)
{
    return [quality](const InputPtr& in) -> Work {
        return [in, quality] {
            st::TightOptions options;
            options.quality = quality;
            const st::SphereTree tree = buildTree(*in, options);
            return int64_t(tree.levels.front().size());
        };
    };
}

Work errors(const InputPtr& in)
{
    auto tree = std::make_shared<st::SphereTree>(*extendedTree(*in));
    return [in, tree] {
        st::computeLevelErrors(*tree, *in->grid);
        return int64_t(0);
    };
}

/// Tight trees cost seconds to minutes: of two objects only.
bool isDragon(const BenchmarkObject& object) { return object.name.rfind("dragon", 0) == 0; }

} // namespace

std::shared_ptr<const st::SphereTree> extendedTree(const BenchmarkInput& in)
{
    static std::string objectName;
    static std::shared_ptr<const st::SphereTree> tree;
    if (objectName == in.object.name) return tree;
    tree = nullptr; // before the next one needs memory
    tree = std::make_shared<const st::SphereTree>(buildTree(in, st::ExtendedOptions()));
    objectName = in.object.name;
    return tree;
}

std::vector<BenchmarkStage> treeStages(bool more)
{
    std::vector<BenchmarkStage> stages{{"extended", paperTree(st::ExtendedOptions()), {}},
        {"errors", errors, {}}, {"tight-fast", tightTree(st::Quality::Fast), isDragon, true}};
    if (!more) return stages;
    stages.push_back({"reversible", paperTree(st::ReversibleOptions()), {}});
    stages.push_back({"tight-normal", tightTree(st::Quality::Normal), isDragon, true});
    return stages;
}

} // namespace spheretree_benchmark
