// SPDX-License-Identifier: Apache-2.0
/// There are twelve colours of about the same lightness. Spheres get theirs in the order of their
/// ids: one that the nearest neighbours do not have yet, so that what lies side by side differs.

#include "PictureColors.h"

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/index/BoundingTree.h>

#include <openvdb/math/Math.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr int kHues = 12;
constexpr int kPlain = 8; ///< blue: for spheres that all have one colour

/// Colours of Oklab (Ottosson 2020), where hues of one lightness look equally light. Every second
/// one is a little darker, to tell neighbours on the circle apart.
Vec3f paletteColor(int index)
{
    const double hue = 2 * openvdb::math::pi<double>() * (index + 0.6) / kHues;
    const double lightness = index % 2 ? 0.70 : 0.80, chroma = 0.115;
    const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
    const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    Vec3d color(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
    for (int c = 0; c < 3; ++c) color[c] = std::min(std::max(color[c], 0.01), 1.0);
    return Vec3f(color);
}

/// @return a colour that none of the nearest kHues - 1 neighbours of body @a i has, of those with a
///         smaller number: these have their @a colors already.
int colorOf(int32_t i, const std::vector<Bound>& bounds, const BoundingTree& bodies,
    const std::vector<int>& colors)
{
    using Neighbour = std::pair<double, int32_t>; // squared distance, number
    std::array<Neighbour, kHues - 1> nearest;
    int count = 0;
    bodies.visitMeeting(bounds[i], [&](int32_t place) {
        const int32_t other = bodies.order()[place];
        if (other >= i) return;
        const double distanceSq = (bounds[other].center - bounds[i].center).lengthSqr();
        const double reach = bounds[other].radius + bounds[i].radius;
        if (distanceSq > reach * reach) return; // BoundingTree rounds bounds outwards
        const Neighbour neighbour(distanceSq, other);
        if (count == kHues - 1 && !(neighbour < nearest[count - 1])) return;
        const int last = count < kHues - 1 ? count++ : count - 1;
        nearest[last] = neighbour;
        std::sort(nearest.begin(), nearest.begin() + count);
    });
    std::array<bool, kHues> used = {};
    for (int n = 0; n < count; ++n) used[colors[nearest[n].second]] = true;
    int color = int(hash(uint64_t(i)) % kHues);
    while (used[color]) color = (color + 5) % kHues; // 5 and 12 have no divisor in common
    return color;
}

/// @return for each node of a level the index of a colour.
std::vector<int> coloring(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter)
{
    // Of half the radius, and a voxel: with the whole radius there would be too many neighbours.
    std::vector<Bound> bounds;
    for (int32_t id = level.begin; id < level.end; ++id) {
        bounds.push_back(Bound::ofBall(tree.spheres.center[id], tree.spheres.radius[id] / 2 + 1));
    }
    const BoundingTree bodies(bounds, interrupter);
    std::vector<int> colors(level.size(), -1);
    for (int32_t i = 0; i < level.size(); ++i) {
        if (i % 1024 == 0) checkInterrupt(interrupter);
        colors[i] = colorOf(i, bounds, bodies, colors);
    }
    return colors;
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
    if (settings.color == PictureColor::Level) {
        one = paletteColor((kPlain + 5 * level.level) % kHues);
    }
    std::vector<Vec3f> colors(level.size(), one);
    const bool hasParents = tree.hasLevel(level.level + 1);
    const bool lacksParents =
        settings.color == PictureColor::Parent && !hasParents && level.size() > 1;
    if (settings.color == PictureColor::Id || lacksParents) {
        const std::vector<int> own = coloring(tree, level, interrupter);
        std::transform(own.begin(), own.end(), colors.begin(), paletteColor);
    }
    if (settings.color == PictureColor::Parent && hasParents) {
        const SphereTreeLevel& above = tree.level(level.level + 1);
        const std::vector<int> ofParents = coloring(tree, above, interrupter);
        for (int32_t id = level.begin; id < level.end; ++id) {
            const int32_t parent = tree.spheres.parent[id];
            if (parent < 0) continue;
            colors[id - level.begin] = paletteColor(ofParents[parent - above.begin]);
        }
    }
    return colors;
}

} // namespace openvdb_spheretree::detail
