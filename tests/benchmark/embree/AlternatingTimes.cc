// SPDX-License-Identifier: Apache-2.0
#include "AlternatingTimes.h"

#include "contenders/ContenderTimes.h"

#include <cstdio>

namespace spheretree_benchmark {

void printTimes(const std::string& title, const std::vector<Contender>& contenders,
    std::size_t questions, int rounds)
{
    std::vector<double> sums(contenders.size());
    std::vector<std::function<void()>> runs;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        runs.emplace_back([&, i] { sums[i] = contenders[i].run(); });
    }
    const std::vector<double> seconds = medianSeconds(runs, rounds);
    std::printf("%s\n", title.c_str());
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        std::printf("    %-44s %9.1f ns  %6.2fx   mean %.6g\n", contenders[i].name.c_str(),
            seconds[i] / double(questions) * 1e9, seconds[i] / seconds[0],
            sums[i] / double(questions));
    }
}

} // namespace spheretree_benchmark
