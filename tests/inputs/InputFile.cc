// SPDX-License-Identifier: Apache-2.0
#include "InputFile.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

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

} // namespace

InputFile::InputFile(const std::string& extension)
    : mFd(memfd_create("input", MFD_CLOEXEC)), mFolder(newFolder()),
      mPath(mFolder + "/input" + extension)
{
    if (mFd < 0) fail("memfd_create");
    // Readers go by the extension, which a file without a name has not.
    const std::string target = "/proc/self/fd/" + std::to_string(mFd);
    if (symlink(target.c_str(), mPath.c_str()) != 0) fail("symlink");
}

InputFile::~InputFile()
{
    std::error_code ignored;
    std::filesystem::remove_all(mFolder, ignored);
    close(mFd);
}

void InputFile::set(const std::string& bytes)
{
    if (ftruncate(mFd, off_t(bytes.size())) != 0) fail("ftruncate");
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = pwrite(mFd, bytes.data() + done, bytes.size() - done, off_t(done));
        if (count <= 0) fail("pwrite");
        done += std::size_t(count);
    }
}

} // namespace spheretree_test
