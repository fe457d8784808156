// SPDX-License-Identifier: Apache-2.0
/// @file TestDelayedSizes.cc
/// @brief What a `.vdb` says in advance of its leaves, for delayed loading: the guard holds it against the
/// leaves.

#include "support/GuardedVdb.h"
#include "support/VdbSamples.h"

#include <openvdb_spheretree/input/vdb/DelayedSizes.h>

#include <openvdb/io/Compression.h>
#include <openvdb/io/DelayedLoadMetadata.h>

#include <cstdint>
#include <cstring>
#include <sstream>

namespace {

using namespace openvdb_spheretree::detail;
using namespace spheretree_test;
namespace io = openvdb::io;

TEST_F(GuardedVdb, FindsSizesForDelayedLoadingThatAreNotTheLeaves)
{
    const std::string bytes = fileOf("float", io::COMPRESS_ACTIVE_MASK);
    EXPECT_EQ(saidOf(bytes, DelayedMetadata::Keep), "");
    const size_t count = behind(bytes, io::DelayedLoadMetadata::staticTypeName()) + 4;
    uint32_t leaves;
    std::memcpy(&leaves, &bytes[count], 4);
    ASSERT_GT(leaves, 4u);
    std::string fewer = bytes, other = bytes;
    overwrite(fewer, count, leaves - 1);
    EXPECT_NE(saidOf(fewer, DelayedMetadata::Keep), "");
    other[count + 8] = char(other[count + 8] ^ 1);
    EXPECT_NE(saidOf(other, DelayedMetadata::Keep), "");
    EXPECT_EQ(saidOf(other), "") << "OpenVDB never sees them";
}

/// What a file says of its leaves in advance, to be changed.
class TestedSizes {
public:
    explicit TestedSizes(const std::string& bytes)
        : mBytes(bytes), mBegin(behind(bytes, io::DelayedLoadMetadata::staticTypeName()))
    {
        std::stringbuf source(bytes.substr(mBegin));
        ByteWindow window(source);
        mEnd = window.value<uint32_t>();
        sizes = takeDelayedSizes(window, uint32_t(mEnd));
        mEnd += mBegin + 4;
    }

    /// @param more  bytes that the entry claims to have, and has, behind its end
    std::string bytes(uint32_t more = 0) const
    {
        std::string all = mBytes;
        return all.replace(mBegin, mEnd - mBegin, value(more));
    }

    /// @return all of the entry behind its type.
    std::string value(uint32_t more = 0) const
    {
        std::string value;
        const auto put = [&](uint32_t number) {
            value.append(reinterpret_cast<const char*>(&number), sizeof(number));
        };
        put(uint32_t(sizes.selections.size()));
        put(0); // not packed
        value.append(sizes.selections.begin(), sizes.selections.end());
        put(sizes.storedBytes.empty() ? 0xffffffffu : 0);
        value.append(reinterpret_cast<const char*>(sizes.storedBytes.data()),
            sizeof(int64_t) * sizes.storedBytes.size());
        value += std::string(more, '\0');
        std::string length(4, '\0');
        overwrite(length, 0, uint32_t(value.size()));
        return length + value;
    }

