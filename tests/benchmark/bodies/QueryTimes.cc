// SPDX-License-Identifier: Apache-2.0
#include "QueryTimes.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>

#include <time.h>

namespace spheretree_benchmark {
namespace {

double threadSeconds()
{
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Questions that take less than the clock can tell are asked again and again.
double secondsOfRound(const Contender& contender, int questions)
{
    constexpr double kLeast = 2e-3;
    const double begin = threadSeconds();
    double seconds = 0;
    int times = 0;
    while (seconds < kLeast) {
        for (int i = 0; i < questions; i += contender.every) contender.ask(i);
        ++times;
        seconds = threadSeconds() - begin;
    }
    const int asked = (questions + contender.every - 1) / contender.every;
    return seconds / (double(times) * asked);
}

} // namespace

std::vector<double> timesOf(const std::vector<Contender>& contenders, int questions, int rounds)
{
    std::vector<std::vector<double>> seconds(contenders.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            seconds[i].push_back(secondsOfRound(contenders[i], questions));
        }
    }
    std::vector<double> medians;
    for (auto& of : seconds) {
        std::nth_element(of.begin(), of.begin() + rounds / 2, of.end());
        medians.push_back(1e6 * of[std::size_t(rounds / 2)]);
    }
    return medians;
}

void printTimes(const std::string& name, const std::vector<Contender>& contenders,
    const std::vector<double>& times)
{
    std::printf("%-28s %s %9.3f us", name.c_str(), contenders[0].name.c_str(), times[0]);
    for (std::size_t i = 1; i < times.size(); ++i) {
        std::printf("   %s %.2fx", contenders[i].name.c_str(), times[i] / times[0]);
    }
    std::printf("\n");
    std::fflush(stdout);
}

} // namespace spheretree_benchmark
