// SPDX-License-Identifier: Apache-2.0
/// @file TestSpherePicture.cc
/// @brief Pictures: outlines where geometry has them, the same bytes whatever must not matter,
/// colours, .png files, and what is refused.

#include "support/BuiltTrees.h"
#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/picture/PictureColors.h>
#include <openvdb_spheretree/picture/SpherePicture.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <png.h>
#include <tbb/global_control.h>

#include <openvdb/math/Math.h>

#include <cmath>
#include <set>
#include <sstream>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

constexpr double kPi = openvdb::math::pi<double>();

PictureSettings small(PictureColor color = PictureColor::Parent)
{
    PictureSettings settings;
    settings.width = 160;
    settings.height = 120;
    settings.color = color;
    return settings;
}

/// One level, every node a root.
SphereTree treeOf(const std::vector<std::pair<Vec3d, double>>& balls, double voxel = 1)
{
    SphereTree tree;
    tree.settings.kind = ExtendedOptions();
    tree.transform = openvdb::math::Transform::createLinearTransform(voxel);
    tree.object.bbox.reset(Coord(-4, -4, -4), Coord(4, 4, 4));
    addLevel(tree, int32_t(balls.size()), 1);
    for (const auto& [center, radiusWorld] : balls) {
        addNode(tree, center, Coord::round(center), 1, -1);
        tree.spheres.radiusWorld.back() = float(radiusWorld);
    }
    return tree;
}

double linear(uint8_t byte)
{
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Pixels of a black ball before the light background, at least half of each.
int darkPixels(const Picture& picture)
{
    int dark = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) dark += linear(picture.rgb[i]) < 0.42;
    return dark;
}

/// The pixels that a ball should take: its outline is a cone of half angle @a theta around an axis
/// @a phi off the view, so an ellipse on the picture.
double outlineArea(double theta, double phi, const PictureSettings& settings, double fovDegrees)
{
    const double s = std::sin(theta), cosSq = std::cos(phi) * std::cos(phi) - s * s;
    const double pixel = 2 * std::tan(fovDegrees * kPi / 360) / settings.height;
    return kPi * (s * std::cos(theta) / cosSq) * (s / std::sqrt(cosSq)) / (pixel * pixel);
}

Picture decoded(const std::string& file)
{
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_memory(&image, file.data(), file.size()));
    EXPECT_EQ(image.format, png_uint_32(PNG_FORMAT_RGB));
    Picture picture{int(image.width), int(image.height), {}};
    picture.rgb.resize(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr));
    return picture;
}

Camera viewOfObject(const openvdb::BoolGrid& object)
{
    return viewOf(
        object.evalActiveVoxelBoundingBox(), object.transform(), Vec3d(0, 1, 0), 30, 4.0 / 3);
}

Camera viewOfTree(const SphereTree& tree)
{
    return viewOf(tree.object.bbox, *tree.transform, Vec3d(0, 1, 0), 30, 4.0 / 3);
}

/// How many colours, at one hue and lightness each, are in the middle of balls in a row.
std::set<std::vector<int>> colorsOf(const SphereTree& tree, int level, PictureColor color)
{
    std::set<std::vector<int>> colors;
    const SphereTreeLevel& drawn = tree.levels[level];
    for (int32_t id = drawn.begin; id < drawn.end; ++id) {
        Camera camera;
        camera.lookAt = tree.centerWorld(id);
        camera.eye = camera.lookAt + Vec3d(0, 0, 50);
        camera.fovDegrees = 0.01;
        PictureSettings settings = small(color);
        settings.width = settings.height = 1;
        settings.lightRays = 64;
        const Picture dot = renderLevel(tree, level, camera, settings);
        colors.insert(std::vector<int>(dot.rgb.begin(), dot.rgb.end()));
    }
    return colors;
}

} // namespace

