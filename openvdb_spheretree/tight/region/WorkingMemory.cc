// SPDX-License-Identifier: Apache-2.0
#include "WorkingMemory.h"

#include "VoxelRegion.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallReach.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::tight {

WorkingMemory& WorkingMemory::addSamples(std::size_t leafNodes, int dim)
{
    constexpr double kBytes = 84;
    const double levels = dim == 2 ? 1.34 : 1.15; // leaves of all levels, for each of the finest
    bytes += levels * kBytes * double(leafNodes);
    return *this;
}

WorkingMemory& WorkingMemory::addMerging(std::size_t balls)
{
    constexpr double kBytes = 1500; // 1200 to 1800 were measured
    bytes += kBytes * double(balls);
    return *this;
}

WorkingMemory& WorkingMemory::addRegions(const std::vector<ExactSphere>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<RegionSize> sizes(balls.size());
    detail::parallelFor(balls.size(), interrupter, [&](std::size_t i) {
        const ExactSphere& ball = balls[i];
        object.forEachLeaf(ballBox(ball), [&](std::size_t leaf) {
            const auto box = openvdb::CoordBBox::createCube(object.origin(leaf), kLeafDim);
            const BoxReach reach(ball, box);
            sizes[i].leaves += reach.meets(ball);
            sizes[i].whole += reach.isHeldBy(ball);
        });
    });
    for (const RegionSize& size : sizes) addRegion(size);
    return *this;
}

WorkingMemory& WorkingMemory::guessRegions(
    const std::vector<ExactSphere>& balls, std::size_t leafNodes)
{
    constexpr double kOfCube = 0.5236; // a ball of a cube
    for (const ExactSphere& ball : balls) {
        if (ball.empty()) continue;
        const double side = 2 * ball.radius() / double(kFine * kLeafDim) + 1;
        const double inBall = kOfCube * side * side * side;
        const double leaves = std::min(double(leafNodes), inBall);
        // Those that it holds in part are two leaves deep at most; all of the object's may be
        // there.
        const double depth = std::max(0.0, 1 - 4 / side);
        const double parts = std::min(leaves, inBall * (1 - depth * depth * depth));
        addRegion({leaves, leaves - parts});
    }
    return *this;
}

WorkingMemory& WorkingMemory::guessCover(double balls, std::size_t leafNodes, int dim)
{
    // Of a share of 3,000 leaf nodes a ball was seen to meet 4,800 at most; of 500 1,500, of 60
    // 600, of 10 270, and of 0.2 10: those in a cube around it.
    constexpr double kBeyond = 4.6, kTimes = 2.6, kWhole = 0.4;
    const double share = std::pow(double(leafNodes) / balls, 1.0 / dim);
    const double side = std::min(share + kBeyond, 1 + kTimes * share);
    const double leaves = balls * std::min(double(leafNodes), std::pow(side, dim));
    addRegion({leaves, kWhole * leaves});
    return *this;
}

void WorkingMemory::addRegion(const RegionSize& size)
{
    constexpr double kCopies = 2; // of the next coarser level's balls, too
    constexpr double kClaim = 24; // of a ball on a leaf whose voxels are dealt to cells
    bytes += kCopies * regionBytes(size.leaves, size.whole) + kClaim * size.leaves;
}

double regionBytes(double leaves, double whole)
{
    return double(VoxelRegion::kBytesOfLeaf) * leaves + double(sizeof(LeafMask)) * (leaves - whole);
}

bool WorkingMemory::fits(int64_t memory) const { return detail::isAllowed(bytes, memory); }

void WorkingMemory::require(int64_t memory, const std::string& what) const
{
    detail::requireAllowed(bytes, memory, what,
        "use a larger voxel, ask for fewer spheres (spheres=), or use tree=extended");
}

} // namespace openvdb_spheretree::tight
