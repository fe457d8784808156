// SPDX-License-Identifier: Apache-2.0
#include "VdbSamples.h"

#include <files/VdbStream.h>

#include <sstream>

namespace spheretree_test {

namespace {

constexpr std::size_t kTagVersion = 35; // where the identifier says how it was made

} // namespace

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

std::string vdbBytes(
    const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable, Saver saver)
{
    std::stringstream out(std::ios::in | std::ios::out | std::ios::binary);
    command::writeVdb(out, grids, compression, seekable);
    std::string bytes = out.str();
    if (saver == Saver::OpenVdb) bytes[kTagVersion] = '4';
    return bytes;
}

} // namespace spheretree_test
