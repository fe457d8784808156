// SPDX-License-Identifier: Apache-2.0
#include "TemporaryFile.h"

#include "base/Errors.h"
#include "base/RememberedFiles.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace command {

namespace {

/// Names have 255 bytes at most; this leaves room for what is added.
constexpr size_t kLongestName = 200;
/// Taken names that are tried before giving up. One is taken only if a process had the same number
/// before, or has it in another container.
constexpr int kMostNames = 1000;

std::string folderOf(const std::string& path)
{
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

std::string startOfNames(const std::string& target)
{
    std::string name = target.substr(target.rfind('/') + 1);
    if (name.size() > kLongestName) {
        size_t end = kLongestName; // not within a character of several bytes
        while (end > 0 && (name[end] & 0xc0) == 0x80) --end;
        name.resize(end);
    }
    return folderOf(target) + "/." + name + ".vdb_spheretree-tmp.";
}

bool lock(int fd, int how)
{
    int result;
    do {
        result = flock(fd, how);
    } while (result != 0 && errno == EINTR);
    return result == 0;
}

/// @return whether @a path is a name of the open file.
bool isNameOf(const std::string& path, int fd)
{
    struct stat named, open;
    return lstat(path.c_str(), &named) == 0 && fstat(fd, &open) == 0 && named.st_dev == open.st_dev
        && named.st_ino == open.st_ino;
}

/// Where the lock cannot be had, for whatever reason, the file stays.
void removeIfAbandoned(const std::string& path)
{
    const int fd = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0) return;
    if (lock(fd, LOCK_EX | LOCK_NB) && isNameOf(path, fd)) unlink(path.c_str());
    close(fd);
}

/// By readdir(), as the standard library's iterator calls std::terminate for want of memory.
void removeAbandoned(const std::string& folder, const std::string& start)
{
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(opendir(folder.c_str()), closedir);
    const std::string name = start.substr(folder.size() + 1);
    while (const dirent* const entry = entries ? readdir(entries.get()) : nullptr) {
        if (std::strncmp(entry->d_name, name.c_str(), name.size()) != 0) continue;
        removeIfAbandoned(folder + "/" + entry->d_name);
    }
}

mode_t permissionsFor(const std::string& target)
{
    struct stat info;
    if (stat(target.c_str(), &info) == 0) return info.st_mode & 07777;
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

} // namespace

TemporaryFile::TemporaryFile(const std::string& target)
    : mTarget(target), mFolder(folderOf(target)), mStart(startOfNames(target))
{
    // The system takes what is before it, which is the name of another file.
    if (target.find('\0') != std::string::npos) throwOutput("its name has a null byte");
    removeAbandoned(mFolder, mStart);
    if (openNameless() || openNamed()) return;
    throwOutput("no file can be made in its folder " + systemError(mFolder));
}

TemporaryFile::~TemporaryFile()
{
    if (!mName.empty()) {
        unlink(mName.c_str());
        forgetFile(mName.c_str());
    }
    close(mFd);
}

std::string TemporaryFile::path() const
{
    return mName.empty() ? "/proc/self/fd/" + std::to_string(mFd) : mName;
}

bool TemporaryFile::openNameless()
{
#ifdef O_TMPFILE
    mFd = open(mFolder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (mFd < 0) return false;
    // It gets its name by way of /proc, which need not be there.
    if (access(path().c_str(), F_OK) == 0) {
        lock(mFd, LOCK_EX);
        return true;
    }
    close(mFd);
#endif
    return false;
}

bool TemporaryFile::openNamed()
{
    for (int i = 0; i < kMostNames; ++i) {
        std::string name = mStart + std::to_string(getpid()) + "-" + std::to_string(i);
        // From here on nothing asks for memory: an exception would leave the file.
        mFd = open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        if (mFd < 0 && errno == EEXIST) continue;
        if (mFd < 0) return false;
        // Another run may have seen the file before it was locked, and removed it.
        lock(mFd, LOCK_EX);
        if (isNameOf(name, mFd)) {
            mName = std::move(name);
            rememberFile(mName.c_str());
            return true;
        }
        close(mFd);
    }
    return false;
}

bool TemporaryFile::nameIt()
{
    const std::string nameless = path();
    for (int i = 0; mName.empty() && i < kMostNames; ++i) {
        std::string name = mStart + std::to_string(getpid()) + "-" + std::to_string(i);
        const int result =
            linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
        // Not remembered: what is published next neither throws nor terminates.
        if (result == 0) mName = std::move(name);
        if (result != 0 && errno != EEXIST) return false;
    }
    return !mName.empty();
}

bool TemporaryFile::sync() const
{
    int result;
    do {
        result = fsync(mFd);
    } while (result != 0 && errno == EINTR);
    // Some file systems have nothing to do, and say so.
    return result == 0 || errno == EINVAL || errno == ENOTSUP;
}

bool TemporaryFile::publish()
{
    fchmod(mFd, permissionsFor(mTarget));
    if (!nameIt() || std::rename(mName.c_str(), mTarget.c_str()) != 0) return false;
    forgetFile(mName.c_str());
    mName.clear();
    return true;
}

} // namespace command
