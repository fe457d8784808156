// SPDX-License-Identifier: Apache-2.0
#include "GeneratedObject.h"

#include "BallShape.h"
#include "GyroidShape.h"
#include "MengerShape.h"
#include "NoiseShape.h"
#include "TerrainShape.h"
#include <openvdb_spheretree/base/EnumNames.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Stage.h>

#include <openvdb/Exceptions.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace openvdb_spheretree {

namespace {

constexpr std::array<detail::Named<Shape>, 5> kShapes{
    {{Shape::Gyroid, "gyroid"}, {Shape::Menger, "menger"}, {Shape::Terrain, "terrain"},
        {Shape::Noise, "noise"}, {Shape::Ball, "ball"}}};

/// @return about how many bytes the leaf nodes of an object take, as measured, each with its share of
///         the nodes above it: those along a surface hold few leaves each.
double leafBytes(const GeneratedObjectSettings& settings, double leaves)
{
    return leaves * (settings.shape == Shape::Terrain || settings.shape == Shape::Ball ? 320 : 176);
}

/// @return about how many leaf nodes an object has, as measured; a ball has them at its surface.
double leafCount(const GeneratedObjectSettings& settings)
{
    const double voxels = double(settings.voxels);
    switch (settings.shape) {
    case Shape::Gyroid: return voxels / 170;
    case Shape::Menger: return voxels / 160;
    case Shape::Terrain: return voxels / 120;
    case Shape::Noise: return voxels / 5;
    case Shape::Ball: break;
    }
    return 0.12 * std::pow(voxels, 2.0 / 3.0);
}

std::unique_ptr<detail::VoxelRule> shapeOf(
    const GeneratedObjectSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    const int64_t voxels = settings.voxels;
    switch (settings.shape) {
    case Shape::Gyroid: return std::make_unique<detail::GyroidShape>(voxels);
    case Shape::Menger: return std::make_unique<detail::MengerShape>(voxels);
    case Shape::Terrain:
        return std::make_unique<detail::TerrainShape>(voxels, settings.seed, interrupter);
    case Shape::Noise: return std::make_unique<detail::NoiseShape>(voxels, settings.seed);
    case Shape::Ball: break;
    }
    return std::make_unique<detail::SolidBall>(voxels);
}

} // namespace

void GeneratedObjectSettings::validate() const
{
    if (voxels < kFewestVoxels) {
        OPENVDB_THROW(openvdb::ValueError,
            "voxels=" << voxels << " is out of range: ask for " << kFewestVoxels << " or more");
    }
    if (!(voxelSize >= kSmallestVoxel && voxelSize <= kLargestVoxel)) {
        OPENVDB_THROW(openvdb::ValueError,
            "voxel=" << voxelSize << " is out of range: it must be " << kSmallestVoxel << " to "
                     << kLargestVoxel << " world units");
    }
    constexpr double kMostLeaves = 2147483648.0; // LeafLayout's
    const double leaves = leafCount(*this);
    const std::string what = "voxels=" + std::to_string(voxels) + " of shape=" + toString(shape);
    if (leaves > kMostLeaves) {
        OPENVDB_THROW(
            openvdb::ValueError, what << " are more than 2^31 leaf nodes: ask for fewer voxels");
    }
    detail::requireMemory(leafBytes(*this, leaves), what, "ask for fewer voxels");
}

openvdb::BoolGrid::Ptr generateObject(
    const GeneratedObjectSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    settings.validate();
    const detail::Stage stage("Generating object", interrupter, nullptr);
    const auto shape = shapeOf(settings, interrupter);
    const auto grid = openvdb::BoolGrid::create(detail::treeOf(*shape, interrupter));
    grid->setName(toString(settings.shape));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(settings.voxelSize));
    return grid;
}

const char* toString(Shape value) { return detail::nameOf(kShapes, value); }

std::vector<std::string> shapeNames()
{
    std::vector<std::string> names;
    for (const auto& shape : kShapes) names.emplace_back(shape.name);
    return names;
}

Shape shapeFromString(const std::string& text) { return detail::fromName(kShapes, "shape", text); }

} // namespace openvdb_spheretree
