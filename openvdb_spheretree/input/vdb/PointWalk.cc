// SPDX-License-Identifier: Apache-2.0
#include "PointWalk.h"

#include "PointDescriptor.h"

#include <openvdb/util/NodeMasks.h>
#include <openvdb/version.h>

#include <algorithm>
#include <limits>

namespace openvdb_spheretree::detail {

namespace {

using LeafMask = openvdb::util::NodeMask<3>;

constexpr uint64_t kOffsetBytes = LeafMask::SIZE * sizeof(uint32_t); // of a leaf's voxel values
constexpr uint16_t kNotPacked = std::numeric_limits<uint16_t>::max();
constexpr uint64_t kPadded = 128; // bytes that OpenVDB fills fewer up to before it packs them
constexpr uint64_t kLargestArray = std::numeric_limits<int32_t>::max(); // bytes

// How an attribute is stored (AttributeArray::SerializationFlag), and what may vary (Flag).
constexpr uint8_t kStrided = 1, kUniform = 2, kPaged = 8, kUnknown = 0x10;
constexpr uint8_t kConstantStride = 8;

/// @return whether a Blosc buffer that holds @a unpacked bytes is one of @a bytes values.
bool holds(uint64_t unpacked, uint64_t bytes)
{
    return unpacked == bytes || (unpacked == kPadded && bytes < kPadded);
}

/// An attribute of a leaf.
struct Array {
    uint32_t bytes = 0;       ///< when it is unpacked
    uint32_t storedBytes = 0; ///< of one that is not in a page
    bool paged = false;
    bool uniform = false;
};

/// An attribute of some leaves, one after the other.
struct Page {
    int32_t packedBytes = 0; ///< negative: it is not packed
    uint32_t bytes = 0;      ///< when it is unpacked
};

/// Where we are in the pages of an attribute. OpenVDB (PagedInputStream) takes the next page where
/// one array ends with its page, and never looks whether one reaches beyond.
class PageCursor {
public:
    bool atEnd() const { return mByte == mBytes; }
    void start(const Page& page)
    {
        mByte = 0;
        mBytes = page.bytes;
    }
    void skip(ByteWindow& window, uint32_t bytes)
    {
        if (bytes > mBytes - mByte) window.fail("an attribute is longer than its page");
        mByte += bytes;
    }

private:
    uint32_t mByte = 0, mBytes = 0;
};

class PointWalk : public BufferWalk {
public:
    PointWalk(const BlockFormat& format, size_t leafCount)
        : mFormat(format), mLeafCount(leafCount), mOffsetBytes(leafCount)
    {}

    bool takeSome(ByteWindow& window) override
    {
        if (mPass == 0 && mLeaf == 0) {
            if (mFormat.fileVersion < openvdb::OPENVDB_FILE_VERSION_MULTIPASS_IO) {
                window.fail("points are of a version that is no longer read");
            }
            mPasses = window.value<uint16_t>();
        }
        if (mPass == mPasses) return false;
        for (; mLeaf < mLeafCount && window.size() < kWindow; ++mLeaf) takeLeaf(window);
        if (mLeaf == mLeafCount) endPass(window);
        return true;
    }

private:
    void takeLeaf(ByteWindow& window)
    {
        const size_t n = mPages.size();
        if (mPass == 0) {
            mOffsetBytes[mLeaf] = window.value<uint16_t>();
        } else if (mPass == 1) {
            takeAttributes(window);
        } else if (mPass < n + 2) {
            takeHeader(window, mPass - 2);
        } else if (mPass == n + 2) {
            takeOffsets(window);
        } else if (mPass < 2 * n + 3) {
            takeArray(window, mPass - n - 3);
        }
    }

    void endPass(ByteWindow& window)
    {
        if (!mCursor.atEnd()) window.fail("a page is longer than its attributes");
        if (mPass == 1) {
            size_t most = 0;
            for (const auto& arrays : mArrays) most = std::max(most, arrays.size());
            if (mLeafCount > 0 && mPasses != 2 * most + 4) window.fail("attributes are missing");
            mPages.resize(most);
        }
        mCursor = PageCursor();
        mNextPage = 0;
        mLeaf = 0;
        ++mPass;
    }

    /// The first leaf whose descriptor says so has it for all that follow.
    void takeAttributes(ByteWindow& window)
    {
        if (!mShared) {
            const auto header = window.value<uint8_t>();
            if (header > 3) window.fail("points are of a version that is not known");
            mTypeBytes = takePointDescriptor(window);
            mShared = header & 1;
            if (header & 2) window.take(window.value<uint64_t>());
        }
        std::vector<Array> arrays;
        for (const uint32_t typeBytes : mTypeBytes) arrays.push_back(takeSizes(window, typeBytes));
        mArrays.push_back(std::move(arrays));
    }

