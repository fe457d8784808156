// SPDX-License-Identifier: Apache-2.0
/// @file TestVdbGuard.cc
/// @brief Damaged `.vdb`: a length that is wrong is found before OpenVDB acts on it.
///
/// The guard alone reads here, so that a miss is a failed test and no crash. tests/mutation goes on to
/// OpenVDB.

#include "support/TemporaryFolder.h"
#include "support/VdbSamples.h"

#include <openvdb_spheretree/input/vdb/VdbGuard.h>

#include <openvdb/io/Compression.h>
#include <openvdb/io/DelayedLoadMetadata.h>
#include <openvdb/io/File.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

namespace {

using namespace openvdb_spheretree::detail;
using namespace spheretree_test;
namespace io = openvdb::io;

class GuardedVdb : public testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

/// @return what the guard says of a file, or nothing if it lets it pass.
std::string saidOf(const std::string& bytes, DelayedMetadata treatment = DelayedMetadata::Drop)
{
    std::stringbuf source(bytes);
    try {
        VdbGuard(source, treatment).takeAll();
    } catch (const openvdb::Exception& error) {
        return error.what();
    }
    return "";
}

openvdb::GridBase::Ptr sample(const std::string& name)
{
    for (const auto& grid : vdbSamples()) {
        if (grid->getName() == name) return grid;
    }
    throw std::logic_error("no sample " + name);
}

std::string fileOf(const std::string& name, uint32_t compression)
{
    return vdbBytes({sample(name)}, compression);
}

template <typename T>
void write(std::string& bytes, size_t at, T value)
{
    std::memcpy(&bytes.at(at), &value, sizeof(T));
}

/// @return the end of the last place of @a text.
size_t behind(const std::string& bytes, const std::string& text)
{
    const size_t at = bytes.rfind(text);
    EXPECT_NE(at, std::string::npos) << text;
    return at + text.size();
}

void expectSaid(const std::string& bytes, const std::string& words,
    DelayedMetadata treatment = DelayedMetadata::Drop)
{
    const std::string said = saidOf(bytes, treatment);
    EXPECT_NE(said.find(words), std::string::npos) << "said: '" << said << "'";
}

constexpr uint32_t kBlosc = io::COMPRESS_BLOSC | io::COMPRESS_ACTIVE_MASK;

TEST_F(GuardedVdb, LetsEverySampleOfOpenVdbPass)
{
    for (const uint32_t compression : vdbCompressions()) {
        EXPECT_EQ(saidOf(vdbBytes(vdbSamples(), compression)), "");
        EXPECT_EQ(saidOf(vdbBytes(vdbSamples(), compression), DelayedMetadata::Keep), "");
    }
}

TEST_F(GuardedVdb, FindsEveryTruncation)
{
    for (const char* name : {"float", "mask", "points"}) {
        const std::string bytes = fileOf(name, kBlosc);
        const size_t step = 1 + bytes.size() / 5000;
        for (size_t length = 0; length < bytes.size(); length += step) {
            ASSERT_NE(saidOf(bytes.substr(0, length)), "") << name << " of " << length << " bytes";
        }
        EXPECT_NE(saidOf(bytes.substr(0, bytes.size() - 1)), "");
    }
}

TEST_F(GuardedVdb, FindsABlockThatIsLongerThanItsNode)
{
    auto grid = openvdb::Int64Grid::create();
    std::mt19937_64 random(5);
    for (int i = 0; i < 512; ++i) { // what zip cannot pack
        grid->tree().setValueOn(openvdb::Coord(i >> 6, i >> 3 & 7, i & 7), int64_t(random()));
    }
    const std::string bytes = vdbBytes({grid}, io::COMPRESS_ZIP);
    const int64_t said = -int64_t(512 * sizeof(int64_t));
    const size_t at = bytes.rfind(std::string(reinterpret_cast<const char*>(&said), sizeof(said)));
    ASSERT_NE(at, std::string::npos);
    for (const int64_t wrong : {said - 8, said + 8, int64_t(0), -(int64_t(1) << 40), INT64_MIN}) {
        std::string damaged = bytes;
        write(damaged, at, wrong);
        expectSaid(damaged, "a node has more or fewer values than it stores");
    }
}

TEST_F(GuardedVdb, FindsALengthInABloscHeaderThatIsNotItsNodes)
{
    const std::string bytes = fileOf("float", kBlosc);
    size_t found = 0;
    for (size_t at = 16; at + 16 < bytes.size(); ++at) {
        int64_t length;
        int32_t unpacked, packed;
        std::memcpy(&length, &bytes[at - 8], 8);
        std::memcpy(&unpacked, &bytes[at + 4], 4);
        std::memcpy(&packed, &bytes[at + 12], 4);
        const bool header = bytes[at] == 2 && length == packed && packed > 16;
        if (!header) continue;
        for (const int32_t wrong : {unpacked + 4, unpacked - 4, -unpacked}) {
            std::string damaged = bytes;
            write(damaged, at + 4, wrong);
            EXPECT_NE(saidOf(damaged), "");
        }
        std::string damaged = bytes;
        write(damaged, at + 12, packed + 1);
        expectSaid(damaged, "packed values have two lengths");
        ++found;
    }
    EXPECT_GT(found, 3u);
}

TEST_F(GuardedVdb, FindsClaimsThatTheFileIsTooShortFor)
{
    const std::string bytes = fileOf("float", kBlosc);
    std::string metadata = bytes, name = bytes, grids = bytes;
    write<uint32_t>(metadata, behind(bytes, "compression\6\0\0\0string") - 0, 0xfffffff0u);
    write<uint32_t>(grids, 61, 0x7fffffffu);
    write<uint32_t>(name, 65, 0xffffffffu);
    for (const auto& damaged : {metadata, name, grids}) {
        expectSaid(damaged, "it ends too early");
    }
}

TEST_F(GuardedVdb, FindsMetadataThatIsLongerOrShorterThanItsType)
{
    auto grid = openvdb::FloatGrid::create();
    grid->insertMeta("number", openvdb::Int32Metadata(7));
    std::string bytes = vdbBytes({grid}, io::COMPRESS_NONE);
    EXPECT_EQ(saidOf(bytes), "");
    for (const uint32_t wrong : {8, 3, 0}) {
        write<uint32_t>(bytes, behind(bytes, "number") + 4 + 5, wrong);
        expectSaid(bytes, "longer or shorter than its type");
    }
}

TEST_F(GuardedVdb, FindsTruthValuesThatAreNeitherTrueNorFalse)
{
    auto grid = openvdb::FloatGrid::create();
    grid->insertMeta("truth", openvdb::BoolMetadata(true));
    std::string bytes = vdbBytes({grid}, io::COMPRESS_NONE);
    bytes.at(behind(bytes, "truth") + 4 + 4 + 4) = 2;
    expectSaid(bytes, "neither true nor false");
}

TEST_F(GuardedVdb, FindsABackgroundOfPointsOrMasksThatCannotBe)
{
    for (const char* name : {"points", "bool", "mask"}) {
        SCOPED_TRACE(name);
        const auto nodes = fileOf(name, kBlosc);
        size_t refused = 0;
        for (size_t at = 0; at < 2000; ++at) { // one of them is the background
            std::string damaged = nodes;
            damaged[at] = 7;
            refused += saidOf(damaged).find("that it cannot have") != std::string::npos;
        }
        EXPECT_GE(refused, 1u);
    }
}

/// @return how many bytes of a damaged file are handed on before it is refused.
size_t handedOn(const std::string& bytes)
{
    std::stringbuf source(bytes);
    VdbGuard guard(source);
    size_t count = 0;
    try {
        while (guard.sbumpc() != std::char_traits<char>::eof()) ++count;
    } catch (const openvdb::Exception&) {}
    return count;
}

TEST_F(GuardedVdb, KeepsTheHeaderOfAPageThatIsLongerThanTheFile)
{
    // The header comes long before the page, and OpenVDB takes memory for the page in between.
    const std::string bytes = fileOf("points", kBlosc);
    const size_t all = handedOn(bytes);
    size_t late = 0, pages = 0;
    for (size_t at = 0; at + 8 < bytes.size(); ++at) {
        int32_t packed, unpacked;
        std::memcpy(&packed, &bytes[at], 4);
        std::memcpy(&unpacked, &bytes[at + 4], 4);
        const bool header = packed > 16 && packed < unpacked && unpacked == 3000 * 3 * 8; // strided
        if (!header) continue;
        ++pages;
        std::string damaged = bytes;
        write<int32_t>(damaged, at, 0x40000000);
        late += handedOn(damaged) > at && handedOn(damaged) < all;
    }
    EXPECT_GT(pages, 0u);
    EXPECT_EQ(late, 0u);
}

TEST_F(GuardedVdb, FindsNodesWhereNoneCanBeOrOutOfOrder)
{
    auto grid = openvdb::MaskGrid::create();
    grid->tree().setValueOn(openvdb::Coord(0, 0, 0));
    grid->tree().setValueOn(openvdb::Coord(4096, 0, 0));
    const std::string bytes = vdbBytes({grid}, kBlosc);
    const int32_t place[] = {4096, 0, 0};
    const std::string pattern(reinterpret_cast<const char*>(place), sizeof(place));
    const size_t second = bytes.find(pattern, bytes.find(pattern) + 1); // the first is metadata
    ASSERT_NE(second, std::string::npos);
    for (const size_t axis : {0, 1, 2}) {
        for (const int32_t wrong : {4095, 2048, -1}) {
            std::string between = bytes;
            write<int32_t>(between, second + 4 * axis, wrong);
            expectSaid(between, "where no node can be");
        }
    }
    std::string twice = bytes, before = bytes, leaf = bytes;
    write<int32_t>(twice, second, 0);
    expectSaid(twice, "out of order");
    write<int32_t>(before, second, -4096);
    expectSaid(before, "out of order");
    write<int32_t>(leaf, bytes.rfind(pattern), 8192);
    expectSaid(leaf, "a leaf is where no leaf can be");

    grid->tree().setValueOn(openvdb::Coord(8192, 0, 0));
    std::string third = vdbBytes({grid}, kBlosc);
    const int32_t last[] = {8192, 0, 0};
    const std::string lastPattern(reinterpret_cast<const char*>(last), sizeof(last));
    write<int32_t>(third, third.find(lastPattern, third.find(lastPattern) + 1), 4096);
    expectSaid(third, "out of order");
}

TEST_F(GuardedVdb, FindsATileThatCannotBe)
{
    auto grid = openvdb::BoolGrid::create();
    grid->tree().addTile(3, openvdb::Coord(0, 0, 4096), true, true);
    const std::string bytes = vdbBytes({grid}, kBlosc);
    EXPECT_EQ(saidOf(bytes), "");
    std::string value = bytes, active = bytes;
    value.at(bytes.size() - 2) = 2;
    expectSaid(value, "has a value that it cannot have");
    active.at(bytes.size() - 1) = 2;
    expectSaid(active, "a tile is neither active nor inactive");
}

TEST_F(GuardedVdb, FindsALeafThatDoesNotSayWhatItStores)
{
    auto grid = openvdb::FloatGrid::create();
    grid->tree().setValueOn(openvdb::Coord(0, 0, 0), 1);
    const std::string bytes = vdbBytes({grid}, io::COMPRESS_NONE);
    const size_t selection = bytes.size() - 512 * sizeof(float) - 1;
    ASSERT_EQ(bytes.at(selection), char(io::NO_MASK_AND_ALL_VALS));
    std::string damaged = bytes;
    damaged.at(selection) = char(io::NO_MASK_OR_INACTIVE_VALS);
    expectSaid(damaged, "a node leaves values out where its grid does not");
    for (const char wrong : {7, -1}) {
        damaged.at(selection) = wrong;
        expectSaid(damaged, "a node's values are of no kind that there is");
    }
}

TEST_F(GuardedVdb, FindsPointIndicesThatOpenVdbCannotRead)
{
    expectSaid(vdbBytes({pointIndexSample(2)}, kBlosc), "cannot read grids of point indices");
    std::string bytes = vdbBytes({pointIndexSample(1)}, kBlosc);
    const size_t count = bytes.size() - 8 - 4 - 8; // an index, and what is not read, are behind it
    ASSERT_EQ(bytes.at(count), 1);
    write<uint64_t>(bytes, count, uint64_t(1) << 62); // of four bytes each, 0 in 64 bits
    expectSaid(bytes, "a leaf has more than a file can hold");
}

TEST_F(GuardedVdb, FindsAnIdentifierThatIsNone)
{
    const std::string bytes = fileOf("mask", kBlosc);
    constexpr size_t kTag = 21;
    for (const size_t at : {0, 7, 8, 9, 13, 18, 23, 24, 35}) {
        std::string damaged = bytes;
        damaged.at(kTag + at) = damaged.at(kTag + at) == '-' ? '0' : '-';
        expectSaid(damaged, "its identifier is none");
    }
}

TEST_F(GuardedVdb, FindsAFrustumWithinAFrustum)
{
    std::string bytes = fileOf("frustum", kBlosc);
    const std::string frustum = "NonlinearFrustumMap";
    const size_t inner = behind(bytes, frustum) + 8 * sizeof(double); // its length, then its name
    uint32_t length;
    std::memcpy(&length, &bytes.at(inner), sizeof(length));
    ASSERT_EQ(bytes.substr(inner + 4 + length - 3, 3), "Map");
    bytes.replace(inner + 4, length, frustum);
    write(bytes, inner, uint32_t(frustum.size()));
    expectSaid(bytes, "its transform is of no type that there is");
}

/// @return what the guard says of a Blosc header that stands for @a count bytes.
std::string saidOfBlosc(int32_t unpacked, int32_t packed, uint64_t count)
{
    const int32_t numbers[] = {0x04010102, unpacked, unpacked, packed};
    const std::string bytes(reinterpret_cast<const char*>(numbers), sizeof(numbers));
    std::stringbuf source(bytes);
    ByteWindow window(source);
    try {
        EXPECT_EQ(unpackedBlosc(window, window.take(bytes.size()), count), uint64_t(unpacked));
    } catch (const openvdb::IoError& error) {
        return error.what();
    }
    return "";
}

TEST_F(GuardedVdb, FindsABloscHeaderThatPromisesTooMuch)
{
    const auto expectWords = [](const std::string& said, const std::string& words) {
        EXPECT_NE(said.find(words), std::string::npos) << "said: '" << said << "'";
    };
    EXPECT_EQ(saidOfBlosc(16 * 255, 16, 16), "");
    expectWords(saidOfBlosc(16 * 255 + 1, 16, 16), "so few bytes cannot hold so many values");
    expectWords(saidOfBlosc(-1, 16, 16), "so few bytes cannot hold so many values");
    expectWords(saidOfBlosc(40, 17, 16), "packed values have two lengths");
    expectWords(saidOfBlosc(40, 15, 16), "packed values have two lengths");
    expectWords(saidOfBlosc(40, 15, 15), "packed values are too short");
}

/// A source like a pipe that does not know what is to come.
class Pipe : public std::streambuf {
public:
    explicit Pipe(std::string bytes) : mBytes(std::move(bytes)) {}
    /// The most that was asked for at once, and how many bytes in all.
    uint64_t most = 0, asked = 0;

protected:
    std::streamsize xsgetn(char* to, std::streamsize count) override
    {
        most = std::max(most, uint64_t(count));
        asked += uint64_t(count);
        const size_t some = std::min(size_t(count), mBytes.size() - mPlace);
        std::memcpy(to, mBytes.data() + mPlace, some);
        mPlace += some;
        return std::streamsize(some);
    }

private:
    std::string mBytes;
    size_t mPlace = 0;
};

TEST_F(GuardedVdb, WaitsForNothingBehindTheLastGrid)
{
    for (const char* name : {"float", "mask", "points"}) {
        const std::string bytes = fileOf(name, kBlosc);
        Pipe pipe(bytes);
        VdbGuard(pipe).takeAll();
        EXPECT_EQ(pipe.asked, bytes.size());
    }
}

TEST_F(GuardedVdb, BelievesALengthInPieces)
{
    std::string bytes = fileOf("float", kBlosc);
    constexpr size_t kFirstName = 65;
    write<uint32_t>(bytes, kFirstName, 200u << 20);
    Pipe pipe(bytes);
    EXPECT_THROW(VdbGuard(pipe).takeAll(), openvdb::IoError);
    EXPECT_LE(pipe.most, 1u << 20);
}

TEST_F(GuardedVdb, FindsPointsWhoseNamesAndGroupsLeadNowhere)
{
    const std::string bytes = fileOf("points", kBlosc);
    // Names come after the types, each with its place; groups after these.
    std::string name = bytes, group = bytes;
    write<uint64_t>(name, behind(bytes, "uniform"), 77);
    expectSaid(name, "an attribute has two names or none");
    write<uint64_t>(group, behind(bytes, std::string("\4\0\0\0some", 8)), 8);
    expectSaid(group, "a group of points is nowhere stored");
}

TEST_F(GuardedVdb, FindsPointsWithPassesTooFewOrTooMany)
{
    auto grid = sample("points");
    const std::string bytes = vdbBytes({grid}, kBlosc);
    const auto points = openvdb::gridPtrCast<openvdb::points::PointDataGrid>(grid);
    const auto attributes = points->tree().cbeginLeaf()->attributeSet().size();
    const auto passes = uint16_t(2 * attributes + 4);
    size_t refused = 0, places = 0;
    for (size_t at = 0; at + 2 < bytes.size(); ++at) {
        if (std::memcmp(&bytes[at], &passes, 2) != 0) continue;
        std::string damaged = bytes;
        write<uint16_t>(damaged, at, uint16_t(passes + 2));
        ++places;
        refused += saidOf(damaged).find("attributes are missing") != std::string::npos;
    }
    EXPECT_EQ(refused, 1u) << "of " << places;
}

TEST_F(GuardedVdb, FindsSizesForDelayedLoadingThatAreNotTheLeaves)
{
    const std::string bytes = fileOf("float", io::COMPRESS_ACTIVE_MASK);
    EXPECT_EQ(saidOf(bytes, DelayedMetadata::Keep), "");
    const size_t count = behind(bytes, io::DelayedLoadMetadata::staticTypeName()) + 4;
    uint32_t leaves;
    std::memcpy(&leaves, &bytes[count], 4);
    ASSERT_GT(leaves, 4u);
    std::string fewer = bytes, other = bytes;
    write(fewer, count, leaves - 1);
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
        write(length, 0, uint32_t(value.size()));
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
        write(entry, entry.size() - 4, uint32_t(text.size()));
        entry += text;
    }
    return entry + value;
}

