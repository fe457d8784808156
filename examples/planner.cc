// SPDX-License-Identifier: Apache-2.0
// A planner's inner loop: thousands of configurations of an arm against a scan. First which of them are free, then how
// near the free ones are, and where a push would help most.

#include <openvdb/openvdb.h>
#include <openvdb_spheretree/openvdb_spheretree.h>
#include <openvdb_spheretree/openvdb_spheretree_extras.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

using namespace openvdb_spheretree;
using openvdb::Vec3d;

constexpr int kLinks = 4, kSpheresPerLink = 8, kSpheres = kLinks * kSpheresPerLink;

// The spheres of an arm: links of 12 units one behind the other, each turned against the one before.
void placeArm(const Vec3d& foot, const double* angles, float* spheres)
{
    Vec3d place = foot, along(0, 0, 1);
    for (int link = 0; link < kLinks; ++link) {
        const double yaw = angles[2 * link], pitch = angles[2 * link + 1];
        const Vec3d side(std::cos(yaw), std::sin(yaw), 0);
        along += 1.2 * (std::sin(pitch) * side + std::cos(pitch) * Vec3d(0, 0, 1));
        along.normalize();
        for (int i = 0; i < kSpheresPerLink; ++i) {
            for (int axis = 0; axis < 3; ++axis) *spheres++ = float(place[axis]);
            *spheres++ = 1.2f;
            place += along * (12.0 / kSpheresPerLink);
        }
    }
}

int main()
{
    openvdb::initialize();
    GeneratedObjectSettings landscape;
    landscape.shape = Shape::Terrain;
    landscape.voxels = 50000;
    const auto scan = generateObject(landscape);
    TightOptions options;
    options.quality = Quality::Fast;
    const QueryTree tree = makeQueryTree(buildSphereTree(*scan, options));

    // The foot stands on the ground in the middle: there a ray from above meets it.
    Vec3d foot = tree.center();
    foot[2] += tree.radius();
    const RayHit ground = intersect(tree, QueryRay{foot, Vec3d(0, 0, -1)});
    foot[2] -= ground.t - 3;

    const std::size_t configurations = 4000;
    std::vector<float> spheres(4 * kSpheres * configurations);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-2.5, 2.5);
    for (std::size_t i = 0; i < configurations; ++i) {
        double angles[2 * kLinks];
        for (double& a : angles) a = angle(random);
        placeArm(foot, angles, &spheres[4 * kSpheres * i]);
    }

    std::vector<uint8_t> touching(configurations);
    spheresTouch(tree, spheres.data(), configurations, kSpheres, touching.data());

    std::vector<float> distances(kSpheres * configurations), pushes(3 * distances.size());
    SphereDistanceArrays results;
    results.distance = distances.data();
    results.gradient = pushes.data();
    sphereDistances(tree, spheres.data(), distances.size(), /*activation=*/20, results);

    std::size_t freeCount = 0, best = 0, wrong = 0;
    float clearance = -1;
    for (std::size_t i = 0; i < configurations; ++i) {
        const auto first = distances.begin() + std::ptrdiff_t(kSpheres * i);
        const float nearest = *std::min_element(first, first + kSpheres);
        wrong += touching[i] != (nearest <= 0);
        freeCount += !touching[i];
        if (nearest > clearance) clearance = nearest, best = i;
    }
    const auto first = distances.begin() + std::ptrdiff_t(kSpheres * best);
    const auto sphere = std::min_element(first, first + kSpheres) - distances.begin();
    const Vec3d push(&pushes[3 * std::size_t(sphere)]);
    std::cout << freeCount << " of " << configurations << " configurations are free; number "
              << best << " keeps " << clearance << " away, and its sphere " << sphere % kSpheres
              << " would go to " << push << "\n";
    return wrong == 0 && freeCount > 0 && freeCount < configurations && clearance > 0 ? 0 : 1;
}
