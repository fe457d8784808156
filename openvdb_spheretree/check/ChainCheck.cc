// SPDX-License-Identifier: Apache-2.0
/// @file ChainCheck.cc
/// @brief Chains are followed upwards, in all voxels of an 8^3 leaf at once.
///
/// Let S(n) be the object's voxels that have a chain from a leaf of the forest up to node n. For a
/// leaf these are the voxels its ball holds; for other nodes, those of S of any child that the
/// node's ball holds. A voxel has a chain up to a section just when S of some node of it has the
/// voxel.
///
/// 1. The object's cubes of voxels are halved in space over and over. Each part keeps the nodes of
///    the part before whose balls touch its box, less those left without a child.
/// 2. A part is finished as soon as balls that hold all of its box make a chain up to the last
///    section: what is inside costs little.
/// 3. What is left comes down to single leaves, where S is computed as masks.
///
/// Parts are halved in parallel (RegionHalving.h). No more masks exist at a time than nodes reach
/// into one leaf.

#include "ChainCheck.h"

#include <openvdb_spheretree/index/RegionHalving.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>

#include <algorithm>
#include <array>
#include <memory>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;

/// A node that reaches into a part of space.
struct Candidate {
    int32_t node;
    int32_t parent;  ///< place in the list of candidates; -1 if the parent does not reach there
    bool holdsAll;   ///< its ball holds all of the part
    bool chainedAll; ///< and so do a leaf below it and all balls in between
};
using Candidates = std::vector<Candidate>;

/// A part of the object: some of its cubes of voxels.
struct Part {
    VoxelCube *begin, *end;
    std::shared_ptr<VoxelCube> own; ///< holds the cube of a part that is an eighth of a tile
    std::shared_ptr<const Candidates> candidates; ///< of the part that this is part of
};

bool reachesInto(const ClippedSphere& ball, const openvdb::CoordBBox& box)
{
    for (int a = 0; a < 3; ++a) {
        if (ball.lo[a] > ball.hi[a]) return false;
        if (ball.lo[a] > box.max()[a] || ball.hi[a] < box.min()[a]) return false;
    }
    return ball.touches(box.min().data(), box.max().data());
}

class ChainSearch {
public:
    ChainSearch(const ChainForest& forest, const SphereMetric& metric) : mForest(forest)
    {
        const openvdb::CoordBBox everywhere(Coord::min(), Coord::max());
        const int shift = shiftOf(metric);
        mBalls.resize(forest.spheres.size());
        for (std::size_t i = 0; i < mBalls.size(); ++i) {
            ClippedSphere& ball = mBalls[i];
            if (clipSphere(forest.spheres[i], metric.distance, shift, everywhere, ball)) continue;
            ball.lo[0] = 1; // an empty box
            ball.hi[0] = 0;
        }
    }

    /// @return the parts that are to be looked at in place of one; losses are added up.
    std::vector<Part> step(const Part& part, std::vector<ChainLoss>& losses) const
    {
        openvdb::CoordBBox box;
        for (const VoxelCube* cube = part.begin; cube != part.end; ++cube) {
            box.expand(openvdb::CoordBBox::createCube(cube->origin, cube->size));
        }
        auto candidates = std::make_shared<Candidates>(narrowed(*part.candidates, box));
        for (const Candidate& candidate : *candidates) {
            const uint64_t sections = mForest.sections[candidate.node];
            if (candidate.chainedAll && sections >> (mForest.sectionCount - 1) & 1) return {};
        }
        if (part.end - part.begin > 1) { // in halves along the longest side
            VoxelCube* const middle = halve(part.begin, part.end, box,
                [](const VoxelCube& some) -> const Coord& { return some.origin; });
            return {{part.begin, middle, part.own, candidates},
                {middle, part.end, part.own, candidates}};
        }
        if (part.begin->size == kLeafDim) {
            searchLeaf(*part.begin, *candidates, losses);
            return {};
        }
        std::vector<Part> parts; // of a tile
        for (int i = 0; i < 8; ++i) {
            auto cube = std::make_shared<VoxelCube>(part.begin->eighth(i));
            parts.push_back({cube.get(), cube.get() + 1, cube, candidates});
        }
        return parts;
    }

private:
    bool isLeaf(int32_t node) const { return mForest.sections[node] & 1; }