void insertEntry(std::string& bytes, size_t count, const std::string& entry)
{
    uint32_t entries;
    std::memcpy(&entries, &bytes.at(count), sizeof(entries));
    write(bytes, count, entries + 1);
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
    write(late, count, uint32_t(late.at(count) + 1));
    expectSaid(late, "sizes of leaves are missing", DelayedMetadata::Keep);
    EXPECT_EQ(saidOf(late), "");
}

TEST_F(GuardedVdb, FindsSizesForDelayedLoadingWhereNoneBelong)
{
    constexpr size_t kFileMetadata = 57;
    const std::string claim = delayedEntry("any", std::string("\10\0\0\0\0\377\377\377\0\0\0", 12));
    std::string bytes = fileOf("float", kBlosc);
    insertEntry(bytes, kFileMetadata, claim);
    expectSaid(bytes, "it ends too early", DelayedMetadata::Keep);
    EXPECT_EQ(saidOf(bytes), "") << "OpenVDB never sees them";
}

TEST_F(GuardedVdb, FindsSizesForDelayedLoadingThatDoNotUnpack)
{
    auto grid = openvdb::FloatGrid::create();
    for (int i = 0; i < 300; ++i) grid->tree().setValueOn(openvdb::Coord(8 * i, 0, 0), float(i));
    const std::string bytes = vdbBytes({grid}, kBlosc);
    EXPECT_EQ(saidOf(bytes, DelayedMetadata::Keep), "");
    const size_t count = behind(bytes, io::DelayedLoadMetadata::staticTypeName()) + 4;
    std::string more = bytes, fewer = bytes, content = bytes;
    write<uint32_t>(more, count, 301);
    expectSaid(more, "sizes of leaves are missing", DelayedMetadata::Keep);
    write<uint32_t>(fewer, count, 299);
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
        write(bytes, 12, major);
        write(bytes, 16, minor);
        return saidOf(bytes, DelayedMetadata::Keep);
    };
    EXPECT_EQ(saidOfLibrary(5, 2), "");
    EXPECT_EQ(saidOfLibrary(6, 0), "");
    EXPECT_EQ(saidOfLibrary(6, 1), "");
    EXPECT_NE(saidOfLibrary(6, 2), "");
    EXPECT_NE(saidOfLibrary(7, 0), "");
}

