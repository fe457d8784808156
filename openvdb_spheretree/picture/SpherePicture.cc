// SPDX-License-Identifier: Apache-2.0
#include "SpherePicture.h"

#include "BallScene.h"
#include "PictureColors.h"
#include "PictureLight.h"
#include "RayScene.h"
#include "RayShapes.h"
#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/Masks.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Grid.h>
#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

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

/// CoordBBox::getCenter() would add up the corners in 32 bits.
openvdb::Coord middleOf(const openvdb::CoordBBox& box)
{
    return openvdb::Coord::round((box.min().asVec3d() + box.max().asVec3d()) / 2);
}

/// @throw openvdb::ValueError, before shapes are made
void requireRoom(std::size_t shapes, const PictureSettings& settings)
{
    constexpr double kBytesPerShape = 400; // itself, its colour and bound, and nodes of two trees
    const double pixels = double(settings.width) * settings.height;
    detail::requireMemory(double(shapes) * kBytesPerShape + 3 * pixels,
        "the " + std::to_string(shapes) + " shapes and the " + std::to_string(settings.width)
            + " x " + std::to_string(settings.height) + " pixels of a picture",
        "draw a coarser level, or fewer pixels");
}

/// What a picture needs besides shapes and their colours.
struct View {
    View(const Camera& camera, const PictureSettings& pictureSettings,
        const openvdb::math::Transform& transform, const openvdb::CoordBBox& object)
        : settings(pictureSettings),
          rays(camera, transform, middleOf(object), settings.width, settings.height), light(rays),
          occlusionReach(0.25 * (object.max().asVec3d() - object.min().asVec3d()).length() + 2)
    {}

    const PictureSettings& settings;
    detail::CameraRays rays;
    Light light;
    double occlusionReach; ///< in voxels; what is further away shades nothing
};

/// Point @a i of Hammersley's @a count points, which fill the unit square evenly. All are moved by
/// the same random vector, and wrap around at the edges.
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

/// @tparam Scene  a RayScene, or what answers as one
template <typename Scene>
class Painter {
public:
    /// @param colors  linear, one for each shape
    Painter(const Scene& scene, const std::vector<Vec3f>& colors, const View& view)
        : mScene(scene), mColors(colors), mView(view)
    {}

    /// By tiles, not by rows: rays side by side need the same shapes.
    Picture paint(openvdb::util::NullInterrupter* interrupter) const
    {
        Picture picture{mView.settings.width, mView.settings.height, {}};
        picture.rgb.resize(std::size_t(picture.width) * picture.height * 3);
        const std::size_t across = (picture.width + kTile - 1) / kTile;
        const std::size_t tiles = across * ((picture.height + kTile - 1) / kTile);
        detail::parallelFor(tiles, interrupter, [&](std::size_t tile) {
            paintTile(int(tile % across) * kTile, int(tile / across) * kTile, picture, interrupter);
        });
        return picture;
    }

private:
    static constexpr int kTile = 64;  ///< pixels along a side
    static constexpr int kBlur = 2;   ///< light is the mean of that many pixels to each side
    static constexpr int kProbes = 2; ///< every pixel has kProbes x kProbes samples or more

    struct Sample {
        Ray ray;
        double y; ///< in pixels
        std::optional<detail::Hit> hit;
        Vec3d start{0.0}; ///< where rays to the light start, if there is a hit
    };
    using Probes = std::array<Sample, kProbes * kProbes>;

    struct Incident {
        double lamp = 0;    ///< how much of the lamp is visible, 0 to 1
        Vec3d ambient{0.0}; ///< mean light of the sky
    };
    /// What a pixel shows of one smooth surface, and the light on it: means of the samples.
    struct Surface {
        int32_t shape;
        Vec3d point{0.0}, normal{0.0}, toEye{0.0};
        Incident light = {};
    };
    struct Pixel {
        Vec3d color{0.0}; ///< linear; not used where there is a surface
        std::optional<Surface> surface;
    };

    /// The pixels of a tile and kBlur more on each side, which belong to other tiles as well.
    struct Patch {
        int left, top, right, bottom; ///< the last two exclusive
        std::vector<Pixel> pixels;

