// SPDX-License-Identifier: Apache-2.0
/// @file ScaleMesh.h
/// @brief Makes a mesh larger, as scale= and units= of -read do.

#pragma once

namespace openvdb_spheretree {
struct TriangleMesh;
} // namespace openvdb_spheretree

namespace command {

/// @throw CommandError (input) if a point would be beyond the largest number
void scaleMesh(openvdb_spheretree::TriangleMesh& mesh, double scale);

} // namespace command
