// SPDX-License-Identifier: Apache-2.0
#include "InputReader.h"

#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/vol/VolFile.h>

#include <base/Errors.h>
#include <line/ActionParser.h>
#include <session/Session.h>

#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>

#include <stdexcept>

#include <unistd.h>

namespace spheretree_test {

using openvdb_spheretree::isVolFileName;
using openvdb_spheretree::readMeshFile;
using openvdb_spheretree::readVolFile;

namespace {

void checkMessage(const std::string& message, const std::string& path)
{
    constexpr std::size_t kLongest = 4096;
    if (message.size() > kLongest) throw std::logic_error("a message of more than 4 KiB");
    if (message.find(path) == std::string::npos) {
        throw std::logic_error("a message that does not name the file: " + message);
    }
}

/// Closes what was opened during its life. What is read with delayed loading keeps its file open for as
/// long as the program runs, which is too long for thousands of files.
class FileCloser {
public:
    FileCloser() : mFirst(dup(STDIN_FILENO)) { close(mFirst); }
    ~FileCloser() { close_range(unsigned(mFirst), ~0u, 0); }
    FileCloser(const FileCloser&) = delete;
    FileCloser& operator=(const FileCloser&) = delete;

private:
    int mFirst; ///< the lowest number that was free
};

} // namespace

void InputReader::readVdb(bool delayed) const
{
    const FileCloser closer;
    const auto line =
        command::parseLine({"-quiet", "-read", mFile.path(), delayed ? "delayed=1" : "delayed=0"});
    const command::Plan plan = command::checkLine(line);
    command::Session session(plan);
    session.run(line);
    for (const auto& item : session.stack.items()) {
        if (!item->grid) continue;
        try {
            item->grid->baseTree().readNonresidentBuffers();
        } catch (...) {
            command::rethrowNamed(mFile.path(), command::kInput);
        }
    }
}

bool InputReader::read(const std::string& bytes, bool delayed)
{
    mFile.set(bytes);
    const std::string& path = mFile.path();
    const bool isConfig = mExtension == ".cfg";
    try {
        if (mExtension == ".vdb") readVdb(delayed);
        else if (isConfig) command::parseLine({"-config", path});
        else if (isVolFileName(path)) readVolFile(path);
        else readMeshFile(path);
        return true;
    } catch (const command::CommandError& error) {
        // Actions in the wrong order may be the fault of the line that the file is a part of.
        if (isConfig && error.code() == command::kUsage) return false;
        if (error.code() != command::kInput) throw;
        checkMessage(error.what(), path);
    } catch (const openvdb::IoError& error) { // what the readers of the library throw
        checkMessage(error.what(), path);
    }
    return false;
}

} // namespace spheretree_test
