// SPDX-License-Identifier: Apache-2.0
/// @file TestMemoryPlan.cc
/// @brief Builds in little memory: what is planned, that trees are the same, and what is refused.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/build/MemoryPlan.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"
#include "support/TreeSettings.h"
#include "support/TemporaryFolder.h"

#include <openvdb_spheretree/store/SphereTreeJson.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <tbb/global_control.h>

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

constexpr int64_t kMiB = 1 << 20;

openvdb::BoolGrid::Ptr ballGrid(float radius)
{
    const auto ball =
        openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(radius, openvdb::Vec3f(0.f), 1.f);
    return openvdb::tools::sdfInteriorMask(*ball);
}

openvdb::BoolGrid::Ptr plateGrid()
{
    auto plate = openvdb::BoolGrid::create();
    plate->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(239, 199, 0)), true);
    return plate;
}

/// With thousands of leaf balls.
openvdb::BoolGrid::Ptr noiseGrid()
{
    Random random(1);
    return gridOf(shapes::noise(Coord(40, 36, 32), 0.2, random));
}

std::string fileOf(const SphereTree& tree)
{
    std::ostringstream text;
    writeJson(tree, text);
    return text.str();
}

SphereTreeSettings settingsOf(TreeType tree, int64_t memory)
{
    SphereTreeSettings settings;
    setType(settings, tree);
    settings.memory = memory;
    return settings;
}

/// @return why no tree is built; nothing if one is.
std::string refusalOf(const openvdb::BoolGrid& object, const SphereTreeSettings& settings)
{
    try {
        buildSphereTree(object, settings);
    } catch (const openvdb::ValueError& error) {
        return error.what();
    }
    return {};
}

/// @return the bytes that a refusal says are needed.
int64_t namedIn(const std::string& why)
{
    const std::size_t number = why.find_first_of("0123456789", why.find("about "));
    if (number == std::string::npos) throw std::runtime_error("no number in '" + why + "'");
    std::size_t length = 0;
    const double count = std::stod(why.substr(number), &length);
    const std::string unit = why.substr(number + length + 1, 3);
    return int64_t(count * (unit == "KiB" ? 1 << 10 : unit == "MiB" ? 1 << 20 : 1 << 30));
}

class MemoryPlanTest : public testing::Test {
protected:
    void SetUp() override { openvdb::initialize(); }
    const tbb::global_control limit{tbb::global_control::max_allowed_parallelism, 2};
};

TEST_F(MemoryPlanTest, LittleMemoryGivesTheSameFile)
{
    const auto ball = ballGrid(40);
    for (const TreeType type : {TreeType::Reversible, TreeType::Extended, TreeType::Tight}) {
        for (const bool special : {false, true}) {
            SphereTreeSettings settings = settingsOf(type, 0);
            if (special && type == TreeType::Tight) settings.kind = InnerOptions();
            auto* options = settings.find<PyramidOptions>();
            if (options) options->dag = special;
            const std::string expected = fileOf(buildSphereTree(*ball, settings));
            settings.memory = (options && options->dag ? 5 : 3) * kMiB / 2;
            EXPECT_TRUE(memoryPlan(*ball, settings).packed);
            EXPECT_EQ(fileOf(buildSphereTree(*ball, settings)), expected) << toString(type);
            settings.memory = 100 * kMiB;
            EXPECT_FALSE(memoryPlan(*ball, settings).packed);
            EXPECT_EQ(fileOf(buildSphereTree(*ball, settings)), expected) << toString(type);
        }
    }
}

TEST_F(MemoryPlanTest, FlatObjectsToo)
{
    SphereTreeSettings settings = settingsOf(TreeType::Extended, 0);
    settings.dim = 2;
    const auto plate = plateGrid();
    const std::string expected = fileOf(buildSphereTree(*plate, settings));
    settings.memory = kMiB;
    EXPECT_TRUE(memoryPlan(*plate, settings).packed);
    EXPECT_EQ(fileOf(buildSphereTree(*plate, settings)), expected);
}

TEST_F(MemoryPlanTest, SaysWhatIsGoingToHappen)
{
    const auto ball = ballGrid(40);
    const MemoryPlan usual = memoryPlan(*ball, settingsOf(TreeType::Extended, 100 * kMiB));
    EXPECT_EQ(usual.allowed, 100 * kMiB);
    EXPECT_EQ(usual.slabs, 10);
    EXPECT_EQ(usual.slabsAtATime, 10);
    EXPECT_LT(usual.needed, 100 * kMiB);
    EXPECT_TRUE(mentions(toString(usual), "100 MiB allowed for power labels, at most "));
    EXPECT_TRUE(mentions(toString(usual), ": 10 of 10 slabs at a time"));
    const MemoryPlan packed = memoryPlan(*ball, settingsOf(TreeType::Extended, 2 * kMiB));
    EXPECT_TRUE(packed.packed);
    EXPECT_LE(packed.needed, 2 * kMiB);
    EXPECT_LT(packed.storedBytes, packed.needed);
    EXPECT_TRUE(mentions(toString(packed), "1.4 MiB before compression"));
    const MemoryPlan machine = memoryPlan(*ball, settingsOf(TreeType::Extended, 0));
    EXPECT_GT(machine.allowed, 100 * kMiB);
    EXPECT_FALSE(machine.packed);
}

