// SPDX-License-Identifier: Apache-2.0
#include "CoreStages.h"

#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <algorithm>
#include <memory>

namespace spheretree_test {

openvdb::MaskTree::Ptr maskOf(const Voxels& voxels)
{
    auto tree = std::make_shared<openvdb::MaskTree>(false);
    openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(*tree);
    for (const Coord& voxel : voxels) accessor.setValueOn(voxel);
    return tree;
}

openvdb::MaskTree::Ptr maskOf(const CoordBBox& box)
{
    auto tree = std::make_shared<openvdb::MaskTree>(false);
    tree->sparseFill(box, true);
    return tree;
}

openvdb::SharedPtr<openvdb::BoolGrid> gridOf(const openvdb::MaskTree& mask)
{
    auto tree = std::make_shared<openvdb::BoolTree>(mask, false, true, openvdb::TopologyCopy());
    return openvdb::BoolGrid::create(tree);
}

openvdb::SharedPtr<openvdb::BoolGrid> gridOf(const Voxels& voxels)
{
    return gridOf(*maskOf(voxels));
}

Voxels voxelsOf(const openvdb::MaskTree& tree)
{
    Voxels voxels;
    for (auto it = tree.cbeginValueOn(); it; ++it) {
        CoordBBox box;
        it.getBoundingBox(box);
        for (const Coord& voxel : voxelsOfBox(box)) voxels.push_back(voxel);
    }
    std::sort(voxels.begin(), voxels.end());
    return voxels;
}

CoreStages::CoreStages(
    const openvdb::MaskTree& level, int dim, const openvdb_spheretree::Distance& distance)
    : medial(level, dim, distance, nullptr, nullptr, {0, {}, true}), layout(medial.layout),
      distances(distanceTransform(layout, dim, distance)), labels(medial.labels),
      balls(medial.balls)
{}

uint32_t CoreStages::distSq(const Coord& ijk) const
{
    const auto leaf = layout.findLeaf(ijk);
    return leaf ? distances.at(*leaf, openvdb_spheretree::leafIndex(ijk)) : 0;
}

testing::AssertionResult agreeOnVoxels(
    const NaiveReference& naive, const CoreStages& stages, const Coord& shift)
{
    for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
        const Coord voxel = naive.voxels()[i] + shift;
        const int64_t distSq = stages.distSq(voxel);
        if (distSq != naive.distSq(i)) {
            return testing::AssertionFailure()
                << "distSq of " << voxel << " is " << distSq << ", should be " << naive.distSq(i);
        }
        const Coord label = stages.labels.label(voxel);
        if (label != naive.label(i) + shift) {
            return testing::AssertionFailure() << "label of " << voxel << " is " << label
                                               << ", should be " << naive.label(i) + shift;
        }
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult agreeOnBalls(const std::vector<NaiveReference::Ball>& expected,
    const std::vector<openvdb_spheretree::MedialBall>& balls)
{
    for (std::size_t i = 0; i < std::min(expected.size(), balls.size()); ++i) {
        if (balls[i].center == expected[i].center && balls[i].radiusSq == expected[i].radiusSq) {
            continue;
        }
        return testing::AssertionFailure()
            << "ball " << i << " is at " << balls[i].center << ", radiusSq " << balls[i].radiusSq
            << ", should be at " << expected[i].center << ", radiusSq " << expected[i].radiusSq;
    }
    if (balls.size() == expected.size()) return testing::AssertionSuccess();
    return testing::AssertionFailure() << balls.size() << " balls, should be " << expected.size();
}

testing::AssertionResult agree(const NaiveReference& naive, const CoreStages& stages)
{
    if (stages.layout.voxelCount() != int64_t(naive.voxels().size())) {
        return testing::AssertionFailure()
            << stages.layout.voxelCount() << " voxels, should be " << naive.voxels().size();
    }
    const auto voxels = agreeOnVoxels(naive, stages);
    return voxels ? agreeOnBalls(naive.balls(), stages.balls) : voxels;
}

namespace {

/// Distance of every voxel.
testing::AssertionResult agreeOnDistances(const LineReference& reference, const CoreStages& stages)
{
    auto result = testing::AssertionSuccess();
    forEachVoxel(stages.layout, [&](uint32_t leaf, uint32_t k, const Coord& voxel) {
        const int64_t distSq = stages.distances.at(leaf, k);
        if (!result || distSq == reference.distSq(voxel)) return;
        result = testing::AssertionFailure() << "distSq of " << voxel << " is " << distSq
                                             << ", should be " << reference.distSq(voxel);
    });
    return result;
}

} // namespace

testing::AssertionResult agreeOnPlane(
    const LineReference& reference, const CoreStages& stages, int z, std::set<Coord>* sites)
{
    const auto plane = reference.labelsOfPlane(z);
    CoordBBox box = reference.box();
    box.min()[2] = box.max()[2] = z;
    for (const Coord& voxel : voxelsOfBox(box)) {
        if (reference.distSq(voxel) == 0) continue;
        const Coord label = stages.labels.label(voxel),
                    expected = reference.labelIn(plane, voxel).at;
        if (sites) sites->insert(expected);
        if (label == expected) continue;
        return testing::AssertionFailure()
            << "label of " << voxel << " is " << label << ", should be " << expected;
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult agree(const LineReference& reference, const CoreStages& stages)
{
    auto result = agreeOnDistances(reference, stages);
    std::set<Coord> sites;
    for (int z = reference.box().min()[2]; result && z <= reference.box().max()[2]; ++z) {
        result = agreeOnPlane(reference, stages, z, &sites);
    }
    if (!result) return result;
    std::vector<NaiveReference::Ball> balls;
    for (const Coord& site : sites) balls.push_back({site, reference.distSq(site)});
    return agreeOnBalls(balls, stages.balls);
}

} // namespace spheretree_test
