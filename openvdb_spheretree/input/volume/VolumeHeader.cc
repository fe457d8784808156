// SPDX-License-Identifier: Apache-2.0
#include "VolumeHeader.h"

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

using openvdb::IoError;
using openvdb::Vec3d;

std::array<uint64_t, 3> threeSides(std::vector<uint64_t> sides)
{
    if (sides.size() < 2) throw IoError("its array has one axis; a volume has two or three");
    for (std::size_t i = sides.size(); i-- > 0 && sides.size() > 3;) {
        if (sides[i] == 1) sides.erase(sides.begin() + std::ptrdiff_t(i));
    }
    if (sides.size() > 3) {
        throw IoError("its array has " + std::to_string(sides.size())
            + " axes of more than one number; a volume has three");
    }
    sides.resize(3, 1);
    return {sides[0], sides[1], sides[2]};
}

openvdb::Mat4d placeOf(std::array<Vec3d, 3> steps, const Vec3d& origin)
{
    double shortest = 0;
    for (const Vec3d& step : steps) {
        const double length = step.length();
        if (length > 0 && (shortest == 0 || length < shortest)) shortest = length;
    }
    for (int a = 0; a < 3; ++a) {
        if (steps[a] != Vec3d(0)) continue;
        Vec3d normal = steps[(a + 1) % 3].cross(steps[(a + 2) % 3]);
        if (normal.normalize()) steps[a] = shortest * normal;
    }
    openvdb::Mat4d place = openvdb::Mat4d::identity();
    for (int a = 0; a < 3; ++a) {
        for (int i = 0; i < 3; ++i) place(a, i) = steps[a][i];
    }
    place.setTranslation(origin);
    return place;
}

} // namespace openvdb_spheretree::detail
