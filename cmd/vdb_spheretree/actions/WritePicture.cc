// SPDX-License-Identifier: Apache-2.0
#include "WritePicture.h"

#include "GivenSpheres.h"
#include "ObjectChoice.h"
#include "WriteChart.h"
#include "WriteExport.h"

#include <openvdb_spheretree/picture/Camera.h>
#include <openvdb_spheretree/picture/SpherePicture.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <algorithm>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::Camera;
using spheretree::Picture;
using spheretree::PictureColor;
using spheretree::PictureSettings;
using spheretree::SphereTree;

namespace {

openvdb::Vec3d vectorOf(const ActionCall& call, const std::string& option)
{
    const auto numbers = call.vector(option);
    return {numbers[0], numbers[1], numbers[2]};
}

PictureSettings settingsOf(const ActionCall& call)
{
    PictureSettings settings;
    settings.width = int(call.integer("width"));
    settings.height = int(call.integer("height"));
    const std::string color = call.text("color");
    if (color == "parent") {
        settings.color = PictureColor::Parent;
    } else if (color == "level") {
        settings.color = PictureColor::Level;
    } else if (color == "id") {
        settings.color = PictureColor::Id;
    } else if (const auto rgb = parseVector(color)) {
        settings.color = PictureColor::Fixed;
        settings.fixed = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
    } else {
        throwUsage("color=" + color
            + " is not understood: it takes parent, level, id, or red,green,blue of 0 to 1 each");
    }
    settings.validate();
    return settings;
}

/// Far from the object, rounding would turn the camera, or put its eye on the point it looks at.
void requireKeptView(const ActionCall& call, const Camera& view, const Camera& moved)
{
    constexpr double kMaxTurn = 1e-3; // radians; a pixel or so
    const openvdb::Vec3d before = view.eye - view.lookAt, after = moved.eye - moved.lookAt;
    if ((after - before).length() <= kMaxTurn * before.length()) return;
    throwUsage("lookat=" + call.text("lookat")
        + " is too far from the object to look at it from where the object is seen: give eye= too");
}

/// @param view  has the values of what the user has not chosen
Camera cameraOf(const ActionCall& call, const Camera& view)
{
    Camera camera = view;
    if (call.given("lookat")) camera.lookAt = vectorOf(call, "lookat");
    if (call.given("eye")) {
        camera.eye = vectorOf(call, "eye");
    } else {
        camera.eye += camera.lookAt - view.lookAt;
        requireKeptView(call, view, camera);
    }
    try {
        camera.validate();
    } catch (const openvdb::ValueError&) {
        rethrowNamed("", kUsage);
    }
    return camera;
}

/// @return the view of @a object, changed by what the user has chosen.
Camera cameraOf(const ActionCall& call, const openvdb::CoordBBox& object,
    const openvdb::math::Transform& transform)
{
    const double aspect = double(call.integer("width")) / double(call.integer("height"));
    const bool isFlat = spheretree::flatAxisOf(object) >= 0;
    const double fov = isFlat && !call.given("fov") ? 0 : call.real("fov");
    return cameraOf(call, spheretree::viewOf(object, transform, vectorOf(call, "up"), fov, aspect));
}

/// The background alone: a camera that turns its back on the only voxel.
Picture pictureOfNothing(const ActionCall& call, Session& session)
{
    const auto object = openvdb::BoolGrid::create();
    object->tree().setValueOn(openvdb::Coord(0), true);
    Camera camera;
    camera.eye = {0, 0, 10};
    camera.lookAt = {0, 0, 20};
    PictureSettings settings = settingsOf(call);
    settings.color = PictureColor::Fixed;
    return spheretree::renderObject(*object, camera, settings, &session.progress);
}

StackItem& itemToDraw(const std::vector<StackItem*>& items, const std::string& path)
{
    std::vector<StackItem*> trees, grids;
    for (StackItem* item : items) {
        (item->anyTree() ? trees : grids).push_back(item);
    }
    const std::vector<StackItem*>& found = trees.empty() ? grids : trees;
    if (found.size() == 1) return *found.front();
    throwInput(path + " is a picture of one sphere-tree or object, and there are "
        + std::to_string(found.size()) + ": choose with vdb=");
}

Picture pictureOfTree(const ActionCall& call, const SphereTree& tree, Session& session)
{
    const int level = call.given("level") ? int(call.integer("level")) : tree.levels.front().level;
    if (!tree.hasLevel(level)) {
        throwInput("the tree has no level " + call.text("level") + ": it has levels "
            + std::to_string(tree.levels.front().level) + " to "
            + std::to_string(tree.root().level));
    }
    const Camera camera = cameraOf(call, tree.object.bbox, *tree.transform);
    PictureSettings settings = settingsOf(call);
    // Without parents all spheres would be of one colour.
    if (!call.given("color") && level == tree.root().level) settings.color = PictureColor::Id;
    return spheretree::renderLevel(tree, level, camera, settings, &session.progress);
}

Picture pictureOfObject(const ActionCall& call, const StackItem& item, Session& session)
{
    const PictureSettings settings = settingsOf(call);
    if (call.given("level")) throwInput("level is for sphere-trees, and a grid is drawn");
    if (call.given("color") && settings.color != PictureColor::Fixed) {
        throwInput("color=" + call.text("color")
            + " is for sphere-trees, and a grid is drawn: it takes red,green,blue");
    }
    const openvdb::BoolGrid::ConstPtr object = objectOf(item, {}, session);
    const openvdb::CoordBBox box = object->evalActiveVoxelBoundingBox();
    const Camera camera = cameraOf(call, box, object->transform());
    return spheretree::renderObject(*object, camera, settings, &session.progress);
}

} // namespace