TEST(SpherePicture, AnOrthographicOutlineIsACircleAtAnyDistance)
{
    PictureSettings settings;
    settings.width = 640;
    settings.height = 480;
    settings.color = PictureColor::Fixed;
    settings.fixed = Vec3d(0.0);
    Camera camera;
    camera.fovDegrees = 0;
    camera.height = 6;
    const double pixel = camera.height / settings.height, expected = kPi * 2.25 / (pixel * pixel);
    for (const int dim : {3, 2}) {
        SphereTree tree = treeOf({{Vec3d(2, 1, 0), 1.5}}, 0.5); // at (1, 0.5, 0) in the world
        tree.settings.dim = dim;
        for (const double distance : {0.1, 5.0, 1e6}) {
            camera.lookAt = Vec3d(1, 0.5, 0);
            camera.eye = Vec3d(1, 0.5, distance); // the first is in the ball
            const Picture straight = renderLevel(tree, 0, camera, settings);
            EXPECT_NEAR(darkPixels(straight), expected, 0.005 * expected) << dim << distance;
        }
        // Half as far to the side as it is away: a ball stays a circle, a disc is foreshortened.
        camera.eye = camera.lookAt + Vec3d(2, 0, 4);
        const double seen = dim == 3 ? expected : expected * 2 / std::sqrt(5);
        EXPECT_NEAR(darkPixels(renderLevel(tree, 0, camera, settings)), seen, 0.005 * seen) << dim;
    }
}

TEST(SpherePicture, OfDiscsTheSmallerOneIsInFrontFromBothSides)
{
    SphereTree tree = treeOf({{Vec3d(0.5, 0, 0), 1}, {Vec3d(0, 0, 0), 3}});
    tree.settings.dim = 2;
    PictureSettings settings = small(PictureColor::Id);
    settings.width = settings.height = 1;
    for (const double side : {-1.0, 1.0}) {
        Camera camera;
        camera.fovDegrees = 0;
        camera.height = 0.01;
        const auto seenAt = [&](double x) {
            camera.lookAt = Vec3d(x, 0, 0);
            camera.eye = Vec3d(x, 0, 9 * side);
            return renderLevel(tree, 0, camera, settings).rgb;
        };
        EXPECT_NE(seenAt(0.5), seenAt(-2)) << side;
        SphereTree alone = tree;
        alone.spheres.radiusWorld[1] = 0.5f;
        alone.spheres.center[1] = Vec3d(100, 0, 0);
        tree.spheres.radiusWorld.swap(alone.spheres.radiusWorld);
        tree.spheres.center.swap(alone.spheres.center);
        const auto small = seenAt(0.5);
        tree.spheres.radiusWorld.swap(alone.spheres.radiusWorld);
        tree.spheres.center.swap(alone.spheres.center);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seenAt(0.5)[c], small[c], 3) << side;
    }
}

TEST(SpherePicture, AJpegHoldsThePictureNearly)
{
    const Picture picture =
        renderLevel(treeOf({{Vec3d(0, 0, 0), 3}}), 0, viewOfTree(treeOf({{Vec3d(0), 3}})), small());
    std::ostringstream out;
    if (!writesJpeg()) {
        EXPECT_TRUE(mentions(
            messageOf<openvdb::IoError>([&] { writeJpeg(picture, out); }), "SPHERETREE_WITH_JPEG"));
        return;
    }
    writeJpeg(picture, out);
    const std::string file = out.str();
    EXPECT_EQ(file.substr(0, 3), "\xFF\xD8\xFF");
    EXPECT_EQ(file.substr(file.size() - 2), "\xFF\xD9");
    std::ostringstream again, rough;
    writeJpeg(picture, again);
    EXPECT_EQ(again.str(), file);
    writeJpeg(picture, rough, 10);
    EXPECT_LT(rough.str().size(), file.size());
    EXPECT_THROW(writeJpeg(picture, out, 0), openvdb::ValueError);
    EXPECT_THROW(writeJpeg(Picture(), out), openvdb::ValueError);
    out.setstate(std::ios::badbit);
    EXPECT_THROW(writeJpeg(picture, out), openvdb::IoError);
}

