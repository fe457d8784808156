// SPDX-License-Identifier: Apache-2.0
/// @file FaultShim.cc
/// @brief A library that tests load before all others (LD_PRELOAD), so that a chosen system call of
/// the program fails, or a signal comes just before it: a full disk, or a kill between two renames,
/// at the same moment in every run.
///
/// SPHERETREE_FAULTS holds the faults, separated by `;`, each as `CALL:N:EFFECT:NUMBER`:
///
/// - `CALL` is `tmpfile` (open with O_TMPFILE), `write` and `read` (of regular files but the standard
///   ones), `fsync`, `link`, `unlink`, `rename`, `thread` or `malloc`;
/// - `N` counts these calls from 1;
/// - `EFFECT` is `error` (it fails with this errno, and so do all later ones; of a write, half is
///   written first), `once` (only this one fails), `part` (of a write: half is written, and no later
///   one fails), `signal` (SIGSTOP lets the test act meanwhile), or `hang` (it takes so many seconds,
///   whatever signals come).
///
/// SPHERETREE_FAULT_MEMORY is how many MiB of memory the machine says it has.
///
/// SPHERETREE_FAULT_COUNTS names a file that gets a line `CALL NUMBER` for each at a normal end.

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

extern "C" void* __libc_malloc(size_t);

namespace {

enum Call { kTmpfile, kWrite, kRead, kFsync, kLink, kUnlink, kRename, kThread, kMalloc, kCalls };
constexpr const char* kNames[kCalls] = {
    "tmpfile", "write", "read", "fsync", "link", "unlink", "rename", "thread", "malloc"};

enum class Effect { Error, Once, Part, Signal, Hang };

struct Fault {
    Call call;
    Effect effect;
    long when;
    int number;
};

// All of it is there before any constructor has run: malloc comes first of all.
std::array<Fault, 4> sFaults;
std::atomic<int> sFaultCount{-1}; // -1: the environment has not been read yet
std::array<std::atomic<long>, kCalls> sCounts;

int readFaults()
{
    const char* text = std::getenv("SPHERETREE_FAULTS");
    int count = 0;
    while (text && *text && count < int(sFaults.size())) {
        char call[16], effect[16];
        long when = 0;
        int number = 0;
        if (std::sscanf(text, "%15[^:]:%ld:%15[^:]:%d", call, &when, effect, &number) != 4) abort();
        Fault& fault = sFaults[size_t(count++)];
        int index = 0;
        while (std::strcmp(kNames[index], call) != 0) {
            if (++index == kCalls) abort(); // a mistake in the test
        }
        fault.call = Call(index);
        fault.when = when;
        fault.number = number;
        fault.effect = *effect == 'e' ? Effect::Error
            : *effect == 'o'          ? Effect::Once
            : *effect == 'p'          ? Effect::Part
            : *effect == 'h'          ? Effect::Hang
                                      : Effect::Signal;
        text = std::strchr(text, ';');
        if (text) ++text;
    }
    return count;
}

void hangFor(int seconds)
{
    timespec left = {seconds, 0};
    while (nanosleep(&left, &left) != 0) {}
}

enum class Verdict { Go, Half, Fail };

/// Counts a call, and sends the signal that is due. Fail: errno is set.
Verdict countCall(Call call)
{
    Verdict verdict = Verdict::Go;
    int error = 0;
    const long count = ++sCounts[call];
    if (sFaultCount < 0) sFaultCount = readFaults();
    for (int i = 0; i < sFaultCount; ++i) {
        const Fault& fault = sFaults[size_t(i)];
        if (fault.call != call || count < fault.when) continue;
        const bool isNow = count == fault.when;
        if (fault.effect == Effect::Signal) {
            if (isNow) kill(getpid(), fault.number);
        } else if (fault.effect == Effect::Hang) {
            if (isNow) hangFor(fault.number);
        } else if (isNow || fault.effect == Effect::Error) {
            const bool isHalf = isNow && fault.effect != Effect::Once;
            verdict = isHalf ? Verdict::Half : Verdict::Fail;
            error = fault.number;
        }
    }
    if (verdict != Verdict::Go) errno = error;
    return verdict;
}

bool fails(Call call) { return countCall(call) != Verdict::Go; }

bool isFile(int fd)
{
    struct stat info;
    return fd > STDERR_FILENO && fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
}

/// The function of this name in the library after this one, looked up at its first call. A static with a
/// guard would not do: the shim is called before a sanitizer has started, whose guards they are.
template <auto function>
auto next(const char* name)
{
    static std::atomic<void*> found{nullptr};
    if (!found) found = dlsym(RTLD_NEXT, name);
    return reinterpret_cast<decltype(function)>(found.load());
}

struct WriteCounts {
    ~WriteCounts()
    {
        const char* const path = std::getenv("SPHERETREE_FAULT_COUNTS");
        if (!path) return;
        FILE* const out = std::fopen(path, "w");
        for (int i = 0; i < kCalls; ++i) {
            std::fprintf(out, "%s %ld\n", kNames[i], sCounts[size_t(i)].load());
        }
        std::fclose(out);
    }
} sWriteCounts;

} // namespace

