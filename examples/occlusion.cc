// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion of a point cloud: a scanner's points on a curved wall, and of each the part of its sky that it sees.
// Ends in the picture occlusion.png.

#include <openvdb/openvdb.h>
#include <openvdb_spheretree/openvdb_spheretree.h>
#include <openvdb_spheretree/openvdb_spheretree_extras.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <random>
#include <vector>

using namespace openvdb_spheretree;
using openvdb::Vec3d;

constexpr int kWidth = 480, kHeight = 360, kSkyRays = 64;

// One ray a pixel, as a scanner or a camera sends them.
std::vector<QueryRay> scannerRays(const QueryTree& tree)
{
    const Vec3d towards = Vec3d(-0.6, -0.5, -1).unit();
    const Vec3d right = towards.cross(Vec3d(0, 1, 0)).unit(), up = right.cross(towards);
    const Vec3d eye = tree.center() - 3.2 * tree.radius() * towards;
    std::vector<QueryRay> rays;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const double u = (x - kWidth / 2) * 0.5 / kHeight;
            const double v = (kHeight / 2 - y) * 0.5 / kHeight;
            rays.push_back(QueryRay{eye, towards + u * right + v * up});
        }
    }
    return rays;
}

// Directions around a normal, as often as light of an even sky would come from there.
void addSkyRays(const Vec3d& point, const Vec3d& normal, double reach, std::mt19937& random,
    std::vector<QueryRay>& rays)
{
    std::normal_distribution<double> any;
    for (int i = 0; i < kSkyRays; ++i) {
        const Vec3d around = Vec3d(any(random), any(random), any(random)).unit();
        QueryRay ray{point, normal + 0.999 * around};
        ray.direction.normalize();
        ray.tFar = reach;
        ray.leavesStart = true; // the spheres that the point lies on
        rays.push_back(ray);
    }
}

int main()
{
    openvdb::initialize();
    GeneratedObjectSettings wall;
    wall.voxels = 300000;
    const auto object = generateObject(wall);
    TightOptions options;
    options.quality = Quality::Fast;
    const QueryTree tree = makeQueryTree(buildSphereTree(*object, options));

    const std::vector<QueryRay> scan = scannerRays(tree);
    std::vector<RayHit> hits(scan.size());
    intersect(tree, scan.data(), scan.size(), hits.data());

    std::mt19937 random(1);
    std::vector<QueryRay> sky;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!hits[i]) continue;
        const Vec3d point = scan[i].at(hits[i].t);
        const Vec3d normal = (point - tree.leafCenter(hits[i].leaf)).unit();
        addSkyRays(point, normal, tree.radius(), random, sky);
    }
    std::vector<uint8_t> blocked(sky.size());
    occluded(tree, sky.data(), sky.size(), blocked.data());

    Picture picture{kWidth, kHeight, std::vector<uint8_t>(3 * scan.size(), 255)};
    std::size_t next = 0, dark = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!hits[i]) continue;
        int seen = 0;
        for (int k = 0; k < kSkyRays; ++k) seen += !blocked[next++];
        dark += seen < kSkyRays / 2;
        const auto gray = uint8_t(255 * std::pow(double(seen) / kSkyRays, 1 / 2.2)); // sRGB, nearly
        for (int channel = 0; channel < 3; ++channel) picture.rgb[3 * i + channel] = gray;
    }
    std::ofstream file("occlusion.png", std::ios::binary);
    writePng(picture, file);
    std::cout << next / kSkyRays << " points, " << sky.size() << " rays; " << dark
              << " points see less than half of their sky\n";
    return dark > 0 && dark * kSkyRays < sky.size() ? 0 : 1;
}
