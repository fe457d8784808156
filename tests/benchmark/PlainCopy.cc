// SPDX-License-Identifier: Apache-2.0
#include "PlainCopy.h"

#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace spheretree_benchmark {

namespace {

constexpr int64_t kMostLeaves = 1 << 16;
constexpr std::size_t kLeaf = openvdb_spheretree::kLeafVoxels;

void copyLeaves(const std::vector<int32_t>& from, std::vector<int32_t>& to, int64_t leaves)
{
    tbb::parallel_for(tbb::blocked_range<int64_t>(0, leaves, 256), [&](const auto& range) {
        std::copy(from.begin() + range.begin() * kLeaf, from.begin() + range.end() * kLeaf,
            to.begin() + range.begin() * kLeaf);
    });
    benchmark::DoNotOptimize(to.data());
}

} // namespace

double copySeconds(int64_t leaves)
{
    // Kept from call to call, so that no copy pays for fresh pages.
    static std::vector<int32_t> from, to;
    const int64_t copied = std::min(leaves, kMostLeaves);
    if (from.size() < copied * kLeaf) {
        from.assign(copied * kLeaf, 1);
        to.assign(copied * kLeaf, 2);
    }
    double best = 1e9;
    for (int i = 0; i < 5; ++i) {
        const openvdb_spheretree::detail::Stopwatch watch;
        copyLeaves(from, to, copied);
        best = std::min(best, watch.seconds());
    }
    return best * double(leaves) / double(copied);
}

} // namespace spheretree_benchmark
