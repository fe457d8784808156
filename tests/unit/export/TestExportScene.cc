// SPDX-License-Identifier: Apache-2.0
// What of a tree goes into a file: levels, frame, units, and what is said of the rest.

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/export/ExportScene.h>
#include <openvdb_spheretree/measure/MassProperties.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace openvdb_spheretree;
using namespace spheretree_test;
using detail::ExportLevel;
using detail::ExportScene;
using openvdb::Vec3d;

namespace {

ExportFormat format(bool allLevels, ExportNumbers numbers = ExportNumbers::Double)
{
    ExportFormat result = *findExportFormat(".vtp");
    result.name = "test";
    result.allLevels = allLevels;
    result.numbers = numbers;
    return result;
}

struct Exported {
    ExportScene scene;
    std::vector<std::string> notes;
};

Exported sceneOf(
    const SphereTree& tree, const ExportFormat& format, const ExportSettings& settings = {})
{
    Exported result;
    ExportSettings all = settings;
    all.links = {"object"};
    std::optional<detail::FileFrame> frame;
    result.scene = detail::makeScene(tree, format, all, 0, frame, result.notes, nullptr);
    return result;
}

/// @return all notes of an export, a `; ` behind each.
std::string notesOf(
    const SphereTree& tree, const char* extension, const char* name, const ExportSettings& settings)
{
    std::string all;
    for (const std::string& note :
        sceneOf(tree, *findExportFormat(extension, name), settings).notes) {
        all += note + "; ";
    }
    return all;
}

/// A turn, a mirror, a scale and a shift of index space.
openvdb::math::Transform::Ptr turned()
{
    const openvdb::Mat4R toWorld(-0.4, 0.0, 0.3, 0.0, //
        0.18, 0.4, 0.24, 0.0,                         //
        -0.24, 0.3, -0.32, 0.0,                       //
        31.0, -22.0, 7.0, 1.0);
    return openvdb::math::Transform::createLinearTransform(toWorld);
}

/// A tree whose stored radii are those of its transform.
SphereTree turnedTree()
{
    SphereTree tree = randomTree(200, 3);
    tree.transform = turned();
    return tree;
}

TEST(ExportScene, AllLevelsFromTheTopWithIdsAndParents)
{
    const SphereTree tree = turnedTree();
    const auto [scene, notes] = sceneOf(tree, format(true));
    EXPECT_TRUE(notes.empty());
    ASSERT_EQ(scene.levels.size(), tree.levels.size());
    EXPECT_EQ(scene.sphereCount(), std::size_t(tree.size()));
    int32_t id = 0;
    for (const ExportLevel& level : scene.levels) {
        for (std::size_t i = 0; i < level.size(); ++i, ++id) {
            EXPECT_EQ(level.ids[i], id);
            EXPECT_EQ(level.parents[i], tree.spheres.parent[std::size_t(id)]);
            EXPECT_EQ(level.centers[i], tree.centerWorld(id));
            EXPECT_EQ(level.radii[i], double(tree.spheres.radiusWorld[std::size_t(id)]));
        }
    }
}

TEST(ExportScene, OneLevelWhereThereIsRoomForOne)
{
    const SphereTree tree = turnedTree();
    const auto [scene, notes] = sceneOf(tree, format(false));
    EXPECT_EQ(scene.sphereCount(), std::size_t(tree.levels.front().size()));
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(mentions(notes.front(), "test holds one level"));
    EXPECT_TRUE(mentions(notes.front(), "level 0 of 200 spheres"));
}

TEST(ExportScene, TheLevelThatIsAskedFor)
{
    const SphereTree tree = turnedTree();
    ExportSettings settings;
    settings.level = 1;
    EXPECT_EQ(sceneOf(tree, format(true), settings).scene.sphereCount(), 20u);
    settings = {};
    settings.spheres = 199;
    const auto [scene, notes] = sceneOf(tree, format(false), settings);
    EXPECT_EQ(scene.sphereCount(), 20u);
    EXPECT_EQ(scene.finest().number, 1);
    EXPECT_TRUE(notes.empty());
    for (const int32_t parent : scene.finest().parents) EXPECT_EQ(parent, -1);
    settings.spheres = 0;
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { sceneOf(tree, format(true), settings); }),
            "no level has at most 0"));
}

TEST(ExportScene, TheCutThatIsAskedFor)
{
    const SphereTree tree = tightSampleTree();
    ASSERT_FALSE(tree.cuts.empty());
    ExportSettings settings;
    settings.spheres = 2;
    EXPECT_EQ(sceneOf(tree, format(true), settings).scene.sphereCount(), 2u);
    const auto notes = sceneOf(tree, format(true)).notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(mentions(notes.front(), "no room for the cuts"));
}

