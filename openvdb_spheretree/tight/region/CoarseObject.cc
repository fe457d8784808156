// SPDX-License-Identifier: Apache-2.0
#include "CoarseObject.h"

#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// @return the steps and levels of the pyramid, up to the first of less than @a leastVoxels.
CoarseObject pyramidOf(const openvdb::MaskTree::ConstPtr& voxels, int dim, int64_t leastVoxels,
    openvdb::util::NullInterrupter* interrupter)
{
    openvdb::CoordBBox box;
    voxels->evalActiveVoxelBoundingBox(box);
    PyramidStep step;
    step.dim = dim;
    step.origin = pyramidOrigin(box);
    if (dim == 2) step.origin[2] = 0;
    CoarseObject object;
    object.levels.push_back(voxels);
    const int64_t least = std::max<int64_t>(leastVoxels, 2); // one voxel is the last level
    while (detail::countVoxels(*object.levels.back()) >= least) {
        openvdb::MaskTree::ConstPtr next = coarsen(*object.levels.back(), step, interrupter);
        object.levels.push_back(std::move(next));
        object.steps.push_back(step);
        step.origin = openvdb::Coord(0);
    }
    return object;
}

/// @return from how many leaf balls levels of named counts are made, at least. With fewer, a voxel
/// of the coarse object is too large for its balls.
int64_t leastLeafBalls(int64_t count, Quality quality)
{
    constexpr int64_t kLeast = 2048;
    return std::max(kLeast, (quality == Quality::Fast ? 3 : 4) * count);
}

/// @return of how many voxels the object is large enough for that, whatever its leaf balls: a ball
/// of the finest level has a radius of 32 of them.
int64_t enoughVoxels(int64_t count)
{
    constexpr int64_t kOfABall = 140000;
    return count * kOfABall;
}

/// @return whether the number of spheres does not follow from the settings alone, or all levels
/// need the object's own leaf balls.
bool needsLeafBalls(const TightOptions& options)
{
    return options.budget.hasBound() || options.budget.spheres.empty() || options.cuts
        || options.cover == Cover::Balls || options.leaves == Leaves::Medial;
}

} // namespace

std::vector<int64_t> CoarseObject::leafNodesBelow(std::size_t level) const
{
    std::vector<int64_t> nodes;
    for (std::size_t k = 0; k < level; ++k) nodes.push_back(detail::leafNodesOf(*levels[k]));
    return nodes;
}

CoarseSize sizeFor(const TightOptions& options)
{
    if (needsLeafBalls(options)) return {};
    const int64_t count = options.budget.counts(INT64_MAX).front();
    return {leastLeafBalls(count, options.quality), enoughVoxels(count)};
}

WorkingMemory leastAllowed(const SphereTreeSettings& settings, std::size_t leafNodes)
{
    const TightOptions& options = settings.tight();
    WorkingMemory memory;
    memory.addSamples(leafNodes, settings.dim);
    if (needsLeafBalls(options)) return memory;
    const double voxels = double(kLeafVoxels) * double(leafNodes);
    for (const int64_t count : options.budget.counts(INT64_MAX)) {
        memory.guessCover(std::min(double(count), voxels), leafNodes, settings.dim);
    }
    return memory;
}

bool makesLeafRegions(const TightOptions& options, bool allLeaves)
{
    if (options.cover == Cover::Balls) return false;
    return options.cuts ? options.quality != Quality::Fast : allLeaves;
}

CoarseObject coarseObject(const openvdb::MaskTree::ConstPtr& voxels,
    const SphereTreeSettings& settings, const CoarseSize& size,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds)
{
    // A level has no more leaf balls than voxels.
    CoarseObject object = detail::timed("pyramid", interrupter, &seconds->pyramid,
        [&] { return pyramidOf(voxels, settings.dim, size.leafBalls, interrupter); });
    LevelQueries queries;
    queries.memory = settings.memory;
    for (;;) {
        const bool isObject = object.steps.empty();
        const MedialLevel medial(*object.levels.back(), settings.dim,
            isObject ? settings.dist() : Distance(), interrupter, seconds, queries);
        object.leaves = detail::timed("leaves", interrupter, &seconds->tree, [&] {
            object.samples = detail::timed("", interrupter, nullptr,
                [&] { return SampledObject(medial.layout, settings.dim == 2, interrupter); });
            return medialLeaves(
                medial, object.samples.level(0), settings.tight().leaves, interrupter);
        });
        if (isObject || int64_t(object.leaves.balls.size()) >= size.leafBalls) return object;
        if (detail::countVoxels(*object.levels.back()) >= size.voxels) return object;
        object.levels.pop_back();
        object.steps.pop_back();
    }
}

} // namespace openvdb_spheretree::tight
