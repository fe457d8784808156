// SPDX-License-Identifier: Apache-2.0
/// @file TemporaryFile.h
/// @brief The file that an output is written to before it takes its place: in the folder of its
/// target, because only there a rename is one step.
///
/// Where the file system allows it (Linux; not network file systems), the file has no name until it
/// is complete. Then it gets the name `.NAME.vdb_spheretree-tmp.PID-N` for the moment between two
/// system calls: a rename replaces a file, a link does not. So whatever kills the program leaves one
/// file at most, and usually none. Elsewhere the file has that name from the start.
///
/// The program holds a lock (flock) on the file as long as it has it, and the system drops the lock
/// with the process. A file of that name without a lock is one that a killed run has left; the next
/// run that writes the same target removes it. On a network file system whose locks are the
/// machine's own (a mount option), a run on another machine may take a file for abandoned; then the
/// writer's rename fails, and the old target stays.

#pragma once

#include <string>

namespace command {

class TemporaryFile {
public:
    /// @brief Make an empty file that only its owner can read, and remove abandoned ones.
    /// @param target  the path it is for, no link. Removal costs one look through its folder
    /// @throw CommandError (output) with the folder and the reason if none can be made
    explicit TemporaryFile(const std::string& target);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile(); ///< removes the file, unless it has been published

    /// @return a path by which this process can open the file once more.
    std::string path() const;
    /// @brief Have the system put the file's content on the disk.
    /// @return false (and errno) if it does not get there
    bool sync() const;
    /// @brief Put the file in the place of the target, with the target's permissions or those of any
    /// new file. Call once.
    /// @return false (and errno) if that fails
    bool publish();

private:
    bool openNameless();
    bool openNamed();
    /// @return whether the file has a name now.
    bool nameIt();

    const std::string mTarget, mFolder;
    const std::string mStart; ///< of the temporary names for the target, with the folder
    std::string mName;        ///< empty as long as it has none
    int mFd = -1;
};

} // namespace command
