// SPDX-License-Identifier: Apache-2.0
/// @file StoredReach.cc
/// @brief Branch and bound over cells, as the header says.

#include "StoredReach.h"

#include "LeafReach.h"
#include <openvdb_spheretree/base/AtomicExtremes.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;
using Point = std::array<double, 3>;
using Block = NearestVoxel::Block;

constexpr double kFinest = 1.0 / 32, kFinestOfNorm = 1.0 / 4; // voxels
/// Longer lists of spheres are not worth the second bound, unless cells are small.
constexpr std::size_t kFewSpheres = 16;
/// Cells larger than this are seldom enough to ask the interrupter at each.
constexpr double kSeldom = 4;

/// A cube of space; with a flat axis a square, whose lo and hi are the same there.
struct Cell {
    Point lo, hi;
    double size;

    Point middle() const
    {
        Point point;
        for (int a = 0; a < 3; ++a) point[a] = 0.5 * (lo[a] + hi[a]);
        return point;
    }
};

/// A cell that is to be halved.
struct Task {
    Cell cell;
    std::vector<int32_t> spheres; ///< that meet it; none of interest if one holds all of it
    bool held = false;            ///< by one sphere
    Block block;                  ///< nearest to its middle
    double bound = 0;
};

/// How far an interval reaches out of another one at most.
double largestGap(double lo, double hi, double blockLo, double blockHi)
{
    return std::max({blockLo - lo, hi - blockHi, 0.0});
}

/// @return the largest value of gap(p)^2 - t (p - c)^2 for p in [lo, hi], where gap is the distance
///         to [blockLo, blockHi]. Its three pieces are parabolas, so it is at an end of a piece or
///         where a parabola turns. (All these are in [lo, hi], so too many do no harm.)
double largestTerm(double lo, double hi, double blockLo, double blockHi, double t, double c)
{
    const auto clamped = [](double p, double from, double to) {
        return std::max(from, std::min(p, to));
    };
    const auto value = [&](double p) {
        const double gap = std::max({blockLo - p, p - blockHi, 0.0});
        return gap * gap - t * (p - c) * (p - c);
    };
    double most = std::max(value(lo), value(hi));
    const auto look = [&](double p) { most = std::max(most, value(clamped(p, lo, hi))); };
    look(blockLo);
    look(blockHi);
    look(clamped(c, blockLo, blockHi));
    if (t > 1) {
        look((blockLo - t * c) / (1 - t));
        look((blockHi - t * c) / (1 - t));
    }
    return most;
}

class ReachSearch {
public:
    ReachSearch(const std::vector<ReachSphere>& spheres, const openvdb::MaskTree& object,
        const NearestVoxel& solid, int flatAxis, openvdb::util::NullInterrupter* interrupter)
        : mSpheres(spheres), mMask(object), mSolid(solid), mFlatAxis(flatAxis),
          mPlane(flatAxis < 0 ? 0 : spheres.front().center[flatAxis]), mInterrupter(interrupter),
          mUnit(solid.distance().unit()), mEuclidean(solid.distance().isEuclidean()),
          mFinest(mEuclidean ? kFinest : kFinestOfNorm)
    {}

    double best() const { return mBest.load(std::memory_order_relaxed); }

    /// Step 1, for up to about a thousand spheres: from the poles, outward along the sphere.
    void seed();

    /// A node of the touched voxels, and which spheres meet it.
    struct PlacedNode {
        std::size_t node;
        openvdb::CoordBBox box;
        std::vector<int32_t> spheres;
    };
    /// Gives each node those of @a candidates that meet it; reorders the nodes.
    void shareOut(std::vector<PlacedNode>::iterator begin, std::vector<PlacedNode>::iterator end,
        const std::vector<int32_t>& candidates) const;

    /// Memory of a thread, for each depth of the recursion.
    struct Halves {
        std::array<Task, 8> tasks;
        std::vector<int> order;
    };
    /// For each block of 4^3 leaves in a cube of 128 voxels: whether one query has dismissed it; none where it was not
    /// asked. B only grows, so a block that is dismissed stays so.
    struct NearBlocks {
        static constexpr int32_t kCube = 128, kBlock = 32, kAcross = kCube / kBlock;
        openvdb::Coord cube = openvdb::Coord::max();
        std::array<std::optional<bool>, kAcross * kAcross * kAcross> isNear;
    };
    struct Scratch {
        std::vector<std::unique_ptr<Halves>> depths;
        std::vector<VoxelCube> cubes;
        NearBlocks blocks;
        LeafReach reach;
    };

