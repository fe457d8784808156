// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkInput.h
/// @brief What the stages of one object have in common.

#pragma once

#include "BenchmarkObject.h"

#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <memory>

namespace spheretree_benchmark {

struct BenchmarkInput {
    explicit BenchmarkInput(const BenchmarkObject& of)
        : object(of), grid(openvdb_spheretree::objectOf(*of.makeGrid())),
          mask(grid->tree(), false, openvdb::TopologyCopy()), layout(mask)
    {}
    const BenchmarkObject object;
    const openvdb::BoolGrid::Ptr grid;
    const openvdb::MaskTree mask;
    const openvdb_spheretree::LeafLayout layout;
};

using InputPtr = std::shared_ptr<const BenchmarkInput>; // stages refer to its parts

} // namespace spheretree_benchmark
