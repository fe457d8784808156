// SPDX-License-Identifier: Apache-2.0
/// @file TreeViewer.h
/// @brief A sphere-tree and its object as one web page that needs nothing else: no network, no
/// library, plain WebGL2. It turns, cuts open and colours the spheres of every level, and shows the
/// numbers of each.
///
/// 1. *Page*: the files of `viewer/page/`, which the build puts into the library as text
///    (ViewerPage.h).
/// 2. *Description*: names, settings, levels and errors as JSON (TreeDescription.h).
/// 3. *Arrays*: the nodes, the cuts and the object's surface, as base64 of little-endian numbers
///    (Base64.h). Centers are doubles in world space and radii the stored floats, so that the page
///    shows the numbers of the other files.
///
/// The same input gives the same page, for any number of threads. Cost: O(spheres), and the surface
/// (ObjectSurface.h); 43 bytes a sphere in the page, 53 a sphere of a cut. Memory does not grow with the
/// tree. Tests: TestTreeViewer.cc, and in a browser TestCommandViewer.cc.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <iosfwd>

namespace openvdb_spheretree {

struct ViewerSettings {
    /// The object's surface has no more, and is made of larger blocks where it would: 0 to
    /// kMaxTriangles; 0: there is none.
    int64_t triangles = 200000;

    static constexpr int64_t kMaxTriangles = 10000000;
    /// @throw openvdb::ValueError if it is out of range
    void validate() const;
};

/// Nodes and spheres of cuts together, that a page may hold: more than browsers open in good time.
constexpr int64_t kMaxViewerSpheres = 2000000;

/// @brief Write the page.
/// @param tree         with its transform and stored radii; at least one level
/// @param object       that the tree was built from, in the same place; null if it is not at hand
/// @param settings     what is on the page
/// @param out          binary; written from its start to its end
/// @param interrupter  may be null
/// @throw openvdb::ValueError if a setting is out of range, or there are more than
///        kMaxViewerSpheres
/// @throw openvdb::IoError if the stream fails
/// @throw Interrupted if the interrupter said so; what is written by then is no whole page
void writeViewer(const SphereTree& tree, const openvdb::BoolGrid* object,
    const ViewerSettings& settings, std::ostream& out,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
