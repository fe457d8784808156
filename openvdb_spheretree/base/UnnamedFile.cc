// SPDX-License-Identifier: Apache-2.0
#include "UnnamedFile.h"

#include <cerrno>
#include <cstdlib>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace openvdb_spheretree::detail {

std::string temporaryFolder()
{
    const char* const folder = std::getenv("TMPDIR");
    return folder && *folder ? folder : "/tmp";
}

int openUnnamedFile(const std::string& folder)
{
#ifdef O_TMPFILE
    const int nameless =
        open(folder.c_str(), O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (nameless >= 0) return nameless;
#endif
    std::string name = folder + "/spheretree.XXXXXX";
    const int fd = mkostemp(name.data(), O_CLOEXEC);
    if (fd < 0 || unlink(name.c_str()) == 0) return fd;
    const int error = errno;
    close(fd);
    errno = error;
    return -1;
}

} // namespace openvdb_spheretree::detail