TEST_F(MemoryPlanTest, TellsWhatTheLevelsOfATightTreeWillTake)
{
    const auto noise = noiseGrid();
    EXPECT_EQ(memoryPlan(*noise, settingsOf(TreeType::Extended, 0)).leafBalls, 0);
    SphereTreeSettings settings = settingsOf(TreeType::Tight, 0);
    settings.budgeted().budget.spheres = {};
    const MemoryPlan all = memoryPlan(*noise, settings);
    const int64_t leafBalls = buildSphereTree(*noise, settings).levels.front().size();
    EXPECT_GE(all.leafBalls, leafBalls / 3);
    EXPECT_LE(all.leafBalls, 3 * leafBalls);
    EXPECT_GT(all.levelsBytes, 1000.0 * double(leafBalls));
    EXPECT_TRUE(mentions(toString(all), " leaf balls: about "));
    settings.tight().quality = Quality::Fast;
    EXPECT_LT(memoryPlan(*noise, settings).levelsSeconds, all.levelsSeconds);
    settings.budgeted().budget.spheres = {4};
    EXPECT_LT(memoryPlan(*noise, settings).levelsBytes, all.levelsBytes);
    for (const bool cuts : {false, true}) {
        settings.budgeted().budget.error = 20;
        settings.budgeted().cuts = cuts;
        EXPECT_GT(memoryPlan(*noise, settings).levelsSeconds, 0);
    }
}

/// Parts are one voxel each on most levels of the pyramid: their leaf balls do not grow in number there.
TEST_F(MemoryPlanTest, TheLeafBallsOfPartsThatLieFarApartAreNoMoreThanTheirVoxels)
{
    constexpr int kSide = 14, kApart = 64; // parts along an axis, voxels
    auto parts = openvdb::BoolGrid::create();
    for (openvdb::Coord at(0); at[0] < kSide; ++at[0]) {
        for (at[1] = 0; at[1] < kSide; ++at[1]) {
            for (at[2] = 0; at[2] < kSide; ++at[2]) {
                const openvdb::Coord first(at[0] * kApart, at[1] * kApart, at[2] * kApart);
                parts->fill(openvdb::CoordBBox(first, first.offsetBy(2)), true);
            }
        }
    }
    constexpr int64_t kParts = kSide * kSide * kSide;
    SphereTreeSettings settings = settingsOf(TreeType::Tight, 0);
    settings.tight().quality = Quality::Fast;
    settings.budgeted().budget.spheres = {};
    const MemoryPlan plan = memoryPlan(*parts, settings);
    EXPECT_GE(plan.leafBalls, kParts);
    EXPECT_LE(plan.leafBalls, 27 * kParts);
    EXPECT_LT(plan.levelsBytes, 30'000.0 * kParts);
}

/// What levels take is within memory=, too; and what a refusal names is enough.
TEST_F(MemoryPlanTest, LevelsThatNeedMoreAreRefusedWithTheNumber)
{
    const auto noise = noiseGrid();
    SphereTreeSettings settings = settingsOf(TreeType::Tight, 0);
    settings.tight().quality = Quality::Fast;
    const std::string usual = fileOf(buildSphereTree(*noise, settings));
    settings.memory = kMiB;
    const std::string why =
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*noise, settings); });
    EXPECT_TRUE(mentions(why, " leaf balls need about ")) << why;
    EXPECT_TRUE(mentions(why, "memory= allows 1 MiB: try memory=")) << why;
    settings.memory = namedIn(why);
    EXPECT_EQ(fileOf(buildSphereTree(*noise, settings)), usual);
}

