// SPDX-License-Identifier: Apache-2.0
#include "BenchmarkStages.h"
#include "FileStages.h"
#include "LevelStages.h"
#include "TransformStages.h"
#include "TreeStages.h"

#include <iterator>

namespace spheretree_benchmark {

namespace {

void append(std::vector<BenchmarkStage>& stages, std::vector<BenchmarkStage> others)
{
    std::move(others.begin(), others.end(), std::back_inserter(stages));
}

} // namespace

std::vector<BenchmarkStage> benchmarkStages(bool more)
{
    std::vector<BenchmarkStage> stages = readingStages();
    append(stages, transformStages());
    append(stages, levelStages(more));
    append(stages, treeStages(more));
    append(stages, writingStages());
    return stages;
}

} // namespace spheretree_benchmark
