// SPDX-License-Identifier: Apache-2.0
#include "DelayedSizes.h"

#include "ValueBlock.h"

#include <blosc.h>

#include <limits>

namespace openvdb_spheretree::detail {

namespace {

constexpr uint64_t kPadded = 128; // bytes that OpenVDB fills fewer up to before it packs them

/// @param packedBytes  0 where the values are not packed
template <typename T>
std::vector<T> takeArray(ByteWindow& window, uint32_t count, uint32_t packedBytes)
{
    const uint64_t bytes = uint64_t(count) * sizeof(T);
    if (packedBytes == 0) {
        const char* values = window.take(bytes);
        std::vector<T> array(count);
        if (bytes > 0) std::memcpy(array.data(), values, bytes); // an empty array has no address
        return array;
    }
    const char* packed = window.take(packedBytes);
    const uint64_t unpacked = unpackedBlosc(window, packed, packedBytes);
    if (unpacked != bytes && !(unpacked == kPadded && bytes < kPadded)) {
        window.fail("sizes of leaves are missing");
    }
    std::vector<T> array(unpacked / sizeof(T));
    const int done = blosc_decompress_ctx(packed, array.data(), unpacked, /*numinternalthreads=*/1);
    if (done != int(unpacked)) window.fail("sizes of leaves cannot be unpacked");
    array.resize(count);
    return array;
}

} // namespace

DelayedSizes takeDelayedSizes(ByteWindow& window, uint32_t bytes)
{
    DelayedSizes sizes;
    if (bytes == 0) return sizes;
    const uint64_t begin = window.position();
    const auto count = window.value<uint32_t>();
    sizes.selections = takeArray<int8_t>(window, count, window.value<uint32_t>());
    const auto packedBytes = window.value<uint32_t>();
    if (packedBytes != std::numeric_limits<uint32_t>::max()) {
        sizes.storedBytes = takeArray<int64_t>(window, count, packedBytes);
    }
    if (window.position() - begin != bytes) window.fail("sizes of leaves have a wrong length");
    return sizes;
}

} // namespace openvdb_spheretree::detail
