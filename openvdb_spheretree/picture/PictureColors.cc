// SPDX-License-Identifier: Apache-2.0
/// @file PictureColors.cc
/// @brief Twelve colours of about one lightness are handed out so that what lies side by side
/// differs: greedily, by id, avoiding the colours of the nearest neighbours that have one.

#include "PictureColors.h"

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/index/BoundingTree.h>

#include <openvdb/math/Math.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace openvdb_spheretree {
namespace detail {

namespace {

using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr int kHues = 12;

/// Oklab (Ottosson 2020): equal steps look equal, so that no hue shouts.
Vec3d linearOfOklab(double lightness, double a, double b)
{
    const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    return Vec3d(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}

/// Every second one a little darker, to tell neighbours on the circle apart.
Vec3f paletteColor(int index)
{
    const double hue = 2 * openvdb::math::pi<double>() * (index + 0.6) / kHues;
    const double lightness = index % 2 ? 0.70 : 0.80, chroma = 0.115;
    Vec3d color = linearOfOklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
    for (int c = 0; c < 3; ++c) color[c] = std::min(std::max(color[c], 0.01), 1.0);
    return Vec3f(color);
}

constexpr int kPlain = 8; ///< the blue one, where one colour is all there is

/// The nodes in [begin, end) of a tree, each with the index of a colour.
class Coloring {
public:
    Coloring(const SphereTree& tree, int32_t begin, int32_t end,
        openvdb::util::NullInterrupter* interrupter)
        : mTree(tree), mBegin(begin), mBounds(boundsOf(begin, end), interrupter)
    {
        mColors.resize(end - begin, -1);
        for (int32_t i = 0; i < end - begin; ++i) {
            if (i % 1024 == 0) checkInterrupt(interrupter);
            mColors[i] = choose(i);
        }
    }
    int colorOf(int32_t id) const { return mColors[id - mBegin]; }

private:
    struct Neighbour {
        double distanceSq;
        int32_t index;
        bool operator<(const Neighbour& o) const
        {
            return distanceSq != o.distanceSq ? distanceSq < o.distanceSq : index < o.index;
        }
    };

    /// Half as large as the sphere, and a voxel: overlapping spheres would all be neighbours.
    Bound boundOf(int32_t id) const
    {
        return Bound::ofBall(mTree.spheres.center[id], mTree.spheres.radius[id] / 2 + 1);
    }
    std::vector<Bound> boundsOf(int32_t begin, int32_t end) const
    {
        std::vector<Bound> bounds;
        for (int32_t id = begin; id < end; ++id) bounds.push_back(boundOf(id));
        return bounds;
    }

    /// A colour that none of the nearest kHues - 1 neighbours has.
    int choose(int32_t i) const
    {
        std::array<Neighbour, kHues - 1> nearest;
        int count = 0;
        mBounds.visitMeeting(boundOf(mBegin + i), [&](int32_t place) {
            const int32_t other = mBounds.order()[place];
            if (other >= i) return; // has no colour yet
            const Vec3d apart =
                mTree.spheres.center[mBegin + other] - mTree.spheres.center[mBegin + i];
            const Neighbour neighbour{apart.lengthSqr(), other};
            const double reach = boundOf(mBegin + other).radius + boundOf(mBegin + i).radius;
            if (neighbour.distanceSq > reach * reach) return; // bounds are not exact
            if (count == kHues - 1 && !(neighbour < nearest[count - 1])) return;
            const int last = count < kHues - 1 ? count++ : count - 1;
            nearest[last] = neighbour;
            std::sort(nearest.begin(), nearest.begin() + count);
        });
        std::array<bool, kHues> used = {};
        for (int n = 0; n < count; ++n) used[mColors[nearest[n].index]] = true;
        int color = int(hash(uint64_t(i)) % kHues);
        while (used[color]) color = (color + 5) % kHues; // 5 and 12 have no divisor in common
        return color;
    }

    const SphereTree& mTree;
    const int32_t mBegin;
    BoundingTree mBounds;
    std::vector<int> mColors;
};

/// The level whose nodes are the parents of @a level, or null.
const SphereTreeLevel* levelAbove(const SphereTree& tree, const SphereTreeLevel& level)
{
    for (const SphereTreeLevel& other : tree.levels) {
        if (other.end == level.begin && other.size() > 0) return &other;
    }
    return nullptr;
}

} // namespace

Vec3d linearOf(const Vec3d& srgb)
{
    Vec3d linear;
    for (int c = 0; c < 3; ++c) {
        const double v = srgb[c];
        linear[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    return linear;
}

uint8_t srgbByte(double linear)
{
    const double v = std::min(std::max(linear, 0.0), 1.0);
    const double coded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return uint8_t(255 * coded + 0.5);
}

std::vector<Vec3f> levelColors(const SphereTree& tree, const SphereTreeLevel& level,
    const PictureSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    Vec3f one = paletteColor(kPlain);
    if (settings.color == PictureColor::Fixed) one = Vec3f(linearOf(settings.fixed));
    if (settings.color == PictureColor::Level)
        one = paletteColor((kPlain + 5 * level.level) % kHues);
    std::vector<Vec3f> colors(level.size(), one);
    if (settings.color == PictureColor::Id) {
        const Coloring own(tree, level.begin, level.end, interrupter);
        for (int32_t id = level.begin; id < level.end; ++id) {
            colors[id - level.begin] = paletteColor(own.colorOf(id));
        }
    }
    const SphereTreeLevel* const above = levelAbove(tree, level);
    if (settings.color != PictureColor::Parent || !above) return colors;
    const Coloring ofParents(tree, above->begin, above->end, interrupter);
    for (int32_t id = level.begin; id < level.end; ++id) {
        const int32_t parent = tree.spheres.parent[id];
        if (parent >= 0) colors[id - level.begin] = paletteColor(ofParents.colorOf(parent));
    }
    return colors;
}

} // namespace detail
} // namespace openvdb_spheretree
