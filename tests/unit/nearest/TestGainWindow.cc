// SPDX-License-Identifier: Apache-2.0
/// @file TestGainWindow.cc
/// @brief What a sphere gains, and where a climb ends, against counting voxel by voxel.

#include <openvdb_spheretree/nearest/GainWindow.h>
#include <openvdb_spheretree/nearest/SphereClimb.h>

#include "NaiveSpheres.h"
#include "support/BuiltTrees.h"

#include <openvdb_spheretree/voxel/LeafLayout.h>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::nearest;
using namespace spheretree_test;
using openvdb_spheretree::tight::FineBox;
using openvdb_spheretree::tight::SampledObject;

/// The others, and the one that a window is for.
struct Scene {
    std::vector<ExactSphere> others;
    ExactSphere sphere;
};

Scene randomScene(const Voxels& voxels, Random& random, bool flat)
{
    Scene scene;
    for (int i = random.between(0, 4); i > 0; --i) {
        scene.others.push_back(randomSphere(voxels, random, flat));
    }
    scene.sphere = randomSphere(voxels, random, flat);
    return scene;
}

GainWindow windowOf(const SampledObject& samples, const Scene& scene, bool flat, int level = 0)
{
    GainWindow window;
    const int64_t margin = (tight::kFine * kMargin) << level;
    window.reset(samples, FineBox(scene.sphere, double(margin)), level, flat);
    for (const ExactSphere& other : scene.others) window.cover(other);
    window.sum();
    return window;
}

} // namespace

TEST(GainWindow, CountsWhatASphereGainsGivenTheOthers)
{
    Random random(3);
    for (const RandomObject& object : someObjects(0, 60)) {
        for (const bool flat : {false, true}) {
            SCOPED_TRACE(object.name + (flat ? ", flat" : ""));
            const Voxels voxels = flat ? inPlaneZero(object.voxels) : object.voxels;
            const SampledObject samples{LeafLayout(*maskOf(voxels))};
            const Scene scene = randomScene(voxels, random, flat);
            const GainWindow window = windowOf(samples, scene, flat);
            const LocalSphere local = window.toLocal(scene.sphere);
            EXPECT_TRUE(window.holds(local));
            std::vector<ExactSphere> all = scene.others;
            const int64_t without = naiveWrong(voxels, all, flat);
            all.push_back(scene.sphere);
            EXPECT_EQ(window.gain(local), without - naiveWrong(voxels, all, flat));
            EXPECT_EQ(window.moved(scene.sphere, local, local), scene.sphere);
        }
    }
}

TEST(GainWindow, CountsSamplesAtACoarserLevel)
{
    Random random(4);
    for (const RandomObject& object : someObjects(60, 20)) {
        const SampledObject samples{LeafLayout(*maskOf(object.voxels))};
        Scene scene;
        scene.sphere = randomSphere(object.voxels, random, false);
        for (int64_t& c : scene.sphere.center) c &= ~int64_t(1); // halves are whole
        scene.sphere.radiusSq &= ~int64_t(3);
        const GainWindow window = windowOf(samples, scene, false, 1);
        int64_t naive = 0;
        for (const Coord& v : naiveVoxels({scene.sphere}, false)) {
            if ((v[0] | v[1] | v[2]) & 1) continue;
            naive += isIn(object.voxels, v) ? 1 : -1;
        }
        EXPECT_EQ(window.gain(window.toLocal(scene.sphere)), naive) << object.name;
    }
}

TEST(SphereClimb, EndsWhereNoStepGainsMoreAndNeverLower)
{
    Random random(5);
    for (const RandomObject& object : someObjects(80, 20)) {
        const SampledObject samples{LeafLayout(*maskOf(object.voxels))};
        const Scene scene = randomScene(object.voxels, random, false);
        const GainWindow window = windowOf(samples, scene, false);
        const LocalSphere from = window.toLocal(scene.sphere);
        LocalSphere to = from;
        const int64_t gain = climb(window, to, false);
        EXPECT_GE(gain, window.gain(from));
        EXPECT_EQ(gain, window.gain(to));
        EXPECT_TRUE(window.holds(to));
        for (int axis = 0; axis < 3; ++axis) {
            for (const int64_t step : {-kSmallestStep, kSmallestStep}) {
                LocalSphere trial = to;
                trial.center[axis] += step;
                if (!window.holds(trial)) continue;
                EXPECT_LE(window.gain(trial), gain) << object.name;
            }
        }
    }
}
