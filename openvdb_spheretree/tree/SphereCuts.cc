// SPDX-License-Identifier: Apache-2.0
#include "SphereCuts.h"

#include "TreeShape.h"

#include <algorithm>
#include <cstddef>

namespace openvdb_spheretree {
namespace detail {

namespace {

std::string nodeDamage(const SphereCuts& cuts, int32_t leaves)
{
    for (int32_t i = 0; i < cuts.size(); ++i) {
        const int32_t first = cuts.first[i], last = cuts.last[i], parent = cuts.spheres.parent[i];
        if (first < 1 || last < first || last > leaves) {
            return sentence("node ", i, " is part of the cuts of ", first, " to ", last,
                " spheres, but there are cuts of 1 to ", leaves);
        }
        if (parent == -1) continue;
        if (parent <= i || parent >= cuts.size()) {
            return sentence("node ", i, " has the parent ", parent,
                ", but a parent must be a node that comes after its children, or -1");
        }
        if (cuts.last[parent] != first - 1) {
            return sentence("node ", i, " ends with the cut of ", first,
                " spheres, but its parent ", parent, " begins with that of ", cuts.last[parent]);
        }
    }
    return "";
}

std::string childDamage(const SphereCuts& cuts, int32_t leaves)
{
    std::vector<char> hasChild(cuts.spheres.parent.size(), 0);
    for (const int32_t parent : cuts.spheres.parent) {
        if (parent >= 0) hasChild[parent] = 1;
    }
    for (int32_t i = 0; i < cuts.size(); ++i) {
        const bool leaf = cuts.last[i] == leaves;
        if (leaf == !hasChild[i]) continue;
        return sentence("node ", i, leaf ? " is a leaf, but has a child" : " has no child");
    }
    return "";
}

std::string countDamage(const SphereCuts& cuts, int32_t leaves)
{
    std::vector<int32_t> change(std::size_t(leaves) + 2, 0); // of the count, from N - 1 to N
    for (int32_t i = 0; i < cuts.size(); ++i) {
        ++change[cuts.first[i]];
        --change[std::size_t(cuts.last[i]) + 1];
    }
    int32_t count = 0;
    for (int32_t spheres = 1; spheres <= leaves; ++spheres) {
        count += change[spheres];
        if (count != spheres) return sentence("the cut of ", spheres, " spheres has ", count);
    }
    return "";
}

} // namespace

int32_t leavesOf(const SphereCuts& cuts)
{
    return cuts.last.empty() ? 0 : *std::max_element(cuts.last.begin(), cuts.last.end());
}

std::string cutsDamage(const SphereCuts& cuts)
{
    const Spheres& spheres = cuts.spheres;
    const std::size_t n = spheres.center.size();
    for (const std::size_t size :
        {spheres.radius.size(), spheres.coverRadiusSq.size(), spheres.radiusWorld.size(),
            spheres.parent.size(), cuts.first.size(), cuts.last.size()}) {
        if (size != n) return "the arrays differ in length";
    }
    if (cuts.empty()) return "";
    const int32_t leaves = leavesOf(cuts);
    if (leaves > cuts.size()) {
        return sentence("the last cut is of ", leaves, " spheres, but there are ", cuts.size());
    }
    std::string damage = nodeDamage(cuts, leaves);
    if (damage.empty()) damage = childDamage(cuts, leaves);
    if (damage.empty()) damage = countDamage(cuts, leaves);
    return damage;
}

} // namespace detail

std::vector<int32_t> cutNodes(const SphereCuts& cuts, int64_t spheres)
{
    std::vector<int32_t> nodes;
    for (int32_t i = 0; i < cuts.size(); ++i) {
        if (cuts.first[i] <= spheres && spheres <= cuts.last[i]) nodes.push_back(i);
    }
    return nodes;
}

SphereTree cutTree(const SphereTree& tree, int64_t spheres)
{
    if (tree.cuts.empty()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the tree has no cuts to choose " << spheres << " spheres from: build it with cuts=1");
    }
    if (spheres < 1) {
        OPENVDB_THROW(openvdb::ValueError,
            "spheres=" << spheres << " is out of range: a level has one sphere or more");
    }
    SphereTree result = detail::describedLike(tree);
    const int64_t count = std::min<int64_t>(spheres, detail::leavesOf(tree.cuts));
    result.spheres = tree.cuts.spheres.take(cutNodes(tree.cuts, count));
    std::fill(result.spheres.parent.begin(), result.spheres.parent.end(), -1);
    for (const openvdb::Vec3d& center : result.spheres.center) {
        result.ijk.push_back(openvdb::Coord::round(center));
    }
    result.radiusSq.assign(result.ijk.size(), -1);
    result.levels.resize(1);
    result.levels[0].end = result.size();
    return result;
}

} // namespace openvdb_spheretree
