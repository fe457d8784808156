// SPDX-License-Identifier: Apache-2.0
#include "PointDescriptor.h"

#include "GridHead.h"

#include <openvdb/points/AttributeArray.h>
#include <openvdb/points/AttributeGroup.h>

namespace openvdb_spheretree::detail {

using openvdb::points::AttributeArray;
using openvdb::points::GroupAttributeArray;

namespace {

constexpr uint64_t kLeastEntry = 8; // bytes of the shortest name and what belongs to it

/// @return how many entries follow, which the file is long enough for.
uint64_t takeCount(ByteWindow& window)
{
    const auto count = window.value<uint64_t>();
    if (count >> 32 != 0) window.fail("points have more attributes than a file can hold");
    window.require(count * kLeastEntry);
    return count;
}

/// Each attribute has one name.
void takeNames(ByteWindow& window, size_t attributes)
{
    std::vector<bool> named(attributes);
    for (size_t i = 0; i < attributes; ++i) {
        window.string();
        const auto index = window.value<uint64_t>();
        if (index >= attributes || named[index]) window.fail("an attribute has two names or none");
        named[index] = true;
    }
}

/// Each group is one bit of an attribute made for groups.
void takeGroups(ByteWindow& window, size_t bits)
{
    for (uint64_t left = takeCount(window); left > 0; --left) {
        window.string();
        if (window.value<uint64_t>() >= bits) window.fail("a group of points is nowhere stored");
    }
}

} // namespace

std::vector<uint32_t> takePointDescriptor(ByteWindow& window)
{
    std::vector<uint32_t> bytes;
    size_t groupBits = 0;
    for (uint64_t left = takeCount(window); left > 0; --left) {
        const std::string value = window.string(), codec = window.string();
        const openvdb::NamePair type(value, codec);
        bytes.push_back(AttributeArray::create(type, 1, 1)->storageTypeSize());
        if (type == GroupAttributeArray::attributeType()) groupBits += 8;
    }
    takeNames(window, bytes.size());
    takeGroups(window, groupBits);
    takeMetadata(window);
    return bytes;
}

} // namespace openvdb_spheretree::detail
