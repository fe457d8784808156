// SPDX-License-Identifier: Apache-2.0
#include "SphereForest.h"

#include <openvdb_spheretree/base/Rounding.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Vec3d;

/// How often a list of children is divided in two at most, one below the other: 2^40 is more than
/// there can be.
constexpr int kMostDivisions = 40;
/// Lists longer than this are sorted along the longest side of their box alone.
constexpr std::size_t kAllAxes = 4096;

struct Box {
    Vec3d low = Vec3d(std::numeric_limits<double>::max());
    Vec3d high = Vec3d(std::numeric_limits<double>::lowest());

    void add(const ForestNode& node)
    {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], node.center[axis] - node.radius);
            high[axis] = std::max(high[axis], node.center[axis] + node.radius);
        }
    }
    double sizeSq() const { return (high - low).lengthSqr(); }
    int longestAxis() const
    {
        const Vec3d size = high - low;
        if (size[0] >= size[1]) return size[0] >= size[2] ? 0 : 2;
        return size[1] >= size[2] ? 1 : 2;
    }
};

/// Where a sorted list is cut in two, and what the halves cost.
struct Division {
    double cost = std::numeric_limits<double>::max();
    std::size_t at = 0;
    int axis = 0;
};

/// Children become groups that fit a block.
class Divider {
public:
    explicit Divider(SphereForest& forest) : mForest(forest) {}

    /// @return the node itself, if it is one; or a node above all of @a list, of two halves if they
    ///         fit no block.
    int32_t group(std::vector<int32_t> list, int divisions = kMostDivisions)
    {
        if (list.size() == 1) return list[0];
        const ForestNode around = enclosingSphere(mForest.nodes, list);
        std::vector<int32_t> children = halves(std::move(list), divisions);
        const int32_t node = int32_t(mForest.nodes.size());
        mForest.nodes.push_back(around);
        mForest.nodes.back().children = std::move(children);
        return node;
    }

    /// @return a list that fits a block as it is; else two groups.
    std::vector<int32_t> halves(std::vector<int32_t> list, int divisions)
    {
        if (list.size() <= kBlockWidth) return list;
        const Division best = bestDivision(list, divisions);
        sortAlong(best.axis, list);
        const auto middle = list.begin() + std::ptrdiff_t(best.at);
        std::vector<int32_t> second(middle, list.end());
        list.erase(middle, list.end());
        const int32_t first = group(std::move(list), divisions - 1);
        return {first, group(std::move(second), divisions - 1)};
    }

private:
    /// Ties by place, so that the order is that of every sort.
    void sortAlong(int axis, std::vector<int32_t>& list) const
    {
        std::sort(list.begin(), list.end(), [&](int32_t a, int32_t b) {
            const double x = mForest.nodes[a].center[axis], y = mForest.nodes[b].center[axis];
            return x != y ? x < y : a < b;
        });
    }

    Division bestDivision(std::vector<int32_t>& list, int divisions) const
    {
        Box box;
        for (const int32_t i : list) box.add(mForest.nodes[i]);
        const int longest = box.longestAxis();
        Division best;
        for (int axis = 0; axis < 3; ++axis) {
            if (list.size() > kAllAxes && axis != longest) continue;
            sortAlong(axis, list);
            const Division division = divisionOfSorted(list, divisions);
            if (division.cost >= best.cost) continue;
            best = division;
            best.axis = axis;
        }
        return best;
    }

    /// No half may be longer than what can still be divided: that bounds the depth, whatever the
    /// spheres are like.
    Division divisionOfSorted(const std::vector<int32_t>& list, int divisions) const
    {
        const std::size_t count = list.size(), most = std::size_t(1) << (divisions - 1);
        std::vector<double> behind(count); // cost of list[i] to the end
        Box box;
        for (std::size_t i = count; i-- > 1;) {
            box.add(mForest.nodes[list[i]]);
            behind[i] = box.sizeSq() * double(count - i);
        }
        Division best;
        box = {};
        for (std::size_t at = 1; at < count; ++at) {
            box.add(mForest.nodes[list[at - 1]]);
            if (at > most || count - at > most) continue;
            const double cost = box.sizeSq() * double(at) + behind[at];
            if (cost >= best.cost) continue;
            best.cost = cost;
            best.at = at;
        }
        return best;
    }

    SphereForest& mForest;
};

/// Lays out blocks in the order of a visit from the root down.
class BlockWriter {
public:
    BlockWriter(const SphereForest& forest, int32_t leafCount) : mForest(forest)
    {
        mResult.leafPlace.assign(std::size_t(leafCount), -1);
    }

    SphereBlocks run()
    {
        mResult.root = rounded(enclosingSphere(mForest.nodes, mForest.roots));
        write(mForest.roots, 1);
        mResult.blocks.shrink_to_fit();
        for (const SphereBlock& block : mResult.blocks) addExtent(block);
        setLargestLeaves();
        return std::move(mResult);
    }

private:
    /// @return a sphere in floats that holds @a node.
    static FloatSphere rounded(const ForestNode& node)
    {
        const FloatSphere s{
            float(node.center[0]), float(node.center[1]), float(node.center[2]), 0.0f};
        const double moved = (Vec3d(s.x, s.y, s.z) - node.center).length();
        return {s.x, s.y, s.z, toFloatUp(addUp(node.radius, moved * (1 + 1e-15)))};
    }

    bool isLeaf(int32_t node) const { return mForest.nodes[node].leaf >= 0; }

