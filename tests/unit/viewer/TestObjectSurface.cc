// SPDX-License-Identifier: Apache-2.0
/// @file TestObjectSurface.cc
/// @brief The surface that a page shows: where voxels end, not too large, and nothing lost.

#include <openvdb_spheretree/viewer/ObjectSurface.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace {

using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;
using openvdb_spheretree::detail::ObjectSurface;
using openvdb_spheretree::detail::objectSurface;

constexpr int64_t kPlenty = 1000000;

BoolGrid::Ptr voxelsWhere(const CoordBBox& box, const std::function<bool(const Coord&)>& isOn)
{
    const auto grid = BoolGrid::create(false);
    auto access = grid->getAccessor();
    for (auto ijk = box.begin(); ijk; ++ijk) {
        if (isOn(*ijk)) access.setValueOn(*ijk, true);
    }
    return grid;
}

BoolGrid::Ptr ballOf(int radius, const Coord& center = Coord(0))
{
    return voxelsWhere(CoordBBox(center.offsetBy(-radius), center.offsetBy(radius)),
        [&](const Coord& ijk) { return (ijk - center).asVec3d().length() <= radius; });
}

double farthestFrom(const ObjectSurface& surface, double distance)
{
    double worst = 0;
    for (const auto& point : surface.points) {
        worst = std::max(worst, std::abs(Vec3d(point).length() - distance));
    }
    return worst;
}

/// Six times the volume that the quads enclose: positive if they turn left as seen from outside.
double volumeOf(const ObjectSurface& surface)
{
    double volume = 0;
    for (const auto& quad : surface.quads) {
        const Vec3d a(surface.points[quad[0]]), b(surface.points[quad[1]]),
            c(surface.points[quad[2]]), d(surface.points[quad[3]]);
        volume += a.dot(b.cross(c)) + a.dot(c.cross(d));
    }
    return volume / 6;
}

TEST(ObjectSurface, LiesWhereTheVoxelsEnd)
{
    const auto surface = objectSurface(*ballOf(20), kPlenty);
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->factor, 1);
    EXPECT_EQ(surface->growth, 1);
    EXPECT_LE(farthestFrom(*surface, 20), 1.0);
    EXPECT_NEAR(volumeOf(*surface), 4.0 / 3.0 * 3.14159265 * 8000, 0.03 * 33510)
        << "and it is seen from outside";
}

TEST(ObjectSurface, HasNoMoreTrianglesThanAreWanted)
{
    const auto ball = ballOf(40);
    int last = 0;
    for (const int64_t triangles : {100000, 10000, 2000, 500, 60}) {
        const auto surface = objectSurface(*ball, triangles);
        ASSERT_TRUE(surface) << triangles;
        EXPECT_LE(2 * int64_t(surface->quads.size()), triangles);
        EXPECT_GT(surface->quads.size(), 0u);
        EXPECT_GE(surface->factor, last);
        EXPECT_LE(farthestFrom(*surface, 40), surface->factor + 1.0) << triangles;
        last = surface->factor;
    }
    EXPECT_GT(last, 8) << "the last ones are of blocks larger than a leaf node";
}

TEST(ObjectSurface, ASheetOfOneVoxelIsNotLost)
{
    const auto sheet =
        voxelsWhere(CoordBBox(Coord(0), Coord(99, 99, 0)), [](auto&) { return true; });
    const auto surface = objectSurface(*sheet, 3000);
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->factor, 4);
    EXPECT_EQ(surface->growth, 4);
    openvdb::BBoxd box;
    for (const auto& point : surface->points) box.expand(Vec3d(point));
    EXPECT_GT(box.extents()[0], 90);
    EXPECT_GT(box.extents()[1], 90);
}

