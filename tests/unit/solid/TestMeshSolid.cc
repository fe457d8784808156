// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshSolid.cc
/// @brief The object of all voxels that a mesh's solid meets: thin, nested, overlapping, inverted and open
/// meshes; what other objects lack of it.

#include "support/Meshes.h"
#include "support/Messages.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/solid/MeshSolid.h>

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;
using openvdb::Vec3I;

class MeshSolid : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

MeshSolidSettings withGap(double gap)
{
    MeshSolidSettings settings;
    settings.gap = gap;
    return settings;
}

int64_t voxelsOf(const BoolGrid& object) { return int64_t(object.activeVoxelCount()); }

/// The voxels whose cubes a box in voxels meets.
CoordBBox voxelsOf(const Vec3d& low, const Vec3d& high)
{
    CoordBBox box;
    for (int axis = 0; axis < 3; ++axis) {
        box.min()[axis] = int32_t(std::ceil(low[axis] - 0.5));
        box.max()[axis] = int32_t(std::floor(high[axis] + 0.5));
    }
    return box;
}

bool isBox(const BoolGrid& object, const CoordBBox& box)
{
    return object.evalActiveVoxelBoundingBox() == box && voxelsOf(object) == int64_t(box.volume());
}

TEST_F(MeshSolid, OfABoxIsEveryVoxelThatItMeets)
{
    const std::pair<Vec3d, Vec3d> boxes[] = {{Vec3d(0.1, 0.2, 0.3), Vec3d(9.4, 20.6, 30)},
        {Vec3d(-40.5, -7, -3.2), Vec3d(-20.5, 0.5, 8)}, // faces between voxels are met by both
        {Vec3d(1, 1, 1), Vec3d(1.3, 60, 70)},           // a plate
        {Vec3d(1.45, 3, -2), Vec3d(1.55, 60, 3)}};
    for (const auto& [low, high] : boxes) {
        for (const bool inverted : {false, true}) {
            const auto object = meshToObject(boxMesh(low, high, inverted), 1);
            EXPECT_TRUE(isBox(*object, voxelsOf(low, high))) << low << high;
            EXPECT_EQ("box", object->getName());
        }
        const auto half = meshToObject(boxMesh(low, high), 0.5);
        EXPECT_TRUE(isBox(*half, voxelsOf(2.0 * low, 2.0 * high))) << low << high;
    }
}

TEST_F(MeshSolid, HoldsWhatIsBoundedTwiceAndWhatIsHollow)
{
    TriangleMesh mesh = boxMesh(Vec3d(0.2), Vec3d(20.3));
    addBox(mesh, Vec3d(5.5), Vec3d(10)); // inside, facing either way
    addBox(mesh, Vec3d(12), Vec3d(15.2), true);
    addBox(mesh, Vec3d(19.7, 3, 3), Vec3d(40, 5, 5)); // overlapping
    const auto object = meshToObject(mesh, 1);
    const CoordBBox large = voxelsOf(Vec3d(0.2), Vec3d(20.3)),
                    arm = voxelsOf(Vec3d(19.7, 3, 3), Vec3d(40, 5, 5));
    int64_t count = 0;
    for (auto voxel = CoordBBox(Coord(-2), Coord(45)).begin(); voxel; ++voxel) {
        const bool inside = large.isInside(*voxel) || arm.isInside(*voxel);
        count += inside;
        ASSERT_EQ(inside, object->tree().isValueOn(*voxel)) << *voxel;
    }
    EXPECT_EQ(count, voxelsOf(*object));
}

TEST_F(MeshSolid, OfTetrahedraHoldsEveryPointOfThem)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> where(-12, 12);
    std::uniform_real_distribution<double> part(0, 1);
    for (int n = 0; n < 40; ++n) {
        TriangleMesh mesh;
        for (int i = 0; i < 4; ++i) {
            mesh.points.emplace_back(where(random), where(random), where(random));
        }
        mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
        const auto object = meshToObject(mesh, 0.7);
        for (int k = 0; k < 2000; ++k) {
            double weight[4], sum = 0;
            for (double& w : weight) sum += w = -std::log(part(random) + 1e-300);
            Vec3d point(0);
            for (int i = 0; i < 4; ++i)
                point += weight[i] / sum * Vec3d(mesh.points[std::size_t(i)]);
            const Coord voxel = Coord::round(object->worldToIndex(point));
            ASSERT_TRUE(object->tree().isValueOn(voxel)) << point;
        }
        // And no more: a voxel of the object has a corner of its cube, or its center, near a point inside.
        const double volume = std::abs((Vec3d(mesh.points[1] - mesh.points[0]))
                                           .cross(Vec3d(mesh.points[2] - mesh.points[0]))
                                           .dot(Vec3d(mesh.points[3] - mesh.points[0])))
            / 6;
        const double shell =
            areaOf(mesh) * 0.7 * std::sqrt(3.0) + 50; // cubes that the surface meets
        EXPECT_LE(double(voxelsOf(*object)) * 0.343, volume + shell);
        EXPECT_GE(double(voxelsOf(*object)) * 0.343, volume);
    }
}

