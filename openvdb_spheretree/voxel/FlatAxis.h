// SPDX-License-Identifier: Apache-2.0
/// @file FlatAxis.h
/// @brief Objects one voxel thick along an axis are turned so that this axis is z, which the stages
/// leave out in two dimensions. Their results are turned back. The two other axes keep their order:
/// so does the order of voxels, and with it every tie.

#pragma once

#include "Masks.h"

namespace openvdb_spheretree {

/// @return the axis along which a box is one voxel thick, z before y before x; -1 if there is none.
int flatAxisOf(const openvdb::CoordBBox& box);

class FlatAxis {
public:
    /// @param axis  the flat axis, 0 to 2; 2 changes nothing
    explicit FlatAxis(int axis) : mAxis(axis) {}

    /// @return the vector with the flat axis moved to the end.
    template <typename Vector>
    Vector toZ(const Vector& v) const
    {
        if (mAxis == 0) return Vector(v[1], v[2], v[0]);
        return mAxis == 1 ? Vector(v[0], v[2], v[1]) : v;
    }
    /// @return the vector with z moved to the flat axis.
    template <typename Vector>
    Vector fromZ(const Vector& v) const
    {
        if (mAxis == 0) return Vector(v[2], v[0], v[1]);
        return mAxis == 1 ? Vector(v[0], v[2], v[1]) : v;
    }
    openvdb::CoordBBox toZ(const openvdb::CoordBBox& box) const
    {
        return {toZ(box.min()), toZ(box.max())};
    }
    /// The voxels of a flat mask, one by one; the mask itself if the axis is z.
    openvdb::MaskTree::Ptr toZ(const openvdb::MaskTree::Ptr& mask) const;
    openvdb::MaskTree::Ptr fromZ(const openvdb::MaskTree::Ptr& mask) const;

    bool isZ() const { return mAxis == 2; }

private:
    int mAxis;
};

/// @return how to turn @a object for stages that leave out z if @a dim is 2. An object that is flat
///         along no axis is not turned: each of its slices of equal z is an object of its own.
FlatAxis flatAxisOf(const openvdb::BoolGrid& object, int dim);

/// @return the active voxels of @a object as the stages take them: turned so that its flat axis is z.
openvdb::MaskTree::Ptr voxelsOf(const openvdb::BoolGrid& object, const FlatAxis& flat);

} // namespace openvdb_spheretree
