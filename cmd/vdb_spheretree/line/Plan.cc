// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "files/AtomicFile.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/vol/VolFile.h>

#include <filesystem>
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

} // namespace

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
    if (openvdb_spheretree::isVolFileName(path)) return FileKind::Vol;
    if (openvdb_spheretree::isMeshFileName(path)) return FileKind::Mesh;
    return FileKind::Unknown;
}

void Plan::addInput(const std::string& path)
{
    if (path == "stdin.vdb") {
        if (mStdinTaken) throwUsage("stdin.vdb can be read only once");
        if (isatty(STDIN_FILENO)) throwInput("stdin.vdb: nothing is piped into this command");
        mStdinTaken = true;
        return;
    }
    const bool willBeWritten = mOutputs.count(absolute(AtomicFile::targetOf(path))) > 0;
    if (!willBeWritten) checkReadable(path);
    switch (fileKind(path)) {
    case FileKind::Vdb:
    case FileKind::Vol:
    case FileKind::Csv:
    case FileKind::Json:
    case FileKind::Mesh: return;
    default:
        throwInput("cannot read " + path
            + ": files of this kind are not read; it reads .vdb, .vol, "
              ".longvol, meshes (.obj, .ply, .stl, .off ...) and spheres (.csv, .json), by their "
              "extension");
    }
}

void Plan::addOutput(const std::string& path)
{
    if (path == "-" || path == "stdout.vdb") {
        if (mStdoutTaken) throwUsage("two outputs go to stdout");
        if (path != "-" && isTerminal(standardOutput())) {
            throwOutput("stdout.vdb: stdout is a terminal; pipe it into another command");
        }
        mStdoutTaken = true;
        return;
    }
    const std::string target = absolute(AtomicFile::targetOf(path));
    if (!mOutputs.insert(target).second) throwUsage(path + " is written more than once");
    AtomicFile::checkTarget(path);
}

} // namespace command