TEST(ExportScene, UnitsScaleCentersAndRadii)
{
    const SphereTree tree = turnedTree();
    ExportSettings settings;
    settings.scale = 1000;
    const auto scene = sceneOf(tree, format(true), settings).scene;
    const ExportLevel& root = scene.levels.front();
    EXPECT_EQ(root.centers[0], tree.centerWorld(0) * 1000);
    const double radius = double(tree.spheres.radiusWorld[0]) * 1000;
    EXPECT_GE(root.radii[0], radius);
    EXPECT_LE(root.radii[0], radius * (1 + 1e-12));
}

TEST(ExportScene, RobotsAreInMetres)
{
    const auto inUnits = [](const char* extension, double scale, double metersPerUnit) {
        ExportSettings settings;
        settings.level = 0;
        settings.scale = scale / metersPerUnit;
        settings.metersPerUnit = metersPerUnit;
        return notesOf(turnedTree(), extension, "", settings);
    };
    EXPECT_TRUE(mentions(inUnits(".urdf", 1, 1), "urdf is in metres, and these spheres span"));
    EXPECT_TRUE(mentions(inUnits(".yml", 1e-6, 1), "curobo is in metres"));
    EXPECT_EQ(inUnits(".urdf", 0.01, 1), "");
    EXPECT_TRUE(mentions(inUnits(".srdf", 0.01, 0.001), "take its numbers for metres"));
    EXPECT_EQ(inUnits(".vtp", 1, 0.001), "");
    EXPECT_EQ(inUnits(".glb", 1, 0.001), ""); // its root node makes metres of them
}

/// A body is what it is in any frame: distances stay, and the mass is where the frame says.
TEST(ExportScene, FramesOfTheBody)
{
    const SphereTree tree = turnedTree();
    const auto world = sceneOf(tree, format(true)).scene;
    const auto mass = *massProperties(tree, tree.levels.front());
    ExportFormat massive = format(true);
    massive.mass = true;
    for (const ExportFrame frame : {ExportFrame::Centroid, ExportFrame::Principal}) {
        ExportSettings settings;
        settings.frame = frame;
        settings.scale = 10;
        settings.density = 2;
        const auto scene = sceneOf(tree, massive, settings).scene;
        EXPECT_NEAR(scene.mass.center.length(), 0, 1e-12);
        EXPECT_NEAR(scene.mass.volume / (1000 * mass.volume), 1, 1e-12);
        const ExportLevel& here = scene.finest();
        const ExportLevel& there = world.finest();
        for (std::size_t i = 1; i < here.size(); ++i) {
            const double apart = (here.centers[i] - here.centers[i - 1]).length();
            EXPECT_NEAR(apart, 10 * (there.centers[i] - there.centers[i - 1]).length(), 1e-9);
            const Vec3d a = here.centers[i - 1], b = here.centers[i], c = here.centers[0];
            const Vec3d p = there.centers[i - 1], q = there.centers[i], r = there.centers[0];
            EXPECT_NEAR(
                a.cross(b - a).dot(c - a), 1000 * (p - mass.center).cross(q - p).dot(r - p), 1e-4)
                << "it is not mirrored";
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (frame == ExportFrame::Centroid) break;
            const double moment = 2 * 1e5 * mass.principalMoments[axis];
            EXPECT_NEAR(scene.mass.inertia(axis, axis) / moment, 1, 1e-9);
            EXPECT_NEAR(scene.mass.inertia(axis, (axis + 1) % 3) / moment, 0, 1e-9);
        }
    }
}

/// A body that moves between two frames moves in their file, whatever its frame.
TEST(ExportScene, SamplesAreInTheFrameOfTheFirst)
{
    const SphereTree first = turnedTree();
    SphereTree second = turnedTree();
    second.transform->postTranslate(Vec3d(5, -3, 2));
    ExportFormat ofSamples = format(true), ofLinks = format(true);
    ofSamples.samples = true;
    for (const ExportFrame frame : {ExportFrame::Centroid, ExportFrame::Principal}) {
        ExportSettings settings;
        settings.frame = frame;
        settings.links = {"a", "b"};
        const auto distances = [&](const ExportFormat& file) {
            std::optional<detail::FileFrame> common;
            std::vector<std::string> notes;
            const auto a = detail::makeScene(first, file, settings, 0, common, notes, nullptr);
            const auto b = detail::makeScene(second, file, settings, 1, common, notes, nullptr);
            std::vector<double> all;
            for (std::size_t i = 0; i < a.finest().size(); ++i) {
                all.push_back((a.finest().centers[i] - b.finest().centers[i]).length());
            }
            return all;
        };
        for (const double distance : distances(ofSamples)) {
            EXPECT_NEAR(distance, Vec3d(5, -3, 2).length(), 1e-9);
        }
        for (const double distance : distances(ofLinks)) EXPECT_NEAR(distance, 0, 1e-9);
    }
}

