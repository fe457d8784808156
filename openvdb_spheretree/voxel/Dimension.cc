// SPDX-License-Identifier: Apache-2.0
#include "Dimension.h"

#include <openvdb/Exceptions.h>

namespace openvdb_spheretree {

void requireDim(int dim)
{
    if (dim == 2 || dim == 3) return;
    OPENVDB_THROW(openvdb::ValueError, "dim=" << dim << " is out of range: it must be 2 or 3");
}

} // namespace openvdb_spheretree