    /// Those that reach into the box, and have a leaf below them that does.
    Candidates narrowed(const Candidates& from, const openvdb::CoordBBox& box) const
    {
        constexpr int32_t kGone = -1;
        std::vector<int32_t> place(from.size(), kGone);
        std::vector<char> hasChild(from.size(), 0), hasChained(from.size(), 0);
        Candidates kept;
        for (std::size_t i = 0; i < from.size(); ++i) {
            Candidate candidate = from[i];
            const ClippedSphere& ball = mBalls[candidate.node];
            const bool leaf = isLeaf(candidate.node);
            if (!leaf && !hasChild[i]) continue;
            if (!candidate.holdsAll) {
                if (!reachesInto(ball, box)) continue;
                candidate.holdsAll = ball.contains(box.min().data(), box.max().data());
            }
            candidate.chainedAll = candidate.holdsAll && (leaf || hasChained[i]);
            place[i] = int32_t(kept.size());
            if (candidate.parent >= 0) {
                hasChild[candidate.parent] = 1;
                hasChained[candidate.parent] |= char(candidate.chainedAll);
            }
            kept.push_back(candidate);
        }
        for (Candidate& candidate : kept) {
            if (candidate.parent >= 0) candidate.parent = place[candidate.parent];
        }
        return kept;
    }

    void searchLeaf(
        const VoxelCube& leaf, const Candidates& candidates, std::vector<ChainLoss>& losses) const
    {
        std::vector<LeafMask> below(candidates.size(), LeafMask{}); // S of the children
        std::array<LeafMask, ChainForest::kMaxSections> chained{};
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const Candidate& candidate = candidates[i];
            LeafMask voxels = isLeaf(candidate.node) ? leaf.mask : below[i];
            if (!candidate.holdsAll && !voxels.none()) {
                LeafMask held{};
                addVoxelsOf(mBalls[candidate.node], leaf.origin, held);
                voxels &= held;
            }
            if (candidate.parent >= 0) below[candidate.parent] |= voxels;
            for (uint64_t rest = mForest.sections[candidate.node]; rest != 0; rest &= rest - 1) {
                chained[openvdb::util::FindLowestOn(openvdb::Index64(rest))] |= voxels;
            }
        }
        const LeafMask* before = &leaf.mask;
        for (int section = 0; section < mForest.sectionCount; ++section) {
            const VoxelCube lost{leaf.origin, kLeafDim, *before - chained[section]};
            before = &chained[section];
            const int64_t voxels = lost.voxels();
            if (voxels > 0) losses[section].add({voxels, lost.first()});
        }
    }

    const ChainForest& mForest;
    std::vector<ClippedSphere> mBalls;
};

} // namespace

void ChainLoss::add(const ChainLoss& other)
{
    if (other.voxels == 0) return;
    first = voxels == 0 ? other.first : std::min(first, other.first);
    voxels += other.voxels;
}

std::vector<ChainLoss> brokenChains(const ChainForest& forest, const SphereMetric& metric,
    const openvdb::MaskTree& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<ChainLoss> losses(std::size_t(forest.sectionCount));
    std::vector<VoxelCube> cubes = maskDifference(object, openvdb::MaskTree(), interrupter).cubes;
    if (cubes.empty() || forest.sectionCount == 0) return losses;
    auto all = std::make_shared<Candidates>();
    for (int32_t node = 0; node < int32_t(forest.spheres.size()); ++node) {
        all->push_back({node, forest.parent[node], false, false});
    }
    const Part whole{cubes.data(), cubes.data() + cubes.size(), nullptr, all};
    const ChainSearch search(forest, metric);
    const auto step = [&](const Part& part, std::vector<ChainLoss>& lost) {
        return search.step(part, lost);
    };
    for (const auto& some : divideRegions(whole, losses, step, interrupter)) {
        for (std::size_t s = 0; s < losses.size(); ++s) losses[s].add(some[s]);
    }
    return losses;
}

} // namespace openvdb_spheretree::detail