TEST(ExportScene, WhatFilesOfOneFormatLackIsSaid)
{
    SphereTree tree = turnedTree();
    const std::string foam = notesOf(tree, ".json", "foam", {});
    EXPECT_TRUE(mentions(foam, "not which is whose child") && mentions(foam, "they are 0")) << foam;
    ExportSettings finest;
    finest.level = 0;
    EXPECT_FALSE(mentions(notesOf(tree, ".json", "foam", finest), "whose child"));
    for (const char* whole : {".vtp", ".sph", ".swc"}) {
        EXPECT_EQ(notesOf(tree, whole, "", {}), "") << whole;
    }
    for (int32_t id = 0; id < tree.size(); ++id) tree.track.push_back(id);
    tree.nextTrack = tree.size();
    for (const char* without : {".swc", ".sph", ".stl"}) {
        EXPECT_TRUE(mentions(notesOf(tree, without, "", finest), "from frame to frame")) << without;
    }
    EXPECT_EQ(notesOf(tree, ".vtp", "", {}), "");
}

TEST(ExportScene, ThatRobotsOfManySpheresAreSlowIsSaid)
{
    ExportSettings settings;
    settings.level = 0;
    settings.scale = 0.01;
    for (const int spheres : {1000, 1001}) {
        SphereTree tree = randomTree(spheres, 3);
        tree.transform = turned();
        const bool isSaid = mentions(notesOf(tree, ".srdf", "", settings), "1001 spheres are many");
        EXPECT_EQ(isSaid, spheres > 1000);
        EXPECT_FALSE(mentions(notesOf(tree, ".vtp", "", settings), "are many"));
    }
}

/// Its readers are told the mass by hand, so it is said, in the units of the file.
TEST(ExportScene, WhatAClumpWeighsIsSaidWhereReadersAskForIt)
{
    const SphereTree tree = turnedTree();
    const auto mass = *massProperties(tree, tree.levels.front());
    ExportSettings settings;
    settings.level = 0;
    settings.scale = 2;
    const std::string volume = "the mass " + detail::shortNumber(8 * mass.volume) + " and";
    const std::string moment =
        "inertia " + detail::shortNumber(32 * mass.principalMoments[0]) + ", ";
    const std::string world = notesOf(tree, ".csv", "deme", settings);
    EXPECT_TRUE(mentions(world, "around the center of mass, along the principal axes")) << world;
    settings.frame = ExportFrame::Principal;
    const std::string principal = notesOf(tree, ".csv", "deme", settings);
    EXPECT_TRUE(mentions(principal, volume) && mentions(principal, moment)) << principal;
    EXPECT_FALSE(mentions(principal, "around the center")) << principal;
}

TEST(ExportScene, FarFromTheOriginFloatsAreSaidToBeCoarse)
{
    SphereTree tree = turnedTree();
    EXPECT_TRUE(sceneOf(tree, format(true, ExportNumbers::Float)).notes.empty());
    tree.transform->postTranslate(Vec3d(1e7, 0, 0));
    const auto [scene, notes] = sceneOf(tree, format(true, ExportNumbers::Float));
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(mentions(notes.front(), "coarse so far from the origin"));
    for (std::size_t i = 0; i < scene.finest().size(); ++i) {
        const int32_t id = scene.finest().ids[i];
        const double moved = (scene.finest().centers[i] - tree.centerWorld(id)).length();
        EXPECT_GE(scene.finest().radii[i],
            double(tree.spheres.radiusWorld[std::size_t(id)]) + moved * 0.999);
    }
}

TEST(ExportScene, NumbersThatTextCannotHoldAreRefused)
{
    const SphereTree tree = turnedTree();
    ExportSettings settings;
    settings.scale = 1e20;
    const auto text = [&] { return sceneOf(tree, format(true, ExportNumbers::Decimal), settings); };
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>(text), "choose another scale= or units="));
    EXPECT_NO_THROW(sceneOf(tree, format(true), settings));
    settings.scale = 1e10;
    EXPECT_NO_THROW(text());
}

