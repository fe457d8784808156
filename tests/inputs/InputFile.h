// SPDX-License-Identifier: Apache-2.0
/// @file InputFile.h
/// @brief Bytes that a reader sees as a regular file of a given extension, without touching a disk:
/// thousands of inputs a second are tried this way.

#pragma once

#include <string>

namespace spheretree_test {

/// A file in memory. A child process must make its own: one that it inherits has the same bytes as its
/// parent's.
class InputFile {
public:
    /// @param extension  with its dot
    explicit InputFile(const std::string& extension);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Replaces what is in the file.
    void set(const std::string& bytes);
    const std::string& path() const { return mPath; }

private:
    int mFd;
    std::string mFolder, mPath;
};

} // namespace spheretree_test
