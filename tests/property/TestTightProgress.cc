// SPDX-License-Identifier: Apache-2.0
/// @file TestTightProgress.cc
/// @brief What whoever waits for a tight tree is told: one percentage that rises to the end.

#include "support/RandomObjects.h"
#include "support/TightObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// Keeps the percentages of the stage that makes the levels.
struct LevelsListener : openvdb::util::NullInterrupter {
    void start(const char* name) override
    {
        if (depth++ == 0) inLevels = std::string(name) == "levels";
        times += depth == 1 && inLevels;
    }
    void end() override { --depth; }
    bool wasInterrupted(int percent) override
    {
        if (!inLevels || depth != 1 || percent < 0) return false;
        if (told.empty() || told.back() != percent) told.push_back(percent);
        return false;
    }
    std::vector<int> told;
    int depth = 0, times = 0;
    bool inLevels = false;
};

void expectRises(const SphereTreeSettings& settings, const Voxels& voxels, std::size_t least)
{
    SCOPED_TRACE(describeTight(settings));
    // Of two threads one may be late to say what it knows.
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    LevelsListener listener;
    buildSphereTree(*gridOf(voxels), settings, nullptr, &listener);
    EXPECT_EQ(listener.times, 1);
    EXPECT_TRUE(std::is_sorted(listener.told.begin(), listener.told.end()));
    EXPECT_GE(listener.told.size(), least);
    ASSERT_FALSE(listener.told.empty());
    EXPECT_LE(listener.told.front(), 20);
    EXPECT_GE(listener.told.back(), 50);
    EXPECT_LE(listener.told.back(), 99);
}

TEST(TightProgress, RisesOnce)
{
    Random random(1);
    const Voxels voxels = shapes::noise(Coord(22, 20, 18), 0.3, random);
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        for (const std::vector<int64_t>& spheres :
            std::vector<std::vector<int64_t>>{{}, {300, 60}, {20, 5}, {8}}) {
            if (quality == Quality::Best && spheres.empty()) continue; // takes long
            SphereTreeSettings settings = tightSettings(quality);
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.spheres = spheres;
            // From the top there is a step for each level.
            expectRises(settings, voxels, spheres.empty() || spheres.front() > 64 ? 20 : 3);
        }
    }
}

TEST(TightProgress, OfBoundsAndCutsRisesOnce)
{
    Random random(2);
    const Voxels voxels = shapes::noise(Coord(30, 28, 26), 0.3, random);
    SphereTreeSettings settings = tightSettings(Quality::Fast);
    settings.budgeted().budget = SphereBudget();
    settings.budgeted().budget.error = 60;
    expectRises(settings, voxels, 20);
    settings.budgeted().budget = SphereBudget();
    settings.budgeted().cuts = true;
    expectRises(settings, voxels, 20);
}

} // namespace
