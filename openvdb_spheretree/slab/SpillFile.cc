// SPDX-License-Identifier: Apache-2.0
#include "SpillFile.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/UnnamedFile.h>

#include <openvdb/Exceptions.h>

#include <cerrno>
#include <system_error>

#include <sys/statvfs.h>
#include <unistd.h>

namespace openvdb_spheretree::slab {

namespace {

std::string whyNot(int error) { return std::generic_category().message(error); }

} // namespace

SpillFile::SpillFile() : mFolder(detail::temporaryFolder()), mFile(detail::openUnnamedFile(mFolder))
{
    if (mFile < 0) fail("cannot be made: " + whyNot(errno));
}

SpillFile::~SpillFile() { close(mFile); }

int64_t SpillFile::append(const void* data, std::size_t bytes)
{
    const int64_t place = mSize.fetch_add(int64_t(bytes));
    const char* from = static_cast<const char*>(data);
    for (std::size_t done = 0; done < bytes;) {
        const ssize_t count = pwrite(mFile, from + done, bytes - done, place + off_t(done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            fail("does not take " + detail::asText(double(place + int64_t(bytes))) + ": "
                + whyNot(count < 0 ? errno : ENOSPC));
        }
        done += std::size_t(count);
    }
    return place;
}

void SpillFile::read(int64_t place, void* data, std::size_t bytes) const
{
    char* to = static_cast<char*>(data);
    for (std::size_t done = 0; done < bytes;) {
        const ssize_t count = pread(mFile, to + done, bytes - done, place + off_t(done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail("cannot be read: " + (count < 0 ? whyNot(errno) : "it is too short"));
        done += std::size_t(count);
    }
}

void SpillFile::requireRoom(double bytes) const
{
    struct statvfs folder;
    if (fstatvfs(mFile, &folder) != 0) return;
    const double there = double(folder.f_bavail) * double(folder.f_frsize);
    if (bytes <= there) return;
    fail("needs about " + detail::asText(bytes) + ", and there is room for "
        + detail::asText(there, false));
}

void SpillFile::fail(const std::string& what) const
{
    OPENVDB_THROW(openvdb::IoError,
        "the temporary file in '" << mFolder << "' " << what
                                  << "; set TMPDIR to a folder that has room, or allow the build "
                                     "more memory=");
}

} // namespace openvdb_spheretree::slab
