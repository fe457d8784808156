// SPDX-License-Identifier: Apache-2.0
#include "LastWords.h"

#include "Errors.h"
#include "RememberedFiles.h"

#include <atomic>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>

#include <unistd.h>

namespace command {

namespace {

constexpr unsigned kPatience = 1; // seconds

std::atomic<int> sUninterrupted{0};
std::atomic<bool> sAllIsDone{false};
std::atomic<bool> sMemoryWasRefused{false}; // once, to any thread
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers read it");

/// Plain system calls: streams may not be there yet, and a signal handler may call nothing else.
[[noreturn]] void endWith(ExitCode code, const char* words)
{
    const auto say = [](const char* text) {
        if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return; // nobody is left to tell
    };
    if (isatty(STDERR_FILENO)) say("\r\033[K"); // there may be a progress bar
    say("vdb_spheretree: ");
    if (code != kInterrupted) say("error: ");
    say(words);
    say("\n");
    removeRememberedFiles();
    _exit(code);
}

/// What operator new calls in place of throwing.
[[noreturn]] void noteRefusedMemory()
{
    sMemoryWasRefused = true;
    throw std::bad_alloc();
}

/// The exception that ends the program may not be there to be asked. Where GCC has compiled a
/// function with something to clean up into one that lets no exception pass, it cleans up, and then
/// calls std::terminate while the exception is still under way: nobody has caught it. OpenVDB's
/// Tree::clear() is the former, as it lists nodes before it deletes them, and ~Tree() the latter.
[[noreturn]] void endByException()
{
    const std::exception_ptr error = std::current_exception();
    const bool isHidden = !error || std::uncaught_exceptions() > 0;
    if (isHidden && sMemoryWasRefused) endWith(kInput, kNoMemory);
    if (!error) endWith(kInternal, "unexpected: std::terminate without an exception");
    try {
        std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        endWith(kInput, kNoMemory);
    } catch (const std::exception& e) {
        if (isLackOfThreads(e)) endWith(kInput, kNoThread);
        endWith(kInternal, "unexpected exception outside of all actions");
    } catch (...) {
        endWith(kInternal, "unexpected exception outside of all actions");
    }
}

void endByLostPage(int signal, siginfo_t* info, void*)
{
    if (info->si_code == BUS_ADRERR) {
        endWith(kInput,
            "an input file became shorter, or could not be read any more, while it was in use");
    }
    std::signal(signal, SIG_DFL); // and the instruction that failed is tried again
}

void endOverdue(int)
{
    if (sUninterrupted > 0) {
        startCountdown();
        return;
    }
    if (sAllIsDone) _exit(kOk);
    endWith(kInterrupted, "interrupted");
}

void catchExceptions(int, char**, char**)
{
    std::set_terminate(endByException);
    std::set_new_handler(noteRefusedMemory);
}

} // namespace

void catchLostPages()
{
    struct sigaction action = {};
    action.sa_sigaction = endByLostPage;
    action.sa_flags = SA_SIGINFO;
    sigemptyset(&action.sa_mask);
    sigaction(SIGBUS, &action, nullptr);
}

void endOverdueStops()
{
    struct sigaction action = {};
    action.sa_handler = endOverdue;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGALRM, &action, nullptr);
}

void noteAllIsDone() noexcept { sAllIsDone = true; }

void startCountdown() noexcept { alarm(kPatience); }

Uninterrupted::Uninterrupted() { ++sUninterrupted; }
Uninterrupted::~Uninterrupted() { --sUninterrupted; }

#ifdef __linux__
// Run by the dynamic linker before the constructors of any library, which a function of this program
// could not be otherwise. Both calls are a store to a variable, and need nothing constructed.
[[gnu::section(".preinit_array"), gnu::used]] void (*const kFirstOfAll)(
    int, char**, char**) = catchExceptions;
#endif

} // namespace command
