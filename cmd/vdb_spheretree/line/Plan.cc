// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "files/AtomicFile.h"
#include "Length.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/export/ExportFormat.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/input/volume/VolumeFile.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <iostream>

#include <sys/stat.h>
#include <unistd.h>

namespace command {

using openvdb_spheretree::isStackName;
using openvdb_spheretree::isVolumeFileName;
using openvdb_spheretree::stackFiles;

namespace {

std::string absolute(const std::string& path)
{
    std::error_code error;
    // A relative name of what is not there yet would stay as it is spelled.
    const auto whole = std::filesystem::absolute(path, error);
    if (error) return path;
    const auto resolved = std::filesystem::weakly_canonical(whole, error);
    return error ? path : resolved.string();
}

std::string extensionOf(const std::string& path)
{
    return openvdb_spheretree::detail::lowerExtension(path);
}

bool isOneOf(const std::string& word, std::initializer_list<const char*> words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// Pictures and volumes that are not read: assimp would take some of them for meshes, and find none.
bool isArray(const std::string& path)
{
    return isOneOf(extensionOf(path),
        {".bin", ".dat", ".npz", ".gz", ".mha", ".mhd", ".dcm", ".hdr", ".img", ".tif", ".tiff",
            ".jpg", ".jpeg", ".bmp", ".ppm", ".pbm", ".gif"});
}

/// @return whether files of another tool have this extension.
bool isExported(const std::string& extension)
{
    const auto& formats = openvdb_spheretree::exportFormats();
    return std::any_of(formats.begin(), formats.end(), [&](const auto& format) {
        const auto& known = format.extensions;
        return std::find(known.begin(), known.end(), extension) != known.end();
    });
}

/// @return how all frames go to one file, if it has room for them.
std::string allInOne(const std::string& path)
{
    const auto* const format = openvdb_spheretree::findExportFormat(extensionOf(path));
    if (!format || !format->samples) return {};
    return "; for all frames in one file write it behind the loop: -for i=1,25 -read a_####.vdb "
           "... "
           "-end -write "
        + path;
}

[[noreturn]] void refuseToRead(const std::string& path)
{
    const std::string kinds =
        "it reads .vdb, volumes (.vol, .longvol, .npy, .raw, .nrrd, .nii, .nii.gz), gray pictures "
        "(.png, .pgm), meshes (.obj, .ply, .stl, .off ...) and spheres (.csv, .json), by their "
        "extension";
    if (isArray(path)) {
        throwInput("cannot read " + path
            + ": pictures and arrays of this kind are not read; make a "
              ".png or .pgm of pictures first (ImageMagick's convert does), and a .nrrd, .nii or "
              ".npy "
              "of volumes, or read bytes that you know as a .raw with shape= and type=; "
            + kinds);
    }
    throwInput("cannot read " + path + ": files of this kind are not read; " + kinds);
}

} // namespace

bool isStdin(const std::string& path)
{
    return path.rfind("stdin.", 0) == 0
        && (isVolumeFileName(path)
            || isOneOf(extensionOf(path),
                {".vdb", ".vol", ".longvol", ".obj", ".off", ".ply", ".stl", ".csv", ".json"}));
}

bool isStdout(const std::string& path)
{
    return path == "-"
        || (path.rfind("stdout.", 0) == 0
            && (isOneOf(extensionOf(path),
                    {".vdb", ".vol", ".csv", ".json", ".png", ".jpg", ".html", ".svg"})
                || isExported(extensionOf(path))));
}

void Plan::addWorldUnit(bool metres) { mAllMetres = mAllMetres.value_or(true) && metres; }

void Plan::requireKnownUnit(
    const std::string& option, const std::string& typed, const std::string& remedy) const
{
    const auto length = parseLength(typed);
    if (!length || mAllMetres.value_or(false)) return;
    std::string advice = remedy;
    advice.replace(advice.find('@'), 1, length->unit);
    throwUsage(option + "=" + typed + ": a file does not say what its unit of length is; " + advice
        + ", or write the number alone, in the units of the file");
}

bool Plan::replacesInput(const std::string& path) const
{
    return mInputs.count(absolute(AtomicFile::targetOf(path))) > 0;
}

void checkReadable(const std::string& path)
{
    struct stat info;
    if (stat(path.c_str(), &info) != 0) throwInput("cannot read " + systemError(path));
    if (S_ISDIR(info.st_mode))
        throwInput("cannot read " + path
            + ": it is a folder (-files reads all files of one, and slice_####.png a stack of "
              "slices)");
    if (access(path.c_str(), R_OK) != 0) throwInput("cannot read " + systemError(path));
}

FileKind fileKind(const std::string& path)
{
    const std::string extension = openvdb_spheretree::detail::lowerExtension(path);
    if (extension == ".vdb") return FileKind::Vdb;
    if (extension == ".csv") return FileKind::Csv;
    if (extension == ".png") return FileKind::Png;
    if (extension == ".jpg" || extension == ".jpeg") return FileKind::Jpeg;
    if (extension == ".json") return FileKind::Json;
    if (extension == ".html" || extension == ".htm") return FileKind::Html;
    if (openvdb_spheretree::isVolFileName(path)) return FileKind::Vol;
    if (isVolumeFileName(path)) return FileKind::Volume;
    if (isArray(path)) return FileKind::Unknown;
    if (openvdb_spheretree::isMeshFileName(path)) return FileKind::Mesh;
    return FileKind::Unknown;
}

void Plan::addInput(const std::string& path)
{
    if (isStdin(path)) {
        if (mStdinTaken) throwUsage(path + ": standard input can be read only once");
        if (isatty(STDIN_FILENO)) throwInput(path + ": nothing is piped into this command");
        mStdinTaken = true;
        return;
    }
    if (!isStackName(path)) return addFile(path);
    try {
        for (const std::string& slice : stackFiles(path)) addFile(slice);
    } catch (const openvdb::IoError& error) {
        throwInput(openvdb_spheretree::detail::messageOf(error));
    }
}

void Plan::addFile(const std::string& path)
{
    const std::string target = absolute(AtomicFile::targetOf(path));
    const bool willBeWritten = mOutputs.count(target) > 0;
    std::error_code ignored;
    const bool isMissing = !willBeWritten && !std::filesystem::exists(path, ignored);
    if (!mFrame.empty()) ++mFrameInputs;
    if (!mFrame.empty() && isMissing) mMissing.push_back(path);
    else if (!willBeWritten) checkReadable(path);
    if (isVolumeFileName(path)) {
        mInputs.insert(target);
        return;
    }
    switch (fileKind(path)) {
    case FileKind::Vdb:
    case FileKind::Vol:
    case FileKind::Csv:
    case FileKind::Json:
    case FileKind::Mesh: mInputs.insert(target); return;
    default: refuseToRead(path);
    }
}

void Plan::addOutput(const std::string& path)
{
    if (isStdout(path)) {
        if (mStdoutTaken) throwUsage("two outputs go to stdout");
        const FileKind kind = fileKind(path);
        const bool isText = path == "-" || kind == FileKind::Csv || kind == FileKind::Json;
        if (!isText && isTerminal(standardOutput())) {
            throwOutput(path + ": stdout is a terminal; pipe it into another command");
        }
        mStdoutTaken = true;
        return;
    }
    const std::string target = absolute(AtomicFile::targetOf(path));
    const auto [output, isNew] = mOutputs.emplace(target, mFrame);
    if (!isNew && output->second != mFrame && !mFrame.empty()) {
        const std::string other = output->second.empty() ? "an action before" : output->second;
        throwUsage(path + " would be written by " + other + " and by " + mFrame
            + ": put what tells them apart into its name, such as tree_####.vdb or 'tree_{$i}.vdb' "
              "(in single quotes)"
            + allInOne(path));
    }
    if (!isNew) throwUsage(path + " is written more than once");
    AtomicFile::checkTarget(path);
}

void Plan::requireInputs() const
{
    if (mMissing.empty()) return;
    constexpr size_t kNamed = 12;
    std::string names;
    for (size_t i = 0; i < std::min(kNamed, mMissing.size()); ++i) {
        names += (i ? ", " : "") + mMissing[i];
    }
    if (mMissing.size() > kNamed) {
        names += " and " + std::to_string(mMissing.size() - kNamed) + " more";
    }
    throwInput(std::to_string(mMissing.size()) + " of the " + std::to_string(mFrameInputs)
        + " files that loops read are not there: " + names);
}

} // namespace command