TEST(SpherePicture, TheOutlineOfABallIsTheEllipseOfItsCone)
{
    const SphereTree tree = treeOf({{Vec3d(2, 0, 0), 3}}, 0.5); // at (1, 0, 0) in the world
    PictureSettings settings;
    settings.width = 640;
    settings.height = 480;
    settings.color = PictureColor::Fixed;
    settings.fixed = Vec3d(0.0);
    Camera camera;
    camera.fovDegrees = 50;
    camera.eye = Vec3d(1, 0, 10);
    for (const Vec3d& lookAt :
        {Vec3d(1, 0, 0), Vec3d(2.5, 0, 0), Vec3d(1, -1.2, 1), Vec3d(3, 0.5, 0)}) {
        camera.lookAt = lookAt;
        const Vec3d view = (lookAt - camera.eye).unit();
        const double theta = std::asin(0.3), phi = std::acos(std::min(1.0, view.dot({0, 0, -1})));
        const double expected = outlineArea(theta, phi, settings, camera.fovDegrees);
        ASSERT_GT(expected, 20000);
        EXPECT_NEAR(darkPixels(renderLevel(tree, 0, camera, settings)), expected, 0.002 * expected);
    }
}

TEST(SpherePicture, TheRadiusDrawnIsTheStoredOneButHalfAVoxelAtLeast)
{
    PictureSettings settings = small(PictureColor::Fixed);
    settings.fixed = Vec3d(0.0);
    Camera camera;
    camera.eye = Vec3d(0, 0, 100);
    camera.fovDegrees = 5;
    for (const double radius : {0.0, 0.6, 1.0, 3.0}) {
        const SphereTree tree = treeOf({{Vec3d(0.0), radius}}, 2);
        const double expected =
            outlineArea(std::asin(std::max(radius, 1.0) / 100), 0, settings, camera.fovDegrees);
        EXPECT_NEAR(darkPixels(renderLevel(tree, 0, camera, settings)), expected, 0.02 * expected);
    }
}

TEST(SpherePicture, BallsOfNormsAreThePolyhedraThatTheyAre)
{
    PictureSettings settings = small(PictureColor::Fixed);
    settings.fixed = Vec3d(0.0);
    Camera camera;
    camera.eye = Vec3d(0, 0, 1000); // so far off that what is seen is a projection
    camera.fovDegrees = 0.8;
    const double pixel = 2 * 1000 * std::tan(0.4 * kPi / 180) / settings.height;
    SphereTree tree = treeOf({{Vec3d(0.0), 6}}, 2); // three voxels
    const auto areaOf = [&](const char* dist) {
        tree.settings.pyramid().dist = distanceFromString(dist);
        return darkPixels(renderLevel(tree, 0, camera, settings)) * pixel * pixel;
    };
    // Seen along an axis: a square of 12 x 12, one half as large on its tip, and between them an
    // octagon that the norm's corner (r a / b, r a / b) belongs to.
    EXPECT_NEAR(areaOf("linf"), 144, 3);
    EXPECT_NEAR(areaOf("l1"), 72, 2);
    EXPECT_NEAR(areaOf("chamfer:3,4,5"), 8 * 6 * (6 * 0.75) / 2, 3);
    EXPECT_NEAR(areaOf("l2"), kPi * 36, 3);
    // Turned by 45 degrees the cube shows two of its sides, and the octahedron two tips.
    tree.transform->postRotate(kPi / 4, openvdb::math::Y_AXIS);
    EXPECT_NEAR(areaOf("linf"), 144 * std::sqrt(2), 4);
    EXPECT_NEAR(areaOf("l1"), 72 / std::sqrt(2), 2);
}