/// Cubes that touch a face of the mesh from within are met by it.
TEST_F(MeshSolid, HoldsOfWholeVoxelsThoseThatNoTriangleMeets)
{
    MeshSolidSettings whole;
    whole.coverage = Coverage::Whole;
    const TriangleMesh mesh = boxMesh(Vec3d(-0.2), Vec3d(20.5, 10.6, 7));
    EXPECT_TRUE(isBox(*meshToObject(mesh, 1, whole), CoordBBox(Coord(1), Coord(19, 10, 6))));
    const std::string message = messageOf<openvdb::ValueError>(
        [&] { meshToObject(boxMesh(Vec3d(0), Vec3d(20, 1.2, 20)), 1, whole); });
    EXPECT_TRUE(mentions(message, "no voxel of 1 lies wholly inside mesh 'box'")) << message;
    MeshSolidSettings centers;
    centers.coverage = Coverage::Centers;
    EXPECT_THROW(meshToObject(mesh, 1, centers), openvdb::ValueError);
}

/// A room that a neck narrower than a voxel leads to is outside, and so is a hollow.
TEST_F(MeshSolid, HoldsNoWholeVoxelOfARoomOrAHollow)
{
    MeshSolidSettings whole;
    whole.coverage = Coverage::Whole;
    const CoordBBox room(Coord(-9), Coord(9));
    const auto expectShell = [&](const TriangleMesh& mesh) {
        const auto object = meshToObject(mesh, 1, whole);
        for (auto voxel = room.begin(); voxel; ++voxel) {
            ASSERT_FALSE(object->tree().isValueOn(*voxel)) << *voxel;
        }
        EXPECT_TRUE(object->tree().isValueOn(Coord(15)));
        EXPECT_EQ(CoordBBox(Coord(-19), Coord(19)), object->evalActiveVoxelBoundingBox());
        EXPECT_TRUE(meshToObject(mesh, 1)->tree().isValueOn(Coord(0))) << "on the safe side there";
    };
    TriangleMesh hollow = boxMesh(Vec3d(-20.3), Vec3d(20.3));
    addBox(hollow, Vec3d(-10.3), Vec3d(10.3), /*inverted=*/true);
    expectShell(hollow);

    // A bottle: of both lids, a hole is left, and a neck joins the two.
    TriangleMesh bottle;
    bottle.name = "bottle";
    const double n = 0.2;
    const auto quad = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
        const auto first = uint32_t(bottle.points.size());
        for (const Vec3d& p : {a, b, c, d}) bottle.points.emplace_back(p);
        bottle.triangles.emplace_back(first, first + 1, first + 2);
        bottle.triangles.emplace_back(first, first + 2, first + 3);
    };
    const auto shell = [&](double s, bool out) { // all but the lid, and the lid around the hole
        TriangleMesh box = boxMesh(Vec3d(-s), Vec3d(s), !out);
        box.triangles.erase(box.triangles.begin() + 2, box.triangles.begin() + 4);
        const auto first = uint32_t(bottle.points.size());
        bottle.points.insert(bottle.points.end(), box.points.begin(), box.points.end());
        for (const Vec3I& t : box.triangles) bottle.triangles.push_back(t + Vec3I(first));
        const std::pair<double, double> around[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        for (int i = 0; i < 4; ++i) {
            const auto [x0, y0] = around[i];
            const auto [x1, y1] = around[(i + 1) % 4];
            const Vec3d a(s * x0, s * y0, s), b(s * x1, s * y1, s), c(n * x1, n * y1, s),
                d(n * x0, n * y0, s);
            out ? quad(a, b, c, d) : quad(a, d, c, b);
        }
    };
    shell(20.3, true);
    shell(10.3, false);
    const std::pair<double, double> around[] = {{-n, -n}, {n, -n}, {n, n}, {-n, n}};
    for (int i = 0; i < 4; ++i) { // the neck faces its own middle
        const auto [x0, y0] = around[i];
        const auto [x1, y1] = around[(i + 1) % 4];
        quad({x0, y0, 10.3}, {x0, y0, 20.3}, {x1, y1, 20.3}, {x1, y1, 10.3});
    }
    ASSERT_GT(openEdges(bottle), 0) << "corners are given anew for each face";
    expectShell(bottle);
}

