// SPDX-License-Identifier: Apache-2.0
#include "ExportFrame.h"

#include <cmath>
#include <limits>

namespace openvdb_spheretree::detail {

FileFrame::FileFrame(const ExportSettings& settings, const MassProperties& mass)
    : mScale(settings.scale), mIsWorld(settings.frame == ExportFrame::World)
{
    if (!mIsWorld) mOrigin = mass.center;
    if (settings.frame == ExportFrame::Principal) mAxes = mass.principalAxes;
}

openvdb::Vec3d FileFrame::toFile(const openvdb::Vec3d& world) const
{
    return mIsWorld ? world * mScale : mAxes * (world - mOrigin) * mScale;
}

MassProperties FileFrame::toFile(const MassProperties& world, double density) const
{
    const double cubed = mScale * mScale * mScale;
    MassProperties file = world;
    file.volume = world.volume * cubed;
    file.center = toFile(world.center);
    // A moment is density length^5.
    const double moment = density * cubed * mScale * mScale;
    file.inertia = mAxes * world.inertia * mAxes.transpose() * moment;
    file.principalMoments = world.principalMoments * moment;
    file.principalAxes = world.principalAxes * mAxes.transpose();
    return file;
}

double FileFrame::slack(const openvdb::Vec3d& world) const
{
    if (mIsWorld && mScale == 1) return 0;
    // Each of three coordinates is the sum of three products of rounded factors and differences: less than
    // 16 roundings of numbers no larger than these.
    constexpr double kRoundings = 32 * std::numeric_limits<double>::epsilon();
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += std::abs(world[axis]) + std::abs(mOrigin[axis]);
    return kRoundings * sum * mScale;
}

} // namespace openvdb_spheretree::detail