TEST(ExportScene, SpheresOfNoSizeAreRefusedWhereReadersRefuseThem)
{
    SphereTree tree = turnedTree();
    tree.spheres.radiusWorld.back() = 0;
    ExportFormat strict = format(true);
    EXPECT_EQ(sceneOf(tree, strict).scene.finest().radii.back(), 0);
    strict.positiveRadii = true;
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { sceneOf(tree, strict); }),
        "1 of the spheres have the radius 0"));
}

TEST(ExportScene, SpheresOfNoSizeAreWhereTheyAre)
{
    SphereTree tree = turnedTree();
    std::fill(tree.spheres.radiusWorld.begin(), tree.spheres.radiusWorld.end(), 0.0f);
    const double voxel = tree.voxelSize();
    const Exported exported = sceneOf(tree, format(true, ExportNumbers::Decimal));
    const ExportLevel& finest = exported.scene.finest();
    for (std::size_t i = 0; i < finest.size(); ++i) {
        const Vec3d moved = finest.centers[i] - tree.centerWorld(finest.ids[i]);
        EXPECT_LE(moved.length(), 1e-6 * voxel) << i;
        EXPECT_LE(finest.radii[i], 3e-6 * voxel) << i;
    }
}

TEST(ExportScene, BallsOfNormsAreNoSpheres)
{
    SphereTree tree = turnedTree();
    ReversibleOptions options;
    options.dist = Distance::l1();
    tree.settings = options;
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { sceneOf(tree, format(true)); }), "those of a norm"));
}

TEST(ExportScene, ThatDiscsBecomeSpheresIsSaid)
{
    SphereTree tree = turnedTree();
    const char* const said = "take the discs of a tree with dim=2 for whole spheres";
    EXPECT_FALSE(mentions(notesOf(tree, ".yml", "", {}), said));
    tree.settings.dim = 2;
    EXPECT_TRUE(mentions(notesOf(tree, ".yml", "", {}), said));
}

TEST(ExportScene, TracksAreIdsWhereTheOrderOfIdsIsFree)
{
    SphereTree tree = turnedTree();
    const auto plain = sceneOf(tree, format(true)).scene;
    for (int32_t id = 0; id < tree.size(); ++id) tree.track.push_back(tree.size() - 1 - id);
    tree.nextTrack = tree.size();
    const auto tracked = sceneOf(tree, format(true)).scene;
    ExportFormat ordered = format(true);
    ordered.ordersIds = true;
    const auto places = sceneOf(tree, ordered).scene;
    for (std::size_t k = 0; k < plain.levels.size(); ++k) {
        EXPECT_EQ(places.levels[k].ids, plain.levels[k].ids);
        EXPECT_EQ(tracked.levels[k].centers, plain.levels[k].centers);
        for (std::size_t i = 0; i < plain.levels[k].size(); ++i) {
            EXPECT_EQ(tracked.levels[k].ids[i], tree.track[std::size_t(plain.levels[k].ids[i])]);
            const int32_t parent = plain.levels[k].parents[i];
            EXPECT_EQ(
                tracked.levels[k].parents[i], parent < 0 ? -1 : tree.track[std::size_t(parent)]);
        }
    }
}

/// Readers that blend samples go by the place in the list.
TEST(ExportScene, SamplesHaveTheirSpheresInTheOrderOfTracks)
{
    SphereTree tree = turnedTree();
    const auto plain = sceneOf(tree, format(true)).scene;
    for (int32_t id = 0; id < tree.size(); ++id) tree.track.push_back((7 * id + 3) % tree.size());
    ASSERT_NE(tree.size() % 7, 0);
    tree.nextTrack = tree.size();
    ExportFormat ofSamples = format(true);
    ofSamples.samples = true;
    const auto tracked = sceneOf(tree, ofSamples).scene;
    for (std::size_t k = 0; k < plain.levels.size(); ++k) {
        const ExportLevel &level = tracked.levels[k], &before = plain.levels[k];
        ASSERT_EQ(level.size(), before.size());
        EXPECT_TRUE(std::is_sorted(level.ids.begin(), level.ids.end()));
        for (std::size_t i = 0; i < before.size(); ++i) {
            const int32_t track = tree.track[std::size_t(before.ids[i])];
            const auto found = std::find(level.ids.begin(), level.ids.end(), track);
            ASSERT_NE(found, level.ids.end());
            const auto at = std::size_t(found - level.ids.begin());
            EXPECT_EQ(level.centers[at], before.centers[i]);
            EXPECT_EQ(level.radii[at], before.radii[i]);
            const int32_t parent = before.parents[i];
            EXPECT_EQ(level.parents[at], parent < 0 ? -1 : tree.track[std::size_t(parent)]);
        }
    }
}

} // namespace
