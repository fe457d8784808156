// SPDX-License-Identifier: Apache-2.0
/// @file BlockStore.h
/// @brief Blocks of numbers, compressed: in memory up to a bound, the rest in a temporary file.
///
/// Blosc splits numbers into their bits, and LZ4 takes those of equal place together.

#pragma once

#include "SpillFile.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

class BlockStore {
public:
    using Bytes = std::vector<unsigned char>; ///< memory of a thread, for one block after the other

    /// @param memory  bytes that compressed blocks may take in memory
    BlockStore(std::size_t blocks, int64_t memory) : mBlocks(blocks), mMemory(memory) {}

    /// Makes the temporary file before it is needed, so that an error comes early.
    /// @throw openvdb::IoError if it cannot be made
    void makeFile() { mFile = std::make_unique<SpillFile>(); }

    /// @param bytes  less than 2^31 - 16
    /// @param typeSize  bytes of each number
    /// @throw openvdb::IoError if the temporary file cannot be made, or has no room
    /// @note Thread-safe for different blocks; so is get(), once they have been put.
    void put(std::size_t block, const void* data, std::size_t bytes, int typeSize, Bytes& scratch);
    /// @param bytes  as they were put
    /// @throw openvdb::IoError if the temporary file cannot be read
    void get(std::size_t block, void* data, std::size_t bytes, Bytes& scratch) const;

    int64_t bytesInMemory() const { return mInMemory; }
    int64_t bytesInFile() const { return mFile ? mFile->size() : 0; }

private:
    struct Block {
        std::unique_ptr<unsigned char[]> data; ///< null: in the file
        uint32_t size = 0;
        int64_t place = 0; ///< in the file
    };

    bool takesRoom(int64_t bytes);
    SpillFile& file(std::size_t size);

    std::vector<Block> mBlocks;
    const int64_t mMemory;
    std::atomic<int64_t> mInMemory{0};
    std::atomic<std::size_t> mCount{0}; ///< of blocks put
    std::mutex mFileMutex;
    std::unique_ptr<SpillFile> mFile; ///< once it is needed
    bool mHasRoom = false;            ///< as far as that is known
};

} // namespace slab
} // namespace openvdb_spheretree