    /// Steps 2 to 4 for a node of @a touched. @param spheres  those that meet it
    void visitNode(const MaskMinus& touched, std::size_t node, const std::vector<int32_t>& spheres,
        Scratch& scratch);

private:
    bool isNear(const Coord& origin, int32_t size) const;
    bool isInNearBlock(const Coord& leaf, NearBlocks& blocks) const;
    void visitGroup(const std::vector<const VoxelCube*>& cubes, int32_t size,
        const std::vector<int32_t>& spheres, Scratch& scratch);
    void visitCube(const VoxelCube& cube, const std::vector<int32_t>& spheres, Scratch& scratch);
    void visit(const Task& task, Scratch& scratch, std::size_t depth = 0);
    Cell cellOf(const Coord& origin, int32_t size) const;
    /// @return B, squared, in the integers of squared distances of voxels; rounded down.
    int64_t bestSq() const
    {
        constexpr double kLess = 1 - 1e-12;
        const double most = mUnit * best();
        return int64_t(most * most * kLess);
    }
    const std::vector<int>& halve(const Task& task, Halves& halves);
    bool bound(const Task& above, Task& task);
    bool meet(const std::vector<int32_t>& candidates, Task& task) const;
    double largestDistance(const Cell& cell, const Block& block) const;
    double largestHeldDistance(const Task& task) const;
    double boundOfSphere(const Task& task, const ReachSphere& sphere) const;
    Cell part(const Cell& cell, int octant) const;
    std::vector<int32_t> spheresNear(
        const openvdb::CoordBBox& box, const std::vector<int32_t>& candidates) const;

    const std::vector<ReachSphere>& mSpheres;
    const openvdb::MaskTree& mMask;
    const NearestVoxel& mSolid;
    const int mFlatAxis;
    const double mPlane; ///< where the flat axis has it
    openvdb::util::NullInterrupter* const mInterrupter;
    const double mUnit; ///< of a voxel, in the metric
    const bool mEuclidean;
    const double mFinest;
    std::atomic<double> mBest{0}; ///< B, in voxels
};

void ReachSearch::seed()
{
    constexpr std::size_t kMost = 1024;
    constexpr int kSteps = 4;
    constexpr double kLess = 1 - 1e-12; // a point of the sphere, however rounded
    const std::size_t step = (mSpheres.size() + kMost - 1) / kMost;
    const auto seedAt = [&](const ReachSphere& sphere, const Vec3d& direction) {
        Vec3d way = direction;
        for (int i = 0; i < (mEuclidean ? kSteps : 1); ++i) {
            const Vec3d point = sphere.center + kLess * sphere.radius * way;
            Block block;
            raiseTo(mBest, mSolid.nearestBlock(point.asPointer(), block) / mUnit);
            for (int a = 0; a < 3; ++a) { // away from what is nearest
                way[a] = point[a] - std::max(block.lo[a], std::min(point[a], block.hi[a]));
            }
            if (!way.normalize()) return;
        }
    };
    parallelFor(mSpheres.size() / step, mInterrupter, [&](std::size_t i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (axis == mFlatAxis) continue;
            Vec3d pole(0);
            for (const double side : {-1.0, 1.0}) {
                pole[axis] = side;
                seedAt(mSpheres[i * step], pole);
            }
        }
    });
}

/// The cell of voxels: their cubes; with a flat axis, in the plane of the voxels.
Cell ReachSearch::cellOf(const Coord& origin, int32_t size) const
{
    Cell cell;
    cell.size = size;
    for (int a = 0; a < 3; ++a) {
        const bool flat = a == mFlatAxis;
        cell.lo[a] = flat ? mPlane : origin[a] - 0.5;
        cell.hi[a] = flat ? mPlane : cell.lo[a] + size;
    }
    return cell;
}

/// @return whether no voxel of a cube is farther than B, for all that one query tells.
bool ReachSearch::isNear(const Coord& origin, int32_t size) const
{
    return mSolid.areAllWithin(openvdb::CoordBBox::createCube(origin, size), 2 * mUnit * best());
}

