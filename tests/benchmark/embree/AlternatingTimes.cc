// SPDX-License-Identifier: Apache-2.0
#include "AlternatingTimes.h"

#include <time.h>

#include <algorithm>
#include <cstdio>

namespace spheretree_benchmark {
namespace {

double processorSeconds()
{
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

void printTimes(const std::string& title, const std::vector<Contender>& contenders,
    std::size_t questions, int rounds)
{
    std::vector<std::vector<double>> seconds(contenders.size());
    std::vector<double> sums(contenders.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            const double begin = processorSeconds();
            sums[i] = contenders[i].run();
            seconds[i].push_back(processorSeconds() - begin);
        }
    }
    std::printf("%s\n", title.c_str());
    const double first = median(seconds[0]);
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        const double own = median(seconds[i]);
        std::printf("    %-44s %9.1f ns  %6.2fx   mean %.6g\n", contenders[i].name.c_str(),
            own / double(questions) * 1e9, own / first, sums[i] / double(questions));
    }
}

} // namespace spheretree_benchmark
