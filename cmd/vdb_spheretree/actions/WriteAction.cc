// SPDX-License-Identifier: Apache-2.0
/// @file WriteAction.cc
/// @brief -write: grids, sphere-trees, pictures and pages of them to files. All files of one -write are
/// complete before the first takes its place.

#include "base/LastWords.h"
#include "base/Terminal.h"
#include "files/AtomicFile.h"
#include "files/FdBuffer.h"
#include "files/VdbStream.h"
#include "line/Actions.h"
#include "ObjectChoice.h"
#include "session/Session.h"
#include "WriteAdvice.h"
#include "WriteChart.h"
#include "WriteExport.h"
#include "WritePage.h"
#include "WritePicture.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/export/VolWriter.h>
#include <openvdb_spheretree/picture/Picture.h>
#include <openvdb_spheretree/store/SphereTreeCsv.h>
#include <openvdb_spheretree/store/SphereTreeJson.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include <unistd.h>

namespace command {

namespace {

uint32_t compressionOf(const ActionCall& call)
{
    using openvdb::io::Archive;
    const std::string codec = call.text("codec");
    if (codec == "none") return openvdb::io::COMPRESS_NONE;
    if (codec == "active") return openvdb::io::COMPRESS_ACTIVE_MASK;
    const bool zip = codec == "zip" || (!call.given("codec") && !Archive::hasBloscCompression());
    const bool available = zip ? Archive::hasZLibCompression() : Archive::hasBloscCompression();
    if (!available) throwUsage("codec=" + codec + ": this build of OpenVDB does not have it");
    return openvdb::io::COMPRESS_ACTIVE_MASK
        | (zip ? openvdb::io::COMPRESS_ZIP : openvdb::io::COMPRESS_BLOSC);
}

/// @return x_dag.csv of x.csv: the file for the edges of the tree. Whether there will be any is not
/// known before the work is done, so its place is always checked.
std::string dagPath(const std::string& csv)
{
    const std::string extension = std::filesystem::path(csv).extension().string();
    return csv.substr(0, csv.size() - extension.size()) + "_dag" + extension;
}

/// @return how @a path is written: what format= and the extension say.
FileKind writtenKind(const ActionCall& call, const std::string& path)
{
    if (isChart(call, path)) return FileKind::Chart;
    return exportFormatOf(call, path) ? FileKind::Export : fileKind(path);
}

[[noreturn]] void refuseToWrite(const std::string& path, const std::string& extension)
{
    const std::string formats = formatsOf(extension), advice = writeAdvice(extension);
    if (!formats.empty()) {
        throwUsage(path + ": " + extension + " does not say what to write: " + formats + " does");
    }
    throwUsage(path + ": "
        + (extension.empty() ? "a name without an extension says not what to write"
                             : extension + " files are not written")
        + (advice.empty() ? "" : "; " + advice)
        + "; it writes .vdb (grids and sphere-trees), .vol (an object), .csv and .json (a "
          "sphere-tree), .png and .jpg (a picture), .html (a page that shows a sphere-tree), .svg "
          "(curves of errors), and files of other tools such as .urdf, .usda, .ply and .obj (-help "
          "write lists them)");
}

void check(const ActionCall& call, Plan& plan)
{
    if (!call.given("files")) throwUsage("names no file");
    compressionOf(call);
    for (const std::string& path : call.list("files")) {
        const FileKind kind = writtenKind(call, path);
        const std::string extension = openvdb_spheretree::detail::lowerExtension(path);
        if ((kind == FileKind::Vol && extension != ".vol") || kind == FileKind::Mesh
            || kind == FileKind::Unknown) {
            refuseToWrite(path, extension);
        }
        if (kind == FileKind::Jpeg && !openvdb_spheretree::writesJpeg()) {
            throwUsage(path + ": this build has no libjpeg, so it writes pictures as .png only");
        }
        plan.addOutput(path);
        if (kind == FileKind::Csv && !isStdout(path)) plan.addOutput(dagPath(path));
    }
    checkPictureOptions(call);
    checkExportOptions(call);
    checkPageOptions(call);
    checkCharts(call);
}

/// @param giveUp  whether the trees are not needed any more; then each is released, because a tree
///                and its grid together take twice the memory
openvdb::GridCPtrVec gridsOf(const std::vector<StackItem*>& items, bool giveUp, Progress& progress)
{
    namespace st = openvdb_spheretree;
    openvdb::GridCPtrVec grids;
    for (StackItem* item : items) {
        if (item->grid) {
            grids.push_back(item->grid);
            continue;
        }
        st::SphereTree& tree = *item->tree;
        const auto dag = st::dagToPoints(tree, &progress), cuts = st::cutsToPoints(tree, &progress);
        if (giveUp) item->object = nullptr;
        grids.push_back(
            giveUp ? st::releaseToPoints(tree, &progress) : st::toPoints(tree, &progress));
        if (dag) grids.push_back(dag);
        if (cuts) grids.push_back(cuts);
    }
    return grids;
}

const openvdb_spheretree::SphereTree& onlyTree(
    const std::vector<StackItem*>& items, const std::string& path)
{
    const openvdb_spheretree::SphereTree* tree = nullptr;
    for (const StackItem* item : items) {
        if (!item->anyTree()) continue;
        if (tree) throwInput(path + " holds one sphere-tree, and there are more: choose with vdb=");
        tree = item->anyTree();
    }
    if (!tree) throwInput(path + " holds a sphere-tree, and there is none: put -spheretree before");
    return *tree;
}

const StackItem& onlyGrid(const std::vector<StackItem*>& items, const std::string& path)
{
    const StackItem* grid = nullptr;
    for (const StackItem* item : items) {
        if (!item->grid) continue;
        if (grid) throwInput(path + " holds one object, and there are more: choose with vdb=");
        grid = item;
    }
    if (!grid) {
        throwInput(path
            + " holds the voxels of an object, and there is none: -spheres2mask makes those of a "
              "level of a tree");
    }
    return *grid;
}

/// Who reads the file could not tell apart two trees of one name, or a tree from the edges or cuts
/// of another.
void requireDistinctTrees(const std::vector<StackItem*>& items)
{
    std::set<std::string> names;
    for (const StackItem* item : items) {
        const openvdb_spheretree::SphereTree* const tree = item->anyTree();
        if (!tree) continue;
        const std::string name = item->name();
        const auto taken = [&](bool written, const char* suffix) {
            return written && !names.insert(name + suffix).second;
        };
        const bool edges = !tree->dag.empty(), cuts = !tree->cuts.empty();
        if (!taken(true, "") && !taken(edges, "_dag") && !taken(cuts, "_cuts")) continue;
        throwInput("two sphere-trees are named '" + oneLine(name, 60)
            + "', or one as the edges or cuts of the other: give them different names with name= "
              "of -spheretree (in a loop over i, name='tree_{$i}')");
    }
}

/// Writes a `.vdb`, for which OpenVDB's header has to be gone back to.
void writeGridsToStdout(
    const std::string& path, const openvdb::GridCPtrVec& grids, uint32_t compression)
{
    openvdb_spheretree::detail::TextStream buffer;
    writeVdb(buffer, grids, compression, /*seekable=*/false);
    buffer.seekg(0);
    writeToFd(STDOUT_FILENO, *buffer.rdbuf(), path);
}

class Writer {
public:
    Writer(const ActionCall& call, const std::vector<StackItem*>& items, Session& session)
        : mCall(call), mItems(items), mSession(session), mCompression(compressionOf(call))
    {}