    static Array takeSizes(ByteWindow& window, uint32_t typeBytes)
    {
        const uint64_t stored = window.value<uint64_t>() - sizeof(uint16_t) - sizeof(uint32_t);
        const auto flags = window.value<uint8_t>(), form = window.value<uint8_t>();
        const uint64_t size = window.value<uint32_t>();
        const uint64_t stride = form & kStrided ? window.value<uint32_t>() : 1;
        const uint64_t values = flags & kConstantStride ? size * stride : stride;
        Array array;
        array.uniform = form & kUniform;
        array.paged = form & kPaged;
        const uint64_t bytes = typeBytes * (array.uniform ? 1 : std::min(values, kLargestArray));
        if (form >= kUnknown) window.fail("an attribute is stored in a way that is not known");
        if (bytes == 0 || bytes > kLargestArray) window.fail("an attribute has a wrong size");
        const bool packed = !array.paged && !array.uniform;
        if (packed ? stored > bytes : stored != bytes) {
            window.fail("an attribute has more or fewer values than it stores");
        }
        array.bytes = uint32_t(bytes);
        array.storedBytes = uint32_t(stored);
        return array;
    }

    /// @return nothing if this leaf has no such attribute.
    const Array* array(size_t attribute) const
    {
        const auto& arrays = mArrays[mLeaf];
        return attribute < arrays.size() ? &arrays[attribute] : nullptr;
    }

    void takeHeader(ByteWindow& window, size_t attribute)
    {
        const Array* array = this->array(attribute);
        if (!array || !array->paged) return;
        if (mCursor.atEnd()) {
            Page page;
            page.packedBytes = window.value<int32_t>();
            const int64_t bytes =
                page.packedBytes > 0 ? window.value<int32_t>() : -int64_t(page.packedBytes);
            if (bytes <= 0 || bytes > int64_t(kLargestArray)) window.fail("a page is empty");
            page.bytes = uint32_t(bytes);
            mPages[attribute].push_back(page);
            mCursor.start(page);
        }
        mCursor.skip(window, array->bytes);
    }

    void takeOffsets(ByteWindow& window) const
    {
        window.take(LeafMask::SIZE / 8); // active voxels
        const auto packedBytes = window.value<uint16_t>();
        if (packedBytes != mOffsetBytes[mLeaf]) window.fail("voxels of points have two lengths");
        if (packedBytes == kNotPacked) {
            window.take(kOffsetBytes);
            return;
        }
        const char* packed = window.take(packedBytes);
        if (unpackedBlosc(window, packed, packedBytes) != kOffsetBytes) {
            window.fail("voxels of points are missing");
        }
    }

    void takeArray(ByteWindow& window, size_t attribute)
    {
        const Array* array = this->array(attribute);
        if (!array) return;
        if (!array->paged) {
            takeSingle(window, *array);
            return;
        }
        if (mCursor.atEnd()) {
            const Page& page = mPages[attribute][mNextPage++];
            const auto stored = uint64_t(std::abs(int64_t(page.packedBytes)));
            const char* bytes = window.take(stored);
            if (page.packedBytes > 0 && !holds(unpackedBlosc(window, bytes, stored), page.bytes)) {
                window.fail("a page has more or fewer values than it stores");
            }
            mCursor.start(page);
        }
        mCursor.skip(window, array->bytes);
    }

    /// An attribute of a leaf that is in no page.
    static void takeSingle(ByteWindow& window, const Array& array)
    {
        const uint8_t packed = array.uniform ? 0 : window.value<uint8_t>();
        if (packed > 1) window.fail("an attribute is stored in a way that is not known");
        const char* bytes = window.take(array.storedBytes);
        const uint64_t unpacked =
            packed ? unpackedBlosc(window, bytes, array.storedBytes) : array.storedBytes;
        if (packed ? !holds(unpacked, array.bytes) : unpacked != array.bytes) {
            window.fail("an attribute has more or fewer values than it stores");
        }
    }

    BlockFormat mFormat;
    size_t mLeafCount;
    std::vector<uint16_t> mOffsetBytes; ///< of each leaf's packed voxel values

    // The descriptor that is read last, and whether it is that of all further leaves.
    std::vector<uint32_t> mTypeBytes;
    bool mShared = false;

    std::vector<std::vector<Array>> mArrays; ///< of each leaf
    std::vector<std::vector<Page>> mPages;   ///< of each attribute

    size_t mPasses = 0;
    size_t mPass = 0, mLeaf = 0; // the next
    PageCursor mCursor;
    size_t mNextPage = 0;
};

} // namespace

std::unique_ptr<BufferWalk> walkPoints(const BlockFormat& format, size_t leafCount)
{
    return std::make_unique<PointWalk>(format, leafCount);
}

} // namespace openvdb_spheretree::detail
