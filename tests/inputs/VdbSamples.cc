// SPDX-License-Identifier: Apache-2.0
#include "VdbSamples.h"

#include <files/VdbStream.h>

#include <sstream>

namespace spheretree_test {

openvdb::BoolGrid::Ptr sampleObject()
{
    openvdb::initialize();
    const auto object = openvdb::BoolGrid::create(false);
    object->fill(openvdb::CoordBBox({-3, 1, 2}, {2, 4, 5}), true);
    object->fill(openvdb::CoordBBox({1, 3, 4}, {3, 5, 9}), true);
    object->tree().voxelizeActiveTiles();
    object->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    object->setName("object");
    return object;
}

std::string vdbBytes(const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable)
{
    std::stringstream out(std::ios::in | std::ios::out | std::ios::binary);
    command::writeVdb(out, grids, compression, seekable);
    return out.str();
}

} // namespace spheretree_test
