// SPDX-License-Identifier: Apache-2.0
#include "Memory.h"

#include <openvdb/Exceptions.h>

#include <cmath>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace openvdb_spheretree {
namespace detail {

namespace {

/// @return bytes; 0 if unknown.
double physicalMemory()
{
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    if (pages > 0 && size > 0) return double(pages) * double(size);
#endif
    return 0;
}

} // namespace

void requireMemory(int64_t leaves, int64_t bytesPerLeaf)
{
    constexpr double kGiB = 1 << 30;
    const double needed = double(leaves) * double(bytesPerLeaf), there = physicalMemory();
    if (there == 0 || needed <= there) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object's " << leaves << " leaf nodes, those inside its tiles included, need about "
                        << std::ceil(needed / kGiB) << " GiB, more than the "
                        << std::floor(there / kGiB)
                        << " GiB of this machine: use a larger voxel, or split the object");
}

} // namespace detail
} // namespace openvdb_spheretree
