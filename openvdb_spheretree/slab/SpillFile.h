// SPDX-License-Identifier: Apache-2.0
/// @file SpillFile.h
/// @brief A temporary file for what does not fit into memory.
///
/// It has no name (UnnamedFile.h), so that nothing that it holds is left however the process ends.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace openvdb_spheretree::slab {

class SpillFile {
public:
    /// In the folder $TMPDIR, or /tmp.
    /// @throw openvdb::IoError if no file can be made there
    SpillFile();
    ~SpillFile();
    SpillFile(const SpillFile&) = delete;
    SpillFile& operator=(const SpillFile&) = delete;

    /// @return where the bytes are. Thread-safe.
    /// @throw openvdb::IoError if there is no room
    int64_t append(const void* data, std::size_t bytes);
    /// @param place  of some bytes that were appended. Thread-safe.
    /// @throw openvdb::IoError
    void read(int64_t place, void* data, std::size_t bytes) const;

    /// @return the bytes written so far.
    int64_t size() const { return mSize; }
    /// @throw openvdb::IoError if the folder has less room than @a bytes (where that can be told)
    void requireRoom(double bytes) const;

private:
    /// @param what  went wrong, the predicate of "the temporary file in FOLDER"
    [[noreturn]] void fail(const std::string& what) const;

    std::string mFolder;
    int mFile = -1;
    std::atomic<int64_t> mSize{0};
};

} // namespace openvdb_spheretree::slab
