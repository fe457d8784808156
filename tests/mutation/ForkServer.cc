// SPDX-License-Identifier: Apache-2.0
#include "ForkServer.h"

#include "inputs/MemoryLimit.h"
#include "support/Sanitizers.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <map>
#include <new>
#include <system_error>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace spheretree_test {

namespace {

/// What a child tells its parent, in shared memory. One process writes at a time.
struct Share {
    int64_t next, end, step; ///< inputs that are left: next, next + step, ...
    int64_t read, refused;
    bool outOfMemory;
    char what[300]; ///< of an input that ended in some other exception; else empty
};

/// Shares that children and parent see alike.
class SharedArray {
public:
    explicit SharedArray(int count) : mBytes(sizeof(Share) * std::size_t(count))
    {
        void* const memory =
            mmap(nullptr, mBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) {
            throw std::system_error(errno, std::generic_category(), "mmap");
        }
        mShares = static_cast<Share*>(memory); // zeros
    }
    ~SharedArray() { munmap(mShares, mBytes); }
    SharedArray(const SharedArray&) = delete;
    SharedArray& operator=(const SharedArray&) = delete;
    Share& operator[](int i) { return mShares[i]; }

private:
    std::size_t mBytes;
    Share* mShares;
};

Share* gShare = nullptr; ///< of this child

void noteOutOfMemory()
{
    gShare->outOfMemory = true;
    throw std::bad_alloc();
}

void limitMemory(uint64_t bytes)
{
    if (kSanitized) return;
    const rlim_t limit = rlim_t(bytesOfAddresses() + bytes);
    const rlimit wanted{limit, limit};
    setrlimit(RLIMIT_AS, &wanted);
}

void note(const std::string& what)
{
    std::snprintf(gShare->what, sizeof(gShare->what), "%s", what.c_str());
}

void tryOne(const std::function<bool(int64_t)>& tryInput)
{
    try {
        (tryInput(gShare->next) ? gShare->read : gShare->refused)++;
    } catch (const std::exception& error) {
        note(std::string("threw: ") + error.what());
    } catch (...) {
        note("threw something that is no std::exception");
    }
    if (gShare->outOfMemory) note("asked for more memory than it may");
    gShare->outOfMemory = false;
}

/// Ends where an input has something to tell, or with its share.
[[noreturn]] void beChild(
    const std::function<std::function<bool(int64_t)>()>& prepare, const ForkLimits& limits)
{
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    limitMemory(limits.memory);
    if (!freopen("/dev/null", "w", stderr)) _exit(1); // OpenVDB warns of what it then refuses
    std::set_new_handler(noteOutOfMemory);
    {
        const auto tryInput = prepare();
        while (gShare->next < gShare->end && gShare->what[0] == '\0') {
            alarm(limits.seconds);
            tryOne(tryInput);
            if (gShare->what[0] == '\0') gShare->next += gShare->step;
        }
        alarm(0);
    }
    _exit(0); // without the end of the parent's statics, and of GoogleTest
}

std::string endOf(int status, const Share& share, const ForkLimits& limits)
{
    if (share.what[0]) return share.what;
    if (!WIFSIGNALED(status)) return "ended its process";
    if (WTERMSIG(status) == SIGALRM) return "no end after " + std::to_string(limits.seconds) + " s";
    return std::string("died: ") + strsignal(WTERMSIG(status));
}

} // namespace

ForkedRun runForked(int64_t count, const std::function<std::function<bool(int64_t)>()>& prepare,
    const ForkLimits& limits)
{
    SharedArray shares(limits.children);
    std::map<pid_t, Share*> running;
    const auto start = [&](Share& share) {
        std::cout.flush();
        const pid_t child = fork();
        if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
        if (child > 0) {
            running[child] = &share;
            return;
        }
        gShare = &share;
        beChild(prepare, limits);
    };
    for (int i = 0; i < limits.children; ++i) {
        shares[i].next = i;
        shares[i].end = count;
        shares[i].step = limits.children;
        start(shares[i]);
    }

    ForkedRun run;
    while (!running.empty()) {
        int status = 0;
        const pid_t child = wait(&status);
        if (child < 0 || !running.count(child)) continue;
        Share& share = *running[child];
        running.erase(child);
        if (share.next >= share.end) continue;
        run.findings.push_back({share.next, endOf(status, share, limits)});
        share.what[0] = '\0';
        share.outOfMemory = false;
        share.next += share.step;
        if (share.next < share.end) start(share);
    }
    for (int i = 0; i < limits.children; ++i) {
        run.read += shares[i].read;
        run.refused += shares[i].refused;
    }
    std::sort(run.findings.begin(), run.findings.end(),
        [](const Finding& a, const Finding& b) { return a.input < b.input; });
    return run;
}

std::string ForkedRun::summary() const
{
    return std::to_string(read) + " read, " + std::to_string(refused) + " refused, "
        + std::to_string(findings.size()) + " findings";
}

} // namespace spheretree_test
