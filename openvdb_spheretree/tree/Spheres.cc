// SPDX-License-Identifier: Apache-2.0
#include "Spheres.h"

namespace openvdb_spheretree {

namespace {

/// Calls @a f with each array of @a to beside the same array of @a from.
template <typename To, typename From, typename F>
void eachArray(To& to, From& from, const F& f)
{
    f(to.center, from.center);
    f(to.radius, from.radius);
    f(to.coverRadiusSq, from.coverRadiusSq);
    f(to.radiusWorld, from.radiusWorld);
    f(to.parent, from.parent);
}

} // namespace

void Spheres::reserve(std::size_t count)
{
    eachArray(*this, *this, [&](auto& array, auto&) { array.reserve(count); });
}

void Spheres::resize(std::size_t count)
{
    const openvdb::Vec3d origin(0.0);
    center.resize(count, origin); // whose own default is no value
    eachArray(*this, *this, [&](auto& array, auto&) { array.resize(count); });
}

Spheres Spheres::slice(int32_t begin, int32_t end) const
{
    Spheres result;
    eachArray(result, *this,
        [&](auto& part, const auto& all) { part.assign(all.begin() + begin, all.begin() + end); });
    return result;
}

Spheres Spheres::take(const std::vector<int32_t>& ids) const
{
    Spheres result;
    eachArray(result, *this, [&](auto& part, const auto& all) {
        part.reserve(ids.size());
        for (const int32_t id : ids) part.push_back(all[std::size_t(id)]);
    });
    return result;
}

bool Spheres::operator==(const Spheres& o) const
{
    return center == o.center && radius == o.radius && coverRadiusSq == o.coverRadiusSq
        && radiusWorld == o.radiusWorld && parent == o.parent;
}

} // namespace openvdb_spheretree