/// Where B is many voxels, one query for a block spares those for its leaves.
bool ReachSearch::isInNearBlock(const Coord& leaf, NearBlocks& blocks) const
{
    const Coord cube = leaf & ~(NearBlocks::kCube - 1);
    if (cube != blocks.cube) blocks = {cube, {}};
    std::size_t place = 0;
    for (int a = 0; a < 3; ++a) {
        place = place * NearBlocks::kAcross + std::size_t((leaf[a] - cube[a]) / NearBlocks::kBlock);
    }
    std::optional<bool>& known = blocks.isNear[place];
    if (!known) known = isNear(leaf & ~(NearBlocks::kBlock - 1), NearBlocks::kBlock);
    return *known;
}

void ReachSearch::visitNode(const MaskMinus& touched, std::size_t node,
    const std::vector<int32_t>& spheres, Scratch& scratch)
{
    touched.cubes(node, scratch.cubes);
    std::vector<const VoxelCube*> cubes;
    int32_t size = 2 * kLeafDim;
    for (VoxelCube& cube : scratch.cubes) {
        if (cube.size == kLeafDim) {
            if (isInNearBlock(cube.origin, scratch.blocks)) continue;
            if (isNear(cube.origin, kLeafDim)) continue;
            scratch.reach.takeNear(mMask, mSolid.distance(), bestSq(), cube.origin, cube.mask);
            if (cube.mask.none()) continue;
        }
        size = std::max(size, 2 * cube.size);
        cubes.push_back(&cube);
    }
    if (!cubes.empty()) visitGroup(cubes, std::max(size, 128), spheres, scratch);
}

/// @param size  that of an aligned cube around them all. Recursion: from 8192 to 8 in ten halvings.
void ReachSearch::visitGroup(const std::vector<const VoxelCube*>& cubes, int32_t size,
    const std::vector<int32_t>& spheres, Scratch& scratch)
{
    checkInterrupt(mInterrupter);
    openvdb::CoordBBox box;
    for (const VoxelCube* cube : cubes) {
        box.expand(openvdb::CoordBBox::createCube(cube->origin, cube->size));
    }
    const std::vector<int32_t> near = spheresNear(box, spheres);
    if (near.empty()) return;
    if (cubes.size() == 1) return visitCube(*cubes.front(), near, scratch);
    std::array<std::vector<const VoxelCube*>, 8> parts;
    const int32_t half = size / 2;
    for (const VoxelCube* cube : cubes) {
        const Coord& o = cube->origin;
        parts[(o[0] & half ? 4 : 0) | (o[1] & half ? 2 : 0) | (o[2] & half ? 1 : 0)].push_back(
            cube);
    }
    for (const auto& part : parts) {
        if (!part.empty()) visitGroup(part, half, near, scratch);
    }
}

/// A voxel's bound is its distance to the nearest voxel of the object, as above. (Where B is more
/// than LeafReach knows of, one search settles many voxels, as in FarthestVoxel.cc.)
void ReachSearch::visitCube(
    const VoxelCube& cube, const std::vector<int32_t>& spheres, Scratch& scratch)
{
    Task above, task;
    above.spheres = spheres;
    if (cube.size > kLeafDim) {
        above.cell = cellOf(cube.origin, cube.size);
        above.bound = std::numeric_limits<double>::infinity();
        return visit(above, scratch);
    }
    LeafMask left = cube.mask;
    scratch.reach.takeNear(mMask, mSolid.distance(), bestSq(), cube.origin, left);
    while (!left.none()) {
        const Coord voxel = VoxelCube{cube.origin, kLeafDim, left}.first();
        Coord nearest;
        const int64_t nearSq = scratch.reach.nearest(voxel, nearest);
        above.bound = nearSq >= 0 ? std::sqrt(double(nearSq)) / mUnit
                                  : 0.5 * std::sqrt(double(mSolid.nearest(voxel, nearest))) / mUnit;
        if (above.bound > best()) {
            LeafMask visited{};
            visited.setOn(leafIndex(voxel));
            left -= visited;
            above.block = NearestVoxel::blockOf(nearest);
            task.cell = cellOf(voxel, 1);
            if (bound(above, task)) visit(task, scratch);
            continue;
        }
        LeafMask settled = voxelsOf(ExactSphere::around(nearest, 4 * bestSq()), /*shift=*/1,
            cube.origin, mSolid.distance());
        settled.setOn(leafIndex(voxel));
        left -= settled;
    }
}

/// Recursion: from 4096 voxels to 1/32 in 17 halvings.
void ReachSearch::visit(const Task& task, Scratch& scratch, std::size_t depth)
{
    if (task.bound <= best()) return;
    if (task.cell.size <= mFinest) return raiseTo(mBest, task.bound);
    if (task.cell.size > kSeldom) checkInterrupt(mInterrupter);
    if (scratch.depths.size() == depth) scratch.depths.push_back(std::make_unique<Halves>());
    Halves& halves = *scratch.depths[depth];
    for (const int i : halve(task, halves)) visit(halves.tasks[i], scratch, depth + 1);
}

