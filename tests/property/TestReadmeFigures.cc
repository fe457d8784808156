// SPDX-License-Identifier: Apache-2.0
/// @file TestReadmeFigures.cc
/// @brief Figures about results that README.md and docs/ name, so that they stay true.

#include "support/Meshes.h"
#include "support/Sanitizers.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/build/MemoryPlan.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/shapes/GeneratedObject.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/solid/MeshSolid.h>

#include <openvdb/Exceptions.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetPlatonic.h>
#include <openvdb/tools/VolumeToSpheres.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// @return how many percent of the object's voxels have their centers in one of the spheres.
double coveredPercent(const openvdb::BoolGrid& object, const std::vector<openvdb::Vec4s>& spheres)
{
    int64_t covered = 0, all = 0;
    for (auto voxel = object.cbeginValueOn(); voxel; ++voxel) {
        openvdb::CoordBBox box;
        voxel.getBoundingBox(box);
        for (auto at = box.begin(); at; ++at) {
            const openvdb::Vec3d center = object.indexToWorld(*at);
            ++all;
            for (const openvdb::Vec4s& s : spheres) {
                if ((openvdb::Vec3d(s[0], s[1], s[2]) - center).length() > double(s[3])) continue;
                ++covered;
                break;
            }
        }
    }
    return 100.0 * double(covered) / double(all);
}

/// That of vdb_tool -platonic d=128 f=12.
TEST(ReadmeFigures, InnerSpheresCoverMoreOfADodecahedronThanThoseOfOpenVDB)
{
    openvdb::initialize();
    const auto levelSet = openvdb::tools::createLevelSetPlatonic<openvdb::FloatGrid>(
        12, 1.0f, openvdb::Vec3f(0), 2.0f / 128);
    const auto object = objectOf(*levelSet);
    InnerOptions options;
    options.budget.spheres = {512, 64, 8};
    SphereTree tree = buildSphereTree(*object, options);
    computeLevelErrors(tree, *object);
    const double expected[] = {99.1, 94.0, 80.9}, openvdbs[] = {92.4, 84.4, 73.9};
    for (std::size_t k = 0; k < 3; ++k) {
        const LevelError& error = *tree.levels[k].error;
        EXPECT_NEAR(expected[k],
            100.0 * double(error.covered - error.excess) / double(tree.object.voxels), 0.06)
            << k;
        // OpenVDB's tools, compiled with a sanitizer, start from other points.
        if (kSanitized) continue;
        std::vector<openvdb::Vec4s> spheres;
        const int count = tree.levels[k].size();
        // Its threads share the place of the next sphere without a lock.
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        openvdb::tools::fillWithSpheres(*levelSet, spheres, openvdb::Vec2i(1, count),
            /*overlapping=*/true, /*minRadius=*/0.5f, std::numeric_limits<float>::max(),
            /*isovalue=*/0.0f, /*instanceCount=*/100000);
        EXPECT_NEAR(openvdbs[k], coveredPercent(*object, spheres), 1) << k; // its points are random
    }
}

TEST(ReadmeFigures, TheLeastMemoryOfSolidBalls)
{
    openvdb::initialize();
    struct Row {
        int64_t voxels;
        int64_t allowed; // MiB
        const char* needed;
    };
    for (const Row& row : {Row{1000000, 3, "need at least 3.4 MiB"},
             {30000000, 64, "need at least 65 MiB"}, {300000000, 394, "need at least 395 MiB"}}) {
        GeneratedObjectSettings ball;
        ball.shape = Shape::Ball;
        ball.voxels = row.voxels;
        SphereTreeSettings settings = ExtendedOptions();
        settings.memory = row.allowed << 20;
        try {
            memoryPlan(*generateObject(ball), settings);
            ADD_FAILURE() << row.needed;
        } catch (const openvdb::ValueError& error) {
            EXPECT_NE(std::string(error.what()).find(row.needed), std::string::npos)
                << error.what();
        }
    }
}

/// Sixteen spheres at 64 voxels across cover no more than at 256: of a bracket, the volume of their union.
TEST(ReadmeFigures, FewSpheresNeedFewVoxels)
{
    openvdb::initialize();
    TriangleMesh mesh = boxMesh(openvdb::Vec3d(0), openvdb::Vec3d(120, 12, 40));
    addBox(mesh, openvdb::Vec3d(0), openvdb::Vec3d(12, 90, 40));
    double volume[2];
    for (const int dim : {64, 256}) {
        const auto object = meshToObject(mesh, voxelSizeForDim(mesh, dim));
        TightOptions options;
        options.budget.spheres = {16};
        options.quality = Quality::Fast;
        SphereTree tree = buildSphereTree(*object, options);
        computeLevelErrors(tree, *object);
        volume[dim == 256] = double(tree.levels[0].error->covered) * std::pow(tree.voxelSize(), 3);
    }
    EXPECT_LT(volume[0], volume[1] * 1.02);
}

} // namespace
