// SPDX-License-Identifier: Apache-2.0
#include "BlockStore.h"

#include <openvdb/Exceptions.h>

#include <blosc.h>

#include <cstring>

namespace openvdb_spheretree {
namespace slab {

void BlockStore::put(
    std::size_t block, const void* data, std::size_t bytes, int typeSize, Bytes& scratch)
{
    // Of labels, level 5 gained 5 %, and zstd a quarter for a quarter more time of the whole
    // stream. Byte shuffle took more of both.
    constexpr int kLevel = 1;
    scratch.resize(bytes + BLOSC_MAX_OVERHEAD);
    const int size = blosc_compress_ctx(kLevel, BLOSC_BITSHUFFLE, std::size_t(typeSize), bytes,
        data, scratch.data(), scratch.size(), BLOSC_LZ4_COMPNAME, 0, 1);
    if (size <= 0) {
        OPENVDB_THROW(openvdb::RuntimeError,
            "Blosc does not compress " << bytes << " bytes with lz4: error " << size);
    }
    Block& own = mBlocks[block];
    own.size = uint32_t(size);
    if (takesRoom(size)) {
        own.data = std::unique_ptr<unsigned char[]>(new unsigned char[own.size]);
        std::memcpy(own.data.get(), scratch.data(), own.size);
    } else {
        own.place = file(own.size).append(scratch.data(), own.size);
    }
    ++mCount;
}

void BlockStore::get(std::size_t block, void* data, std::size_t bytes, Bytes& scratch) const
{
    const Block& own = mBlocks[block];
    const unsigned char* from = own.data.get();
    if (!from) {
        scratch.resize(own.size);
        mFile->read(own.place, scratch.data(), own.size);
        from = scratch.data();
    }
    const int size = blosc_decompress_ctx(from, data, bytes, 1);
    if (size < 0 || std::size_t(size) != bytes) {
        OPENVDB_THROW(openvdb::IoError,
            "a block of the temporary file is damaged: " << size << " bytes in place of " << bytes);
    }
}

/// @return whether a block may stay in memory, which then counts it.
bool BlockStore::takesRoom(int64_t bytes)
{
    if (mInMemory.fetch_add(bytes) + bytes <= mMemory) return true;
    mInMemory -= bytes;
    return false;
}

/// @return the file, which a block of @a size bytes goes to. When the first one does, the blocks so
/// far tell how large it is about to become.
SpillFile& BlockStore::file(std::size_t size)
{
    const std::lock_guard<std::mutex> lock(mFileMutex);
    if (!mFile) makeFile();
    if (mHasRoom) return *mFile;
    const double average = double(mInMemory + int64_t(size)) / double(mCount + 1);
    constexpr double kDoubt = 0.5; // blocks to come may be smaller
    mFile->requireRoom(kDoubt * average * double(mBlocks.size() - mCount));
    mHasRoom = true;
    return *mFile;
}

} // namespace slab
} // namespace openvdb_spheretree