        Patch(int x, int y, const Picture& picture)
            : left(std::max(0, x - kBlur)), top(std::max(0, y - kBlur)),
              right(std::min(picture.width, x + kTile + kBlur)),
              bottom(std::min(picture.height, y + kTile + kBlur)),
              pixels(std::size_t(right - left) * std::size_t(bottom - top))
        {}
        Pixel& at(int x, int y) { return pixels[std::size_t(y - top) * (right - left) + x - left]; }
    };

    /// A pixel takes microseconds, or milliseconds where it sends thousands of rays: every one asks
    /// the interrupter.
    void paintTile(
        int left, int top, Picture& picture, openvdb::util::NullInterrupter* interrupter) const
    {
        Patch patch(left, top, picture);
        const int right = std::min(left + kTile, picture.width);
        const int bottom = std::min(top + kTile, picture.height);
        for (int y = patch.top; y < patch.bottom; ++y) {
            for (int x = patch.left; x < patch.right; ++x) {
                detail::checkInterrupt(interrupter);
                const bool isInTile = x >= left && x < right && y >= top && y < bottom;
                patch.at(x, y) = pixel(x, y, isInTile);
            }
        }
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                const Pixel& shown = patch.at(x, y);
                const Vec3d light = shown.surface ? blurred(patch, x, y) : shown.color;
                uint8_t* const rgb = &picture.rgb[3 * (std::size_t(y) * picture.width + x)];
                for (int c = 0; c < 3; ++c) rgb[c] = detail::srgbByte(light[c]);
            }
        }
    }

    /// The color of a surface in the mean light of those pixels around it that show nearly the same
    /// plane. So a few rays for each pixel leave no grain, and edges stay sharp.
    Vec3d blurred(Patch& patch, int x, int y) const
    {
        const Surface& here = *patch.at(x, y).surface;
        const int left = std::max(patch.left, x - kBlur);
        const int right = std::min(patch.right, x + kBlur + 1);
        const int top = std::max(patch.top, y - kBlur);
        const int bottom = std::min(patch.bottom, y + kBlur + 1);
        Incident sum;
        int count = 0;
        for (int v = top; v < bottom; ++v) {
            for (int u = left; u < right; ++u) {
                const auto& other = patch.at(u, v).surface;
                if (!other) continue;
                if (!isSmooth(here.point, here.normal, other->point, other->normal)) continue;
                sum.lamp += other->light.lamp;
                sum.ambient += other->light.ambient;
                ++count;
            }
        }
        return mView.light.reflected(Vec3d(mColors[here.shape]), here.normal, here.toEye,
            sum.lamp / count, sum.ambient / count);
    }

    /// Four samples are enough where they all see one smooth surface, or all see nothing.
    /// @param isInTile  if not, only a surface is needed, and no color
    Pixel pixel(int x, int y, bool isInTile) const
    {
        const uint64_t seed = detail::hash(uint64_t(y) << 32 | uint64_t(x));
        const Probes probes = {trace(x, y, 0, kProbes, seed), trace(x, y, 1, kProbes, seed),
            trace(x, y, 2, kProbes, seed), trace(x, y, 3, kProbes, seed)};
        Pixel result;
        const bool alike = areAlike(probes);
        if (alike && probes[0].hit) {
            result.surface = surfaceOf(probes, seed);
        } else if (isInTile) {
            const int side = alike ? kProbes : mView.settings.samples;
            for (int s = 0; s < side * side; ++s) {
                result.color += lightOf(
                    side == kProbes ? probes[s] : trace(x, y, s, side, seed), s, side * side, seed);
            }
            result.color /= side * side;
        }
        return result;
    }

    Surface surfaceOf(const Probes& probes, uint64_t seed) const
    {
        Surface mean{probes[0].hit->shape};
        const auto count = int(probes.size());
        for (int s = 0; s < count; ++s) {
            const Incident light = incidentOn(probes[s], s, count, seed);
            mean.point += probes[s].start / count;
            mean.normal += probes[s].hit->normal;
            mean.toEye -= probes[s].ray.direction;
            mean.light.lamp += light.lamp / count;
            mean.light.ambient += light.ambient / count;
        }
        mean.normal.normalize();
        mean.toEye.normalize();
        return mean;
    }

    /// @return sample @a s of @a side x @a side, at a random place in its part of the pixel.
    Sample trace(int x, int y, int s, int side, uint64_t seed) const
    {
        const uint64_t jitter = detail::hash(seed + uint64_t(s));
        const double u = x + (s % side + detail::unitInterval(jitter)) / side;
        const double v = y + (s / side + detail::unitInterval(jitter << 32)) / side;
        const Ray ray = mView.rays.through(u, v);
        Sample sample{ray, v, mScene.nearest(ray)};
        if (!sample.hit) return sample;
        constexpr double kClear = 1e-4; // off the surface, so that no ray hits it where it starts
        sample.start = ray.at(sample.hit->distance) + kClear * sample.hit->normal;
        return sample;
    }

    /// Whether both points lie in nearly the same plane.
    static bool isSmooth(const Vec3d& p, const Vec3d& normalP, const Vec3d& q, const Vec3d& normalQ)
    {
        constexpr double kCosine = 0.97;  // of some 14 degrees
        constexpr double kOffPlane = 0.3; // sine of the angle from the plane to the other point
        const Vec3d apart = q - p;
        return normalP.dot(normalQ) > kCosine
            && std::abs(apart.dot(normalP)) <= kOffPlane * apart.length();
    }

    /// Whether all samples see one smooth surface of one color, perhaps of several spheres that
    /// overlap; or all see nothing.
    bool areAlike(const Probes& samples) const
    {
        const auto& first = samples.front().hit;
        return std::all_of(samples.begin() + 1, samples.end(), [&](const Sample& other) {
            if (!first || !other.hit) return !first && !other.hit;
            return mColors[first->shape] == mColors[other.hit->shape]
                && isSmooth(samples[0].start, first->normal, other.start, other.hit->normal);
        });
    }

    /// @param s, count  this is sample s of the count samples of its pixel
    Vec3d lightOf(const Sample& sample, int s, int count, uint64_t seed) const
    {
        if (!sample.hit) return Light::background(sample.y / mView.settings.height);
        const Incident light = incidentOn(sample, s, count, seed);
        return mView.light.reflected(Vec3d(mColors[sample.hit->shape]), sample.hit->normal,
            -sample.ray.direction, light.lamp, light.ambient);
    }

    /// The samples of a pixel share one set of points of the lamp and one of the sky, so that they
    /// look at all of both.
    Incident incidentOn(const Sample& sample, int s, int count, uint64_t seed) const
    {
        const Vec3d &from = sample.start, &normal = sample.hit->normal;
        const int lampRays = std::max(1, mView.settings.lightRays / 2 / count);
        int seen = 0;
        for (int k = 0; k < lampRays; ++k) {
            const PlanePoint point(k * count + s, lampRays * count, detail::hash(seed ^ 0x1a));
            const Vec3d towards = mView.light.towardsLamp(point.u, point.v);
            seen += towards.dot(normal) > 0 && !mScene.isBlocked(Ray(from, towards));
        }
        constexpr double kBounce = 0.12; // what blocks the sky reflects some light itself
        const int skyRays = std::max(1, mView.settings.lightRays / count);
        Vec3d sky(0.0);
        for (int k = 0; k < skyRays; ++k) {
            const PlanePoint point(k * count + s, skyRays * count, detail::hash(seed ^ 0x5c));
            const Vec3d towards = Light::towardsSky(normal, point.u, point.v);
            const bool open = !mScene.isBlocked(Ray(from, towards), mView.occlusionReach);
            sky += (open ? 1.0 : kBounce) * mView.light.sky(towards);
        }
        return {double(seen) / lampRays, sky / skyRays};
    }

    const Scene& mScene;
    const std::vector<Vec3f>& mColors;
    const View& mView;
};

