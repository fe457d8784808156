// SPDX-License-Identifier: Apache-2.0
#include "QueryTimes.h"

#include "contenders/ContenderTimes.h"

#include <cstddef>
#include <cstdio>

namespace spheretree_benchmark {

std::vector<double> timesOf(const std::vector<Contender>& contenders, int questions, int rounds)
{
    std::vector<std::function<void()>> runs;
    for (const Contender& contender : contenders) {
        runs.emplace_back([&contender, questions] {
            for (int i = 0; i < questions; i += contender.every) contender.ask(i);
        });
    }
    std::vector<double> times = medianSeconds(runs, rounds);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const int asked = (questions + contenders[i].every - 1) / contenders[i].every;
        times[i] *= 1e6 / asked;
    }
    return times;
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
