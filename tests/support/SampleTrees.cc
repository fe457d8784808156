// SPDX-License-Identifier: Apache-2.0
#include "SampleTrees.h"

#include <openvdb_spheretree/tree/SettingsTable.h>

#include <gtest/gtest.h>
#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace spheretree_test {

void addNode(SphereTree& tree, const openvdb::Vec3d& center, const openvdb::Coord& ijk,
    int32_t radiusSq, int32_t parent)
{
    const double radius =
        std::sqrt(std::max(double(radiusSq) - 1, 0.0)) + 0.1 * double(tree.spheres.center.size());
    tree.spheres.center.push_back(center);
    tree.spheres.radius.push_back(radius);
    tree.spheres.coverRadiusSq.push_back(int64_t(4 * radius * radius));
    tree.spheres.radiusWorld.push_back(
        std::nextafter(float(radius * tree.voxelSize()), std::numeric_limits<float>::infinity()));
    tree.spheres.parent.push_back(parent);
    tree.ijk.push_back(ijk);
    tree.radiusSq.push_back(radiusSq);
}

void addLevel(SphereTree& tree, int32_t nodes, int64_t pyramidVoxels)
{
    SphereTreeLevel level;
    level.begin = tree.levels.empty() ? 0 : tree.levels.front().end;
    level.end = level.begin + nodes;
    level.pyramidVoxels = pyramidVoxels;
    for (SphereTreeLevel& above : tree.levels) ++above.level;
    tree.levels.insert(tree.levels.begin(), level);
}

SphereTree oneVoxelTree()
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(0.5);
    tree.origin = {-8, 0, 0};
    tree.settings.kind = openvdb_spheretree::ExtendedOptions();
    tree.settings.padding = 0;
    tree.object.name = "dot";
    tree.object.voxels = tree.object.leaves = 1;
    tree.object.bbox.reset(openvdb::Coord(-3, 4, 5), openvdb::Coord(-3, 4, 5));
    addLevel(tree, 1, 1);
    addNode(tree, {-3, 4, 5}, {5, 4, 5}, 1, -1);
    tree.spheres.radiusWorld[0] = 0;
    return tree;
}

void fillDescription(SphereTree& tree)
{
    using namespace openvdb_spheretree;
    tree.origin = {-16, 8, -1024};
    ExtendedOptions options;
    options.factor = 3;
    options.closing = 5;
    options.parent = ParentRule::Dag;
    options.finalFit = false;
    options.reconstruct = Reconstruction::Free;
    options.scale = RadiusScale::Paper;
    options.dag = true;
    options.edges = DagEdges::Intersecting;
    tree.settings.kind = options;
    tree.hasDag = true;
    tree.settings.padding = 0.1;
    tree.settings.topology = false;
    tree.settings.name = "sample tree";
    tree.object.name = "bunny, left ear";
    tree.object.voxels = int64_t(1) << 40;
    tree.object.leaves = 123;
    tree.object.tiles = 7;
    tree.object.bbox.reset(
        openvdb::Coord(-15, 9, -1000), openvdb::Coord(1 << 14, 1 << 14, 1 << 14));
}

SphereTree sampleTree()
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(0.1);
    tree.transform->postRotate(0.3, openvdb::math::X_AXIS);
    tree.transform->postTranslate({1.0 / 3, -2e5, 7});
    fillDescription(tree);
    tree.subdivision = 16;
    addLevel(tree, 1, 3);
    addLevel(tree, 2, 17);
    addLevel(tree, 5, 99);
    addNode(tree, {-1.5, 10.5, -1000.5}, {0, 0, 1}, 30, -1);
    addNode(tree, {-1.5, 10.5, -1000.5}, {1, 0, 2}, 9, 0);
    addNode(tree, {12.5, 21.5, 30.5}, {3, 1, 500}, 14, 0);
    addNode(tree, {-15, 9, -1000}, {1, 1, 24}, 5, 1);
    addNode(tree, {-1.5, 10.5, -1000.5}, {14, 3, 23}, 6, 1);
    addNode(tree, {0, 10, -999}, {16, 2, 25}, 4, 1);
    addNode(tree, {0.0625, 10.9375, -999.5}, {16, 3, 24}, -1, 2);
    addNode(tree, {20, 30, 40}, {36, 22, 1064}, 1, 2);
    tree.spheres.radius[6] = tree.spheres.radius[7] = 0;
    tree.spheres.coverRadiusSq[6] = int64_t(1) << 50;
    tree.spheres.radiusWorld[6] = 0;
    tree.levels[0].error = openvdb_spheretree::LevelError{int64_t(1) << 41, 5, 1, 0.1, 1.0 / 3};
    tree.levels[0].stored = openvdb_spheretree::StoredError{0.7, 1.0 / 7};
    tree.levels[1].errorUnknown = "too many rows";
    tree.levels[2].error = openvdb_spheretree::LevelError{7, 0, 0, 0, 0};
    tree.levels[2].storedUnknown = "its stored spheres are too large";
    tree.levels[0].topology = openvdb_spheretree::LevelTopology{3, int64_t(1) << 33, 2};
    tree.dag = {{0, 1}, {0, 2}, {1, 3}, {1, 4}, {1, 5}, {2, 5}, {2, 6}, {2, 7}};
    return tree;
}