/// @return makeBall(center, radius) of every sphere, in index space about the object's middle.
template <typename MakeBall>
auto ballsOf(const SphereTree& tree, const SphereTreeLevel& level, const MakeBall& makeBall)
{
    constexpr double kSmallest = 0.5;
    const Vec3d middle = middleOf(tree.object.bbox).asVec3d();
    std::vector<decltype(makeBall(middle, kSmallest))> balls;
    balls.reserve(level.size());
    for (int32_t id = level.begin; id < level.end; ++id) {
        const double radius = tree.spheres.radiusWorld[id] / tree.voxelSize();
        balls.push_back(makeBall(tree.spheres.center[id] - middle, std::max(radius, kSmallest)));
    }
    return balls;
}

/// @return the discs of a flat tree. They lie in one plane but for a quarter of a voxel, the smaller
///         the nearer to the eye.
std::vector<detail::DiscShape> discsOf(
    const SphereTree& tree, const SphereTreeLevel& level, const Vec3d& forward)
{
    const int axis = tree.flatAxis;
    auto discs = ballsOf(tree, level, [axis](const Vec3d& c, double r) {
        return detail::DiscShape{c, r, axis};
    });
    std::vector<int32_t> order(discs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](int32_t a, int32_t b) { return discs[a].radius > discs[b].radius; });
    constexpr double kDepth = 0.25;
    const double step = (forward[axis] > 0 ? -kDepth : kDepth) / double(discs.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        discs[order[rank]].center[axis] += step * double(rank);
    }
    return discs;
}

