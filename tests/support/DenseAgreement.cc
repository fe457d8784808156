// SPDX-License-Identifier: Apache-2.0
#include "DenseAgreement.h"

#include <cmath>
#include <set>
#include <utility>

namespace spheretree_test {

DenseSettings denseSettings(const SphereTreeSettings& settings)
{
    const auto pyramid = optionsOr<openvdb_spheretree::PyramidOptions>(settings);
    const auto extended = optionsOr<openvdb_spheretree::ExtendedOptions>(settings);
    DenseSettings dense;
    dense.extended = settings.type() == TreeType::Extended;
    dense.factor = pyramid.factor;
    dense.dim = settings.dim;
    dense.parentByDag = pyramid.parent == ParentRule::Dag;
    dense.finalFit = extended.finalFit;
    dense.reconstruct = extended.reconstruct == Reconstruction::Clip ? DenseReconstruction::Clip
        : extended.reconstruct == Reconstruction::Free               ? DenseReconstruction::Free
                                                                     : DenseReconstruction::None;
    dense.paperScale = pyramid.scale == RadiusScale::Paper;
    dense.norm = {settings.dist().face(), settings.dist().edge(), settings.dist().corner()};
    return dense;
}

namespace {

constexpr double kTolerance = 1e-9;

testing::AssertionResult agreeOnNode(
    const DenseNode& expected, const SphereTree& tree, int32_t id, int32_t parentBegin)
{
    const auto fail = [&](const char* what) {
        return testing::AssertionFailure()
            << "node " << id << " at " << tree.ijk[id] << " has another " << what << " than "
            << expected.ijk << " of the dense tree: ";
    };
    if (tree.ijk[id] != expected.ijk) return fail("ijk");
    if (tree.radiusSq[id] != expected.radiusSq) {
        return fail("radiusSq") << tree.radiusSq[id] << ", not " << expected.radiusSq;
    }
    const int parent = tree.spheres.parent[id] < 0 ? -1 : tree.spheres.parent[id] - parentBegin;
    if (parent != expected.parent) return fail("parent") << parent << ", not " << expected.parent;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(tree.spheres.center[id][axis] - expected.center[axis]) > kTolerance) {
            return fail("center") << tree.spheres.center[id];
        }
    }
    if (std::abs(tree.spheres.radius[id] - expected.radius) > kTolerance * (1 + expected.radius)) {
        return fail("radius") << tree.spheres.radius[id] << ", not " << expected.radius;
    }
    // coverSq is (2 radius)^2, in units of the distance, rounded down, but for what doubles cannot
    // tell.
    const double unit = tree.settings.dist().unit();
    const double fourRSq = 4 * unit * unit * expected.radius * expected.radius;
    if (std::abs(double(tree.spheres.coverRadiusSq[id]) + 0.5 - fourRSq)
        > 0.5 + kTolerance * (1 + fourRSq)) {
        return fail("coverSq") << tree.spheres.coverRadiusSq[id] << ", not the floor of "
                               << fourRSq;
    }
    return testing::AssertionSuccess();
}

std::set<std::pair<int, int>> edgesOfLevel(const SphereTree& tree, std::size_t level)
{
    const SphereTreeLevel& range = tree.levels[level];
    std::set<std::pair<int, int>> edges;
    for (const auto& edge : tree.dag) {
        if (edge.child < range.begin || edge.child >= range.end) continue;
        edges.emplace(edge.parent - tree.levels[level + 1].begin, edge.child - range.begin);
    }
    return edges;
}

} // namespace

testing::AssertionResult agree(const std::vector<DenseLevel>& expected, const SphereTree& tree)
{
    const auto fail = [] { return testing::AssertionFailure(); };
    if (tree.levels.size() != expected.size()) {
        return fail() << tree.levels.size() << " levels, should be " << expected.size();
    }
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const SphereTreeLevel& level = tree.levels[k];
        const int32_t parents = k + 1 < expected.size() ? tree.levels[k + 1].begin : 0;
        if (level.size() != int32_t(expected[k].nodes.size())) {
            return fail() << "level " << k << " has " << level.size() << " nodes, should be "
                          << expected[k].nodes.size();
        }
        if (level.pyramidVoxels != int64_t(expected[k].voxels.size())) {
            return fail() << "level " << k << " is of " << level.pyramidVoxels
                          << " voxels, should be " << expected[k].voxels.size();
        }
        for (int32_t i = 0; i < level.size(); ++i) {
            const auto node = agreeOnNode(expected[k].nodes[i], tree, level.begin + i, parents);
            if (!node) return fail() << "level " << k << ", " << node.message();
        }
        if (edgesOfLevel(tree, k) != expected[k].dag) {
            return fail() << "other DAG edges between levels " << k + 1 << " and " << k;
        }
    }
    return testing::AssertionSuccess();
}

} // namespace spheretree_test