    void write(const std::string& path)
    {
        if (isStdout(path)) {
            mToStdout = path;
            return;
        }
        switch (writtenKind(mCall, path)) {
        case FileKind::Csv: return writeTables(path);
        case FileKind::Vdb:
            return writeFile(path, [&](std::iostream& out) {
                writeVdb(out, grids(), mCompression, /*seekable=*/true);
            });
        default: writeFile(path, [&](std::iostream& out) { writeContent(path, out); });
        }
    }

    void commit()
    {
        if (!mToStdout.empty()) writeToStdout(mToStdout);
        mSession.requireUnchangedInputs();
        const Uninterrupted untilAllAreThere;
        throwIfStopped(); // for the last time: from here on it is all files, or an error
        std::string done;
        for (auto& file : mFiles) {
            try {
                file->commit();
            } catch (...) {
                rethrowNamed(done.empty() ? "" : "written: " + done + "; not written", kOutput);
            }
            done += (done.empty() ? "" : ", ") + file->path();
        }
    }

private:
    void writeFile(const std::string& path, const std::function<void(std::iostream&)>& write)
    {
        mFiles.push_back(std::make_unique<AtomicFile>(path));
        mFiles.back()->write(write);
    }

    /// All kinds of files but .vdb.
    void writeContent(const std::string& path, std::ostream& out)
    {
        namespace st = openvdb_spheretree;
        switch (writtenKind(mCall, path)) {
        case FileKind::Export: return writeExport(mCall, path, mItems, mSession, out);
        case FileKind::Chart: return writeChart(mCall, path, mItems, out);
        case FileKind::Csv: return st::writeCsv(onlyTree(mItems, path), out);
        case FileKind::Json: return st::writeJson(onlyTree(mItems, path), out);
        case FileKind::Vol: return writeVoxels(path, out);
        case FileKind::Jpeg: return st::writeJpeg(pictureOf(mCall, path, mItems, mSession), out);
        case FileKind::Html: return writePage(mCall, path, mItems, mSession, out);
        default: st::writePng(pictureOf(mCall, path, mItems, mSession), out);
        }
    }

