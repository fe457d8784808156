// SPDX-License-Identifier: Apache-2.0
/// @file InputFile.h
/// @brief A file or pipe that is open to be read through FdBuffer.

#pragma once

#include <string>

namespace command {

/// Closes what it opened; standard input stays open.
class InputFile {
public:
    /// @brief Does not wait for the writer of a pipe: FdBuffer does, and Ctrl-C ends that.
    /// @throw Interrupted, CommandError (input) naming the path and the reason
    explicit InputFile(const std::string& path);

    static InputFile standardInput();

    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    int fd() const { return mFd; }

    /// @return whether it still is what @a path names, unchanged.
    bool isStill(const std::string& path) const;

private:
    explicit InputFile(int fd) : mFd(fd) {}

    int mFd;
};

} // namespace command