TEST(ObjectSurface, TilesAreVoxels)
{
    const CoordBBox box(Coord(-16, 0, 8), Coord(15, 31, 71));
    const auto voxels = BoolGrid::create(false), tiles = BoolGrid::create(false);
    tiles->sparseFill(box, true);
    voxels->denseFill(box, true);
    tiles->tree().prune();
    ASSERT_GT(tiles->tree().activeTileCount(), 0u);
    for (const int64_t triangles : {kPlenty, int64_t(5000), int64_t(200)}) {
        const auto a = objectSurface(*tiles, triangles), b = objectSurface(*voxels, triangles);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->factor, b->factor);
        EXPECT_NEAR(volumeOf(*a), volumeOf(*b), 1e-3 * volumeOf(*b));
    }
}

TEST(ObjectSurface, IsAsFineFarFromTheOrigin)
{
    const Coord far(1 << 28, -(1 << 28) + 3, 12345677);
    const auto here = objectSurface(*ballOf(9), kPlenty);
    const auto there = objectSurface(*ballOf(9, far), kPlenty);
    ASSERT_TRUE(here && there);
    ASSERT_EQ(here->points.size(), there->points.size());
    EXPECT_EQ(there->originWorld, far.asVec3d());
    EXPECT_LE(farthestFrom(*there, 9), 1.0);
    EXPECT_NEAR(volumeOf(*here), volumeOf(*there), 0.1);
}

TEST(ObjectSurface, ReachesFromTheFirstCoordinateToTheLast)
{
    const auto ends = BoolGrid::create(false);
    for (const int x : {INT32_MIN, INT32_MAX}) ends->tree().setValueOn(Coord(x, 0, 0), true);
    const auto surface = objectSurface(*ends, kPlenty);
    ASSERT_TRUE(surface);
    double least = 0, most = 0;
    for (const auto& point : surface->points) {
        least = std::min(least, double(point[0]));
        most = std::max(most, double(point[0]));
        EXPECT_LE(std::abs(point[1]), 2.0 * surface->factor);
    }
    const double reach = 0x1p31, block = 2.0 * surface->factor + 1024; // and floats
    EXPECT_NEAR(least, -reach, block);
    EXPECT_NEAR(most, reach, block);
}

TEST(ObjectSurface, IsInWorldUnits)
{
    const auto ball = ballOf(9);
    ball->transform().postScale(0.25);
    ball->transform().postRotate(0.7, openvdb::math::X_AXIS);
    ball->transform().postTranslate({5, 6, 7});
    const auto surface = objectSurface(*ball, kPlenty);
    ASSERT_TRUE(surface);
    EXPECT_LE((surface->originWorld - Vec3d(5, 6, 7)).length(), 1e-12);
    EXPECT_LE(farthestFrom(*surface, 9 * 0.25), 0.25);
    EXPECT_GT(volumeOf(*surface), 0);
    ball->transform().postScale(openvdb::Vec3d(1, -1, 1));
    EXPECT_GT(volumeOf(*objectSurface(*ball, kPlenty)), 0) << "mirrored";
}

TEST(ObjectSurface, ThousandsOfSpecksAreOneSurfaceOrNone)
{
    const auto specks = voxelsWhere(CoordBBox(Coord(0), Coord(63)),
        [](const Coord& c) { return c[0] % 8 == 0 && c[1] % 8 == 0 && c[2] % 8 == 0; });
    const auto fine = objectSurface(*specks, kPlenty);
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->quads.size(), 6u * 512) << "each voxel has six faces";
    const auto coarse = objectSurface(*specks, 200);
    ASSERT_TRUE(coarse);
    EXPECT_LE(coarse->quads.size(), 100u);
    EXPECT_FALSE(objectSurface(*specks, 1)) << "not even a cube has so few";
}

TEST(ObjectSurface, IsTheSameForAnyNumberOfThreads)
{
    const auto ball = ballOf(30);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = objectSurface(*ball, 5000);
    const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 4);
    const auto together = objectSurface(*ball, 5000);
    ASSERT_TRUE(alone && together);
    EXPECT_EQ(alone->points, together->points);
    EXPECT_EQ(alone->quads, together->quads);
}

} // namespace
