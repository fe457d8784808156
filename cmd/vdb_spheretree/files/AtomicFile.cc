// SPDX-License-Identifier: Apache-2.0
#include "AtomicFile.h"

#include "base/Errors.h"
#include "base/Progress.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace command {

namespace {

std::string folderOf(const std::string& path)
{
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

/// A link is followed, so that the file it names is replaced and not the link.
std::string followed(const std::string& path)
{
    std::error_code error;
    const auto resolved = std::filesystem::canonical(path, error);
    return error ? path : resolved.string();
}

/// @return the name of a new, empty file in @a folder; empty (and errno) if it could not be made.
std::string makeTemporary(const std::string& folder)
{
    std::string name = folder + "/.vdb_spheretree.XXXXXX";
    const int fd = mkstemp(name.data());
    if (fd < 0) return {};
    close(fd);
    return name;
}

/// The permissions of the file it replaces, or those that any new file gets.
mode_t permissionsFor(const std::string& target)
{
    struct stat info;
    if (stat(target.c_str(), &info) == 0) return info.st_mode & 07777;
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

void checkFolder(const std::string& path, const std::string& folder)
{
    struct stat info;
    if (stat(folder.c_str(), &info) != 0) {
        throwOutput("cannot write " + path + ": its folder " + systemError(folder));
    }
    if (!S_ISDIR(info.st_mode)) {
        throwOutput("cannot write " + path + ": " + folder + " is no folder");
    }
    const std::string trial = makeTemporary(folder);
    if (trial.empty()) {
        throwOutput(
            "cannot write " + path + ": no file can be made in its folder " + systemError(folder));
    }
    unlink(trial.c_str());
}

} // namespace

void AtomicFile::checkTarget(const std::string& path)
{
    const std::string target = followed(path);
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
    checkFolder(path, folderOf(target));
}

AtomicFile::AtomicFile(const std::string& path) : mPath(path), mTarget(followed(path))
{
    mTemporary = makeTemporary(folderOf(mTarget));
    if (mTemporary.empty()) throwOutput("cannot write " + systemError(path));
    mStream.open(mTemporary, std::ios::in | std::ios::out | std::ios::binary | std::ios::trunc);
    if (!mStream) {
        unlink(mTemporary.c_str());
        throwOutput("cannot write " + systemError(path));
    }
    mStream.exceptions(std::ios::badbit | std::ios::failbit);
}

AtomicFile::~AtomicFile()
{
    if (!mCommitted) unlink(mTemporary.c_str());
}

void AtomicFile::write(const std::function<void(std::iostream&)>& content)
{
    try {
        content(mStream);
        mStream.flush();
        mStream.close();
    } catch (const std::ios_base::failure&) {
        throwOutput("cannot write " + mPath + ": the disk is full, or a limit is reached");
    }
}

void AtomicFile::commit()
{
    throwIfStopped();
    chmod(mTemporary.c_str(), permissionsFor(mTarget));
    if (std::rename(mTemporary.c_str(), mTarget.c_str()) != 0) {
        throwOutput("cannot write " + systemError(mPath));
    }
    mCommitted = true;
}

} // namespace command
