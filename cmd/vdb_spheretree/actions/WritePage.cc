// SPDX-License-Identifier: Apache-2.0
#include "WritePage.h"

#include "GivenSpheres.h"
#include "ObjectChoice.h"

#include <openvdb_spheretree/viewer/TreeViewer.h>

#include <algorithm>

namespace command {

namespace spheretree = openvdb_spheretree;

namespace {

StackItem& treeToShow(const std::vector<StackItem*>& items, const std::string& path)
{
    StackItem* tree = nullptr;
    for (StackItem* item : items) {
        if (item->emptyTree) {
            throwInput(path
                + " shows spheres, and this frame has none: leave it out, by empty=skip where the "
                  "tree is built "
                  "or by frames= where it is read");
        }
        if (!item->tree) continue;
        if (tree) throwInput(path + " shows one sphere-tree, and there are more: choose with vdb=");
        tree = item;
    }
    if (!tree) throwInput(path + " shows a sphere-tree, and there is none: put -spheretree before");
    return *tree;
}

} // namespace

std::vector<OptionSpec> pageOptions()
{
    return {integer("triangles", "200000", 0, spheretree::ViewerSettings::kMaxTriangles,
        "pages: the most triangles of the object's surface, which is made of blocks of voxels "
        "where "
        "it has more; 0 for none")};
}

void checkPageOptions(const ActionCall& call)
{
    const std::vector<std::string> files = call.list("files");
    const bool page = std::any_of(files.begin(), files.end(),
        [](const std::string& path) { return fileKind(path) == FileKind::Html; });
    for (const OptionSpec& option : pageOptions()) {
        if (page || !call.given(option.name)) continue;
        throwUsage("option " + option.name + " is for pages, and none is written (.html)");
    }
}

void writePage(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, Session& session, std::ostream& out)
{
    StackItem& item = treeToShow(items, path);
    placeInObject(item, session);
    spheretree::ViewerSettings settings;
    settings.triangles = call.integer("triangles");
    const auto object = settings.triangles > 0 ? knownObject(item, session) : nullptr;
    try {
        spheretree::writeViewer(*item.tree, object.get(), settings, out, &session.progress);
    } catch (const openvdb::ValueError&) {
        rethrowNamed(path, kInput);
    }
}

} // namespace command
