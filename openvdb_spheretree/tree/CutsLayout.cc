// SPDX-License-Identifier: Apache-2.0
#include "CutsLayout.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

namespace {

template <typename... Parts>
std::string sentence(const Parts&... parts)
{
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

std::string lengthDamage(const SphereCuts& cuts)
{
    const std::size_t n = cuts.spheres.center.size();
    const bool alike = cuts.spheres.radius.size() == n && cuts.spheres.coverRadiusSq.size() == n
        && cuts.spheres.radiusWorld.size() == n && cuts.spheres.parent.size() == n
        && cuts.first.size() == n && cuts.last.size() == n;
    return alike ? "" : "the arrays differ in length";
}

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
    std::string damage = lengthDamage(cuts);
    if (!damage.empty() || cuts.empty()) return damage;
    const int32_t leaves = leavesOf(cuts);
    if (leaves > cuts.size()) {
        return sentence("the last cut is of ", leaves, " spheres, but there are ", cuts.size());
    }
    damage = nodeDamage(cuts, leaves);
    if (damage.empty()) damage = childDamage(cuts, leaves);
    if (damage.empty()) damage = countDamage(cuts, leaves);
    return damage;
}

} // namespace detail
} // namespace openvdb_spheretree
