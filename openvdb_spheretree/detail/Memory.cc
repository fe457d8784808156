// SPDX-License-Identifier: Apache-2.0
#include "Memory.h"

#include <openvdb/Exceptions.h>

#include <cmath>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace openvdb_spheretree {
namespace detail {

double physicalMemory()
{
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    if (pages > 0 && size > 0) return double(pages) * double(size);
#endif
    return 0;
}

void requireMemory(double bytes, const std::string& what, const std::string& remedy)
{
    constexpr double kGiB = 1 << 30;
    const double there = physicalMemory();
    if (there == 0 || bytes <= there) return;
    OPENVDB_THROW(openvdb::ValueError,
        what << " need about " << std::ceil(bytes / kGiB) << " GiB, more than the "
             << std::floor(there / kGiB) << " GiB of this machine: " << remedy);
}

void requireMemory(int64_t leaves, int64_t bytesPerLeaf)
{
    requireMemory(double(leaves) * double(bytesPerLeaf),
        "the object's " + std::to_string(leaves) + " leaf nodes, those inside its tiles included,",
        "use a larger voxel, or split the object");
}

} // namespace detail
} // namespace openvdb_spheretree
