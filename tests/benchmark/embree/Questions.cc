// SPDX-License-Identifier: Apache-2.0
#include "Questions.h"

#include <cmath>

namespace spheretree_benchmark {

using openvdb::Vec3d;
using openvdb::Vec3s;

namespace {

constexpr int kSide = 141; // rays of a camera in a row: nearly kQuestions in all

FloatRay aimed(const Vec3d& from, const Vec3d& at)
{
    return {Vec3s(from), Vec3s((at - from).unit())};
}

} // namespace

Questions::Questions(const openvdb_spheretree::QueryTree& tree)
{
    for (int32_t i = 0; i < tree.leafCount(); ++i) {
        mBox.expand(tree.leafCenter(i) - Vec3d(tree.leafRadius(i)));
        mBox.expand(tree.leafCenter(i) + Vec3d(tree.leafRadius(i)));
    }
    mRadius = (mBox.max() - mBox.min()).length() / 2;
}

double Questions::unit() { return double(mRandom()) / 4294967296.0; }

Vec3d Questions::normal()
{
    std::normal_distribution<double> gauss;
    const double x = gauss(mRandom), y = gauss(mRandom);
    return Vec3d(x, y, gauss(mRandom));
}

Vec3d Questions::placeIn(double times)
{
    Vec3d place;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = mBox.max()[axis] - mBox.min()[axis];
        place[axis] = mBox.getCenter()[axis] + times * (unit() - 0.5) * side;
    }
    return place;
}

std::vector<FloatRay> Questions::raysFromAround()
{
    std::vector<FloatRay> rays;
    for (int i = 0; i < kQuestions; ++i) {
        const Vec3d from = mBox.getCenter() + 1.5 * mRadius * normal().unit();
        rays.push_back(aimed(from, placeIn(1)));
    }
    return rays;
}

std::vector<FloatRay> Questions::raysOfCamera() const
{
    const Vec3d eye = mBox.getCenter() + mRadius * Vec3d(1.2, 0.6, 2),
                size = mBox.max() - mBox.min();
    std::vector<FloatRay> rays;
    for (int i = 0; i < kSide * kSide; ++i) {
        const double u = (i % kSide + 0.5) / kSide, v = (i / kSide + 0.5) / kSide;
        const Vec3d corner(mBox.min()[0], mBox.min()[1], mBox.getCenter()[2]);
        rays.push_back(aimed(eye, corner + Vec3d(u * size[0], v * size[1], 0)));
    }
    return rays;
}

std::vector<FloatRay> Questions::raysOfCameraInTiles() const
{
    constexpr int kTile = 4, kTiles = kSide / kTile;
    const std::vector<FloatRay> rows = raysOfCamera();
    std::vector<FloatRay> tiles;
    for (int tile = 0; tile < kTiles * kTiles; ++tile) {
        for (int i = 0; i < kTile * kTile; ++i) {
            const int x = kTile * (tile % kTiles) + i % kTile,
                      y = kTile * (tile / kTiles) + i / kTile;
            tiles.push_back(rows[std::size_t(y * kSide + x)]);
        }
    }
    return tiles;
}

std::vector<Vec3s> Questions::pointsInBox()
{
    std::vector<Vec3s> points;
    for (int i = 0; i < kQuestions; ++i) points.push_back(Vec3s(placeIn(1.3)));
    return points;
}

std::vector<Vec3s> Questions::pointsNearSurface(const TriangleList& mesh, double voxel)
{
    std::vector<Vec3s> points;
    for (int i = 0; i < kQuestions; ++i) {
        const auto& p = mesh.points[std::size_t(unit() * double(mesh.points.size()))];
        points.push_back(Vec3s(Vec3d(p[0], p[1], p[2]) + 3 * voxel * normal()));
    }
    return points;
}

std::vector<float> Questions::robots(double voxel)
{
    std::vector<float> spheres;
    for (int c = 0; c < kRobots; ++c) {
        const Vec3d direction = normal().unit();
        Vec3d at = mBox.getCenter() + mRadius * (0.6 + 0.6 * unit()) * direction;
        for (int i = 0; i < kSpheres; ++i) {
            at += 2 * voxel * normal();
            for (int axis = 0; axis < 3; ++axis) spheres.push_back(float(at[axis]));
            spheres.push_back(float(voxel * (2 + 4 * unit())));
        }
    }
    return spheres;
}

} // namespace spheretree_benchmark
