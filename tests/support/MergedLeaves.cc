// SPDX-License-Identifier: Apache-2.0
#include "MergedLeaves.h"

#include <openvdb_spheretree/tight/merge/SlackMerging.h>

#include <algorithm>
#include <set>

namespace spheretree_test {

MergedLeaves::MergedLeaves(const Voxels& some, bool flat, const FitEffort& effort)
    : voxels(some), object(sampled(voxels)), maker{{effort}, object, flat, nullptr}
{
    using namespace openvdb_spheretree::tight;
    leaves = fineBalls(CoreStages(*maskOf(voxels)).balls);
    SlackMerging model(object, ungrouped(leaves), regionsOf(leaves, object.level(0), nullptr),
        effort, flat, nullptr, true);
    forest = mergeToRoots(model, 6, nullptr);
}

std::vector<TightLevel> MergedLeaves::levels(const std::vector<int64_t>& counts) const
{
    return levelsOf(
        forest, counts, std::vector<openvdb_spheretree::MedialBall>(leaves.size(), {Coord(), 1}));
}

std::vector<VoxelRegion> MergedLeaves::regions(const std::vector<ExactSphere>& balls) const
{
    return regionsOf(balls, object.level(0), nullptr);
}

std::vector<ExactSphere> thereOf(const std::vector<openvdb_spheretree::tight::CoverBall>& cover)
{
    std::vector<ExactSphere> balls;
    for (const auto& ball : cover) {
        if (!ball.empty()) balls.push_back(ball.ball);
    }
    return balls;
}

std::vector<int64_t> expectChains(const std::vector<TightLevel>& levels, const Voxels& voxels)
{
    std::vector<int64_t> around;
    std::vector<Voxels> chains; // of each ball of the level above
    for (std::size_t k = levels.size(); k-- > 0;) {
        const TightLevel& level = levels[k];
        EXPECT_EQ(level.parent.empty(), k + 1 == levels.size());
        std::vector<Voxels> held;
        for (std::size_t i = 0; i < level.balls.size(); ++i) {
            EXPECT_FALSE(level.balls[i].empty());
            const Voxels& above =
                level.parent.empty() ? voxels : chains.at(std::size_t(level.parent.at(i)));
            held.push_back(heldBy({level.balls[i]}, above));
        }
        EXPECT_EQ(together(held), voxels) << "level " << k;
        if (k > 0) {
            const std::set<int32_t> parents(
                levels[k - 1].parent.begin(), levels[k - 1].parent.end());
            EXPECT_EQ(parents.size(), level.balls.size()) << "each has a child, level " << k;
        }
        chains = held;
        around.insert(around.begin(), excess(level.balls, voxels));
    }
    return around;
}

Voxels heldBy(const std::vector<ExactSphere>& balls, const Voxels& voxels)
{
    Voxels held;
    for (const Coord& v : voxels) {
        const bool any = std::any_of(
            balls.begin(), balls.end(), [&](const ExactSphere& ball) { return holds(ball, v); });
        if (any) held.push_back(v);
    }
    return held;
}

Voxels together(const std::vector<Voxels>& parts)
{
    Voxels all;
    for (const Voxels& some : parts) all.insert(all.end(), some.begin(), some.end());
    sortVoxels(all);
    return all;
}

std::vector<Voxels> voxelsOf(const std::vector<VoxelRegion>& regions, const SampleLevel& object)
{
    std::vector<Voxels> all;
    for (const VoxelRegion& region : regions) {
        Voxels voxels;
        for (const auto& part : region) {
            const Voxels some = voxelsOf(part.mask, object.origin(part.leaf));
            voxels.insert(voxels.end(), some.begin(), some.end());
        }
        sortVoxels(voxels);
        all.push_back(voxels);
    }
    return all;
}

std::vector<Voxels> heldBelow(const std::vector<ExactSphere>& balls,
    const std::vector<int32_t>& parents, const std::vector<Voxels>& regions)
{
    std::vector<Voxels> held(balls.size());
    for (std::size_t c = 0; c < regions.size(); ++c) {
        const int32_t parent = parents.at(c);
        for (const Coord& v : regions[c]) {
            if (holds(balls.at(parent), v)) held[parent].push_back(v);
        }
    }
    for (Voxels& voxels : held) sortVoxels(voxels);
    return held;
}

} // namespace spheretree_test
