// SPDX-License-Identifier: Apache-2.0
/// @file ExportFrame.h
/// @brief From world space to the frame and the units of a file.

#pragma once

#include "ExportTree.h"
#include <openvdb_spheretree/measure/MassProperties.h>

#include <openvdb/math/Mat3.h>

namespace openvdb_spheretree::detail {

/// A turn, a shift and a scale. Turns do not mirror: what is left stays left.
class FileFrame {
public:
    /// @param mass  of the body, in world space; looked at only if the frame is that of the body
    FileFrame(const ExportSettings& settings, const MassProperties& mass);

    openvdb::Vec3d toFile(const openvdb::Vec3d& world) const;
    /// @return the same body in the file's frame and units.
    MassProperties toFile(const MassProperties& world, double density) const;
    /// @return how far toFile() may be off by its rounding, in units of the file.
    double slack(const openvdb::Vec3d& world) const;
    double scale() const { return mScale; }

private:
    openvdb::math::Mat3d mAxes =
        openvdb::math::Mat3d::identity();             ///< rows: the file's axes in world space
    openvdb::Vec3d mOrigin = openvdb::Vec3d(0, 0, 0); ///< in world space
    double mScale = 1;
    bool mIsWorld = true;
};

} // namespace openvdb_spheretree::detail
