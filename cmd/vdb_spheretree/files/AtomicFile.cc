// SPDX-License-Identifier: Apache-2.0
#include "AtomicFile.h"

#include "base/Errors.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace command {

namespace {

/// Linux gives up after as many.
constexpr int kMostLinks = 40;

/// A folder that is missing, named with the link that leads to it.
void requireFolder(const std::string& path, const std::string& target)
{
    const std::filesystem::path parent = std::filesystem::path(target).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    const std::string start = "cannot write " + path + ": "
        + (target == path ? "" : "it is a link to " + target + ", and ") + "its folder ";
    struct stat info;
    if (stat(folder.c_str(), &info) != 0) throwOutput(start + systemError(folder));
    if (!S_ISDIR(info.st_mode)) throwOutput(start + folder + " is no folder");
}

} // namespace

std::string AtomicFile::targetOf(const std::string& path)
{
    std::filesystem::path target = path;
    for (int i = 0; i < kMostLinks; ++i) {
        std::error_code error;
        const auto link = std::filesystem::read_symlink(target, error);
        if (error) return target.string(); // no link
        target = target.parent_path() / link;
    }
    return path; // they go round in a circle; whoever opens it is told
}

void AtomicFile::checkTarget(const std::string& path)
{
    const std::string target = targetOf(path);
    requireFolder(path, target);
    struct stat info;
    if (stat(target.c_str(), &info) == 0) {
        if (S_ISDIR(info.st_mode)) throwOutput("cannot write " + path + ": it is a folder");
        if (!S_ISREG(info.st_mode)) throwOutput("cannot write " + path + ": it is no regular file");
        if (access(target.c_str(), W_OK) != 0) {
            throwOutput("cannot write " + systemError(path));
        }
    } else if (errno != ENOENT) {
        throwOutput("cannot write " + systemError(path));
    }
    const AtomicFile trial(path);
}

AtomicFile::AtomicFile(const std::string& path)
try : mPath(path), mTemporary(targetOf(path)) {
} catch (...) {
    // As far as a message can hold the name: to a null byte.
    rethrowNamed(std::string("cannot write ") + path.c_str(), kOutput);
}

void AtomicFile::write(const std::function<void(std::iostream&)>& content)
{
    errno = 0;
    std::fstream stream(mTemporary.path(), std::ios::in | std::ios::out | std::ios::binary);
    if (!stream) fail();
    stream.exceptions(std::ios::badbit | std::ios::failbit);
    try {
        content(stream);
        stream.flush();
        stream.close();
    } catch (const std::ios_base::failure&) {
        fail();
    }
    if (!mTemporary.sync()) fail();
}

void AtomicFile::commit()
{
    if (!mTemporary.publish()) fail();
}

void AtomicFile::fail() const
{
    if (errno == 0) throwOutput("cannot write " + mPath + ": the stream has failed");
    throwOutput("cannot write " + systemError(mPath));
}

} // namespace command
