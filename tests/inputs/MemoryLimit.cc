// SPDX-License-Identifier: Apache-2.0
#include "MemoryLimit.h"

#include "support/Sanitizers.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include <unistd.h>

namespace spheretree_test {

uint64_t bytesOfAddresses()
{
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * uint64_t(sysconf(_SC_PAGESIZE));
}

MemoryLimit::MemoryLimit(uint64_t bytes)
{
    if (kSanitized || bytes == 0) return;
    getrlimit(RLIMIT_AS, &mBefore);
    if (bytes >= mBefore.rlim_cur) return;
    const rlimit wanted{rlim_t(bytes), mBefore.rlim_max};
    if (setrlimit(RLIMIT_AS, &wanted) != 0) {
        throw std::system_error(errno, std::generic_category(), "setrlimit");
    }
    mIsSet = true;
}

MemoryLimit::~MemoryLimit()
{
    if (mIsSet) setrlimit(RLIMIT_AS, &mBefore);
}

} // namespace spheretree_test