    /// Opens the largest inner node whose children find room, until there is none. One child needs
    /// none.
    void pullUp(std::vector<int32_t>& lanes) const
    {
        for (;;) {
            int largest = -1;
            for (int i = 0; i < int(lanes.size()); ++i) {
                const ForestNode& node = mForest.nodes[lanes[i]];
                if (node.leaf >= 0 || lanes.size() - 1 + node.children.size() > kBlockWidth)
                    continue;
                if (largest < 0 || node.radius > mForest.nodes[lanes[largest]].radius) largest = i;
            }
            if (largest < 0) return;
            const std::vector<int32_t>& opened = mForest.nodes[lanes[largest]].children;
            lanes.erase(lanes.begin() + largest);
            lanes.insert(lanes.end(), opened.begin(), opened.end());
        }
    }

    /// @return the number of the block of these nodes.
    int32_t write(std::vector<int32_t> lanes, int depth)
    {
        if (depth > kMostDepth) {
            OPENVDB_THROW(openvdb::ValueError,
                "a tree of more levels than queries go down (" << kMostDepth
                                                               << "): keep fewer of them");
        }
        mResult.depth = std::max(mResult.depth, depth);
        pullUp(lanes);
        const int32_t number = int32_t(mResult.blocks.size());
        mResult.blocks.emplace_back();
        for (int lane = 0; lane < kBlockWidth; ++lane) {
            const bool isEmpty = lane >= int(lanes.size());
            const FloatSphere sphere =
                isEmpty ? FloatSphere{kEmptyLane, 0, 0, 0} : rounded(mForest.nodes[lanes[lane]]);
            const int32_t child = isEmpty ? -1 : childOf(lanes[lane], number, lane, depth);
            mResult.blocks[number].set(lane, sphere); // only now: blocks below may have moved it
            mResult.blocks[number].child[lane] = child;
        }
        return number;
    }

    int32_t childOf(int32_t node, int32_t block, int lane, int depth)
    {
        if (!isLeaf(node)) return write(mForest.nodes[node].children, depth + 1);
        mResult.leafPlace[mForest.nodes[node].leaf] = kBlockWidth * block + lane;
        return ~mForest.nodes[node].leaf;
    }

    void addExtent(const SphereBlock& block)
    {
        for (int lane = 0; lane < kBlockWidth; ++lane) {
            if (isEmptyLane(block, lane)) continue;
            const Vec3d center(block.x[lane], block.y[lane], block.z[lane]);
            const float far = toFloatUp(addUp(center.length() * (1 + 1e-15), block.r[lane]));
            mResult.extent = std::max(mResult.extent, far);
        }
    }

    /// @return the largest leaf at or below a child, as a block has them.
    int32_t largestBelow(int32_t child) const
    {
        if (child < 0) return ~child;
        int32_t largest = -1;
        const SphereBlock& block = mResult.blocks[child];
        for (int lane = 0; lane < kBlockWidth; ++lane) {
            if (isEmptyLane(block, lane)) continue;
            const int32_t leaf = largestBelow(block.child[lane]);
            if (largest < 0 || mResult.leaf(leaf).r > mResult.leaf(largest).r) largest = leaf;
        }
        return largest;
    }

    void setLargestLeaves()
    {
        mResult.largestLeaf = largestBelow(0);
        mResult.largestLeaves = mResult.blocks[0]; // with its empty lanes
        for (int lane = 0; lane < kBlockWidth; ++lane) {
            if (isEmptyLane(mResult.blocks[0], lane)) continue;
            const int32_t leaf = largestBelow(mResult.blocks[0].child[lane]);
            mResult.largestLeaves.set(lane, mResult.leaf(leaf));
            mResult.largestLeaves.child[lane] = ~leaf;
        }
    }

    const SphereForest& mForest;
    SphereBlocks mResult;
};

} // namespace

ForestNode enclosingSphere(const std::vector<ForestNode>& nodes, const std::vector<int32_t>& of)
{
    ForestNode sphere = nodes[of[0]];
    sphere.leaf = -1;
    sphere.children.clear();
    if (of.size() == 1) return sphere;
    Box box;
    for (const int32_t i : of) box.add(nodes[i]);
    Vec3d center = 0.5 * (box.low + box.high);
    sphere.radius = std::numeric_limits<double>::max();
    const int steps =
        of.size() < 200 ? 150 : 60; // long lists are near the top: few questions end there
    for (int step = 0; step < steps; ++step) {
        int32_t farthest = of[0];
        double reach = -1;
        for (const int32_t i : of) {
            const double here = (nodes[i].center - center).length() + nodes[i].radius;
            if (here <= reach) continue;
            reach = here;
            farthest = i;
        }
        if (reach < sphere.radius) {
            sphere.radius = reach;
            sphere.center = center;
        }
        const Vec3d towards = nodes[farthest].center - center;
        const double length = towards.length();
        if (length < 1e-9 * reach) break;
        center += towards * std::min(1.0, 0.5 * reach / ((step + 2) * length));
    }
    sphere.radius *= 1 + 1e-14; // more than the rounding of sums and roots
    return sphere;
}

void divideWideNodes(SphereForest& forest)
{
    const std::size_t given = forest.nodes.size();
    Divider divider(forest);
    for (std::size_t i = 0; i < given; ++i) {
        if (forest.nodes[i].children.size() <= kBlockWidth) continue;
        std::vector<int32_t> children = divider.halves(forest.nodes[i].children, kMostDivisions);
        forest.nodes[i].children = std::move(children); // nodes may have moved
    }
    forest.roots = divider.halves(forest.roots, kMostDivisions);
}

SphereBlocks blocksOf(const SphereForest& forest, int32_t leafCount)
{
    return BlockWriter(forest, leafCount).run();
}

} // namespace openvdb_spheretree::detail
