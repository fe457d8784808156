// SPDX-License-Identifier: Apache-2.0
/// @file Errors.h
/// @brief How the command fails: its exit codes, the exception that carries one, and the one place
/// where the exceptions of the library, of OpenVDB and of the system become a line of text and a
/// code.

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

/// What ends the command with a given code. The message names the action, file or option.
class CommandError : public std::runtime_error {
public:
    CommandError(ExitCode code, const std::string& message)
        : std::runtime_error(message), mCode(code)
    {}
    ExitCode code() const { return mCode; }

private:
    ExitCode mCode;
};

[[noreturn]] void throwUsage(const std::string& message);
[[noreturn]] void throwInput(const std::string& message);
[[noreturn]] void throwOutput(const std::string& message);

/// @return @a text on one line, control characters replaced, cut where it is longer than @a limit:
/// names and messages may come from a damaged file (OpenVDB has thrown gigabytes of them).
std::string oneLine(const std::string& text, size_t limit = 400);

/// @return `path: reason` of the system's last error.
std::string systemError(const std::string& path);

/// @brief Rethrow the exception being handled as a CommandError, whatever it is; an interruption
/// stays one.
/// @param where     the action or file that the message is to name
/// @param fallback  the code of an exception that carries none
[[noreturn]] void rethrowNamed(const std::string& where, ExitCode fallback);

/// @brief Print the exception to stderr.
/// @return the exit code for it
int reportError(std::exception_ptr error);

} // namespace command