namespace {

void fillTightSettings(openvdb_spheretree::SphereTreeSettings& settings)
{
    using namespace openvdb_spheretree;
    TightOptions options;
    options.quality = Quality::Fast;
    options.budget.spheres = {512, 2};
    options.cover = Cover::Balls;
    options.leaves = Leaves::Medial;
    options.cuts = true;
    settings = options;
    settings.padding = 0.1;
    settings.name = "tight tree";
}

void addCutsNode(SphereTree& tree, const openvdb::Vec3d& center, int64_t coverSq, int32_t parent,
    int32_t first, int32_t last)
{
    openvdb_spheretree::SphereCuts& cuts = tree.cuts;
    cuts.spheres.center.push_back(center);
    cuts.spheres.coverRadiusSq.push_back(coverSq);
    cuts.spheres.radius.push_back(std::sqrt(double(coverSq)) / tree.subdivision);
    cuts.spheres.radiusWorld.push_back(
        float(cuts.spheres.radius.back()) + float(cuts.spheres.center.size()));
    cuts.spheres.parent.push_back(parent);
    cuts.first.push_back(first);
    cuts.last.push_back(last);
}

} // namespace

void addCuts(SphereTree& tree)
{
    addCutsNode(tree, {-3.0625, 10.5, -1000}, 77, 4, 4, 4);         // 0
    addCutsNode(tree, {-2, 10.9375, -1000}, 5, 4, 4, 4);            // 1
    addCutsNode(tree, {0, 0, 0}, 0, -1, 3, 4);                      // 2
    addCutsNode(tree, {7.125, -3, 2e6}, int64_t(1) << 40, 5, 2, 4); // 3
    addCutsNode(tree, {-2.5, 10.6875, -1000}, 300, 5, 2, 3);        // 4
    addCutsNode(tree, {2, 2, 1e6}, int64_t(1) << 48, -1, 1, 1);     // 5
}

SphereTree tightSampleTree()
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(0.1);
    fillDescription(tree);
    tree.settings = {};
    tree.hasDag = false;
    tree.hasCuts = true;
    fillTightSettings(tree.settings);
    tree.subdivision = 16;
    addLevel(tree, 1, 0);
    addLevel(tree, 3, 99);
    addNode(tree, {-1.4375, 10.5, -1000.0625}, {-1, 11, -1000}, 30, -1);
    addNode(tree, {-4, 9, 3}, {-4, 9, 3}, 20, 0);
    addNode(tree, {-4.0625, 9, 3}, {-4, 9, 3}, 20, 0);
    addNode(tree, {100000.9375, 9, -3.5625}, {100001, 9, -4}, 7, 0);
    for (int32_t id : {0, 2, 3}) tree.radiusSq[id] = -1;
    addCuts(tree);
    return tree;
}

SphereTree randomTree(int32_t n, unsigned seed)
{
    std::mt19937 random(seed);
    const auto number = [&](int lo, int hi) { return lo + int(random() % uint32_t(hi - lo + 1)); };
    SphereTree tree;
    tree.settings.kind = openvdb_spheretree::ExtendedOptions();
    tree.transform = openvdb::math::Transform::createLinearTransform(0.07);
    tree.object.name = "random";
    std::vector<int32_t> counts{n};
    while (counts.back() > 1) counts.push_back(counts.back() / 10 > 0 ? counts.back() / 10 : 1);
    int32_t aboveBegin = -1, aboveEnd = -1;
    for (auto count = counts.rbegin(); count != counts.rend(); ++count) {
        addLevel(tree, *count, 10 * *count);
        const int32_t begin = tree.size();
        for (int32_t i = 0; i < *count; ++i) {
            const openvdb::Coord twice(number(-201, 203), number(-202, 207), number(-211, 199));
            addNode(tree, twice.asVec3d() / 2, {twice[0] >> 1, twice[1] >> 1, twice[2] >> 1},
                number(1, 5000), aboveBegin < 0 ? -1 : number(aboveBegin, aboveEnd - 1));
        }
        aboveBegin = begin;
        aboveEnd = tree.size();
    }
    return tree;
}

