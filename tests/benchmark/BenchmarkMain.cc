// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkMain.cc
/// @brief The benchmark: every stage of every object, on one thread and on all, as a table and as
/// JSON. docs/benchmark.md says what the columns mean.

#include "BenchmarkCase.h"
#include "BenchmarkJson.h"
#include "BenchmarkOptions.h"
#include "BenchmarkTable.h"

#include <benchmark/benchmark.h>
#include <openvdb/openvdb.h>
#include <tbb/info.h>

#include <deque>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>

namespace {

using namespace spheretree_benchmark;

/// Cases stay where they are: benchmarks refer to them.
using Cases = std::deque<BenchmarkCase>;

/// Prints a line when a case is done, and collects it.
class TableReporter : public benchmark::BenchmarkReporter {
public:
    explicit TableReporter(const Cases& cases)
    {
        for (const BenchmarkCase& one : cases) mResults[one.name()] = &one.result();
    }
    bool ReportContext(const Context&) override
    {
        printHeader(std::cout);
        return true;
    }
    void ReportRuns(const std::vector<Run>& runs) override
    {
        const Measurement& result = *mResults.at(runs.front().run_name.function_name);
        printLine(std::cout, result);
        mDone.push_back(result);
    }
    const std::vector<Measurement>& done() const { return mDone; }

private:
    std::map<std::string, const Measurement*> mResults;
    std::vector<Measurement> mDone;
};

std::vector<BenchmarkObject> objectsOf(const BenchmarkOptions& options)
{
    std::vector<BenchmarkObject> objects;
    for (const std::string& name : options.objects) objects.push_back(objectByName(name));
    if (!objects.empty()) return objects;
    for (const std::string& name : namesOfObjects(options.largest)) {
        try {
            objects.push_back(objectByName(name));
        } catch (const openvdb::Exception& e) {
            std::cerr << "left out: " << e.what() << '\n';
        }
    }
    return objects;
}

/// On one thread, and on all.
std::vector<int> threadCounts()
{
    const int all = tbb::info::default_concurrency();
    return all > 1 ? std::vector<int>{1, all} : std::vector<int>{1};
}

Cases casesOf(const BenchmarkOptions& options)
{
    Cases cases;
    for (const BenchmarkObject& object : objectsOf(options)) {
        for (const BenchmarkStage& stage : benchmarkStages(options.more)) {
            if (stage.applies && !stage.applies(object)) continue;
            for (const int threads : threadCounts()) cases.emplace_back(object, stage, threads);
        }
    }
    return cases;
}

void registerCase(BenchmarkCase& one)
{
    auto* registered = benchmark::RegisterBenchmark(
        one.name().c_str(), [&one](benchmark::State& state) { one.run(state); });
    registered->UseManualTime();
    if (one.stage().once) registered->Iterations(1);
}

void writeJson(const std::string& path, const std::string& text)
{
    std::ofstream file(path);
    if (!(file << text << std::flush)) throw std::runtime_error("cannot write '" + path + "'");
}

void runBenchmarks(const BenchmarkOptions& options)
{
    const BenchmarkMachine machine = thisMachine();
    Cases cases = casesOf(options);
    for (BenchmarkCase& one : cases) registerCase(one);
    TableReporter reporter(cases);
    if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) {
        throw std::runtime_error("the filter leaves no stage of any object");
    }
    const std::vector<Growth> growths = growthOf(reporter.done());
    printGrowth(std::cout, growths);
    if (options.jsonFile.empty()) return;
    writeJson(options.jsonFile, benchmarkJson(machine, reporter.done(), growths));
}

} // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv, [] { std::cout << kBenchmarkUsage; });
    try {
        openvdb::initialize();
        runBenchmarks(parseOptions(argc, argv));
        return 0;
    } catch (const std::invalid_argument& e) {
        std::cerr << "spheretree_benchmark: " << e.what() << '\n' << kBenchmarkUsage;
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "spheretree_benchmark: " << e.what() << '\n';
        return 1;
    }
}