TEST(SpherePicture, WhatStandsBeforeTheLampCastsASoftShadowWithoutGrain)
{
    PictureSettings settings = small(PictureColor::Fixed);
    Camera camera;
    camera.eye = Vec3d(0, 0, 30);
    camera.fovDegrees = 4;
    // The lamp is to the left, above and behind the viewer; the second ball is out of sight.
    const Vec3d towardsLamp = Vec3d(-0.55, 0.8, 0.6).unit();
    const Vec3d front(0, 0, 6);
    const auto facing = [&](const std::vector<std::pair<Vec3d, double>>& balls) {
        return renderLevel(treeOf(balls), 0, camera, settings);
    };
    const std::pair<Vec3d, double> lit(Vec3d(0.0), 6), before(front + 10 * towardsLamp, 2);
    const Picture open = facing({lit}), dark = facing({lit, before});
    const std::size_t middle = 3 * (60 * 160 + 80);
    EXPECT_LT(linear(dark.rgb[middle]), 0.75 * linear(open.rgb[middle]));
    EXPECT_GT(linear(dark.rgb[middle]), 0.3 * linear(open.rgb[middle]));
    const Picture edge = facing({lit, {before.first, 0.8}}); // smaller than the lamp seems
    double steps = 0;
    for (std::size_t i = 3; i < edge.rgb.size(); ++i) {
        steps += std::abs(edge.rgb[i] - edge.rgb[i - 3]);
    }
    EXPECT_LT(steps / double(edge.rgb.size()), 1.2) << "of 256";
}

TEST(SpherePicture, TheNumberOfThreadsMakesNoDifference)
{
    const auto object = gridOf(shapes::ball(60));
    const SphereTree tree = buildSphereTree(*object);
    std::vector<Picture> ofLevel, ofObject;
    for (const int threads : {1, 2, 5}) {
        const tbb::global_control limit(
            tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        ofLevel.push_back(renderLevel(tree, 0, viewOfTree(tree), small()));
        ofObject.push_back(renderObject(*object, viewOfObject(*object), small()));
    }
    for (int i = 1; i < 3; ++i) {
        EXPECT_TRUE(ofLevel[i].rgb == ofLevel[0].rgb);
        EXPECT_TRUE(ofObject[i].rgb == ofObject[0].rgb);
    }
    EXPECT_FALSE(ofLevel[0].rgb == ofObject[0].rgb);
}

TEST(SpherePicture, TilesAreDrawnAsTheirVoxels)
{
    auto tiles = openvdb::BoolGrid::create();
    tiles->tree().sparseFill(openvdb::CoordBBox(Coord(-9, 0, -128), Coord(140, 130, 30)), true);
    tiles->tree().setValueOff(Coord(140, 130, 30));
    ASSERT_GT(tiles->tree().activeTileCount(), 0u);
    const auto voxels = tiles->deepCopy();
    voxels->tree().voxelizeActiveTiles();
    const Camera camera = viewOfObject(*tiles);
    EXPECT_TRUE(
        renderObject(*tiles, camera, small()).rgb == renderObject(*voxels, camera, small()).rgb);
}

/// What it costs is counted in TestRayScene.cc.
TEST(SpherePicture, ATileFarAwayLeavesThePictureAsItWas)
{
    const auto near = gridOf(shapes::ball(30));
    auto far = near->deepCopy();
    far->tree().addTile(2, Coord(1 << 27, 1 << 27, -(1 << 27)), true, true);
    Camera camera;
    camera.eye = Vec3d(3, 4, 30);
    const Picture alone = renderObject(*near, camera, small());
    const Picture picture = renderObject(*far, camera, small());
    EXPECT_GT(darkPixels(alone), 100);
    ASSERT_EQ(picture.rgb.size(), alone.rgb.size());
    int others = 0; // the middle of the object is another one, and so is rounding
    for (std::size_t i = 0; i < alone.rgb.size(); ++i) {
        others += std::abs(int(alone.rgb[i]) - int(picture.rgb[i])) > 1;
    }
    EXPECT_LT(others, int(alone.rgb.size()) / 1000);
}

TEST(SpherePicture, AMirroringTransformMirrorsThePicture)
{
    SphereTree tree = treeOf({{Vec3d(0.0), 1}, {Vec3d(3, 0, 0), 1}});
    Camera camera;
    camera.eye = Vec3d(0, 0, 30);
    const auto leftOf = [&] {
        const Picture picture = renderLevel(tree, 0, camera, small(PictureColor::Fixed));
        int left = 0;
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 50; ++x) left += picture.rgb[3 * (y * 160 + x)] < 180;
        }
        return left;
    };
    camera.fovDegrees = 18;
    EXPECT_EQ(leftOf(), 0);
    openvdb::math::Mat4d mirror = openvdb::math::Mat4d::identity();
    mirror[0][0] = -1;
    tree.transform = openvdb::math::Transform::createLinearTransform(mirror);
    EXPECT_GT(leftOf(), 20);
}