/// A tree passes through levels of the pyramid that need ever more: the first refusal names what is enough for all.
TEST_F(MemoryPlanTest, WhatATightTreeIsRefusedWithIsEnough)
{
    const std::vector<std::vector<int64_t>> counts{{8, 2}, {64}, {64, 56, 48, 40}, {}};
    int refused = 0;
    const auto ball = ballGrid(90); // how many leaf balls others have, nobody could guess
    for (const auto& object : {ball, noiseGrid(), plateGrid()}) {
        for (const std::vector<int64_t>& spheres : counts) {
            if (object != ball && spheres.empty()) continue;
            SphereTreeSettings settings = settingsOf(TreeType::Tight, 0);
            settings.tight().quality = Quality::Fast;
            settings.budgeted().budget.spheres = spheres;
            const std::string usual = fileOf(buildSphereTree(*object, settings));
            for (const int64_t little : {int64_t(1), kMiB / 8, kMiB / 2}) {
                settings.memory = little;
                const std::string why = refusalOf(*object, settings);
                if (why.empty()) continue;
                ++refused;
                settings.memory = namedIn(why);
                EXPECT_GT(settings.memory, little) << why;
                EXPECT_EQ(fileOf(buildSphereTree(*object, settings)), usual) << why;
                EXPECT_NO_THROW(memoryPlan(*object, settings)) << why;
            }
        }
    }
    EXPECT_GE(refused, 20);
}

/// A plan refuses what a build refuses before its leaf balls are known, with the same words.
TEST_F(MemoryPlanTest, RefusesTheRegionsOfNamedCountsAsABuildDoes)
{
    const auto ball = ballGrid(90);
    SphereTreeSettings settings = settingsOf(TreeType::Tight, 1);
    settings.tight().quality = Quality::Fast;
    settings.budgeted().budget.spheres = {64, 56, 48, 40};
    const int64_t named = namedIn(refusalOf(*ball, settings));
    int refused = 0;
    for (int tenths = 1; tenths <= 9; ++tenths) {
        settings.memory = named * tenths / 10;
        const std::string why = refusalOf(*ball, settings);
        if (why.find("a tight tree of this object") == std::string::npos) continue;
        ++refused;
        EXPECT_EQ(messageOf<openvdb::ValueError>([&] { memoryPlan(*ball, settings); }), why);
    }
    EXPECT_GE(refused, 5);
}

TEST_F(MemoryPlanTest, TooLittleIsRefused)
{
    const auto ball = ballGrid(20);
    for (const TreeType type : {TreeType::Reversible, TreeType::Extended, TreeType::Tight}) {
        for (const int64_t memory : {int64_t(1), int64_t(20000)}) {
            const SphereTreeSettings settings = settingsOf(type, memory);
            const std::string why =
                messageOf<openvdb::ValueError>([&] { buildSphereTree(*ball, settings); });
            const bool isTight = type == TreeType::Tight;
            EXPECT_TRUE(mentions(why,
                isTight ? "a tight tree of this object needs about "
                        : "leaf nodes, those inside its tiles included, need "));
            const std::string allowed = memory == 1 ? "1 byte" : "19.5 KiB";
            EXPECT_TRUE(mentions(why, "memory= allows " + allowed + ": try memory="));
            EXPECT_EQ(messageOf<openvdb::ValueError>([&] { memoryPlan(*ball, settings); }), why);
        }
    }
    const SphereTreeSettings negative = settingsOf(TreeType::Extended, -1);
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*ball, negative); }), "memory=-1"));
}

TEST_F(MemoryPlanTest, ADagNeedsMoreAndIsRefusedWhereItDoesNotFit)
{
    const auto ball = ballGrid(40);
    SphereTreeSettings settings = settingsOf(TreeType::Reversible, 0);
    const int64_t needed = memoryPlan(*ball, settings).needed;
    settings.pyramid().dag = true;
    EXPECT_GT(memoryPlan(*ball, settings).needed, needed);
    settings.memory = 2 * kMiB; // enough for a tree without one
    const std::string why =
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*ball, settings); });
    EXPECT_EQ(messageOf<openvdb::ValueError>([&] { memoryPlan(*ball, settings); }), why);
    settings.pyramid().dag = false;
    EXPECT_NO_THROW(buildSphereTree(*ball, settings));
    EXPECT_NO_THROW(memoryPlan(*ball, settings));
}

TEST_F(MemoryPlanTest, NormsNeedAllTheirLabels)
{
    const auto ball = ballGrid(20);
    SphereTreeSettings settings = settingsOf(TreeType::Extended, 0);
    settings.pyramid().dist = distanceFromString("l1");
    const MemoryPlan plan = memoryPlan(*ball, settings);
    EXPECT_FALSE(plan.packed);
    EXPECT_EQ(plan.slabsAtATime, plan.slabs);
    const std::string expected = fileOf(buildSphereTree(*ball, settings));
    settings.memory = plan.needed;
    EXPECT_EQ(fileOf(buildSphereTree(*ball, settings)), expected);
    settings.memory = plan.needed - 1;
    EXPECT_THROW(buildSphereTree(*ball, settings), openvdb::ValueError);
    EXPECT_THROW(memoryPlan(*ball, settings), openvdb::ValueError);
}

} // namespace
