// SPDX-License-Identifier: Apache-2.0
#include "QueryBodies.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/query/Collide.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>
#include <filesystem>
#include <random>

namespace spheretree_benchmark {

using namespace openvdb_spheretree;
using openvdb::Vec3d;

namespace {

BodyMesh meshOf(const openvdb::BoolGrid& object)
{
    const auto inside = openvdb::FloatGrid::create(0.0f);
    inside->setTransform(object.transform().copy());
    auto writer = inside->getAccessor();
    for (auto it = object.cbeginValueOn(); it; ++it) {
        openvdb::CoordBBox box;
        it.getBoundingBox(box);
        for (auto voxel = box.beginXYZ(); voxel; ++voxel) writer.setValue(*voxel, 1.0f);
    }
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*inside, points, triangles, quads, 0.5, 0.0);
    BodyMesh mesh;
    for (const auto& p : points) mesh.points.push_back(Vec3d(p));
    for (const auto& t : triangles)
        mesh.triangles.push_back({int32_t(t[0]), int32_t(t[1]), int32_t(t[2])});
    for (const auto& q : quads) {
        mesh.triangles.push_back({int32_t(q[0]), int32_t(q[1]), int32_t(q[2])});
        mesh.triangles.push_back({int32_t(q[0]), int32_t(q[2]), int32_t(q[3])});
    }
    return mesh;
}

double uniform(std::mt19937& random, double low, double high)
{
    return low + (high - low) * (random() / 4294967296.0);
}

Vec3d direction(std::mt19937& random)
{
    const double z = uniform(random, -1, 1), angle = uniform(random, 0, 2 * M_PI),
                 r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

} // namespace

QueryBody queryBody(const std::string& file, Quality quality)
{
    const auto object = objectOf(*readVolFile(file));
    TightOptions options;
    options.quality = quality;
    SphereTree tree = buildSphereTree(*object, options);
    QueryTree query = makeQueryTree(tree);
    QueryTree plain = makeQueryTree(keepLevel(tree, 0), Exactness::LeafUnion);
    return {std::filesystem::path(file).stem().string(), std::move(tree), query, plain,
        meshOf(*object)};
}

std::vector<RigidTransform> posesOf(
    const QueryBody& a, const QueryBody& b, Stratum stratum, int count)
{
    std::mt19937 random(7);
    const double both = a.query.radius() + b.query.radius();
    std::vector<RigidTransform> poses;
    for (int i = 0; i < count; ++i) {
        const auto turn =
            RigidTransform::fromRotation(direction(random), uniform(random, 0, 2 * M_PI));
        const Vec3d along = direction(random);
        const auto at = [&](double offset) {
            return RigidTransform::fromTranslation(
                       a.query.center() + offset * along - turn.rotate(b.query.center()))
                * turn;
        };
        double low = 0, high = both;
        for (int step = 0; step < 30; ++step) {
            const double middle = 0.5 * (low + high);
            (collide(a.query, {}, b.query, at(middle)).isCollision() ? low : high) = middle;
        }
        const double amount = uniform(random, 0, 1);
        double offset = high;
        if (stratum == Stratum::Apart) offset += (0.1 + 0.9 * amount) * both;
        if (stratum == Stratum::Near) offset += 0.05 * amount * both;
        if (stratum == Stratum::Slight) offset -= 0.05 * amount * both;
        if (stratum == Stratum::Deep) offset *= 0.7 * amount;
        poses.push_back(at(offset));
    }
    return poses;
}

std::vector<RigidMotion> motionsTo(
    const QueryBody& a, const QueryBody& b, const std::vector<RigidTransform>& ends)
{
    std::mt19937 random(9);
    const double both = a.query.radius() + b.query.radius();
    std::vector<RigidMotion> motions;
    for (const RigidTransform& end : ends) {
        const auto turn = RigidTransform::fromRotation(direction(random), uniform(random, 0, M_PI));
        const Vec3d center = end * b.query.center(), away = center - a.query.center();
        const Vec3d along = away.length() > 0 ? away / away.length() : Vec3d(1, 0, 0);
        const RigidTransform start = RigidTransform::fromTranslation(a.query.center()
                                         + 1.5 * both * along - turn.rotate(b.query.center()))
            * turn;
        motions.push_back(RigidMotion::screw(start, end));
    }
    return motions;
}

} // namespace spheretree_benchmark