TEST(SpherePicture, SiblingsShareAColorAndNeighboursDiffer)
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(1);
    tree.object.bbox.reset(Coord(0, 0, 0), Coord(40, 1, 1));
    addLevel(tree, 4, 1);
    addLevel(tree, 8, 1);
    for (int i = 0; i < 4; ++i) addNode(tree, Vec3d(10 * i, 0, 0), Coord(i, 0, 0), 26, -1);
    for (int i = 0; i < 8; ++i) addNode(tree, Vec3d(5 * i, 0, 0), Coord(i, 0, 0), 2, i / 2);
    for (int32_t id = 4; id < 12; ++id) tree.spheres.radiusWorld[id] = 1;
    EXPECT_EQ(colorsOf(tree, 0, PictureColor::Parent).size(), 4u);
    EXPECT_EQ(colorsOf(tree, 1, PictureColor::Parent), colorsOf(tree, 1, PictureColor::Id))
        << "no parents: as Id";
    EXPECT_EQ(colorsOf(tree, 0, PictureColor::Level).size(), 1u);
    EXPECT_GE(colorsOf(tree, 0, PictureColor::Id).size(), 4u);
    EXPECT_NE(colorsOf(tree, 0, PictureColor::Level), colorsOf(tree, 0, PictureColor::Fixed));
}

TEST(SpherePicture, SpheresSideBySideNeverHaveOneColor)
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(1);
    addLevel(tree, 300, 1);
    for (int i = 0; i < 300; ++i) addNode(tree, Vec3d(2 * i, 0, 0), Coord(i, 0, 0), 2, -1);
    const auto colors = detail::levelColors(tree, tree.levels[0], small(PictureColor::Id), nullptr);
    for (int i = 1; i < 300; ++i) ASSERT_NE(colors[i - 1], colors[i]) << i;
}

TEST(SpherePicture, APngReadsBackToTheSamePixels)
{
    const SphereTree tree = buildSphereTree(*gridOf(shapes::ball(40)));
    const Picture picture = renderLevel(tree, 0, viewOfTree(tree), small());
    std::ostringstream out, again;
    writePng(picture, out);
    writePng(picture, again);
    EXPECT_EQ(out.str(), again.str());
    const Picture read = decoded(out.str());
    EXPECT_EQ(read.width, 160);
    EXPECT_EQ(read.height, 120);
    EXPECT_TRUE(read.rgb == picture.rgb);
}

TEST(SpherePicture, AnEmptyPictureAndAStreamThatFailsAreErrors)
{
    std::ostringstream out;
    messageOf<openvdb::ValueError>([&] { writePng(Picture(), out); });
    messageOf<openvdb::ValueError>([&] { writePng(Picture{2, 2, std::vector<uint8_t>(11)}, out); });
    EXPECT_EQ(out.str(), "");
    out.setstate(std::ios::badbit);
    const Picture dot{1, 1, {1, 2, 3}};
    EXPECT_TRUE(mentions(messageOf<openvdb::IoError>([&] { writePng(dot, out); }), "disk full"));
}

