// SPDX-License-Identifier: Apache-2.0
#include "Closing.h"

#include "BallMorphology.h"
#include "OrPyramid.h"
#include <openvdb_spheretree/voxel/Dimension.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/Exceptions.h>
#include <openvdb/tools/Prune.h>

#include <memory>

namespace openvdb_spheretree {

using openvdb::MaskTree;
using openvdb::util::NullInterrupter;

void requireClosing(int radius)
{
    if (radius >= 0 && radius <= kMaxClosing) return;
    OPENVDB_THROW(openvdb::ValueError,
        "closing=" << radius << " is out of range: it must be 0 to " << kMaxClosing);
}

MaskTree::Ptr closing(const MaskTree& voxels, int radius, int dim, NullInterrupter* interrupter)
{
    requireDim(dim);
    requireClosing(radius);
    auto closed = std::make_shared<MaskTree>(voxels);
    const MaskTree::Ptr added = detail::voxelsNear(voxels, radius, dim, "closing", interrupter);
    if (added->empty()) return closed;
    closed->topologyUnion(*added);
    detail::erodeAround(*closed, *added, radius, dim, interrupter);
    openvdb::tools::prune(*closed);
    return closed;
}

PyramidModel closingModel(int radius, NullInterrupter* interrupter)
{
    return [=](const MaskTree& level, const PyramidStep& step) {
        return coarsen(*closing(level, radius, step.dim, interrupter), step, interrupter);
    };
}

} // namespace openvdb_spheretree
