// SPDX-License-Identifier: Apache-2.0
#include "BenchmarkCase.h"
#include "PeakMemory.h"
#include "PlainCopy.h"
#include <openvdb_spheretree/base/Stage.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <exception>

namespace spheretree_benchmark {

namespace {

/// The first run pays for fresh pages, which can be most of its time. Of what takes longer than this
/// there is no second one.
constexpr double kSecondsOfASecondRun = 30;

/// What the case before worked on: the next one mostly needs the same.
struct Prepared {
    std::string objectName, stageName;
    InputPtr input;
    Work work;
};

const Prepared& prepared(const BenchmarkObject& object, const BenchmarkStage& stage)
{
    static Prepared last;
    if (last.objectName != object.name) {
        last = {}; // before the next one needs memory
        last.input = std::make_shared<const BenchmarkInput>(object);
        last.objectName = object.name;
    }
    if (last.stageName != stage.name) {
        last.stageName.clear();
        last.work = nullptr;
        last.work = stage.prepare(last.input);
        last.stageName = stage.name;
    }
    return last;
}

} // namespace

BenchmarkCase::BenchmarkCase(
    const BenchmarkObject& object, const BenchmarkStage& stage, int threads)
    : mObject(object), mStage(stage)
{
    mResult.object = object.name;
    mResult.family = object.family;
    mResult.stage = stage.name;
    mResult.threads = threads;
}

std::string BenchmarkCase::name() const
{
    return mObject.name + "/" + mStage.name + "/threads:" + std::to_string(mResult.threads);
}

void BenchmarkCase::run(benchmark::State& state)
{
    try {
        measure(state);
    } catch (const std::exception& e) {
        mResult.failure = e.what();
        state.SkipWithError(e.what());
    }
}

void BenchmarkCase::measure(benchmark::State& state)
{
    const Prepared& ready = prepared(mObject, mStage);
    mResult.voxels = ready.input->layout.voxelCount();
    mResult.leaves = ready.input->layout.leafCount();

    const tbb::global_control control(
        tbb::global_control::max_allowed_parallelism, std::size_t(mResult.threads));
    copy();
    for (auto _ : state) state.SetIterationTime(runOnce(ready.work));
    if (mResult.runs == 1 && mResult.seconds < kSecondsOfASecondRun) runOnce(ready.work);
    copy();
}

double BenchmarkCase::runOnce(const Work& work)
{
    std::optional<PeakMemory> peak;
    if (mResult.runs == 0) peak.emplace();
    const openvdb_spheretree::detail::Stopwatch watch;
    mResult.balls = work();
    const double seconds = watch.seconds();
    if (peak) mResult.peakBytes = peak->bytes();
    ++mResult.runs;
    mResult.seconds = std::min(mResult.seconds, seconds);
    return seconds;
}

void BenchmarkCase::copy()
{
    mResult.copySeconds = std::min(mResult.copySeconds, copySeconds(mResult.leaves));
}

} // namespace spheretree_benchmark
