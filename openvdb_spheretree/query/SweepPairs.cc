// SPDX-License-Identifier: Apache-2.0
#include "SweepPairs.h"

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Vec3d;

/// The axis along which centers spread most: by their variance.
int widestAxis(const std::vector<BodySphere>& spheres)
{
    Vec3d mean(0.0), variance(0.0);
    for (const BodySphere& sphere : spheres) mean += sphere.center / double(spheres.size());
    for (const BodySphere& sphere : spheres) {
        const Vec3d off = sphere.center - mean;
        variance += off * off;
    }
    return int(
        std::max_element(variance.asPointer(), variance.asPointer() + 3) - variance.asPointer());
}

} // namespace

std::vector<std::pair<int, int>> sweepPairs(std::vector<BodySphere> spheres, double margin)
{
    const int axis = widestAxis(spheres);
    const auto low = [axis](
                         const BodySphere& sphere) { return sphere.center[axis] - sphere.radius; };
    std::sort(spheres.begin(), spheres.end(), [&](const BodySphere& a, const BodySphere& b) {
        return std::make_pair(low(a), a.body) < std::make_pair(low(b), b.body);
    });
    std::vector<std::pair<int, int>> pairs;
    for (auto a = spheres.begin(); a != spheres.end(); ++a) {
        const double end = a->center[axis] + a->radius + margin;
        const double rounding = kPlaceRounding * (std::abs(end) + a->radius + margin);
        for (auto b = a + 1; b != spheres.end(); ++b) {
            if (low(*b) > end + rounding) break;
            const double reach = a->radius + b->radius + margin;
            if ((a->center - b->center).length() > reach * (1 + kPlaceRounding)) continue;
            pairs.emplace_back(std::min(a->body, b->body), std::max(a->body, b->body));
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace openvdb_spheretree::detail
