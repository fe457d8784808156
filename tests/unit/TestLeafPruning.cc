// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/LeafPruning.h>

#include "../support/FineBalls.h"

#include <openvdb_spheretree/MedialLevel.h>

#include <map>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// By definition: smallest first, a ball goes if each of its voxels is in another one.
std::vector<int32_t> naivelyPruned(const std::vector<MedialBall>& balls, const Voxels& voxels)
{
    std::map<Coord, int> counts;
    std::vector<Voxels> held(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (const Coord& v : voxels) {
            if (holds(fineBall(balls[i]), v)) held[i].push_back(v);
        }
        for (const Coord& v : held[i]) ++counts[v];
    }
    std::vector<int32_t> order(balls.size()), kept;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](int32_t a, int32_t b) { return balls[a].radiusSq < balls[b].radiusSq; });
    for (const int32_t i : order) {
        const bool alone = std::any_of(
            held[i].begin(), held[i].end(), [&](const Coord& v) { return counts[v] == 1; });
        if (alone) kept.push_back(i);
        for (const Coord& v : held[i]) counts[v] -= alone ? 0 : 1;
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

TEST(LeafPruning, DropsWhatOthersHoldSmallestFirst)
{
    std::size_t dropped = 0;
    for (uint32_t seed = 0; seed < 66; ++seed) {
        const RandomObject random = randomObject(seed);
        const MedialLevel level(*maskOf(random.voxels), 3, Distance(), nullptr);
        const SampledObject object(level.layout);
        const auto kept = prunedLeaves(level.balls, object.level(0), nullptr);
        ASSERT_EQ(kept, naivelyPruned(level.balls, random.voxels)) << random.name;
        dropped += level.balls.size() - kept.size();
    }
    EXPECT_GT(dropped, 100u);
}

TEST(LeafPruning, OfNothingIsNothing)
{
    EXPECT_TRUE(prunedLeaves({}, sampled({}).level(0), nullptr).empty());
}

} // namespace
