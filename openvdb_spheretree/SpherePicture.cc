// SPDX-License-Identifier: Apache-2.0
#include "SpherePicture.h"

#include "UniformVoxels.h"
#include "detail/Hash.h"
#include "detail/Parallel.h"
#include "detail/PictureColors.h"
#include "detail/PictureLight.h"
#include "detail/RayScene.h"
#include "detail/RayShapes.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace openvdb_spheretree {

namespace {

using detail::Light;
using detail::Ray;
using openvdb::Vec3d;
using openvdb::Vec3f;

void requireRange(const char* name, int value, int lowest, int highest)
{
    if (value >= lowest && value <= highest) return;
    OPENVDB_THROW(openvdb::ValueError,
        name << "=" << value << " is out of range: it takes " << lowest << " to " << highest);
}

openvdb::Coord middleOf(const openvdb::CoordBBox& box)
{
    return openvdb::Coord::round(box.getCenter());
}

/// What a picture needs besides shapes and their colours.
struct View {
    View(const Camera& camera, const PictureSettings& settings,
        const openvdb::math::Transform& transform, const openvdb::CoordBBox& object)
        : settings(settings), frame(camera, transform, middleOf(object)),
          rays(frame, camera.fovDegrees, settings.width, settings.height), light(frame),
          occlusionReach(0.25 * (object.max().asVec3d() - object.min().asVec3d()).length() + 2)
    {}

    PictureSettings settings;
    detail::CameraFrame frame;
    detail::CameraRays rays;
    Light light;
    double occlusionReach; ///< in voxels; what is further away takes no light from the sky
};

/// Point @a i of @a count of a set that fills the unit square evenly (Hammersley's), moved around by
/// @a seed with wrapping.
struct PlanePoint {
    double u, v;
    PlanePoint(uint32_t i, uint32_t count, uint64_t seed)
    {
        uint32_t reversed = 0;
        for (uint32_t bit = 0; bit < 16; ++bit) reversed |= (i >> bit & 1) << (15 - bit);
        u = (i + 0.5) / count + detail::unitInterval(seed);
        v = (reversed + 0.5) / 65536 + detail::unitInterval(seed << 32);
        u -= std::floor(u);
        v -= std::floor(v);
    }
};

/// @tparam Shape  as in RayShapes.h
template <typename Shape>
class Painter {
public:
    /// @param colors  linear, one a shape
    Painter(
        const detail::RayScene<Shape>& scene, const std::vector<Vec3f>& colors, const View& view)
        : mScene(scene), mColors(colors), mView(view)
    {}

    /// Tiles rather than rows, as neighbouring rays ask for the same shapes.
    Picture paint(openvdb::util::NullInterrupter* interrupter) const
    {
        constexpr int kTile = 16;
        Picture picture;
        picture.width = mView.settings.width;
        picture.height = mView.settings.height;
        picture.rgb.resize(std::size_t(picture.width) * picture.height * 3);
        const std::size_t across = (picture.width + kTile - 1) / kTile;
        const std::size_t tiles = across * ((picture.height + kTile - 1) / kTile);
        detail::parallelFor(tiles, interrupter, [&](std::size_t tile) {
            const int left = int(tile % across) * kTile, top = int(tile / across) * kTile;
            for (int y = top; y < std::min(top + kTile, picture.height); ++y) {
                for (int x = left; x < std::min(left + kTile, picture.width); ++x) {
                    const Vec3d light = pixel(x, y);
                    uint8_t* const rgb = &picture.rgb[3 * (std::size_t(y) * picture.width + x)];
                    for (int c = 0; c < 3; ++c) rgb[c] = detail::srgbByte(light[c]);
                }
            }
        });
        return picture;
    }

private:
    struct Sample {
        Ray ray;
        double y; ///< in pixels
        std::optional<detail::Hit> hit;
    };

    /// A pixel in which four samples see one smooth surface, or nothing, is left at these, with the
    /// rays to the light that it would have had anyway.
    Vec3d pixel(int x, int y) const
    {
        constexpr int kProbes = 2;
        const uint64_t seed = detail::hash(uint64_t(y) << 32 | uint64_t(x));
        std::array<Sample, kProbes* kProbes> probes = {trace(x, y, 0, kProbes, seed),
            trace(x, y, 1, kProbes, seed), trace(x, y, 2, kProbes, seed),
            trace(x, y, 3, kProbes, seed)};
        const int side = mView.settings.samples;
        if (side <= kProbes || areAlike(probes)) return meanOf(probes, seed);
        Vec3d sum(0.0);
        for (int s = 0; s < side * side; ++s) {
            sum += lightOf(trace(x, y, s, side, seed), s, side * side, seed);
        }
        return sum / (side * side);
    }