    void writeVoxels(const std::string& path, std::ostream& out)
    {
        const StackItem& item = onlyGrid(mItems, path);
        const openvdb::BoolGrid::ConstPtr object = objectOf(item, {}, mSession);
        try {
            openvdb_spheretree::writeVolFile(*object, out, &mSession.progress);
        } catch (const openvdb::ValueError&) { // empty, or too large a box
            rethrowNamed(path, kInput);
        }
        noteLostPlace(path, *object);
    }

    /// The format has the sides of a voxel, and nothing of where it is.
    void noteLostPlace(const std::string& path, const openvdb::BoolGrid& object)
    {
        const openvdb::math::Transform& place = object.transform();
        const openvdb::Vec3d origin = place.indexToWorld(openvdb::Vec3d(0));
        const openvdb::Coord first = object.evalActiveVoxelBoundingBox().min();
        const openvdb::Vec3d world = place.indexToWorld(first);
        if (first != openvdb::Coord(0) || origin != openvdb::Vec3d(0)) {
            using openvdb_spheretree::detail::shortNumber;
            mSession.note(path
                + " has no room for where the object is: its first voxel is that of index "
                + std::to_string(first.x()) + "," + std::to_string(first.y()) + ","
                + std::to_string(first.z()) + ", in the world at " + shortNumber(world.x()) + ","
                + shortNumber(world.y()) + "," + shortNumber(world.z()));
        }
        for (int axis = 0; axis < 3; ++axis) {
            openvdb::Vec3d along(0);
            along[axis] = 1;
            const openvdb::Vec3d side = place.indexToWorld(along) - origin;
            if (side[axis] >= side.length() * (1 - 1e-12)) continue;
            mSession.note(path
                + " has no room for the turn or the mirror of the object: its axes are those of "
                  "voxels");
            break;
        }
    }

    /// A reader of text that wants no more of it (`| head`) is no error.
    void writeToStdout(const std::string& path)
    {
        const FileKind kind = writtenKind(mCall, path);
        if (kind == FileKind::Vdb) return writeGridsToStdout(path, grids(), mCompression);
        if (kind == FileKind::Csv && openvdb_spheretree::hasDag(onlyTree(mItems, path))) {
            mSession.note(path
                + " holds the spheres; the edges of dag=1 are a table of their own, "
                  "which only a file has room for beside it");
        }
        FdSink sink(STDOUT_FILENO, path);
        std::ostream out(&sink);
        out.exceptions(std::ios::badbit | std::ios::failbit);
        try {
            writeContent(path, out);
            sink.pubsync();
        } catch (const ClosedPipe&) {
            if (kind == FileKind::Html || isPicture(kind)) throw; // of no use in part
        }
    }

    void writeTables(const std::string& path)
    {
        const openvdb_spheretree::SphereTree& tree = onlyTree(mItems, path);
        writeFile(path, [&](std::ostream& out) { writeContent(path, out); });
        if (!openvdb_spheretree::hasDag(tree)) return;
        writeFile(
            dagPath(path), [&](std::ostream& out) { openvdb_spheretree::writeDagCsv(tree, out); });
    }

