// SPDX-License-Identifier: Apache-2.0
#include "FollowedLevels.h"

#include "LevelRegions.h"
#include "PlacedLevels.h"
#include <openvdb_spheretree/base/AtomicExtremes.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tree/SphereTracks.h>
#include <openvdb_spheretree/tree/StoredRadii.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Adds a vector of voxels to all centers.
void move(std::vector<TightLevel>& levels, const int64_t (&voxels)[3])
{
    for (TightLevel& level : levels) {
        for (ExactSphere& ball : level.balls) {
            for (int a = 0; a < 3; ++a) ball.center[a] += kFine * voxels[a];
        }
    }
}

/// @return whether all balls are where @a box is, and not much larger.
bool areNear(const std::vector<TightLevel>& levels, const openvdb::CoordBBox& box)
{
    const double reach = double(kFine) * double(detail::longestSideOf(box));
    const auto isNear = [&](const ExactSphere& ball) {
        constexpr double kLargest = 4;
        if (ball.empty() || ball.radius() > kLargest * reach) return false;
        for (int a = 0; a < 3; ++a) {
            const double center = double(ball.center[a]);
            if (center < double(kFine) * box.min()[a] - reach) return false;
            if (center > double(kFine) * box.max()[a] + reach) return false;
        }
        return true;
    };
    return std::all_of(levels.begin(), levels.end(), [&](const TightLevel& level) {
        return std::all_of(level.balls.begin(), level.balls.end(), isNear);
    });
}

bool areOfOneKind(const SphereTree& last, const SphereTree& tree)
{
    constexpr double kRounding = 1e-9;
    const auto isTight = [](const SphereTree& some) {
        return some.settings.find<TightOptions>() && some.subdivision == kFine;
    };
    return isTight(last) && last.settings.dim == tree.settings.dim && last.flatAxis == tree.flatAxis
        && std::abs(last.voxelSize() - tree.voxelSize()) <= kRounding * tree.voxelSize();
}

/// @return the levels of @a last where the object of @a tree is; none if they are not like those of
/// the counts.
std::vector<TightLevel> movedLevels(const SphereTree& last, const SphereTree& tree,
    const std::vector<int64_t>& counts, const FlatAxis& flat)
{
    if (!areOfOneKind(last, tree) || last.levels.size() != counts.size()) return {};
    for (std::size_t k = 0; k < counts.size(); ++k) {
        if (last.levels[k].size() > counts[k]) return {};
    }
    std::vector<TightLevel> levels = levelsOf(last);
    const openvdb::CoordBBox before = flat.toZ(last.object.bbox), now = flat.toZ(tree.object.bbox);
    if (detail::sidesOf(before) == detail::sidesOf(now)) {
        int64_t way[3];
        for (int a = 0; a < 3; ++a) way[a] = int64_t(now.min()[a]) - before.min()[a];
        move(levels, way);
    } else if (tree.settings.dim == 2 && before.min()[2] != now.min()[2]) {
        return {}; // other planes
    }
    return areNear(levels, now) ? levels : std::vector<TightLevel>();
}

struct Chains {
    SampleLevel bare; ///< voxels that have none, as an object of their own
    bool areAllUsed;  ///< each ball of the finest level holds voxels that have one
};

Chains chainsOf(const std::vector<TightLevel>& levels, const LevelMaker& maker)
{
    const SampleLevel& object = maker.object.level(0);
    std::vector<VoxelRegion> chains;
    for (std::size_t k = levels.size(); k-- > 0;) chains = chainRegions(levels[k], chains, maker);
    std::vector<LeafMask> left;
    for (std::size_t leaf = 0; leaf < object.leafCount(); ++leaf) left.push_back(object.mask(leaf));
    bool areAllUsed = true;
    for (const VoxelRegion& chain : chains) {
        areAllUsed = areAllUsed && !chain.empty();
        for (const RegionLeaf part : chain) left[part.leaf] -= part.mask;
    }
    std::vector<openvdb::Coord> origins;
    std::vector<LeafMask> masks;
    for (std::size_t leaf = 0; leaf < left.size(); ++leaf) {
        if (left[leaf].none()) continue;
        origins.push_back(object.origin(leaf));
        masks.push_back(left[leaf]);
    }
    return {{std::move(origins), std::move(masks)}, areAllUsed};
}

