// SPDX-License-Identifier: Apache-2.0
#include "ScaleMesh.h"

#include "base/Errors.h"

#include <openvdb_spheretree/mesh/TriangleMesh.h>

namespace command {

void scaleMesh(openvdb_spheretree::TriangleMesh& mesh, double scale)
{
    for (auto& point : mesh.points) {
        point *= scale;
        if (!openvdb_spheretree::isMeshPoint(point)) {
            throwInput("mesh '" + oneLine(mesh.name, 60)
                + "' would have points beyond the largest number: choose a smaller scale");
        }
    }
}

} // namespace command