extern "C" {

void* malloc(size_t size) { return fails(kMalloc) ? nullptr : __libc_malloc(size); }

int open(const char* path, int flags, ...)
{
    const auto real = next<&open>("open");
    mode_t mode = 0;
    const bool isNameless = (flags & O_TMPFILE) == O_TMPFILE;
    if (isNameless || (flags & O_CREAT)) {
        va_list arguments;
        va_start(arguments, flags);
        mode = va_arg(arguments, mode_t);
        va_end(arguments);
    }
    if (isNameless && fails(kTmpfile)) return -1;
    return real(path, flags, mode);
}

ssize_t write(int fd, const void* data, size_t size)
{
    const auto real = next<&write>("write");
    if (!isFile(fd)) return real(fd, data, size);
    const Verdict verdict = countCall(kWrite);
    if (verdict == Verdict::Go) return real(fd, data, size);
    const bool isHalf = verdict == Verdict::Half && size > 1;
    return isHalf ? real(fd, data, size / 2) : -1;
}

ssize_t writev(int fd, const iovec* blocks, int count)
{
    const auto real = next<&writev>("writev");
    if (isFile(fd) && fails(kWrite)) return -1;
    return real(fd, blocks, count);
}

ssize_t read(int fd, void* data, size_t size)
{
    const auto real = next<&read>("read");
    if (isFile(fd) && fails(kRead)) return -1;
    return real(fd, data, size);
}

int fsync(int fd)
{
    const auto real = next<&fsync>("fsync");
    return fails(kFsync) ? -1 : real(fd);
}

int linkat(int fromFolder, const char* from, int toFolder, const char* to, int flags)
{
    const auto real = next<&linkat>("linkat");
    return fails(kLink) ? -1 : real(fromFolder, from, toFolder, to, flags);
}

int unlink(const char* path)
{
    const auto real = next<&unlink>("unlink");
    return fails(kUnlink) ? -1 : real(path);
}

int rename(const char* from, const char* to)
{
    const auto real = next<&rename>("rename");
    return fails(kRename) ? -1 : real(from, to);
}

int pthread_create(
    pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*), void* argument)
{
    const auto real = next<&pthread_create>("pthread_create");
    return fails(kThread) ? errno : real(thread, attributes, body, argument);
}

long sysconf(int name)
{
    const auto real = next<&sysconf>("sysconf");
    const char* const mebibytes = std::getenv("SPHERETREE_FAULT_MEMORY");
    if (name != _SC_PHYS_PAGES || !mebibytes) return real(name);
    return std::atol(mebibytes) * (1L << 20) / real(_SC_PAGESIZE);
}

} // extern "C"