/// @param bare  voxels without a chain
/// @return the levels with balls grown until those have one: each goes to the ball that has to grow
/// the least.
std::vector<TightLevel> grownOver(
    const SampleLevel& bare, std::vector<TightLevel> levels, const LevelMaker& maker)
{
    constexpr int32_t kNone = -1;
    const BallGrid grid(levels.front().balls);
    std::vector<std::vector<std::atomic<int64_t>>> radiiSq; // of each level
    for (const TightLevel& level : levels) radiiSq.emplace_back(level.balls.size()); // 0
    detail::parallelFor(bare.leafCount(), maker.interrupter, [&](std::size_t leaf) {
        bare.mask(leaf).visitOn([&](uint32_t index) {
            const ExactSphere voxel = voxelBall(leafVoxel(bare.origin(leaf), index));
            auto node = std::size_t(grid.nearest(kNone, voxel, 1).front());
            for (std::size_t k = 0; k < levels.size(); ++k) {
                const ExactSphere& ball = levels[k].balls[node];
                detail::raiseTo(radiiSq[k][node], radiusSqToHold(ball, voxel));
                if (!levels[k].parent.empty()) node = std::size_t(levels[k].parent[node]);
            }
        });
    });
    for (std::size_t k = 0; k < levels.size(); ++k) {
        for (std::size_t i = 0; i < radiiSq[k].size(); ++i) {
            int64_t& radiusSq = levels[k].balls[i].radiusSq;
            radiusSq = std::max(radiusSq, radiiSq[k][i].load());
        }
    }
    return levels;
}

std::vector<double> costsOf(const std::vector<TightLevel>& levels, const LevelMaker& maker)
{
    std::vector<double> costs;
    for (const TightLevel& level : levels) costs.push_back(maker.costOf(level.balls));
    return costs;
}

/// @param costs  of levels made without the frame before
bool areAboutAsGood(const std::vector<TightLevel>& levels, const std::vector<double>& costs,
    const LevelMaker& maker)
{
    constexpr double kWorse = 8.0 / 7;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        if (maker.costOf(levels[k].balls) > kWorse * costs[k]) return false;
    }
    return true;
}

/// @return how far the spheres of the levels are from where they were.
double movementOf(const std::vector<TightLevel>& levels, SphereTree tree, const SphereTree& last,
    const LevelMaker& maker)
{
    appendLevels(levels, tree);
    detail::storeRadii(tree, maker.interrupter);
    return movementSince(last, tree, maker.interrupter);
}

} // namespace

std::vector<TightLevel> followedLevels(const SphereTree& last, const SphereTree& tree,
    const std::vector<TightLevel>& fresh, const LevelMaker& maker)
{
    const auto counts = tree.settings.tight().budget.counts(INT64_MAX);
    const auto start = movedLevels(last, tree, counts, FlatAxis(tree.flatAxis));
    if (start.size() != fresh.size() || start.empty()) return fresh;
    if (!maker.regionMemory(allBalls(start)).fits(maker.memory)) return fresh;
    const std::vector<double> costs = costsOf(fresh, maker);
    const Chains chains = chainsOf(start, maker);
    const bool holds = chains.bare.leafCount() == 0 && chains.areAllUsed;
    if (holds && areAboutAsGood(start, costs, maker)) return start;
    const auto grown = grownOver(chains.bare, start, maker);
    if (!maker.regionMemory(allBalls(grown)).fits(maker.memory)) return fresh;
    const auto placed = placedLevels(grown, counts.front(), maker, fresh.front().balls);
    const auto movement = [&](const std::vector<TightLevel>& levels) {
        return movementOf(levels, tree, last, maker);
    };
    return areAboutAsGood(placed, costs, maker) && movement(placed) < movement(fresh) ? placed
                                                                                      : fresh;
}

} // namespace openvdb_spheretree::tight