std::vector<OptionSpec> pictureOptions()
{
    constexpr int kMaxSide = PictureSettings::kMaxSide;
    return {
        vector("eye", "",
            "pictures: where the camera stands, x,y,z in world units (by default it sees all of "
            "the object, the same for every level)"),
        vector("lookat", "", "pictures: the point in the middle (by default the object's)"),
        vector("up", "0,1,0", "the direction that is upright; z is short for 0,0,1"),
        real("fov", "30", 0, Camera::kMaxFov,
            "pictures: vertical angle of view in degrees; 0 for an orthographic camera, which is "
            "the "
            "default for objects one voxel thick"),
        integer("width", "1280", 1, kMaxSide, "pictures and curves: pixels, at most 16384"),
        integer("height", "960", 1, kMaxSide, "pictures and curves: pixels, at most 16384"),
        integer("level", "0", 0, 1000,
            "the level that is drawn, or written for another tool; by default the finest there is, "
            "or "
            "all where the file holds them"),
        text("color", "parent",
            "pictures: parent (siblings share a colour; without parents as id), level, id, or "
            "red,green,blue of 0 to 1")};
}

void checkPictureOptions(const ActionCall& call)
{
    const std::vector<std::string> files = call.list("files");
    const bool picture = std::any_of(files.begin(), files.end(),
        [&](const std::string& path) { return isPicture(fileKind(path)) && !isChart(call, path); });
    const bool chart = std::any_of(
        files.begin(), files.end(), [&](const std::string& path) { return isChart(call, path); });
    const bool isExport = std::any_of(files.begin(), files.end(),
        [&](const std::string& path) { return exportFormatOf(call, path) != nullptr; });
    for (const OptionSpec& option : pictureOptions()) {
        if (picture || !call.given(option.name)) continue;
        if (isExport && (option.name == "level" || option.name == "up")) continue;
        if (chart && (option.name == "width" || option.name == "height")) continue;
        const bool isOfTrees = option.name == "level" || option.name == "up";
        throwUsage("option " + option.name
            + (isOfTrees ? " is for pictures and files of other tools, and none is written "
                           "(-help write lists them)"
                         : " is for pictures, and none is written (.png, .jpg)"));
    }
    settingsOf(call);
    if (!picture) return;
    Camera camera; // what is not known before the object is stays as it is, which is in range
    camera.fovDegrees = call.real("fov");
    camera.up = vectorOf(call, "up");
    if (call.given("eye")) camera.eye = vectorOf(call, "eye");
    if (call.given("lookat")) camera.lookAt = vectorOf(call, "lookat");
    camera.validateRanges();
    if (call.given("eye") && call.given("lookat")) camera.validate();
}

Picture pictureOf(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, Session& session)
{
    StackItem& item = itemToDraw(items, path);
    if (item.emptyTree) return pictureOfNothing(call, session);
    placeInObject(item, session); // so that it shares its view with the object's picture
    return item.tree ? pictureOfTree(call, *item.tree, session)
                     : pictureOfObject(call, item, session);
}

} // namespace command
