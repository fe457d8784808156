// SPDX-License-Identifier: Apache-2.0
/// @file SpherePoints.cc
/// @brief Points of a grid to spheres, with any codec of OpenVDB's, by its attribute handles.

#include "SphereFile.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/points/AttributeArray.h>
#include <openvdb/points/PointDataGrid.h>

#include <cmath>

namespace openvdb_spheretree {

namespace {

using openvdb::points::AttributeArray;
using openvdb::points::AttributeHandle;
using openvdb::points::PointDataGrid;
using Leaf = PointDataGrid::TreeType::LeafNodeType;

const AttributeArray* attributeOf(const Leaf& leaf, const char* name)
{
    const AttributeArray* const array = leaf.attributeSet().getConst(name);
    if (array && array->stride() != 1) {
        OPENVDB_THROW(openvdb::ValueError,
            "attribute '" << name << "' has " << array->stride() << " values a point, not one");
    }
    return array;
}

template <typename T>
void appendValues(const AttributeArray& array, std::vector<double>& values)
{
    const AttributeHandle<T> handle(array);
    for (openvdb::Index n = 0; n < array.size(); ++n) values.push_back(double(handle.get(n)));
}

void appendRadii(const Leaf& leaf, std::vector<double>& radii)
{
    const AttributeArray* array = attributeOf(leaf, "pscale");
    if (!array) array = attributeOf(leaf, "radius");
    if (!array) {
        OPENVDB_THROW(openvdb::ValueError,
            "its points have neither the attribute 'pscale' nor 'radius', so they are no spheres");
    }
    if (array->valueType() == "float") appendValues<float>(*array, radii);
    else if (array->valueType() == "double") appendValues<double>(*array, radii);
    else {
        OPENVDB_THROW(openvdb::ValueError,
            "its radii are of type " << detail::inQuotes(array->valueType())
                                     << ", not float or double");
    }
}

void appendCenters(const Leaf& leaf, const openvdb::math::Transform& transform,
    std::vector<openvdb::Vec3d>& centers)
{
    const AttributeArray* const array = attributeOf(leaf, "P");
    if (!array || array->valueType() != "vec3s") {
        OPENVDB_THROW(openvdb::ValueError, "its points have no attribute 'P' of type vec3s");
    }
    const AttributeHandle<openvdb::Vec3f> handle(*array);
    openvdb::Index n = 0;
    for (openvdb::Index v = 0; v < Leaf::SIZE; ++v) {
        const openvdb::Vec3d voxel = leaf.offsetToGlobalCoord(v).asVec3d();
        for (const openvdb::Index end = leaf.getValue(v); n < end; ++n) {
            centers.push_back(transform.indexToWorld(voxel + openvdb::Vec3d(handle.get(n))));
        }
    }
}

void requireFinite(const WorldSpheres& spheres)
{
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (!spheres.center[i].isFinite()) {
            OPENVDB_THROW(openvdb::ValueError, "the position of point " << i << " is not finite");
        }
        if (spheres.radius[i] > 0 && std::isfinite(spheres.radius[i])) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "the radius " << spheres.radius[i] << " of point " << i
                          << " is not above 0 and finite");
    }
}

WorldSpheres read(const PointDataGrid& grid)
{
    WorldSpheres spheres;
    spheres.name = grid.getName();
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        leaf->validateOffsets();
        if (leaf->getLastValue() == 0) continue;
        appendCenters(*leaf, grid.transform(), spheres.center);
        appendRadii(*leaf, spheres.radius);
    }
    if (spheres.size() == 0) OPENVDB_THROW(openvdb::ValueError, "it has no points");
    requireFinite(spheres);
    return spheres;
}

} // namespace

WorldSpheres spheresOfPoints(const openvdb::GridBase& grid)
{
    try {
        if (grid.isType<PointDataGrid>()) return read(static_cast<const PointDataGrid&>(grid));
    } catch (const openvdb::Exception& error) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid) << " cannot be read as spheres: " << detail::messageOf(error));
    }
    OPENVDB_THROW(openvdb::ValueError, detail::describe(grid) << " is no grid of points");
}

} // namespace openvdb_spheretree
