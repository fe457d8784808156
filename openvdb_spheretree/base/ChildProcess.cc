// SPDX-License-Identifier: Apache-2.0
/// @file ChildProcess.cc
/// @brief The child writes a letter for how its work ended, and then bytes: the result, or a message. Without the
/// letter it has died.
#include "ChildProcess.h"

#include "Parallel.h"
#include "Text.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <mutex>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace openvdb_spheretree::detail {
namespace {

constexpr char kResult = 'r', kMessage = 'm', kNoMemory = 'n';

[[noreturn]] void failed(const char* what, int error)
{
    throw openvdb::IoError(std::string(what) + ": " + std::strerror(error));
}

/// @return what this process has of address space now, in bytes; 0 where the system does not say.
uint64_t addressSpace()
{
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * uint64_t(sysconf(_SC_PAGESIZE));
}

void setLimit(int resource, uint64_t most)
{
    rlimit limit;
    if (getrlimit(resource, &limit) != 0) return;
    limit.rlim_cur = std::min<rlim_t>(most, limit.rlim_max);
    // At the hard limit of time comes SIGKILL, which does not say what for.
    const bool isHard = resource == RLIMIT_CPU && limit.rlim_cur == limit.rlim_max;
    if (isHard && limit.rlim_cur > 0) --limit.rlim_cur;
    setrlimit(resource, &limit);
}

void raiseLimit(int resource, uint64_t by)
{
    rlimit limit;
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    setLimit(resource, uint64_t(limit.rlim_cur) + by);
}

/// Of a new process: the handlers of this one belong to threads that the child does not have.
void takeDefaults(const ChildLimits& limits, pid_t parent)
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) {
        std::signal(signal, SIG_DFL);
    }
    std::set_new_handler(nullptr);
    std::set_terminate(std::abort);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1); // it has ended before
#else
    (void)parent;
#endif
    if (const int null = open("/dev/null", O_RDWR); null >= 0) {
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
    }
    setLimit(RLIMIT_CORE, 0);
    const uint64_t now = limits.bytes > 0 ? addressSpace() : 0;
    if (now > 0) setLimit(RLIMIT_AS, now + limits.bytes);
    if (limits.seconds > 0) setLimit(RLIMIT_CPU, limits.seconds); // its clock begins with it
}

bool writeAll(int pipe, const char* bytes, std::size_t count)
{
    while (count > 0) {
        const ssize_t written = write(pipe, bytes, count);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes += written;
        count -= std::size_t(written);
    }
    return true;
}

[[noreturn]] void runChild(const std::function<std::string()>& work, int pipe)
{
    char kind = kResult;
    std::string bytes;
    try {
        bytes = work();
    } catch (const std::bad_alloc&) {
        kind = kNoMemory;
    } catch (const openvdb::Exception& error) {
        kind = kMessage;
        bytes = messageOf(error);
    } catch (const std::exception& error) {
        kind = kMessage;
        bytes = error.what();
    }
    const bool isWhole = writeAll(pipe, &kind, 1) && writeAll(pipe, bytes.data(), bytes.size());
    _exit(isWhole ? 0 : 1);
}

/// Closes a pipe's end, and waits for the process, also after an exception.
struct Child {
    pid_t process;
    int pipe;
    bool isGone = false;

    ~Child()
    {
        if (!isGone) {
            kill(process, SIGKILL);
            wait();
        }
        close(pipe);
    }
    /// @return as waitpid() says; 0 where whoever runs this process takes no note of its children.
    int wait()
    {
        isGone = true;
        int status = 0;
        while (waitpid(process, &status, 0) < 0) {
            if (errno != EINTR) return 0;
        }
        return status;
    }
};

Child startChild(const std::function<std::string()>& work, const ChildLimits& limits)
{
    // One at a time: a child that began meanwhile would hold this pipe open.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    std::array<int, 2> pipe;
    if (::pipe(pipe.data()) != 0) failed("no pipe to a process for its reader", errno);
    const pid_t parent = getpid(), process = fork();
    if (process == 0) {
        close(pipe[0]);
        takeDefaults(limits, parent);
        runChild(work, pipe[1]);
    }
    const int error = errno;
    close(pipe[1]);
    if (process > 0) return {process, pipe[0]};
    close(pipe[0]);
    failed("no process for its reader", error);
}

/// @return all that the child writes.
std::string bytesOf(const Child& child, openvdb::util::NullInterrupter* interrupter)
{
    constexpr int kAskEvery = 50; // ms
    std::string bytes;
    std::array<char, 1 << 16> buffer;
    for (;;) {
        checkInterrupt(interrupter);
        pollfd end{child.pipe, POLLIN, 0};
        const int ready = poll(&end, 1, interrupter ? kAskEvery : -1);
        if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
        const ssize_t count = ready < 0 ? -1 : read(child.pipe, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) failed("what its reader says cannot be read", errno);
        if (count == 0) return bytes;
        bytes.append(buffer.data(), std::size_t(count));
    }
}

} // namespace

std::string resultOfChild(const std::function<std::string()>& work, const ChildLimits& limits,
    openvdb::util::NullInterrupter* interrupter)
{
    Child child = startChild(work, limits);
    std::string bytes = bytesOf(child, interrupter);
    const int status = child.wait();
    const bool isDead = status != 0 || bytes.empty();
    if (isDead) checkInterrupt(interrupter); // who stops this process may have ended the child
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
        throw openvdb::IoError("damaged: its reader does not end, in more processor time than a "
                               "file of its size takes");
    }
    if (WIFSIGNALED(status)) {
        throw openvdb::IoError(
            std::string("damaged: its reader crashed on it (") + strsignal(WTERMSIG(status)) + ")");
    }
    if (isDead) throw openvdb::IoError("damaged: its reader crashed on it");
    const char kind = bytes.front();
    bytes.erase(0, 1);
    if (kind == kNoMemory) throw std::bad_alloc();
    if (kind == kMessage) throw openvdb::IoError(bytes);
    return bytes;
}

void allowMore(const ChildLimits& limits)
{
    raiseLimit(RLIMIT_AS, limits.bytes);
    raiseLimit(RLIMIT_CPU, limits.seconds);
}

} // namespace openvdb_spheretree::detail
