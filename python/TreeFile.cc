// SPDX-License-Identifier: Apache-2.0
/// @file TreeFile.cc
/// @brief Sphere-trees to and from files, and bytes: the same bytes as the command writes.

#include "Call.h"
#include "Errors.h"
#include "Tree.h"

#include "files/AtomicFile.h"
#include "files/Companions.h"
#include "files/VdbStream.h"
#include "line/Plan.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/export/ExportFormat.h>
#include <openvdb_spheretree/input/vdb/VdbGrids.h>
#include <openvdb_spheretree/store/SphereTreeCsv.h>
#include <openvdb_spheretree/store/SphereTreeJson.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;
using openvdb::points::PointDataGrid;
using openvdb_spheretree::detail::inQuotes;
using spheretree::SphereTree;

namespace {

// ---- Writing

/// As the command does without codec=.
uint32_t usualCompression()
{
    using openvdb::io::Archive;
    return openvdb::io::COMPRESS_ACTIVE_MASK
        | (Archive::hasBloscCompression() ? openvdb::io::COMPRESS_BLOSC
                                          : openvdb::io::COMPRESS_ZIP);
}

void writeVdb(const SphereTree& tree, std::iostream& out, Interrupter* interrupter)
{
    openvdb::GridCPtrVec grids = {spheretree::toPoints(tree, interrupter)};
    if (const auto dag = spheretree::dagToPoints(tree, interrupter)) grids.push_back(dag);
    if (const auto cuts = spheretree::cutsToPoints(tree, interrupter)) grids.push_back(cuts);
    command::writeVdb(out, grids, usualCompression(), /*seekable=*/true);
}

void writeCsv(const SphereTree& tree, std::iostream& out, Interrupter*)
{
    spheretree::writeCsv(tree, out);
}

void writeDagCsv(const SphereTree& tree, std::iostream& out, Interrupter*)
{
    spheretree::writeDagCsv(tree, out);
}

void writeJson(const SphereTree& tree, std::iostream& out, Interrupter*)
{
    spheretree::writeJson(tree, out);
}

using Writer = void (*)(const SphereTree&, std::iostream&, Interrupter*);

struct Format {
    const char* extension;
    Writer write;
    Writer writeEdges = nullptr; ///< to a second file, x_dag.csv of x.csv
};

/// Every format that a tree is saved as. A new one is a line here.
constexpr Format kFormats[] = {
    {".vdb", writeVdb}, {".csv", writeCsv, writeDagCsv}, {".json", writeJson}};

const Format& formatOf(const std::string& path)
{
    const std::string extension = spheretree::detail::lowerExtension(path);
    std::string known;
    for (const Format& format : kFormats) {
        if (extension == format.extension) return format;
        known += (known.empty() ? "" : ", ") + std::string(format.extension);
    }
    throw InputError(path + ": "
        + (extension.empty() ? "a name without an extension says not what to write"
                             : "a tree is not saved as " + extension)
        + "; it is as " + known
        + (spheretree::findExportFormat(extension) ? ", and export() writes " + extension : ""));
}

/// All files are complete before the first takes its place.
void save(const SphereTree& tree, const std::string& path, Interrupter* interrupter)
{
    const Format& format = formatOf(path);
    std::vector<std::unique_ptr<command::AtomicFile>> files;
    const auto write = [&](const std::string& to, Writer writer) {
        command::AtomicFile::checkTarget(to);
        files.push_back(std::make_unique<command::AtomicFile>(to));
        files.back()->write([&](std::iostream& out) { writer(tree, out, interrupter); });
    };
    write(path, format.write);
    if (format.writeEdges && spheretree::hasDag(tree)) {
        const std::string extension = format.extension;
        write(
            path.substr(0, path.size() - extension.size()) + "_dag" + extension, format.writeEdges);
    }
    if (interrupter->wasInterrupted()) return; // and they are gone
    for (const auto& file : files) file->commit();
}

// ---- Reading

std::vector<TreePtr> treesOf(
    const openvdb::GridPtrVec& grids, const std::string& path, Interrupter* interrupter)
{
    const command::CompanionIndex index(grids);
    std::vector<TreePtr> trees;
    for (const auto& grid : grids) {
        const auto points = openvdb::gridPtrCast<PointDataGrid>(grid);
        if (!points || !spheretree::isSphereTree(*grid)) continue;
        const command::Companions others = index.of(grid->getName());
        try {
            trees.push_back(std::make_shared<Tree>(
                spheretree::fromPoints(*points, others.dag.get(), others.cuts.get(), interrupter)));
        } catch (const openvdb::Exception& error) { // the file's fault
            OPENVDB_THROW(openvdb::IoError,
                path << ": sphere-tree " << inQuotes(grid->getName()) << ": "
                     << spheretree::detail::messageOf(error));
        }
    }
    return trees;
}

TreePtr load(const std::string& path, const std::string& name, Interrupter* interrupter)
{
    const command::FileKind kind = command::fileKind(path);
    if (kind == command::FileKind::Csv || kind == command::FileKind::Json) {
        throw InputError(path + ": trees are loaded from a .vdb, which save() writes without loss");
    }
    const auto grids = command::readVdb(path, command::Loading::Whole);
    TreePtr found;
    std::string names;
    for (const TreePtr& tree : treesOf(grids, path, interrupter)) {
        const std::string& own = tree->get().settings.name;
        names += (names.empty() ? "" : ", ") + inQuotes(own);
        if (!name.empty() && own != name) continue;
        if (found) throw InputError(path + " holds several sphere-trees: choose one with name=");
        found = tree;
    }
    if (found) return found;
    throw InputError(path + " holds no sphere-tree "
        + (names.empty() ? "at all; build() takes volumes, read_points() any points"
                         : "named " + inQuotes(name) + ", but " + names));
}

// ---- Bytes, for pickle

std::string bytesOf(const SphereTree& tree, Interrupter* interrupter)
{
    spheretree::detail::TextStream stream;
    writeVdb(tree, stream, interrupter);
    return stream.str();
}

TreePtr treeOfBytes(const std::string& bytes, Interrupter* interrupter)
{
    spheretree::detail::TextStream stream(bytes);
    const auto trees =
        treesOf(spheretree::readVdbGrids(*stream.rdbuf()), "a pickled tree", interrupter);
    if (trees.size() != 1) throw InputError("these bytes hold no sphere-tree");
    return trees.front();
}

} // namespace

void bindTreeFiles(py::module_& module)
{
    module.def("save", [](const Tree& tree, const std::string& path, const py::object& progress) {
        runCall({progress}, [&](Interrupter* in) { save(tree.get(), path, in); });
    });
    module.def(
        "load", [](const std::string& path, const std::string& name, const py::object& progress) {
            return resultOfCall(
                CallSettings{progress}, [&](Interrupter* in) { return load(path, name, in); });
        });
    module.def("bytes_of_tree", [](const Tree& tree) {
        return py::bytes(
            resultOfCall(CallSettings(), [&](Interrupter* in) { return bytesOf(tree.get(), in); }));
    });
    module.def("tree_of_bytes", [](const std::string& bytes) {
        return resultOfCall(
            CallSettings(), [&](Interrupter* in) { return treeOfBytes(bytes, in); });
    });
}

} // namespace binding
