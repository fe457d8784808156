// SPDX-License-Identifier: Apache-2.0
#include "ChildMoves.h"

#include "LevelRegions.h"
#include "LevelWork.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>
#include <openvdb_spheretree/tight/search/CoverPart.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

struct Move {
    int32_t child, from, to;

    bool operator==(const Move& o) const
    {
        return child == o.child && from == o.from && to == o.to;
    }
};

/// @return a ball around both.
ExactSphere ballAround(const ExactSphere& ball, const ExactSphere& child)
{
    const double apart = centerDistance(ball, child);
    const double both = (apart + ball.radius() + child.radius()) / 2; // of neither in the other
    const double radius = std::max({ball.radius(), child.radius(), both});
    ExactSphere around = ball;
    if (apart > 0) {
        const double part = std::min(1.0, (radius - ball.radius()) / apart);
        for (int a = 0; a < 3; ++a) {
            around.center[a] += std::lrint(part * double(child.center[a] - ball.center[a]));
        }
    }
    const auto reach = int64_t(std::ceil(radius)) + 2; // centers are rounded
    around.radiusSq = reach * reach;
    return around;
}

constexpr int kMostMoves = 2; // of a child: some would go to and fro

class Moves {
public:
    Moves(std::vector<CoverBall> balls, TightLevel& finer, const std::vector<VoxelRegion>& regions,
        const LevelMaker& maker)
        : mCover(std::move(balls)), mFiner(finer), mRegions(regions), mMaker(maker),
          mBelow(regionsBelow(regions, finer.parent, mCover.size(), maker)),
          mChildren(mCover.size()), mMoved(regions.size(), 0)
    {
        for (std::size_t c = 0; c < regions.size(); ++c) {
            mChildren[std::size_t(finer.parent[c])].push_back(int32_t(c));
        }
    }

    /// @return whether any move was made.
    bool round()
    {
        const detail::Stage loops("", mMaker.interrupter, nullptr); // each is a detail
        std::vector<Tried> moves = nextMoves();
        detail::parallelFor(moves.size(), mMaker.interrupter, [&](std::size_t i) {
            if (!moves[i].isKnown) moves[i].change = tryMove(moves[i].move);
        });
        std::vector<std::size_t> order(moves.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return moves[a].change.change < moves[b].change.change;
        });
        std::vector<FineBox> made;
        std::vector<char> isChanged(mCover.size(), 0);
        for (const std::size_t i : order) {
            auto& [move, change, isKnown] = moves[i];
            if (!(change.change < 0)) break;
            if (mFiner.parent[move.child] != move.from) continue; // it has moved
            if (change.box.meetsAny(made)) {
                detail::checkInterrupt(mMaker.interrupter);
                change = tryMove(move);
            }
            if (!change.improves()) continue;
            make(move, change);
            made.push_back(change.box);
            isChanged[move.from] = isChanged[move.to] = 1;
            for (const int32_t id : change.ids) isChanged[id] = 1;
        }
        for (Tried& tried : moves) {
            const auto& [child, from, to] = tried.move;
            tried.isKnown = !tried.change.improves() && !isChanged[from] && !isChanged[to];
        }
        mTried = std::move(moves);
        return !made.empty();
    }

    std::vector<ExactSphere> balls() const { return ballsOf(mCover.balls()); }

