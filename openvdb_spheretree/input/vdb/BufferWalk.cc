// SPDX-License-Identifier: Apache-2.0
#include "BufferWalk.h"

#include "PointWalk.h"

#include <openvdb/io/Compression.h>
#include <openvdb/util/NodeMasks.h>
#include <openvdb/version.h>

namespace openvdb_spheretree::detail {

using openvdb::Coord;
namespace io = openvdb::io;

namespace {

using LeafMask = openvdb::util::NodeMask<3>;

constexpr uint32_t kMaskBytes = LeafMask::SIZE / 8;

/// Leaves of single values, masks or indices, one after the other.
class ValueWalk : public BufferWalk {
public:
    ValueWalk(
        const BlockFormat& format, std::vector<Coord> leaves, std::optional<DelayedSizes> delayed)
        : mFormat(format), mLeaves(std::move(leaves)), mDelayed(std::move(delayed))
    {}

    bool takeSome(ByteWindow& window) override
    {
        if (mLeaf == mLeaves.size()) return false;
        if (mLeaf == 0) requireSizes(window);
        for (; mLeaf < mLeaves.size() && window.size() < kWindow; ++mLeaf) takeLeaf(window);
        return true;
    }

private:
    /// OpenVDB asserts only that there is an entry for each leaf.
    void requireSizes(ByteWindow& window) const
    {
        if (!mDelayed) return;
        const bool packed = mFormat.compression & (io::COMPRESS_BLOSC | io::COMPRESS_ZIP);
        if (mDelayed->selections.size() < mLeaves.size()
            || (packed && mDelayed->storedBytes.size() < mLeaves.size())) {
            window.fail("sizes of leaves are missing");
        }
    }

    void takeLeaf(ByteWindow& window) const
    {
        switch (mFormat.type.leaf) {
        case LeafKind::Mask:
            window.take(kMaskBytes);
            takeOrigin(window);
            break;
        case LeafKind::Bool:
            window.take(kMaskBytes);
            takeOrigin(window);
            window.take(kMaskBytes);
            break;
        case LeafKind::PointIndices: takePointIndices(window); break;
        default: takeLeafValues(window);
        }
    }

    /// OpenVDB moves the leaf to the place that stands here.
    void takeOrigin(ByteWindow& window) const
    {
        const auto x = window.value<int32_t>(), y = window.value<int32_t>();
        const auto z = window.value<int32_t>();
        if (Coord(x, y, z) != mLeaves[mLeaf]) window.fail("a leaf is where no leaf can be");
    }

    /// OpenVDB 10 does not read the last eight bytes that it writes for each leaf, a count of what follows
    /// (PointIndexLeafNode::readBuffers without a box), and so takes the next leaf for another.
    void takePointIndices(ByteWindow& window) const
    {
        if (mLeaves.size() > 1) {
            window.fail("OpenVDB cannot read grids of point indices that it wrote");
        }
        takeLeafValues(window);
        const auto count = window.value<uint64_t>();
        if (count >> 60 != 0) window.fail("a leaf has more than a file can hold");
        window.take(sizeof(uint32_t) * count);
        window.take(window.value<uint64_t>());
    }

    void takeLeafValues(ByteWindow& window) const
    {
        LeafMask active;
        std::memcpy(static_cast<void*>(&active), window.take(kMaskBytes), kMaskBytes);
        int buffers = 1;
        if (mFormat.fileVersion < openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION) {
            takeOrigin(window);
            buffers = window.value<int8_t>();
        }
        const ValueBlock block = takeValues(
            window, mFormat, LeafMask::SIZE, active.countOn(), kMaskBytes, ValueCare::Length);
        if (mDelayed) requireSame(window, block);
        for (int extra = 1; extra < buffers; ++extra) { // of early versions, and read by nobody
            const uint32_t zip = mFormat.compression & io::COMPRESS_ZIP;
            takePacked(window, zip, uint64_t(LeafMask::SIZE) * storedBytes(mFormat));
        }
    }

    void requireSame(ByteWindow& window, const ValueBlock& block) const
    {
        const bool activeOnly = mFormat.compression & io::COMPRESS_ACTIVE_MASK;
        const bool packed = mFormat.compression & (io::COMPRESS_BLOSC | io::COMPRESS_ZIP);
        if (activeOnly && mDelayed->selections[mLeaf] != block.selection) {
            window.fail("a leaf is not as its grid says");
        }
        if (packed && block.storedBytes != 0
            && mDelayed->storedBytes[mLeaf] != int64_t(block.storedBytes)) {
            window.fail("a leaf is longer or shorter than its grid says");
        }
    }

    BlockFormat mFormat;
    std::vector<Coord> mLeaves;
    std::optional<DelayedSizes> mDelayed;
    size_t mLeaf = 0;
};

} // namespace

std::unique_ptr<BufferWalk> walkBuffers(
    const BlockFormat& format, std::vector<Coord> leaves, std::optional<DelayedSizes> delayed)
{
    if (format.type.leaf == LeafKind::Points) return walkPoints(format, leaves.size());
    return std::make_unique<ValueWalk>(format, std::move(leaves), std::move(delayed));
}

} // namespace openvdb_spheretree::detail