/// A box of walls without thickness, with a square hole in its lid.
TriangleMesh openBox(double width)
{
    TriangleMesh mesh = boxMesh(Vec3d(0), Vec3d(40));
    mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4); // at z = 40
    const double low = 20 - width / 2, high = 20 + width / 2;
    const auto rectangle = [&](double x0, double y0, double x1, double y1) {
        const auto first = uint32_t(mesh.points.size());
        for (const auto& [x, y] : {std::pair(x0, y0), {x1, y0}, {x1, y1}, {x0, y1}}) {
            mesh.points.emplace_back(float(x), float(y), 40.f);
        }
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
    };
    rectangle(0, 0, 40, low);
    rectangle(0, high, 40, 40);
    rectangle(0, low, low, high);
    rectangle(high, low, 40, high);
    return mesh;
}

/// A ball dips into a hole that it does not pass: somewhat is missing of the lid.
TEST_F(MeshSolid, WithAGapClosesHolesOfThatWidth)
{
    const int64_t full = 41 * 41 * 41;
    const std::pair<double, double> widthsAndPassing[] = {{3, 0}, {6, 1}, {9, 3}};
    for (const auto& [width, passing] : widthsAndPassing) {
        const TriangleMesh mesh = openBox(width);
        EXPECT_GT(full / 4, voxelsOf(*meshToObject(mesh, 1))) << width; // its walls
        EXPECT_GT(full / 4, voxelsOf(*meshToObject(mesh, 1, withGap(passing)))) << width;
        const auto closed = meshToObject(mesh, 1, withGap(width));
        EXPECT_LE(full - 81, voxelsOf(*closed)) << width;
        EXPECT_TRUE(closed->tree().isValueOn(Coord(20, 20, 38))) << width;
        EXPECT_EQ(CoordBBox(Coord(0), Coord(40)), closed->evalActiveVoxelBoundingBox());
    }
}

/// A part of a fifth of the area, and a ninth of the volume.
TEST_F(MeshSolid, SaysThatAPartIsHollow)
{
    TriangleMesh parts = openBox(20);
    addBox(parts, Vec3d(100), Vec3d(180));
    const auto warning = [](const TriangleMesh& mesh, double gap) {
        return hollowWarning(mesh, *meshToObject(mesh, 1, withGap(gap)), gap);
    };
    EXPECT_TRUE(mentions(warning(parts, 3), "its object lacks 7% of what it bounds"))
        << warning(parts, 3);
    EXPECT_TRUE(
        mentions(warning(parts, 3), "gap=3, so make gap larger (the widest hole measures "));
    EXPECT_EQ("", warning(parts, 21));
    EXPECT_EQ("", warning(boxMesh(Vec3d(0), Vec3d(40, 40, 2)), 3)) << "it is closed";
    EXPECT_TRUE(mentions(warning(openBox(20), 3), "nothing inside"));
}

/// Slits in any direction, as wide as they may be: nothing gets in.
TEST_F(MeshSolid, WithAGapClosesSlitsThatAreTurned)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> angle(0, 6), between(0, 1);
    for (int n = 0; n < 30; ++n) {
        const double gap = 1 + 5 * between(random);
        TriangleMesh mesh = boxMesh(Vec3d(-14), Vec3d(14));
        mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4); // at z = 14
        const auto half = [&](double x0, double x1) {
            const auto first = uint32_t(mesh.points.size());
            mesh.points.emplace_back(float(x0), -14.f, 14.f);
            mesh.points.emplace_back(float(x1), -14.f, 14.f);
            mesh.points.emplace_back(float(x1), 14.f, 14.f);
            mesh.points.emplace_back(float(x0), 14.f, 14.f);
            mesh.triangles.emplace_back(first, first + 1, first + 2);
            mesh.triangles.emplace_back(first, first + 2, first + 3);
        };
        const double slit = 4 * between(random);
        half(-14, slit);
        half(slit + 0.999 * gap, 14);
        const openvdb::Mat3d turn =
            openvdb::math::rotation<openvdb::Mat3d>(openvdb::math::X_AXIS, angle(random))
            * openvdb::math::rotation<openvdb::Mat3d>(openvdb::math::Z_AXIS, angle(random));
        const Vec3d shift(between(random), between(random), between(random));
        for (Vec3d& point : mesh.points) point = Vec3d(turn * Vec3d(point) + shift);
        const auto closed = meshToObject(mesh, 1, withGap(gap));
        EXPECT_TRUE(closed->tree().isValueOn(Coord::round(shift))) << n << ' ' << gap;
        EXPECT_GT(voxelsOf(*closed), 26 * 26 * 26) << n << ' ' << gap;
    }
}

