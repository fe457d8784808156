// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkCase.h
/// @brief Measures one stage of one object on one number of threads, as a benchmark of Google
/// Benchmark, which chooses the cases and how often each one runs.
///
/// Time is that of the best run; there are two at least, if they take less than 30 seconds. The
/// plain copy is made right before the runs and right after them, on as many threads, and the best
/// one counts as well: whatever else the machine does then slows both. Memory is that of the first
/// run. What a stage works on is made before, on all threads, and kept until the next stage has its
/// turn.

#pragma once

#include "BenchmarkStages.h"
#include "Measurement.h"

#include <benchmark/benchmark.h>

#include <string>

namespace spheretree_benchmark {

class BenchmarkCase {
public:
    BenchmarkCase(const BenchmarkObject& object, const BenchmarkStage& stage, int threads);

    /// @return `object/stage/threads:N`: what filters match.
    std::string name() const;
    const BenchmarkStage& stage() const { return mStage; }
    const Measurement& result() const { return mResult; }

    /// One call of many: the best of all of them stays in result(). What goes wrong is told there.
    void run(benchmark::State& state);

private:
    void measure(benchmark::State& state);
    double runOnce(const Work& work);
    void copy();

    BenchmarkObject mObject;
    BenchmarkStage mStage;
    Measurement mResult;
};

} // namespace spheretree_benchmark
