// SPDX-License-Identifier: Apache-2.0
#include "Growth.h"

#include <algorithm>
#include <cmath>

namespace spheretree_benchmark {

namespace {

using Sizes = std::vector<const Measurement*>; // of one family, stage and number of threads

bool belongTogether(const Measurement& a, const Measurement& b)
{
    return a.family == b.family && a.stage == b.stage && a.threads == b.threads;
}

std::vector<Sizes> groups(const std::vector<Measurement>& measurements)
{
    std::vector<Sizes> found;
    for (const Measurement& m : measurements) {
        if (m.family.empty() || !m.measured()) continue;
        const auto group = std::find_if(found.begin(), found.end(),
            [&](const Sizes& sizes) { return belongTogether(*sizes.front(), m); });
        if (group == found.end()) {
            found.push_back({&m});
        } else {
            group->push_back(&m);
        }
    }
    return found;
}

/// The slope of the line through (log voxels, log seconds).
double exponentOf(const Sizes& sizes)
{
    double meanX = 0, meanY = 0;
    for (const Measurement* m : sizes) {
        meanX += std::log(double(m->voxels)) / double(sizes.size());
        meanY += std::log(m->seconds) / double(sizes.size());
    }
    double xy = 0, xx = 0;
    for (const Measurement* m : sizes) {
        const double x = std::log(double(m->voxels)) - meanX;
        xy += x * (std::log(m->seconds) - meanY);
        xx += x * x;
    }
    return xy / xx;
}

bool fewerVoxels(const Measurement* a, const Measurement* b) { return a->voxels < b->voxels; }

} // namespace

std::vector<Growth> growthOf(const std::vector<Measurement>& measurements)
{
    std::vector<Growth> growths;
    for (const Sizes& sizes : groups(measurements)) {
        const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end(), fewerVoxels);
        if ((*least)->voxels == (*most)->voxels) continue;
        const Measurement& first = *sizes.front();
        growths.push_back({first.family, first.stage, first.threads, exponentOf(sizes),
            int(sizes.size()), (*least)->voxels, (*most)->voxels});
    }
    return growths;
}

} // namespace spheretree_benchmark
