// SPDX-License-Identifier: Apache-2.0
#include "ChildMoves.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>
#include <openvdb_spheretree/tight/search/CoverPart.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

struct Move {
    int32_t child, from, to;
};

/// @return a ball around both.
ExactSphere ballAround(const ExactSphere& ball, const ExactSphere& child)
{
    const double apart = centerDistance(ball, child);
    const double radius = std::max(ball.radius(), (apart + ball.radius() + child.radius()) / 2);
    ExactSphere around = ball;
    if (apart > 0) {
        const double part = (radius - ball.radius()) / apart;
        for (int a = 0; a < 3; ++a) {
            around.center[a] += std::lrint(part * double(child.center[a] - ball.center[a]));
        }
    }
    const auto reach = int64_t(std::ceil(radius)) + 2; // centers are rounded
    around.radiusSq = reach * reach;
    return around;
}

class Moves {
public:
    Moves(std::vector<CoverBall> balls, TightLevel& finer, const std::vector<VoxelRegion>& regions,
        const LevelMaker& maker)
        : mCover(std::move(balls)), mFiner(finer), mRegions(regions), mMaker(maker)
    {}

    /// @return whether any move was made.
    bool round()
    {
        mBelow = regionsBelow(mRegions, mFiner.parent, mCover.size(), mMaker.interrupter);
        constexpr std::size_t kParents = 3;
        std::vector<Move> moves;
        for (std::size_t c = 0; c < mFiner.balls.size(); ++c) {
            const int32_t from = mFiner.parent[c];
            if (mCover[from].empty()) continue; // no voxel needs it
            for (const int32_t to : mCover.grid().nearest(kNewBall, mFiner.balls[c], kParents)) {
                if (to != from) moves.push_back({int32_t(c), from, to});
            }
        }
        std::vector<std::pair<CoverChange, std::size_t>> changes(moves.size());
        detail::parallelFor(moves.size(), mMaker.interrupter, [&](std::size_t i) {
            changes[i] = {tryMove(moves[i]), i};
        });
        std::stable_sort(changes.begin(), changes.end(),
            [](const auto& a, const auto& b) { return a.first.change < b.first.change; });
        std::vector<FineBox> taken;
        for (const auto& [change, i] : changes) {
            if (!change.improves() || change.box.meetsAny(taken)) continue;
            apply(change, mCover);
            mFiner.parent[moves[i].child] = moves[i].to;
            taken.push_back(change.box);
        }
        return !taken.empty();
    }

    std::vector<ExactSphere> balls() const { return ballsOf(mCover.balls()); }

private:
    CoverChange tryMove(const Move& move) const
    {
        VoxelRegion less; // of the old parent's other children
        for (std::size_t c = 0; c < mRegions.size(); ++c) {
            if (mFiner.parent[c] != move.from || int32_t(c) == move.child) continue;
            less.insert(less.end(), mRegions[c].begin(), mRegions[c].end());
        }
        joinLeaves(less);
        const VoxelRegion more = unionOf(mBelow[move.to], mRegions[move.child]);
        std::vector<const VoxelRegion*> regions;
        for (const VoxelRegion& region : mBelow) regions.push_back(&region);
        regions[move.from] = &less;
        regions[move.to] = &more;
        const VoxelGoal goal(mMaker.object.level(0), regions);
        const PartFit fit(mCover, mMaker.object, goal, {mMaker.fit, 0, 0, mMaker.flat});
        CoverPart part = fit.around({move.from, move.to});
        const std::size_t to = part.indexOf(move.to);
        const ExactSphere& child = mFiner.balls[move.child];
        const ExactSphere grown = ballAround(mCover[move.to].ball, child);
        if (!part.box.contains(FineBox(grown))) return {};
        fit.replace(part, to, grown);
        fit.refit(part, part.indexOf(move.from));
        fit.refit(part, to);
        fit.refitNear(
            part, mCover.grid().nearest(move.to, mCover[move.to].ball, kChangedNeighbours), child);
        fit.refit(part, to);
        CoverChange change = fit.changeOf(part);
        // Their regions change, also where these balls do not.
        change.box.expand(mCover[move.from].ball);
        change.box.expand(mCover[move.to].ball);
        return change;
    }

    BallCover mCover;
    TightLevel& mFiner;
    const std::vector<VoxelRegion>& mRegions;
    const LevelMaker& mMaker;
    std::vector<VoxelRegion> mBelow; ///< regionsBelow() the balls, before the round
};

} // namespace

std::vector<VoxelRegion> regionsBelow(const std::vector<VoxelRegion>& regions,
    const std::vector<int32_t>& parents, std::size_t count,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<VoxelRegion> below(count);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        VoxelRegion& region = below[parents[i]];
        region.insert(region.end(), regions[i].begin(), regions[i].end());
    }
    detail::parallelFor(count, interrupter, [&](std::size_t p) { joinLeaves(below[p]); });
    return below;
}

void moveChildren(std::vector<ExactSphere>& balls, TightLevel& finer,
    const std::vector<VoxelRegion>& regions, const LevelMaker& maker)
{
    constexpr int kMostRounds = 8;
    Moves moves(eachInItsGroup(balls), finer, regions, maker);
    for (int round = 0; round < kMostRounds && moves.round(); ++round) {}
    balls = moves.balls();
}

} // namespace openvdb_spheretree::tight
