// SPDX-License-Identifier: Apache-2.0
/// @file InputFile.h
/// @brief Bytes that a reader sees as a regular file of a given extension, without touching a disk
/// where it can be helped: thousands of inputs a second are tried this way.

#pragma once

#include <map>
#include <string>

namespace spheretree_test {

/// A file in memory, but for kinds that name others beside them. A child process must make its own: one
/// that it inherits has the same bytes as its parent's.
class InputFile {
public:
    /// The file's name is `input`. @param extension  with its dot
    explicit InputFile(const std::string& extension);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Replaces what is in the file.
    void set(const std::string& bytes);
    const std::string& path() const { return mPath; }

private:
    std::string mFolder, mPath;
    int mFd;
};

/// Several files side by side, in a folder of their own. What holds of one in a child process holds of
/// each.
class InputFolder {
public:
    InputFolder();
    ~InputFolder();
    InputFolder(const InputFolder&) = delete;
    InputFolder& operator=(const InputFolder&) = delete;

    const std::string& path() const { return mPath; }

    /// Makes the file, or replaces what is in it.
    /// @return its path
    std::string set(const std::string& name, const std::string& bytes);
    /// Removes all files.
    void clear();

private:
    std::string mPath;
    std::map<std::string, int> mFds; ///< by name
};

} // namespace spheretree_test
