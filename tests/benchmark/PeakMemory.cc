// SPDX-License-Identifier: Apache-2.0
#include "PeakMemory.h"

#include <algorithm>
#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace spheretree_benchmark {

namespace {

/// @return whether memory that was freed is no longer resident.
bool giveBackFreedMemory()
{
#ifdef __GLIBC__
    malloc_trim(0);
    return true;
#else
    return false;
#endif
}

bool resetPeak()
{
    std::ofstream file("/proc/self/clear_refs");
    file << "5" << std::flush;
    return bool(file);
}

/// @param key  such as `VmHWM`
std::optional<int64_t> bytesOf(const std::string& key)
{
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind(key + ":", 0) == 0) return 1024 * std::stoll(line.substr(key.size() + 1));
    }
    return std::nullopt;
}

} // namespace

PeakMemory::PeakMemory()
{
    if (giveBackFreedMemory() && resetPeak()) mStart = bytesOf("VmRSS");
}

std::optional<int64_t> PeakMemory::bytes() const
{
    const std::optional<int64_t> peak = mStart ? bytesOf("VmHWM") : std::nullopt;
    if (!peak) return std::nullopt;
    return std::max<int64_t>(0, *peak - *mStart);
}

} // namespace spheretree_benchmark
