// SPDX-License-Identifier: Apache-2.0
#include "ObjectVoxels.h"

#include <openvdb/Grid.h>

#include <memory>

namespace openvdb_spheretree {

openvdb::MaskTree::Ptr voxelsOf(const openvdb::BoolGrid& object, const FlatAxis& flat)
{
    return flat.toZ(
        std::make_shared<openvdb::MaskTree>(object.tree(), false, openvdb::TopologyCopy()));
}

} // namespace openvdb_spheretree
