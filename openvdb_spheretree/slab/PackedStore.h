// SPDX-License-Identifier: Apache-2.0
/// @file PackedStore.h
/// @brief Arrays of numbers, compressed: in memory up to a bound, the rest in a temporary file.
///
/// Blosc puts the bits of equal place side by side, and LZ4 compresses the runs that this makes.

#pragma once

#include "SpillFile.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace openvdb_spheretree::slab {

class PackedStore {
public:
    using Bytes = std::vector<unsigned char>; ///< memory of a thread, for one array after the other

    /// @param arrays  how many there are
    /// @param memory  bytes that compressed arrays may take in memory
    PackedStore(std::size_t arrays, int64_t memory) : mArrays(arrays), mMemory(memory) {}

    /// Makes the temporary file before it is needed, so that an error comes early.
    /// @throw openvdb::IoError if it cannot be made
    void makeFile() { mFile = std::make_unique<SpillFile>(); }

    /// @param bytes  less than 2^31 - 16
    /// @param typeSize  bytes of each number
    /// @throw openvdb::IoError if the temporary file cannot be made, or has no room
    /// @note Thread-safe for different arrays; so is get(), once they have been put.
    void put(std::size_t array, const void* data, std::size_t bytes, int typeSize, Bytes& scratch);
    /// @param bytes  as they were put
    /// @throw openvdb::IoError if the temporary file cannot be read, or has other bytes there
    void get(std::size_t array, void* data, std::size_t bytes, Bytes& scratch) const;

    int64_t bytesInMemory() const { return mInMemory; }
    int64_t bytesInFile() const { return mFile ? mFile->size() : 0; }

private:
    struct Array {
        std::unique_ptr<unsigned char[]> data; ///< null: in the file
        uint32_t size = 0;
        int64_t place = 0; ///< in the file
    };

    SpillFile& file(std::size_t size);

    std::vector<Array> mArrays;
    const int64_t mMemory;
    std::atomic<int64_t> mInMemory{0};
    std::atomic<std::size_t> mCount{0}; ///< of arrays put
    std::mutex mFileMutex;
    std::unique_ptr<SpillFile> mFile; ///< once it is needed
    bool mHasRoom = false;            ///< the file has, as far as that is known
};

} // namespace openvdb_spheretree::slab