    DelayedSizes sizes;

private:
    std::string mBytes;
    size_t mBegin, mEnd;
};

TEST_F(GuardedVdb, FindsSizesForDelayedLoadingThatAreMissingOrWrong)
{
    const TestedSizes sound(fileOf("float", io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK));
    EXPECT_EQ(saidOf(sound.bytes(), DelayedMetadata::Keep), "");
    TestedSizes fewer = sound, none = sound, longer = sound, shorter = sound;
    fewer.sizes.selections.pop_back();
    fewer.sizes.storedBytes.pop_back();
    expectSaid(fewer.bytes(), "sizes of leaves are missing", DelayedMetadata::Keep);
    TestedSizes notPacked(fileOf("float", io::COMPRESS_ACTIVE_MASK));
    EXPECT_EQ(saidOf(notPacked.bytes(), DelayedMetadata::Keep), "");
    notPacked.sizes.selections.pop_back();
    expectSaid(notPacked.bytes(), "sizes of leaves are missing", DelayedMetadata::Keep);
    none.sizes.storedBytes.clear();
    expectSaid(none.bytes(), "sizes of leaves are missing", DelayedMetadata::Keep);
    none.sizes.selections.clear(); // arrays of nothing have no address
    expectSaid(none.bytes(), "sizes of leaves are missing", DelayedMetadata::Keep);
    ++longer.sizes.storedBytes.back();
    expectSaid(longer.bytes(), "a leaf is longer or shorter", DelayedMetadata::Keep);
    --shorter.sizes.storedBytes.front();
    expectSaid(shorter.bytes(), "a leaf is longer or shorter", DelayedMetadata::Keep);
    expectSaid(sound.bytes(/*more=*/4), "have a wrong length", DelayedMetadata::Keep);
}

/// @return an entry of metadata, to be put before others.
std::string delayedEntry(const std::string& name, const std::string& value)
{
    std::string entry;
    for (const std::string& text : {name, std::string(io::DelayedLoadMetadata::staticTypeName())}) {
        entry += std::string(4, '\0');
        overwrite(entry, entry.size() - 4, uint32_t(text.size()));
        entry += text;
    }
    return entry + value;
}

void insertEntry(std::string& bytes, size_t count, const std::string& entry)
{
    uint32_t entries;
    std::memcpy(&entries, &bytes.at(count), sizeof(entries));
    overwrite(bytes, count, entries + 1);
    bytes.insert(count + sizeof(entries), entry);
}

TEST_F(GuardedVdb, HoldsAgainstTheLeavesTheSizesThatOpenVdbAsks)
{
    const TestedSizes sound(fileOf("float", io::COMPRESS_ACTIVE_MASK));
    TestedSizes wrong = sound;
    wrong.sizes.selections.resize(1);
    const size_t count = behind(sound.bytes(), "Tree_float_5_4_3") + 4 + 3 * 8 + 4;
    std::string other = sound.bytes(), late = wrong.bytes();
    const size_t end = late.rfind("file_delayed_load") - 4;
    insertEntry(other, count, delayedEntry("other", wrong.value()));
    EXPECT_EQ(saidOf(other, DelayedMetadata::Keep), "");
    late.insert(end + delayedEntry("file_delayed_load", wrong.value()).size(),
        delayedEntry("other", sound.value()));
    overwrite(late, count, uint32_t(late.at(count) + 1));
    expectSaid(late, "sizes of leaves are missing", DelayedMetadata::Keep);
    EXPECT_EQ(saidOf(late), "");
}

TEST_F(GuardedVdb, FindsSizesForDelayedLoadingWhereNoneBelong)
{
    constexpr size_t kFileMetadata = 57;
    const std::string claim = delayedEntry("any", std::string("\10\0\0\0\0\377\377\377\0\0\0", 12));
    std::string bytes = fileOf("float", io::COMPRESS_BLOSC | io::COMPRESS_ACTIVE_MASK);
    insertEntry(bytes, kFileMetadata, claim);
    expectSaid(bytes, "it ends too early", DelayedMetadata::Keep);
    EXPECT_EQ(saidOf(bytes), "") << "OpenVDB never sees them";
}

TEST_F(GuardedVdb, FindsSizesForDelayedLoadingThatDoNotUnpack)
{
    auto grid = openvdb::FloatGrid::create();
    for (int i = 0; i < 300; ++i) grid->tree().setValueOn(openvdb::Coord(8 * i, 0, 0), float(i));
    const std::string bytes = vdbBytes({grid}, io::COMPRESS_BLOSC | io::COMPRESS_ACTIVE_MASK);
    EXPECT_EQ(saidOf(bytes, DelayedMetadata::Keep), "");
    const size_t count = behind(bytes, io::DelayedLoadMetadata::staticTypeName()) + 4;
    std::string more = bytes, fewer = bytes, content = bytes;
    overwrite<uint32_t>(more, count, 301);
    expectSaid(more, "sizes of leaves are missing", DelayedMetadata::Keep);
    overwrite<uint32_t>(fewer, count, 299);
    expectSaid(fewer, "sizes of leaves are missing", DelayedMetadata::Keep);
    constexpr size_t kBloscHeader = 16;
    for (size_t i = 0; i < 8; ++i) content.at(count + 8 + kBloscHeader + i) = '\x7f';
    expectSaid(content, "sizes of leaves cannot be unpacked", DelayedMetadata::Keep);
}

/// OpenVDB heeds none from libraries up to 6.1.
TEST_F(GuardedVdb, HeedsSizesForDelayedLoadingFromVersion62On)
{
    TestedSizes sizes(fileOf("float", io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK));
    ++sizes.sizes.storedBytes.back();
    std::string bytes = sizes.bytes();
    const auto saidOfLibrary = [&](uint32_t major, uint32_t minor) {
        overwrite(bytes, 12, major);
        overwrite(bytes, 16, minor);
        return saidOf(bytes, DelayedMetadata::Keep);
    };
    EXPECT_EQ(saidOfLibrary(5, 2), "");
    EXPECT_EQ(saidOfLibrary(6, 0), "");
    EXPECT_EQ(saidOfLibrary(6, 1), "");
    EXPECT_NE(saidOfLibrary(6, 2), "");
    EXPECT_NE(saidOfLibrary(7, 0), "");
}

} // namespace