/// What a ball cannot reach from outside is the closing of the solid: nothing is added to a convex one.
TEST_F(MeshSolid, WithAGapHoldsTheSameOfAConvexSolid)
{
    const TriangleMesh mesh = boxMesh(Vec3d(0.2), Vec3d(90, 20, 35.3));
    EXPECT_TRUE(
        meshToObject(mesh, 1)->tree().hasSameTopology(meshToObject(mesh, 1, withGap(7))->tree()));
    const auto plain = meshToObject(mesh, 1), closed = meshToObject(mesh, 1, withGap(7));
    EXPECT_EQ(voxelsOf(*plain), voxelsOf(*closed));
    EXPECT_EQ(plain->evalActiveVoxelBoundingBox(), closed->evalActiveVoxelBoundingBox());
}

TEST_F(MeshSolid, TellsWhatAnotherObjectLacks)
{
    const TriangleMesh mesh = boxMesh(Vec3d(0.2), Vec3d(20.3));
    const auto object = meshToObject(mesh, 1);
    EXPECT_EQ(0, missedSurface(mesh, *object).voxels);
    EXPECT_EQ(0, missedSurface(mesh, *object).distance);
    const auto small = BoolGrid::create(false); // 4 voxels less at x = 20
    small->fill(CoordBBox(Coord(0), Coord(16, 20, 20)), true);
    const MissedSurface missed = missedSurface(mesh, *small);
    // Of x = 18 to 20: 17 is beside the object.
    EXPECT_EQ(2 * (21 * 21 - 19 * 19) + 21 * 21, missed.voxels);
    EXPECT_EQ(4, missed.distance);
}

TEST_F(MeshSolid, RefusesWhatIsOutOfRange)
{
    const TriangleMesh mesh = boxMesh(Vec3d(0), Vec3d(10));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double size : {0.0, -1.0, nan, 1e-300}) {
        EXPECT_THROW(meshToObject(mesh, size), openvdb::ValueError) << size;
    }
    for (const double gap : {-1.0, nan, 127.0}) {
        const std::string message =
            messageOf<openvdb::ValueError>([&] { meshToObject(mesh, 1, withGap(gap)); });
        EXPECT_TRUE(mentions(message, "is out of range: it must be 0 to 125 voxels")) << message;
    }
    TriangleMesh bad = mesh;
    bad.points[3][1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(meshToObject(bad, 1), openvdb::ValueError);
    bad = mesh;
    bad.points[3] = Vec3d(3e9f, 0, 0);
    EXPECT_THROW(meshToObject(bad, 1), openvdb::ValueError);
    EXPECT_THROW(meshToObject(TriangleMesh(), 1), openvdb::ValueError);
}

struct Stop : openvdb::util::NullInterrupter {
    bool wasInterrupted(int) override { return true; }
};

TEST_F(MeshSolid, RefusesWhatWouldNotFitThisMachineWithTheNumberOfVoxels)
{
    const TriangleMesh mesh = boxMesh(Vec3d(0), Vec3d(5e5));
    const std::string message = messageOf<openvdb::ValueError>([&] { meshToObject(mesh, 1); });
    EXPECT_TRUE(
        mentions(message, "the surface of mesh 'box', in a box of 1.3e+17 voxels, need about"))
        << message;
}

TEST_F(MeshSolid, RefusesPartsSoFarApartThatTheirNodesWouldNotFit)
{
    std::mt19937 random(1);
    TriangleMesh dust;
    const auto number = [&] { return float(random() % (1u << 28)); };
    for (int i = 0; i < 1000000; ++i) {
        const Vec3d at(number(), number(), number());
        const auto first = uint32_t(dust.points.size());
        for (const Vec3d& off : {Vec3d(0), Vec3d(32, 0, 0), Vec3d(0, 32, 0)}) {
            dust.points.push_back(at + off);
        }
        dust.triangles.push_back({first, first + 1, first + 2});
    }
    Stop stop; // before any work
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { meshToObject(dust, 1, {}, &stop); }), "need about"));
}

TEST_F(MeshSolid, StopsWhenAskedTo)
{
    Stop stop;
    EXPECT_THROW(meshToObject(boxMesh(Vec3d(0), Vec3d(9)), 1, {}, &stop), Interrupted);
}

} // namespace