/// Whether the kernel of rays finds these balls sooner, the making of its blocks included: that is on one thread, and cannot be
/// interrupted (0.9 s for 138,157 balls).
bool paysOff(const std::vector<detail::BallShape>& balls, const PictureSettings& settings)
{
    constexpr std::size_t kMostBalls = 1 << 18, kPixelsPerBall = 4;
    const std::size_t pixels = std::size_t(settings.width) * std::size_t(settings.height);
    return balls.size() <= std::min(kMostBalls, pixels / kPixelsPerBall)
        && detail::BallScene::isFineEnough(balls);
}

/// @return the leaf nodes and tiles of an object that have voxels.
std::vector<detail::VoxelShape> voxelShapesOf(const openvdb::BoolTree& tree, const Vec3d& middle)
{
    std::vector<detail::VoxelShape> shapes;
    const Vec3d half(0.5);
    const auto add = [&](const openvdb::CoordBBox& box, const detail::VoxelShape::LeafNode* leaf) {
        const Vec3d lo = box.min().asVec3d() - middle - half;
        const Vec3d hi = box.max().asVec3d() - middle + half;
        shapes.push_back({lo, hi, leaf ? leaf->origin().asVec3d() - middle - half : lo, leaf});
    };
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        openvdb::CoordBBox box;
        leaf->evalActiveBoundingBox(box);
        if (!box.empty()) add(box, leaf->isDense() ? nullptr : leaf.getLeaf());
    }
    detail::forEachTile(tree, [&](const openvdb::CoordBBox& box) { add(box, nullptr); });
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
    const SphereTreeLevel& drawn = tree.level(level);
    requireRoom(std::size_t(drawn.size()), settings);
    const auto colors = detail::levelColors(tree, drawn, settings, interrupter);
    const View view(camera, settings, *tree.transform, tree.object.bbox);
    const auto paint = [&](const auto& scene) {
        return Painter(scene, colors, view).paint(interrupter);
    };
    if (!tree.settings.dist().isEuclidean()) {
        const detail::NormFaces faces(tree.settings.dist());
        const auto balls = ballsOf(tree, drawn, [&](const Vec3d& c, double r) {
            return detail::NormBallShape{c, r, &faces};
        });
        return paint(detail::RayScene(balls, interrupter));
    }
    if (tree.settings.dim == 2) {
        return paint(detail::RayScene(discsOf(tree, drawn, view.rays.forward), interrupter));
    }
    const auto balls = ballsOf(tree, drawn, [](const Vec3d& c, double r) {
        return detail::BallShape{c, r};
    });
    if (paysOff(balls, settings)) return paint(detail::BallScene(balls));
    return paint(detail::RayScene(balls, interrupter));
}

Picture renderObject(const openvdb::BoolGrid& object, const Camera& camera,
    const PictureSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    camera.validate();
    settings.validate();
    requireUniformVoxels(object);
    if (object.empty()) OPENVDB_THROW(openvdb::ValueError, "the object has no active voxels");
    const openvdb::CoordBBox box = object.evalActiveVoxelBoundingBox();
    requireRoom(object.tree().leafCount() + object.tree().activeTileCount(), settings);
    const auto shapes = voxelShapesOf(object.tree(), middleOf(box).asVec3d());
    const Vec3d color =
        settings.color == PictureColor::Fixed ? settings.fixed : PictureSettings().fixed;
    const std::vector<Vec3f> colors(shapes.size(), Vec3f(detail::linearOf(color)));
    const View view(camera, settings, object.transform(), box);
    return Painter(detail::RayScene(shapes, interrupter), colors, view).paint(interrupter);
}

} // namespace openvdb_spheretree