TEST(SpherePicture, AnInterrupterStopsIt)
{
    const auto object = gridOf(shapes::ball(60));
    const SphereTree tree = buildSphereTree(*object);
    for (const int after : {0, 3}) {
        StopAfter level(after), voxels(after);
        EXPECT_THROW(renderLevel(tree, 0, viewOfTree(tree), small(), &level), Interrupted);
        EXPECT_THROW(renderObject(*object, viewOfObject(*object), small(), &voxels), Interrupted);
    }
}

/// A picture of one tile: what asks once a tile would not stop before it is done.
TEST(SpherePicture, AnInterrupterStopsItAtAnyPixelOfATile)
{
    const auto object = gridOf(shapes::ball(60));
    const SphereTree tree = buildSphereTree(*object);
    PictureSettings tile;
    tile.width = tile.height = 40;
    for (const int after : {100, 800, 1500}) {
        StopAfter level(after), voxels(after);
        EXPECT_THROW(renderLevel(tree, 0, viewOfTree(tree), tile, &level), Interrupted);
        EXPECT_THROW(renderObject(*object, viewOfObject(*object), tile, &voxels), Interrupted);
    }
}

/// The sum of its corners does not fit 32 bits: a sanitizer would stop here.
TEST(SpherePicture, AnObjectAtTheEndOfCoordinatesLooksAsElsewhere)
{
    const auto pictureAt = [](int from) {
        auto object = openvdb::BoolGrid::create();
        object->tree().addTile(2, Coord(from), true, true); // 128^3 voxels
        return renderObject(*object, viewOfObject(*object), small()).rgb;
    };
    const auto expected = pictureAt(1 << 20);
    EXPECT_EQ(pictureAt(INT32_MAX - 127), expected);
    EXPECT_EQ(pictureAt(INT32_MIN), expected);
}

/// Nothing is asked of the spheres before: this level has none of those that it says.
TEST(SpherePicture, ALevelThatDoesNotFitTheMemoryIsRefusedBeforeAnythingIsMade)
{
    SphereTree tree = treeOf({{Vec3d(0.0), 1}});
    const double there = detail::physicalMemory();
    constexpr double kShape = 400;
    if (there == 0 || there >= kShape * INT32_MAX) GTEST_SKIP() << "no level is too large for it";
    tree.levels.front().end = int32_t(there / kShape) + 1;
    const std::string why =
        messageOf<openvdb::ValueError>([&] { renderLevel(tree, 0, Camera(), small()); });
    EXPECT_TRUE(mentions(why, "shapes and the 160 x 120 pixels of a picture need about"));
    EXPECT_TRUE(mentions(why, "draw a coarser level, or fewer pixels"));
}

TEST(SpherePicture, WhatIsOutOfRangeIsNamed)
{
    const SphereTree tree = treeOf({{Vec3d(0.0), 1}});
    const auto whyNot = [&](int level, const Camera& camera, const PictureSettings& settings) {
        return messageOf<openvdb::ValueError>([&] { renderLevel(tree, level, camera, settings); });
    };
    EXPECT_TRUE(mentions(whyNot(3, Camera(), small()), "no level 3: it has levels 0 to 0"));
    Camera blind;
    blind.eye = blind.lookAt;
    EXPECT_TRUE(mentions(whyNot(0, blind, small()), "eye"));
    PictureSettings settings = small();
    settings.width = 0;
    EXPECT_TRUE(mentions(whyNot(0, Camera(), settings), "width=0"));
    settings = small();
    settings.height = 16385;
    EXPECT_TRUE(mentions(whyNot(0, Camera(), settings), "height=16385"));
    settings = small();
    settings.samples = 1;
    EXPECT_TRUE(mentions(whyNot(0, Camera(), settings), "samples=1"));
    settings = small();
    settings.fixed[1] = 1.5;
    EXPECT_TRUE(mentions(whyNot(0, Camera(), settings), "color="));
    messageOf<openvdb::ValueError>(
        [&] { renderObject(*openvdb::BoolGrid::create(), Camera(), small()); });
}
