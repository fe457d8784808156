// SPDX-License-Identifier: Apache-2.0
/// @file AtomicFile.h
/// @brief An output file that appears whole or not at all. It is written to a temporary file in the
/// folder of its target, and renamed when it is complete and on the disk.

#pragma once

#include "TemporaryFile.h"

#include <functional>
#include <iosfwd>
#include <string>

namespace command {

class AtomicFile {
public:
    /// @return @a path, or where it leads if it is a symbolic link: the file that is replaced, or
    ///         made if it is not there yet. Links to links are followed; if they go round in a
    ///         circle, it is @a path.
    static std::string targetOf(const std::string& path);

    /// @brief Check whether @a path can be written, without touching it: its folder exists and takes
    /// new files, and the path is no folder, device or write-protected file.
    /// @throw CommandError (output) naming the path and the reason why not
    static void checkTarget(const std::string& path);

    /// @throw CommandError (output) if the temporary file cannot be made
    explicit AtomicFile(const std::string& path);

    /// @brief Write the file, and wait until it is on the disk: only then may it replace another.
    /// Call once.
    /// @param content  writes to a binary stream, which is open for reading too, and throws
    /// @throw CommandError (output) if the disk is full, and what @a content throws
    void write(const std::function<void(std::iostream&)>& content);
    /// @brief Put the written file in the place of its target. Whoever has several files looks for
    /// an interrupt before the first: then none is left out.
    /// @throw CommandError (output) if that fails; then the target is as it was
    void commit();

    const std::string& path() const { return mPath; }

private:
    /// @throw CommandError (output) with the reason of the last system call that failed
    [[noreturn]] void fail() const;

    std::string mPath;
    TemporaryFile mTemporary;
};

} // namespace command