/// @return those of @a candidates that meet the cubes of the voxels of a box.
std::vector<int32_t> ReachSearch::spheresNear(
    const openvdb::CoordBBox& box, const std::vector<int32_t>& candidates) const
{
    constexpr double kMore = 1 + 1e-12; // whatever was rounded, no sphere is left out
    std::vector<int32_t> near;
    for (const int32_t i : candidates) {
        const ReachSphere& sphere = mSpheres[i];
        double gap[3];
        for (int a = 0; a < 3; ++a) {
            gap[a] = std::max({box.min()[a] - 0.5 - sphere.center[a],
                sphere.center[a] - box.max()[a] - 0.5, 0.0});
        }
        const double away = mSolid.distance().length(gap[0], gap[1], gap[2]);
        if (away <= mUnit * sphere.radius * kMore) near.push_back(i);
    }
    return near;
}

/// Recursion: as deep as the logarithm of the nodes.
void ReachSearch::shareOut(std::vector<PlacedNode>::iterator begin,
    std::vector<PlacedNode>::iterator end, const std::vector<int32_t>& candidates) const
{
    checkInterrupt(mInterrupter);
    openvdb::CoordBBox box;
    for (auto node = begin; node != end; ++node) box.expand(node->box);
    std::vector<int32_t> near = spheresNear(box, candidates);
    if (end - begin == 1) {
        begin->spheres = std::move(near);
        return;
    }
    const auto sides = sidesOf(box);
    const auto axis = int(std::max_element(sides.begin(), sides.end()) - sides.begin());
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [axis](const PlacedNode& a, const PlacedNode& b) {
        return a.box.min()[axis] < b.box.min()[axis];
    });
    shareOut(begin, middle, near);
    shareOut(middle, end, near);
}

Cell ReachSearch::part(const Cell& cell, int octant) const
{
    Cell result = cell;
    result.size = 0.5 * cell.size;
    const Point middle = cell.middle();
    for (int a = 0; a < 3; ++a) {
        if (a != mFlatAxis) (octant >> a & 1 ? result.lo : result.hi)[a] = middle[a];
    }
    return result;
}

/// @return which halves may reach beyond B, those that may reach farthest first.
const std::vector<int>& ReachSearch::halve(const Task& task, Halves& halves)
{
    halves.order.clear();
    for (int octant = 0; octant < 8; ++octant) {
        if (mFlatAxis >= 0 && octant >> mFlatAxis & 1) continue;
        Task& half = halves.tasks[octant];
        half.cell = part(task.cell, octant);
        if (bound(task, half)) halves.order.push_back(octant);
    }
    std::sort(halves.order.begin(), halves.order.end(),
        [&](int a, int b) { return halves.tasks[a].bound > halves.tasks[b].bound; });
    return halves.order;
}

/// Fills in a task that has its cell: first by the block of the task above, which often will do.
/// @return whether it may reach beyond B.
bool ReachSearch::bound(const Task& above, Task& task)
{
    task.block = above.block;
    task.bound = std::min(above.bound, largestDistance(task.cell, task.block));
    if (task.bound <= best()) return false;
    task.held = above.held;
    task.spheres.clear();
    if (!task.held && !meet(above.spheres, task)) return false;
    task.bound = std::min(task.bound, largestHeldDistance(task));
    if (task.bound <= best()) return false;
    const Point middle = task.cell.middle();
    mSolid.nearestBlock(middle.data(), task.block);
    if (task.block == above.block) return true;
    task.bound =
        std::min({task.bound, largestDistance(task.cell, task.block), largestHeldDistance(task)});
    return task.bound > best();
}

/// Finds the spheres that meet the cell of a task. @return whether any does.
bool ReachSearch::meet(const std::vector<int32_t>& candidates, Task& task) const
{
    constexpr double kMore = 1 + 1e-12; // whatever was rounded, no sphere is left out
    const Cell& cell = task.cell;
    for (const int32_t i : candidates) {
        const ReachSphere& sphere = mSpheres[i];
        double near[3], far[3];
        for (int a = 0; a < 3; ++a) {
            const double below = cell.lo[a] - sphere.center[a];
            const double above = sphere.center[a] - cell.hi[a];
            near[a] = std::max({below, above, 0.0});
            far[a] = std::max(std::abs(below), std::abs(above));
        }
        const Distance& metric = mSolid.distance();
        const double reach = mUnit * sphere.radius;
        if (metric.length(near[0], near[1], near[2]) > reach * kMore) continue;
        task.held = metric.length(far[0], far[1], far[2]) <= reach;
        if (task.held) {
            task.spheres.clear(); // the others add nothing
            return true;
        }
        task.spheres.push_back(i);
    }
    return !task.spheres.empty();
}

