// SPDX-License-Identifier: Apache-2.0
/// @file TreePage.cc
/// @brief Sphere-trees as pages for a browser: the same bytes as the command writes.

#include "Call.h"
#include "Errors.h"
#include "Tree.h"
#include "Volume.h"

#include "files/AtomicFile.h"
#include "line/Plan.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/viewer/TreeViewer.h>

#include <string>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;

namespace {

/// @param volume  null: the page has no surface
void writePage(const spheretree::SphereTree& tree, const std::string& path, const Volume* volume,
    const spheretree::ViewerSettings& settings, Interrupter* interrupter)
{
    if (command::fileKind(path) != command::FileKind::Html) {
        throw InputError(path
            + ": a page is named .html or .htm; save() writes trees as .vdb, .csv and .json, and "
              "export() the files of other tools");
    }
    if (volume) requireObjectOf(tree, *volume, path);
    command::AtomicFile::checkTarget(path);
    command::AtomicFile file(path);
    try {
        file.write([&](std::iostream& out) {
            const openvdb::BoolGrid* const object = volume ? volume->object.get() : nullptr;
            spheretree::writeViewer(tree, object, settings, out, interrupter);
        });
    } catch (const openvdb::ValueError& error) {
        throw InputError(path + ": " + spheretree::detail::messageOf(error));
    }
    if (!interrupter->wasInterrupted()) file.commit();
}

} // namespace

void bindTreePage(py::module_& module)
{
    module.def("write_html",
        [](const Tree& tree, const std::string& path, const Volume* volume, int64_t triangles,
            const py::object& progress) {
            spheretree::ViewerSettings settings;
            settings.triangles = triangles;
            runCall({progress},
                [&](Interrupter* in) { writePage(tree.get(), path, volume, settings, in); });
        });
}

} // namespace binding