    template <typename Samples>
    Vec3d meanOf(const Samples& samples, uint64_t seed) const
    {
        Vec3d sum(0.0);
        for (int s = 0; s < int(samples.size()); ++s) {
            sum += lightOf(samples[s], s, int(samples.size()), seed);
        }
        return sum / double(samples.size());
    }

    /// Sample @a s of @a side x @a side, somewhere in its part of the pixel.
    Sample trace(int x, int y, int s, int side, uint64_t seed) const
    {
        const uint64_t jitter = detail::hash(seed + uint64_t(s));
        const double u = x + (s % side + detail::unitInterval(jitter)) / side;
        const double v = y + (s / side + detail::unitInterval(jitter << 32)) / side;
        const Ray ray = mView.rays.through(u, v);
        return {ray, v, mScene.nearest(ray)};
    }

    template <typename Samples>
    static bool areAlike(const Samples& samples)
    {
        constexpr double kSmooth = 0.97; // cosine of some 14 degrees
        const auto& first = samples.front().hit;
        return std::all_of(samples.begin(), samples.end(), [&](const Sample& other) {
            if (!first || !other.hit) return !first && !other.hit;
            return first->shape == other.hit->shape
                && first->normal.dot(other.hit->normal) > kSmooth;
        });
    }

    /// @param s, count  this is sample s of that many of its pixel
    Vec3d lightOf(const Sample& sample, int s, int count, uint64_t seed) const
    {
        if (!sample.hit) return Light::background(sample.y / mView.settings.height);
        // Off the surface, so that rays from there do not find it; no shape is as small as that.
        constexpr double kClear = 1e-4;
        const Vec3d normal = sample.hit->normal;
        const Vec3d from = sample.ray.at(sample.hit->distance) + kClear * normal;
        const double lamp = lampShare(from, normal, s, count, seed);
        return mView.light.reflected(Vec3d(mColors[sample.hit->shape]), normal,
            -sample.ray.direction, lamp, ambient(from, normal, s, count, seed));
    }

    /// The samples of a pixel share one set of points, so that they look at all of the lamp.
    double lampShare(const Vec3d& from, const Vec3d& normal, int s, int count, uint64_t seed) const
    {
        const int rays = std::max(1, mView.settings.lightRays / 2 / count);
        int seen = 0;
        for (int k = 0; k < rays; ++k) {
            const PlanePoint point(k * count + s, rays * count, detail::hash(seed ^ 0x1a));
            const Vec3d towards = mView.light.towardsLamp(point.u, point.v);
            seen += towards.dot(normal) > 0 && !mScene.isBlocked(Ray(from, towards));
        }
        return double(seen) / rays;
    }

    /// The same for the sky.
    Vec3d ambient(const Vec3d& from, const Vec3d& normal, int s, int count, uint64_t seed) const
    {
        constexpr double kBounce = 0.12; // what blocks the sky is lit itself
        const int rays = std::max(1, mView.settings.lightRays / count);
        Vec3d sum(0.0);
        for (int k = 0; k < rays; ++k) {
            const PlanePoint point(k * count + s, rays * count, detail::hash(seed ^ 0x5c));
            const Vec3d towards = Light::towardsSky(normal, point.u, point.v);
            const bool open = !mScene.isBlocked(Ray(from, towards), mView.occlusionReach);
            sum += (open ? 1.0 : kBounce) * mView.light.sky(towards);
        }
        return sum / rays;
    }