/// @return the largest distance of a point of a cell to a block.
double ReachSearch::largestDistance(const Cell& cell, const Block& block) const
{
    if (block.empty()) return std::numeric_limits<double>::infinity();
    double gap[3];
    for (int a = 0; a < 3; ++a) {
        gap[a] = largestGap(cell.lo[a], cell.hi[a], block.lo[a], block.hi[a]);
    }
    return mSolid.distance().length(gap[0], gap[1], gap[2]) / mUnit;
}

/// @return the same of those points that are in spheres, or something larger.
double ReachSearch::largestHeldDistance(const Task& task) const
{
    constexpr double kNoBound = std::numeric_limits<double>::infinity();
    const bool few = task.spheres.size() <= kFewSpheres || task.cell.size <= 1;
    if (task.held || !mEuclidean || !few || task.block.empty()) return kNoBound;
    double most = 0;
    for (const int32_t i : task.spheres) most = std::max(most, boundOfSphere(task, mSpheres[i]));
    return most;
}

double ReachSearch::boundOfSphere(const Task& task, const ReachSphere& sphere) const
{
    const Cell& cell = task.cell;
    const Block& block = task.block;
    double awaySq = 0, gapSq = 0; // of the cell's middle
    for (int a = 0; a < 3; ++a) {
        const double at = 0.5 * (cell.lo[a] + cell.hi[a]);
        const double gap = largestGap(at, at, block.lo[a], block.hi[a]);
        awaySq += (at - sphere.center[a]) * (at - sphere.center[a]);
        gapSq += gap * gap;
    }
    constexpr double kLeast = 1e-6, kMost = 16; // any multiplier gives a bound
    const double aligned = std::sqrt(gapSq / std::max(awaySq, kLeast));
    double least = std::numeric_limits<double>::infinity();
    // Where a point sticks out aslant, or the cell is no small one, other multipliers are better.
    for (const double factor : {1.0, 0.5, 2.0}) {
        const double t = std::min(kMost, factor * aligned);
        const double tightness = t * sphere.radius * sphere.radius;
        constexpr double kRounding = 1 + 1e-13; // the terms may cancel out
        double sum = tightness * kRounding;
        for (int a = 0; a < 3; ++a) {
            sum +=
                largestTerm(cell.lo[a], cell.hi[a], block.lo[a], block.hi[a], t, sphere.center[a]);
        }
        least = std::min(least, sum);
    }
    return std::sqrt(std::max(0.0, least));
}

} // namespace

double storedReach(const std::vector<ReachSphere>& spheres, const MaskMinus& touched,
    const openvdb::MaskTree& object, const NearestVoxel& solid, int flatAxis,
    openvdb::util::NullInterrupter* interrupter)
{
    if (spheres.empty() || touched.nodeCount() == 0) return 0;
    ReachSearch search(spheres, object, solid, flatAxis, interrupter);
    search.seed();
    std::vector<ReachSearch::PlacedNode> nodes;
    for (std::size_t i = 0; i < touched.nodeCount(); ++i) nodes.push_back({i, touched.box(i), {}});
    std::vector<int32_t> all(spheres.size());
    std::iota(all.begin(), all.end(), 0);
    search.shareOut(nodes.begin(), nodes.end(), all);
    parallelForWithScratch<ReachSearch::Scratch>(
        nodes.size(), interrupter, [&](std::size_t i, ReachSearch::Scratch& scratch) {
            search.visitNode(touched, nodes[i].node, nodes[i].spheres, scratch);
        });
    if (search.best() == 0) return 0;
    // More than all that doubles may be off: by a share of the reach, and of the radii it is a difference of.
    constexpr double kRounding = 1 + 1e-12, kOfRadius = 1e-14;
    double largest = 0;
    for (const ReachSphere& sphere : spheres) largest = std::max(largest, sphere.radius);
    return search.best() * kRounding + largest * kOfRadius;
}

} // namespace openvdb_spheretree::detail
