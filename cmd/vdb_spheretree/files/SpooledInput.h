// SPDX-License-Identifier: Apache-2.0
/// @file SpooledInput.h
/// @brief Standard input as a file on the disk, for readers that must know its size, or go back in
/// it: those of meshes, volumes and spheres.

#pragma once

#include <iosfwd>
#include <string>

namespace command {

/// Copies standard input to its end into a file in `$TMPDIR`, or `/tmp`, that has no name
/// (UnnamedFile.h): whatever ends the program, nothing that it holds is left. It takes a buffer of memory, however
/// long the input is.
class SpooledInput {
public:
    /// @param name  for messages
    /// @throw Interrupted, CommandError (input) if the input is empty or cannot be read, (output) if
    ///        the file cannot be made or is full
    explicit SpooledInput(const std::string& name);
    SpooledInput(const SpooledInput&) = delete;
    SpooledInput& operator=(const SpooledInput&) = delete;
    ~SpooledInput();

    /// @return a path by which this process can open the file.
    std::string path() const { return "/dev/fd/" + std::to_string(mFd); }

private:
    void fillFrom(int fd, const std::string& name) const;

    const std::string mFolder;
    const int mFd;
};

/// @throw CommandError (input), with the name, for a standard input without a byte, or that cannot be read
void requireInput(std::streambuf& input, const std::string& name);

} // namespace command
