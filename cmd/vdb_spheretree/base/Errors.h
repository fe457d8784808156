// SPDX-License-Identifier: Apache-2.0
/// @file Errors.h
/// @brief How the command fails: its exit codes, and the exception that carries one. All exceptions
/// of the library, of OpenVDB and of the system become a line of text and an exit code here.

#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace command {

enum ExitCode {
    kOk = 0,
    kInternal = 1, ///< a defect of the program itself
    kUsage = 2,
    kInput = 3,
    kOutput = 4,
    kInterrupted = 5,
    kCheckFailed = 6
};

/// Ends the command with a given code. The message names the action, file or option.
class CommandError : public std::runtime_error {
public:
    CommandError(ExitCode code, const std::string& message)
        : std::runtime_error(message), mCode(code)
    {}
    ExitCode code() const { return mCode; }

private:
    ExitCode mCode;
};

/// There is no voxel to make anything of, which a frame of a sequence may well be: code kInput.
class EmptyError : public CommandError {
public:
    explicit EmptyError(const std::string& message) : CommandError(kInput, message) {}
};

[[noreturn]] void throwUsage(const std::string& message);
[[noreturn]] void throwInput(const std::string& message);
[[noreturn]] void throwOutput(const std::string& message);

/// @return @a text on one line and without control characters, cut to @a limit characters. Names and
/// messages may come from a damaged file: OpenVDB has thrown messages of gigabytes.
std::string oneLine(const std::string& text, size_t limit = 400);

/// @return `path: reason`, with the reason of the last system call that failed.
std::string systemError(const std::string& path);

/// @return whether @a error says that the system has started no thread. The standard library says so
/// by a code; oneTBB only by its text.
bool isLackOfThreads(const std::exception& error);

/// What there is to say for want of memory, and of threads.
inline constexpr char kNoMemory[] = "not enough memory";
inline constexpr char kNoThread[] = "no thread can be started: a limit on processes or on memory "
                                    "is reached (ulimit -u, ulimit -v); "
                                    "raise it, or ask for fewer threads with -threads";

/// @brief Rethrow the exception that is being handled as a CommandError. Interrupted is rethrown as
/// it is.
/// @param where     the action or file that the message names; may be empty
/// @param fallback  exit code for an exception that has none. A lack of threads is always kInput
[[noreturn]] void rethrowNamed(const std::string& where, ExitCode fallback);

/// @brief Print the exception to stderr.
/// @return its exit code
int reportError(std::exception_ptr error);

} // namespace command
