// SPDX-License-Identifier: Apache-2.0
#include "TreeViewer.h"

#include "Base64.h"
#include "ObjectSurface.h"
#include "TreeDescription.h"
#include "ViewerPage.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/math/Transform.h>
#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace openvdb_spheretree {

namespace {

using detail::Base64;
using detail::ObjectSurface;

void requireRoom(const SphereTree& tree)
{
    const int64_t spheres = int64_t(tree.size()) + tree.cuts.size();
    if (spheres <= kMaxViewerSpheres) return;
    OPENVDB_THROW(openvdb::ValueError,
        "a page holds at most "
            << kMaxViewerSpheres << " spheres, and the tree has " << tree.size()
            << (tree.cuts.empty() ? "" : " and " + std::to_string(tree.cuts.size()) + " in cuts")
            << ": keep one level of it, or build it with fewer (spheres=)");
}

/// An array of the page in an element of its own, as base64.
class ArrayWriter {
public:
    ArrayWriter(std::ostream& out, openvdb::util::NullInterrupter* interrupter)
        : mOut(out), mInterrupter(interrupter)
    {}

    /// @param put  put(i, base64) adds what belongs to entry i
    template <typename Put>
    void write(const std::string& name, std::size_t count, const Put& put)
    {
        mOut << "<script type=\"text/plain\" id=\"" << name << "\">";
        Base64 base64(mOut);
        for (std::size_t i = 0; i < count; ++i) {
            if (i % 4096 == 0) detail::checkInterrupt(mInterrupter);
            put(i, base64);
        }
        base64.finish();
        mOut << "</script>\n";
    }

    template <typename Number>
    void write(const std::string& name, const std::vector<Number>& values)
    {
        write(name, values.size(), [&](std::size_t i, Base64& base64) { base64.add(values[i]); });
    }

private:
    std::ostream& mOut;
    openvdb::util::NullInterrupter* mInterrupter;
};

void writeSpheres(
    ArrayWriter& arrays, const std::string& name, const SphereTree& tree, const Spheres& spheres)
{
    arrays.write(name + "-center", spheres.center.size(), [&](std::size_t id, Base64& base64) {
        const openvdb::Vec3d world = tree.transform->indexToWorld(spheres.center[id]);
        for (int axis = 0; axis < 3; ++axis) base64.add(world[axis]);
    });
    arrays.write(name + "-radius", spheres.radiusWorld);
    arrays.write(name + "-parent", spheres.parent);
}

void writeSurface(ArrayWriter& arrays, const ObjectSurface& surface)
{
    arrays.write("surface-points", surface.points.size(), [&](std::size_t i, Base64& base64) {
        for (int axis = 0; axis < 3; ++axis) base64.add(surface.points[i][axis]);
    });
    arrays.write("surface-quads", surface.quads.size(), [&](std::size_t i, Base64& base64) {
        for (int corner = 0; corner < 4; ++corner) base64.add(surface.quads[i][corner]);
    });
}

void writeParts(const char* const* parts, std::ostream& out)
{
    for (; *parts; ++parts) out << *parts;
}

} // namespace

void ViewerSettings::validate() const
{
    if (triangles >= 0 && triangles <= kMaxTriangles) return;
    OPENVDB_THROW(openvdb::ValueError,
        "triangles=" << triangles << " is out of range: it takes 0 to " << kMaxTriangles);
}

void writeViewer(const SphereTree& tree, const openvdb::BoolGrid* object,
    const ViewerSettings& settings, std::ostream& out, openvdb::util::NullInterrupter* interrupter)
{
    settings.validate();
    requireRoom(tree);
    std::optional<ObjectSurface> surface;
    std::string missing = "the tree comes without its object";
    if (settings.triangles == 0) {
        missing = "it was not asked for (triangles=0)";
    } else if (object && !object->empty()) {
        surface = detail::objectSurface(*object, settings.triangles, interrupter);
        if (!surface) missing = "its surface has too many parts";
    }
    writeParts(detail::kPageBeforeData, out);
    out << "<script type=\"application/json\" id=\"tree\">"
        << detail::treeDescription(tree, surface ? &*surface : nullptr, missing) << "</script>\n";
    ArrayWriter arrays(out, interrupter);
    writeSpheres(arrays, "nodes", tree, tree.spheres);
    if (!tree.cuts.empty()) {
        writeSpheres(arrays, "cuts", tree, tree.cuts.spheres);
        arrays.write("cuts-first", tree.cuts.first);
        arrays.write("cuts-last", tree.cuts.last);
    }
    if (surface) writeSurface(arrays, *surface);
    writeParts(detail::kPageAfterData, out);
    out.flush();
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the .html: is the disk full?");
}

} // namespace openvdb_spheretree
