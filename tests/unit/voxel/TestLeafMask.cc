// SPDX-License-Identifier: Apache-2.0
/// @file TestLeafMask.cc
/// @brief Sets of voxels of a leaf against sets of numbers.

#include <openvdb_spheretree/voxel/LeafMask.h>

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <set>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using openvdb::util::NodeMask;
using Indices = std::set<uint32_t>;

LeafMask maskOf(const Indices& indices)
{
    LeafMask mask{};
    for (const uint32_t index : indices) mask.setOn(index);
    return mask;
}

/// The empty set, all, single voxels at the ends of words, and random sets of every density.
std::vector<Indices> samples()
{
    std::vector<Indices> samples{{}, {0}, {63}, {64}, {511}, {0, 511}, {63, 64, 127, 128}};
    Indices all;
    for (uint32_t i = 0; i < 512; ++i) all.insert(i);
    samples.push_back(all);
    all.erase(300);
    samples.push_back(all);
    std::mt19937 random(1);
    for (const int percent : {1, 10, 50, 90, 99}) {
        Indices some;
        for (uint32_t i = 0; i < 512; ++i) {
            if (int(random() % 100) < percent) some.insert(i);
        }
        samples.push_back(some);
    }
    return samples;
}

TEST(LeafMask, TheIndexOfAVoxelIsThatOfOpenVdbsLeaves)
{
    for (uint32_t i = 0; i < 512; ++i) {
        const Coord local = openvdb::BoolTree::LeafNodeType::offsetToLocalCoord(i);
        EXPECT_EQ(leafIndex(local), i);
        EXPECT_EQ(leafIndex(local + Coord(-8, 16, -1024)), i);
    }
}

TEST(LeafMask, HoldsWhatWasTurnedOnAndNothingElse)
{
    for (const Indices& indices : samples()) {
        const LeafMask mask = maskOf(indices);
        for (uint32_t i = 0; i < 512; ++i) ASSERT_EQ(mask.isOn(i), indices.count(i) == 1) << i;
        EXPECT_EQ(mask.count(), int(indices.size()));
        EXPECT_EQ(mask.none(), indices.empty());
        EXPECT_EQ(mask.all(), indices.size() == 512);
    }
    EXPECT_TRUE(LeafMask::full().all());
    EXPECT_TRUE(LeafMask{}.none());
}

TEST(LeafMask, NeitherEmptyNorFullIsASetThatLacksOneVoxelOrHasOne)
{
    for (uint32_t i = 0; i < 512; ++i) {
        const LeafMask one = maskOf({i}), others = LeafMask::full() - one;
        EXPECT_FALSE(one.none());
        EXPECT_FALSE(one.all());
        EXPECT_FALSE(others.none());
        EXPECT_FALSE(others.all());
        EXPECT_EQ(others.count(), 511);
    }
}

TEST(LeafMask, VisitsItsVoxelsInAscendingOrder)
{
    for (const Indices& indices : samples()) {
        std::vector<uint32_t> visited;
        maskOf(indices).visitOn([&](uint32_t index) { visited.push_back(index); });
        EXPECT_EQ(visited, std::vector<uint32_t>(indices.begin(), indices.end()));
    }
}

TEST(LeafMask, UnionsIntersectionsAndDifferencesAreThoseOfSets)
{
    for (const Indices& a : samples()) {
        for (const Indices& b : samples()) {
            Indices both, either, rest;
            std::set_union(
                a.begin(), a.end(), b.begin(), b.end(), std::inserter(either, either.end()));
            std::set_intersection(
                a.begin(), a.end(), b.begin(), b.end(), std::inserter(both, both.end()));
            std::set_difference(
                a.begin(), a.end(), b.begin(), b.end(), std::inserter(rest, rest.end()));
            EXPECT_EQ(maskOf(a) | maskOf(b), maskOf(either));
            EXPECT_EQ(maskOf(a) & maskOf(b), maskOf(both));
            EXPECT_EQ(maskOf(a) - maskOf(b), maskOf(rest));
        }
    }
}

TEST(LeafMask, ComesFromANodeMaskAndGoesBackToOne)
{
    for (const Indices& indices : samples()) {
        NodeMask<3> node;
        for (const uint32_t index : indices) node.setOn(index);
        EXPECT_EQ(LeafMask::from(node), maskOf(indices));
        NodeMask<3> back(true);
        maskOf(indices).copyTo(back);
        EXPECT_TRUE(back == node);
    }
}

} // namespace