TEST_F(GuardedVdb, FindsAGridThatIsNotWhereTheFileSays)
{
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/a.vdb";
    io::File writer(path);
    writer.write(openvdb::GridCPtrVec{sample("float")});
    writer.close();
    std::ifstream file(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(saidOf(bytes, DelayedMetadata::Keep), "");
    const size_t begin = behind(bytes, "Tree_float_5_4_3") + 4; // no instance
    for (const size_t at : {begin, begin + 16}) {               // where it begins, and ends
        for (const int64_t off : {-1, 1}) {
            std::string damaged = bytes;
            int64_t place;
            std::memcpy(&place, &bytes.at(at), sizeof(place));
            write(damaged, at, place + off);
            expectSaid(damaged, "a grid is not where the file says", DelayedMetadata::Keep);
            EXPECT_EQ(saidOf(damaged), "") << "OpenVDB does not go there";
        }
    }
}

TEST_F(GuardedVdb, NamesAGridWhoseTypeIsNotRead)
{
    std::string bytes = fileOf("float", kBlosc);
    bytes.replace(bytes.find("Tree_float"), 10, "Tree_flaot");
    expectSaid(bytes, "'Tree_flaot_5_4_3'");
}

TEST_F(GuardedVdb, TellsThePlaceInTheFileAsItWasBeforeAnythingWasDropped)
{
    std::stringbuf source(fileOf("float", kBlosc));
    VdbGuard guard(source);
    std::istream in(&guard);
    in.ignore(30); // within the header
    EXPECT_EQ(int(in.tellg()), 30);
    std::string all(std::istreambuf_iterator<char>(in), {});
    in.clear();
    EXPECT_LT(all.size(), source.str().size());
    EXPECT_EQ(size_t(in.tellg()), source.str().size());
}

} // namespace
