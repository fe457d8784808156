// SPDX-License-Identifier: Apache-2.0
#include "InputFile.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace spheretree_test {

namespace {

[[noreturn]] void fail(const char* call)
{
    throw std::system_error(errno, std::generic_category(), call);
}

std::string newFolder()
{
    std::string folder = (std::filesystem::temp_directory_path() / "spheretree_XXXXXX").string();
    if (!mkdtemp(folder.data())) fail("mkdtemp");
    return folder;
}

/// @return a file in memory, which the path leads to: readers go by the extension, which it has not itself.
int fileInMemory(const std::string& path)
{
    const int fd = memfd_create("input", MFD_CLOEXEC);
    if (fd < 0) fail("memfd_create");
    const std::string target = "/proc/self/fd/" + std::to_string(fd);
    if (symlink(target.c_str(), path.c_str()) != 0) fail("symlink");
    return fd;
}

/// @return one that is in the folder that its path says, as it must be if it names others or is named.
int fileInFolder(const std::string& path)
{
    const int fd = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (fd < 0) fail("open");
    return fd;
}

bool namesOthers(const std::string& extension)
{
    return extension == ".nhdr" || extension == ".gltf" || extension == ".glb";
}

void setBytes(int fd, const std::string& bytes)
{
    if (ftruncate(fd, off_t(bytes.size())) != 0) fail("ftruncate");
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = pwrite(fd, bytes.data() + done, bytes.size() - done, off_t(done));
        if (count <= 0) fail("pwrite");
        done += std::size_t(count);
    }
}

void remove(const std::string& folder)
{
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
}

} // namespace

InputFile::InputFile(const std::string& extension)
    : mFolder(newFolder()), mPath(mFolder + "/input" + extension),
      mFd(namesOthers(extension) ? fileInFolder(mPath) : fileInMemory(mPath))
{}

InputFile::~InputFile()
{
    remove(mFolder);
    close(mFd);
}

void InputFile::set(const std::string& bytes) { setBytes(mFd, bytes); }

InputFolder::InputFolder() : mPath(newFolder()) {}

InputFolder::~InputFolder()
{
    remove(mPath);
    for (const auto& [name, fd] : mFds) close(fd);
}

std::string InputFolder::set(const std::string& name, const std::string& bytes)
{
    const std::string path = mPath + "/" + name;
    const auto found = mFds.find(name);
    const int fd = found != mFds.end() ? found->second : mFds[name] = fileInFolder(path);
    setBytes(fd, bytes);
    return path;
}

void InputFolder::clear()
{
    for (const auto& [name, fd] : mFds) {
        close(fd);
        unlink((mPath + "/" + name).c_str());
    }
    mFds.clear();
}

} // namespace spheretree_test
