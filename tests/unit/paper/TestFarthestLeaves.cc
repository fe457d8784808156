// SPDX-License-Identifier: Apache-2.0
/// @file TestFarthestLeaves.cc
/// @brief The search for the leaf balls that reach farthest: the same most as by looking at all, and
/// much less looked at.

#include <openvdb_spheretree/paper/FarthestLeaves.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace openvdb_spheretree;

/// Places on a line, in levels; a node's reach is that of the leaves below it, around its place.
struct Line {
    std::vector<std::vector<double>> place, reach; ///< per level
    std::vector<CompressedRows> below;
    std::vector<std::vector<int32_t>> ancestor; ///< of leaves, per level

    explicit Line(uint32_t seed)
    {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> where(0, 1000);
        std::size_t size = 300;
        ancestor.emplace_back(size);
        for (std::size_t i = 0; i < size; ++i) ancestor[0][i] = int32_t(i);
        for (int level = 0; size > 1; ++level, size = level == 3 ? 1 : size / 4) {
            place.emplace_back(size);
            for (double& p : place.back()) p = where(random);
            std::sort(place.back().begin(), place.back().end());
            if (level > 0) addParents();
            fit();
        }
    }
    /// Each node of the level below hangs on the nearest node of the new one.
    void addParents()
    {
        const std::vector<double>&fine = place[place.size() - 2], &coarse = place.back();
        std::vector<int32_t> parent;
        for (const double p : fine) {
            const auto nearest = std::min_element(coarse.begin(), coarse.end(),
                [p](double a, double b) { return std::abs(a - p) < std::abs(b - p); });
            parent.push_back(int32_t(nearest - coarse.begin()));
        }
        below.push_back(compressedRows(parent, coarse.size()));
        ancestor.push_back(ancestor.back());
        for (int32_t& node : ancestor.back()) node = parent[node];
    }
    void fit()
    {
        const std::size_t level = place.size() - 1;
        reach.emplace_back(place[level].size(), level == 0 ? 1.0 : -1.0);
        for (std::size_t leaf = 0; level > 0 && leaf < place[0].size(); ++leaf) {
            const int32_t t = ancestor[level][leaf];
            reach[level][t] = std::max(reach[level][t], fromTo(level, t, leaf));
        }
    }
    double fromTo(std::size_t level, int32_t node, std::size_t leaf) const
    {
        return std::abs(place[level][node] - place[0][leaf]) + 1;
    }
};

TEST(FarthestLeaves, FindTheMostAndLookAtFew)
{
    std::size_t looked = 0, all = 0;
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const Line line(seed);
        ASSERT_GT(line.place.size(), 2u);
        for (std::size_t level = 1; level < line.place.size(); ++level) {
            detail::FarthestLeaves leaves(line.below);
            for (std::size_t t = 0; t < line.place[level].size(); ++t) {
                const auto bound = [&](int k, int32_t node) {
                    const double apart = std::abs(line.place[level][t] - line.place[k][node]);
                    return (apart + line.reach[k][node]) * (1 + 1e-12);
                };
                double most = -1;
                leaves.search(int(level), int32_t(t), bound, [&](int32_t leaf) {
                    ++looked;
                    EXPECT_EQ(line.ancestor[level][leaf], int32_t(t));
                    return most = std::max(most, line.fromTo(level, int32_t(t), leaf));
                });
                EXPECT_DOUBLE_EQ(most, line.reach[level][t]) << seed << " " << level << " " << t;
            }
            all += line.place[0].size();
        }
    }
    EXPECT_LT(looked, all / 3);
}

} // namespace