SphereTree oneLevelOf(const SphereTree& tree, int number)
{
    const SphereTreeLevel level = tree.levels.at(number);
    const auto cut = [&](auto& values) {
        values = {values.begin() + level.begin, values.begin() + level.end};
    };
    SphereTree kept = tree;
    kept.spheres = tree.spheres.slice(level.begin, level.end);
    kept.spheres.parent.assign(std::size_t(level.size()), -1);
    cut(kept.ijk), cut(kept.radiusSq);
    kept.levels = {level};
    kept.levels[0].begin = 0;
    kept.levels[0].end = level.size();
    kept.dag.clear();
    kept.hasDag = false;
    return kept;
}

void expectSameDescription(const SphereTree& a, const SphereTree& b)
{
    using namespace openvdb_spheretree::detail;
    const auto ofA = recordedSettings(a), ofB = recordedSettings(b);
    for (const Setting& setting : settingsTable()) {
        if (setting.name == "memory") continue; // which no file records
        EXPECT_EQ(setting.get(ofA), setting.get(ofB)) << setting.name;
    }
    EXPECT_EQ(a.hasDag, b.hasDag);
    EXPECT_EQ(a.hasCuts, b.hasCuts);
    EXPECT_EQ(a.flatAxis, b.flatAxis);
    EXPECT_EQ(a.object.name, b.object.name);
    EXPECT_EQ(a.object.voxels, b.object.voxels);
    EXPECT_EQ(a.object.leaves, b.object.leaves);
    EXPECT_EQ(a.object.tiles, b.object.tiles);
    EXPECT_EQ(a.object.bbox, b.object.bbox);
    EXPECT_EQ(a.origin, b.origin);
}

void expectSameTransform(const openvdb::math::Transform& a, const openvdb::math::Transform& b)
{
    EXPECT_EQ(a.mapType(), b.mapType());
    EXPECT_TRUE(a == b);
    EXPECT_EQ(a.baseMap()->getAffineMap()->getMat4(), b.baseMap()->getAffineMap()->getMat4());
}

namespace {

void expectSameLevel(const SphereTreeLevel& a, const SphereTreeLevel& b)
{
    EXPECT_EQ(a.level, b.level);
    EXPECT_EQ(a.begin, b.begin);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.pyramidVoxels, b.pyramidVoxels);
    EXPECT_TRUE(a.topology == b.topology);
    EXPECT_EQ(a.errorUnknown, b.errorUnknown);
    EXPECT_EQ(a.storedUnknown, b.storedUnknown);
    ASSERT_EQ(a.stored.has_value(), b.stored.has_value());
    if (a.stored) {
        EXPECT_EQ(a.stored->hammingPercent, b.stored->hammingPercent);
        EXPECT_EQ(a.stored->reachWorld, b.stored->reachWorld);
    }
    ASSERT_EQ(a.error.has_value(), b.error.has_value());
    if (!a.error) return;
    EXPECT_EQ(a.error->covered, b.error->covered);
    EXPECT_EQ(a.error->excess, b.error->excess);
    EXPECT_EQ(a.error->missing, b.error->missing);
    EXPECT_EQ(a.error->hammingPercent, b.error->hammingPercent);
    EXPECT_EQ(a.error->hausdorff, b.error->hausdorff);
}

void expectSameSpheres(const openvdb_spheretree::Spheres& a, const openvdb_spheretree::Spheres& b)
{
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.coverRadiusSq, b.coverRadiusSq);
    EXPECT_EQ(a.radiusWorld, b.radiusWorld);
    EXPECT_EQ(a.parent, b.parent);
}

void expectSameCuts(
    const openvdb_spheretree::SphereCuts& a, const openvdb_spheretree::SphereCuts& b)
{
    expectSameSpheres(a.spheres, b.spheres);
    EXPECT_EQ(a.first, b.first);
    EXPECT_EQ(a.last, b.last);
}

} // namespace

void expectSameTree(const SphereTree& a, const SphereTree& b)
{
    expectSameSpheres(a.spheres, b.spheres);
    EXPECT_EQ(a.ijk, b.ijk);
    EXPECT_EQ(a.radiusSq, b.radiusSq);
    EXPECT_EQ(a.track, b.track);
    EXPECT_EQ(a.nextTrack, b.nextTrack);
    EXPECT_EQ(a.subdivision, b.subdivision);
    EXPECT_EQ(a.dag, b.dag);
    expectSameCuts(a.cuts, b.cuts);
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t k = 0; k < a.levels.size(); ++k) expectSameLevel(a.levels[k], b.levels[k]);
    expectSameDescription(a, b);
    expectSameTransform(*a.transform, *b.transform);
}

} // namespace spheretree_test
