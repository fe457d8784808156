// SPDX-License-Identifier: Apache-2.0
#include "ContenderTimes.h"

#include <algorithm>
#include <cstddef>

#include <time.h>

namespace spheretree_benchmark {
namespace {

double threadSeconds()
{
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double secondsOf(const std::function<void()>& run)
{
    constexpr double kLeast = 2e-3;
    const double begin = threadSeconds();
    double seconds = 0;
    int times = 0;
    for (; seconds < kLeast; ++times) {
        run();
        seconds = threadSeconds() - begin;
    }
    return seconds / times;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

std::vector<double> medianSeconds(const std::vector<std::function<void()>>& runs, int rounds)
{
    std::vector<std::vector<double>> seconds(runs.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < runs.size(); ++i) seconds[i].push_back(secondsOf(runs[i]));
    }
    std::vector<double> medians;
    for (const auto& of : seconds) medians.push_back(median(of));
    return medians;
}

} // namespace spheretree_benchmark
