// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "files/AtomicFile.h"
#include "Length.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/vol/VolFile.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <iostream>

#include <sys/stat.h>
#include <unistd.h>

namespace command {

namespace {

std::string absolute(const std::string& path)
{
    std::error_code error;
    const auto resolved = std::filesystem::weakly_canonical(path, error);
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

/// Pictures, and arrays of bytes that do not say their size: assimp would take some of them for
/// meshes, and find none.
bool isArray(const std::string& path)
{
    return isOneOf(extensionOf(path),
        {".raw", ".bin", ".dat", ".npy", ".npz", ".nii", ".gz", ".nrrd", ".mha", ".mhd", ".dcm",
            ".tif", ".tiff", ".jpg", ".jpeg", ".bmp", ".pgm", ".png"});
}

[[noreturn]] void refuseToRead(const std::string& path)
{
    const std::string kinds =
        "it reads .vdb, .vol, .longvol and meshes (.obj, .ply, .stl, .off ...) and "
        "spheres (.csv, .json), by their extension";
    if (isArray(path)) {
        throwInput("cannot read " + path + ": pictures and plain arrays of values are not read; "
            + "make a .vdb of it first (pyopenvdb does so with an array), or a .vol, which is a "
              "few "
              "lines of text before the bytes; "
            + kinds);
    }
    throwInput("cannot read " + path + ": files of this kind are not read; " + kinds);
}

} // namespace

bool isStdin(const std::string& path)
{
    return path.rfind("stdin.", 0) == 0
        && isOneOf(extensionOf(path),
            {".vdb", ".vol", ".longvol", ".obj", ".off", ".ply", ".stl", ".csv", ".json"});
}

bool isStdout(const std::string& path)
{
    return path == "-"
        || (path.rfind("stdout.", 0) == 0
            && isOneOf(extensionOf(path), {".vdb", ".csv", ".json", ".png", ".jpg", ".html"}));
}

void Plan::addWorldUnit(bool metres) { mAllMetres = mAllMetres.value_or(true) && metres; }

void Plan::requireKnownUnit(const std::string& option, const std::string& typed) const
{
    const auto length = parseLength(typed);
    if (!length || mAllMetres.value_or(false)) return;
    throwUsage(option + "=" + typed
        + ": a file does not say what its unit of length is; say it where it is read, such as "
          "-read "
          "part.stl units="
        + length->unit + ", or write the number alone, in the units of the file");
}

bool Plan::replacesInput(const std::string& path) const
{
    return mInputs.count(absolute(AtomicFile::targetOf(path))) > 0;
}

void checkReadable(const std::string& path)
{
    struct stat info;
    if (stat(path.c_str(), &info) != 0) throwInput("cannot read " + systemError(path));
    if (S_ISDIR(info.st_mode)) throwInput("cannot read " + path + ": it is a folder");
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
    const std::string target = absolute(AtomicFile::targetOf(path));
    const bool willBeWritten = mOutputs.count(target) > 0;
    if (!willBeWritten) checkReadable(path);
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
    if (!mOutputs.insert(target).second) throwUsage(path + " is written more than once");
    AtomicFile::checkTarget(path);
}

} // namespace command
