// SPDX-License-Identifier: Apache-2.0
#include "ScaleMesh.h"

#include "base/Errors.h"

#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <cmath>

namespace command {

void scaleMesh(openvdb_spheretree::TriangleMesh& mesh, double scale)
{
    for (auto& point : mesh.points) {
        point *= scale;
        for (const double coordinate : {point[0], point[1], point[2]}) {
            if (std::abs(coordinate) <= openvdb_spheretree::kFarthestPoint) continue;
            throwInput("mesh '" + oneLine(mesh.name, 60)
                + "' would have points beyond the largest number: choose a smaller scale");
        }
    }
}

} // namespace command