    const detail::RayScene<Shape>& mScene;
    const std::vector<Vec3f>& mColors;
    const View& mView;
};

const SphereTreeLevel& levelOf(const SphereTree& tree, int level)
{
    for (const SphereTreeLevel& found : tree.levels) {
        if (found.level == level) return found;
    }
    OPENVDB_THROW(openvdb::ValueError,
        "the tree has no level " << level << ": it has levels "
                                 << (tree.levels.empty() ? 0 : tree.levels.front().level) << " to "
                                 << (tree.levels.empty() ? -1 : tree.root().level));
}

/// @return makeBall(center, radius) of every sphere, in index space about the object's middle.
template <typename MakeBall>
auto ballsOf(const SphereTree& tree, const SphereTreeLevel& level, const MakeBall& makeBall)
{
    constexpr double kSmallest = 0.5;
    const Vec3d middle = middleOf(tree.object.bbox).asVec3d();
    std::vector<decltype(makeBall(middle, kSmallest))> balls;
    balls.reserve(level.size());
    for (int32_t id = level.begin; id < level.end; ++id) {
        const double radius = tree.radiusWorld[id] / tree.voxelSize();
        balls.push_back(makeBall(tree.center[id] - middle, std::max(radius, kSmallest)));
    }
    return balls;
}

template <typename Shape>
Picture painted(const std::vector<Shape>& shapes, const std::vector<Vec3f>& colors,
    const View& view, openvdb::util::NullInterrupter* interrupter)
{
    const detail::RayScene<Shape> scene(shapes, interrupter);
    return Painter<Shape>(scene, colors, view).paint(interrupter);
}

/// The leaf nodes and tiles of an object that have voxels.
std::vector<detail::VoxelShape> voxelShapesOf(
    const openvdb::BoolTree& tree, const openvdb::Coord& middle)
{
    std::vector<detail::VoxelShape> shapes;
    const Vec3d half(0.5);
    const auto add = [&](const openvdb::CoordBBox& box,
                         const openvdb::BoolTree::LeafNodeType* leaf) {
        detail::VoxelShape shape;
        shape.lo = box.min().asVec3d() - middle.asVec3d() - half;
        shape.hi = box.max().asVec3d() - middle.asVec3d() + half;
        shape.leaf = leaf;
        if (leaf) shape.corner = leaf->origin().asVec3d() - middle.asVec3d() - half;
        shapes.push_back(shape);
    };
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        openvdb::CoordBBox box;
        leaf->evalActiveBoundingBox(box);
        if (!box.empty()) add(box, leaf->isDense() ? nullptr : leaf.getLeaf());
    }
    auto tile = tree.cbeginValueOn();
    tile.setMaxDepth(openvdb::BoolTree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        openvdb::CoordBBox box;
        if (tile.getBoundingBox(box)) add(box, nullptr);
    }
    return shapes;
}

} // namespace

void PictureSettings::validate() const
{
    requireRange("width", width, 1, kMaxSide);
    requireRange("height", height, 1, kMaxSide);
    requireRange("samples", samples, 2, kMaxSamples);
    requireRange("lightRays", lightRays, 1, kMaxLightRays);
    for (int c = 0; c < 3; ++c) {
        if (fixed[c] >= 0 && fixed[c] <= 1) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "color=" << fixed << " is out of range: red, green and blue are 0 to 1 each");
    }
}

Picture renderLevel(const SphereTree& tree, int level, const Camera& camera,
    const PictureSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    camera.validate();
    settings.validate();
    const SphereTreeLevel& drawn = levelOf(tree, level);
    const auto colors = detail::levelColors(tree, drawn, settings, interrupter);
    const View view(camera, settings, *tree.transform, tree.object.bbox);
    if (tree.settings.dist.isEuclidean()) {
        const auto ball = [](const Vec3d& c, double r) { return detail::BallShape{c, r}; };
        return painted(ballsOf(tree, drawn, ball), colors, view, interrupter);
    }
    const detail::NormFaces faces(tree.settings.dist);
    const auto ball = [&](const Vec3d& c, double r) { return detail::NormBallShape{c, r, &faces}; };
    return painted(ballsOf(tree, drawn, ball), colors, view, interrupter);
}

Picture renderObject(const openvdb::BoolGrid& object, const Camera& camera,
    const PictureSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    camera.validate();
    settings.validate();
    requireUniformVoxels(object);
    if (object.empty()) OPENVDB_THROW(openvdb::ValueError, "the object has no active voxels");
    const openvdb::CoordBBox box = object.evalActiveVoxelBoundingBox();
    const auto shapes = voxelShapesOf(object.tree(), middleOf(box));
    const Vec3d color =
        settings.color == PictureColor::Fixed ? settings.fixed : PictureSettings().fixed;
    const std::vector<Vec3f> colors(shapes.size(), Vec3f(detail::linearOf(color)));
    const View view(camera, settings, object.transform(), box);
    return painted(shapes, colors, view, interrupter);
}

} // namespace openvdb_spheretree
