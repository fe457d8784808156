// SPDX-License-Identifier: Apache-2.0
#include "RememberedFiles.h"

#include <array>
#include <atomic>

#include <unistd.h>

namespace command {

namespace {

std::array<std::atomic<const char*>, 64> sFiles{};
static_assert(std::atomic<const char*>::is_always_lock_free, "signal handlers read them");

} // namespace

void rememberFile(const char* path) noexcept
{
    for (auto& file : sFiles) {
        const char* none = nullptr;
        if (file.compare_exchange_strong(none, path)) return;
    }
}

void forgetFile(const char* path) noexcept
{
    for (auto& file : sFiles) {
        const char* same = path;
        if (file.compare_exchange_strong(same, nullptr)) return;
    }
}

void removeRememberedFiles() noexcept
{
    for (const auto& file : sFiles) {
        if (const char* const path = file.load()) unlink(path);
    }
}

} // namespace command