    const openvdb::GridCPtrVec& grids()
    {
        if (!mGrids.empty()) return mGrids;
        requireDistinctTrees(mItems);
        const bool giveUp = mSession.isLastAction() && !needsTrees();
        return mGrids = gridsOf(mItems, giveUp, mSession.progress);
    }

    /// Whether a file is written of the trees themselves.
    bool needsTrees() const
    {
        const std::vector<std::string> paths = mCall.list("files");
        return std::any_of(paths.begin(), paths.end(),
            [](const std::string& path) { return fileKind(path) != FileKind::Vdb; });
    }

    const ActionCall& mCall;
    const std::vector<StackItem*>& mItems;
    Session& mSession;
    const uint32_t mCompression;
    openvdb::GridCPtrVec mGrids;
    std::vector<std::unique_ptr<AtomicFile>> mFiles;
    std::string mToStdout; ///< empty if nothing goes there
};

/// Whether a file of this name has room for more than one tree.
bool holdsSeveral(const ActionCall& call, const std::string& path)
{
    const openvdb_spheretree::ExportFormat* const format = exportFormatOf(call, path);
    return format ? format->links || format->samples : fileKind(path) == FileKind::Vdb;
}

/// Of a file behind a loop that lacks the trees that were written in it.
void warnOfGone(const std::string& path, const std::vector<StackItem*>& items, Session& session)
{
    const auto isOfLoop = [&](const StackItem* item) {
        return item->anyTree() && session.stack.isOfEndedLoop(*item);
    };
    const int64_t held = std::count_if(items.begin(), items.end(), isOfLoop);
    const int64_t gone = session.stack.writtenAndGone();
    if (held == 0 || gone == 0) return;
    session.warn(path + " lacks " + std::to_string(gone) + " of the "
        + counted(held + gone, "sphere-tree") + " of the loop, which were given up when they had "
        + "been written there: vdb=0 keep=1 of that -write writes each and keeps it for this file");
}

/// Says what a user may not expect of the files that are written.
void noteSurprises(const ActionCall& call, const std::vector<StackItem*>& items, Session& session)
{
    const auto isTree = [](const StackItem* item) { return bool(item->tree); };
    const bool anyTree = std::any_of(items.begin(), items.end(), isTree);
    for (const std::string& path : call.list("files")) {
        session.warnIfReplaced(path);
        if (holdsSeveral(call, path) && !call.given("vdb")) warnOfGone(path, items, session);
        if (fileKind(path) != FileKind::Vdb || !anyTree || call.given("vdb")) continue;
        for (const StackItem* item : items) {
            if (item->tree) continue;
            session.note(
                path + " gets " + item->description() + " as well; with vdb= only what is named");
        }
    }
}

void run(const ActionCall& call, Session& session)
{
    const Stopwatch watch;
    const std::vector<StackItem*> items = session.stack.several(call.list("vdb"));
    noteSurprises(call, items, session);
    countErrorsOfCharts(call, items, session);
    Writer writer(call, items, session);
    for (const std::string& path : call.list("files")) writer.write(path);
    writer.commit();
    for (StackItem* item : items) item->written = !call.flag("keep");
    session.seconds.write += watch.seconds();
}

} // namespace

ActionSpec writeAction()
{
    ActionSpec action{"write", "o", "files",
        "write grids and sphere-trees (.vdb), an object (.vol), one sphere-tree as tables (.csv) "
        "or JSON (.json), a page that shows it in a browser (.html), a picture of a level of it or "
        "of an object (.png, .jpg), curves of errors (.svg), or spheres for other tools"};
    action.options = {
        list("files", "",
            "files to write, or stdout.vdb, .csv, .json, .html; the extension says how"),
        list("vdb", "*", "what to write, by ages on the stack (0 is the newest) or names"),
        choice("codec", {"blosc", "zip", "active", "none"}, "compression of a .vdb"),
        flag("keep", false, "leave on the stack what is written")};
    for (const OptionSpec& option : pictureOptions()) action.options.push_back(option);
    for (const OptionSpec& option : exportOptions()) action.options.push_back(option);
    for (const OptionSpec& option : pageOptions()) action.options.push_back(option);
    action.more = chartDocs();
    for (const auto& doc : exportFormatDocs()) action.more.push_back(doc);
    action.givesOut = true;
    action.writesEmpty = true;
    action.failure = kOutput;
    action.check = check;
    action.run = run;
    return action;
}

} // namespace command
