// SPDX-License-Identifier: Apache-2.0
#include "Memory.h"
#include "TextStream.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace openvdb_spheretree::detail {

namespace {

/// @return the bytes that a container has on Linux (control groups 2 and 1); infinity: no limit.
double containerMemory()
{
    for (const char* path :
        {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        double bytes = 0;
        if (std::ifstream(path) >> bytes && bytes > 0) return bytes; // "max" is no number
    }
    return std::numeric_limits<double>::infinity();
}

} // namespace

double physicalMemory()
{
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    if (pages > 0 && size > 0) return std::min(double(pages) * double(size), containerMemory());
#endif
    return 0;
}

int64_t allowedMemory(int64_t memory)
{
    if (memory > 0) return memory;
    const double there = physicalMemory();
    return there == 0 ? INT64_MAX : int64_t(kMemoryShare * there);
}

std::string asText(double bytes, bool up)
{
    constexpr double kKiB = 1 << 10, kMiB = 1 << 20, kGiB = 1 << 30;
    if (bytes < kKiB && !up)
        return std::to_string(int64_t(bytes)) + (bytes < 2 ? " byte" : " bytes");
    double unit = kKiB;
    const char* name = " KiB";
    if (bytes >= kGiB) {
        unit = kGiB;
        name = " GiB";
    } else if (bytes >= kMiB) {
        unit = kMiB;
        name = " MiB";
    }
    constexpr double kWhole = 1e-3; // what was given in tenths of a unit is whole bytes
    const double tenths = bytes / unit * 10;
    detail::TextStream text;
    text << (up ? std::ceil(tenths) : std::floor(tenths + kWhole)) / 10 << name;
    return text.str();
}

std::string asMemoryOption(double bytes)
{
    std::string text = asText(bytes);
    text.erase(text.find(' '), 1);
    return "memory=" + text;
}

bool isAllowed(double bytes, int64_t memory)
{
    if (memory > 0) return bytes <= double(memory);
    const double there = physicalMemory();
    return there == 0 || bytes <= there;
}

void requireAllowed(int64_t leaves, int64_t needed, int64_t allowed)
{
    if (needed <= allowed) return;
    const std::string what = "the object's " + std::to_string(leaves)
        + " leaf nodes, those inside its tiles included, need at least " + asText(double(needed))
        + " for their power labels, and memory= allows " + asText(double(allowed), false) + ": try "
        + asMemoryOption(double(needed)) + ", use a larger voxel, or split the object";
    throw MemoryError(what, double(needed));
}

void requireMemory(double bytes, const std::string& what, const std::string& remedy)
{
    requireAllowed(bytes, 0, what, remedy);
}

void requireAllowed(
    double bytes, int64_t memory, const std::string& what, const std::string& remedy)
{
    if (isAllowed(bytes, memory)) return;
    const std::string needed = what + " need about " + asText(bytes);
    if (memory <= 0) {
        throw MemoryError(needed + ", more than the " + asText(physicalMemory(), false)
                + " of this machine: " + remedy,
            bytes);
    }
    throw MemoryError(needed + ", and memory= allows " + asText(double(memory), false) + ": try "
            + asMemoryOption(bytes) + ", " + remedy,
        bytes);
}

void requireMemory(int64_t leaves, int64_t bytesPerLeaf)
{
    requireMemory(double(leaves) * double(bytesPerLeaf),
        "the object's " + std::to_string(leaves) + " leaf nodes, those inside its tiles included,",
        "use a larger voxel, or split the object");
}

} // namespace openvdb_spheretree::detail