private:
    struct Tried {
        Move move;
        CoverChange change;
        /// It gained nothing, and its two balls are what they were. (Others near may have changed:
        /// so a gain may be missed, but none is claimed.)
        bool isKnown;
    };

    void make(const Move& move, const CoverChange& change)
    {
        apply(change, mCover);
        mFiner.parent[move.child] = move.to;
        std::vector<int32_t>& before = mChildren[std::size_t(move.from)];
        before.erase(std::find(before.begin(), before.end(), move.child));
        mChildren[std::size_t(move.to)].push_back(move.child);
        ++mMoved[move.child];
        for (const int32_t parent : {move.from, move.to}) {
            mBelow[parent] = unionOf(childrenOf(parent));
        }
    }

    /// @return the regions of a ball's children, but for one of these if it is named.
    std::vector<const VoxelRegion*> childrenOf(int32_t parent, int32_t without = -1) const
    {
        std::vector<const VoxelRegion*> children;
        for (const int32_t c : mChildren[std::size_t(parent)]) {
            if (c != without) children.push_back(&mRegions[std::size_t(c)]);
        }
        return children;
    }

    /// @return for each child the moves to parents that are near; those of the round before as they
    /// were.
    std::vector<Tried> nextMoves() const
    {
        constexpr std::size_t kParents = 3;
        std::vector<Tried> moves;
        std::size_t before = 0; // of mTried, which is ordered by children
        for (std::size_t c = 0; c < mFiner.balls.size(); ++c) {
            const int32_t from = mFiner.parent[c];
            if (mMoved[c] == kMostMoves || mCover[from].empty()) continue; // no voxel needs it
            if (protrusion(mFiner.balls[c], mCover[from].ball) < 0)
                continue; // it keeps no ball large
            while (before < mTried.size() && mTried[before].move.child < int32_t(c)) ++before;
            for (const int32_t to : mCover.grid().nearest(kNewBall, mFiner.balls[c], kParents)) {
                if (to == from) continue;
                Tried& tried = moves.emplace_back(Tried{{int32_t(c), from, to}, {}, false});
                for (std::size_t i = before; i < mTried.size(); ++i) {
                    if (mTried[i].move.child != int32_t(c)) break;
                    if (mTried[i].isKnown && mTried[i].move == tried.move) tried = mTried[i];
                }
            }
        }
        return moves;
    }

    /// @return what the move changes; nothing if it does not pay.
    CoverChange tryMove(const Move& move) const
    {
        if (mCover[move.from].empty() || mCover[move.to].empty()) return {}; // by a move before it
        const VoxelRegion less = unionOf(childrenOf(move.from, move.child));
        const VoxelRegion more = unionOf(mBelow[move.to], mRegions[move.child]);
        std::vector<const VoxelRegion*> regions;
        regions.reserve(mBelow.size());
        for (const VoxelRegion& region : mBelow) regions.push_back(&region);
        regions[move.from] = &less;
        regions[move.to] = &more;
        const VoxelGoal goal(mMaker.object.level(0), std::move(regions));
        const SearchEffort effort{mMaker.fitOf(int64_t(mCover.size())), 0, 0, mMaker.flat};
        const PartFit fit(mCover, mMaker.object, goal, effort);
        CoverPart part = fit.around({move.from, move.to});
        const std::size_t to = part.indexOf(move.to);
        const ExactSphere& child = mFiner.balls[move.child];
        const ExactSphere grown = ballAround(mCover[move.to].ball, child);
        if (!part.box.contains(FineBox(grown))) return {};
        fit.refit(part, part.indexOf(move.from));
        if (!(part.change < 0)) return {}; // the other one grows, nearly always
        fit.replace(part, to, grown);
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
    std::vector<VoxelRegion> mBelow;             ///< regionsBelow() the balls
    std::vector<std::vector<int32_t>> mChildren; ///< of each ball, in no order
    std::vector<int> mMoved;                     ///< how often each child has
    std::vector<Tried> mTried;                   ///< of the round before
};

} // namespace

void moveChildren(std::vector<ExactSphere>& balls, TightLevel& finer,
    const std::vector<VoxelRegion>& regions, const LevelMaker& maker)
{
    const detail::Step step(
        maker.interrupter, LevelWork(maker).ofMoves(int64_t(finer.balls.size())));
    Moves moves(eachInItsGroup(balls), finer, regions, maker);
    for (int round = 0; round < maker.childMoves; ++round) {
        detail::checkInterrupt(maker.interrupter, 100 * round / maker.childMoves);
        if (!moves.round()) break;
    }
    balls = moves.balls();
}

} // namespace openvdb_spheretree::tight
