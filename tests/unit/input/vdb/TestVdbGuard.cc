// SPDX-License-Identifier: Apache-2.0
/// @file TestVdbGuard.cc
/// @brief Damaged `.vdb`: a length that is wrong is found before OpenVDB acts on it.

#include "support/GuardedVdb.h"
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
        overwrite(damaged, at, wrong);
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
            overwrite(damaged, at + 4, wrong);
            EXPECT_NE(saidOf(damaged), "");
        }
        std::string damaged = bytes;
        overwrite(damaged, at + 12, packed + 1);
        expectSaid(damaged, "packed values have two lengths");
        ++found;
    }
    EXPECT_GT(found, 3u);
}

TEST_F(GuardedVdb, FindsClaimsThatTheFileIsTooShortFor)
{
    const std::string bytes = fileOf("float", kBlosc);
    std::string metadata = bytes, name = bytes, grids = bytes;
    overwrite<uint32_t>(metadata, behind(bytes, "compression\6\0\0\0string") - 0, 0xfffffff0u);
    overwrite<uint32_t>(grids, 61, 0x7fffffffu);
    overwrite<uint32_t>(name, 65, 0xffffffffu);
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
        overwrite<uint32_t>(bytes, behind(bytes, "number") + 4 + 5, wrong);
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
        overwrite<int32_t>(damaged, at, 0x40000000);
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
            overwrite<int32_t>(between, second + 4 * axis, wrong);
            expectSaid(between, "where no node can be");
        }
    }
    std::string twice = bytes, before = bytes, leaf = bytes;
    overwrite<int32_t>(twice, second, 0);
    expectSaid(twice, "out of order");
    overwrite<int32_t>(before, second, -4096);
    expectSaid(before, "out of order");
    overwrite<int32_t>(leaf, bytes.rfind(pattern), 8192);
    expectSaid(leaf, "a leaf is where no leaf can be");

    grid->tree().setValueOn(openvdb::Coord(8192, 0, 0));
    std::string third = vdbBytes({grid}, kBlosc);
    const int32_t last[] = {8192, 0, 0};
    const std::string lastPattern(reinterpret_cast<const char*>(last), sizeof(last));
    overwrite<int32_t>(third, third.find(lastPattern, third.find(lastPattern) + 1), 4096);
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

TEST_F(GuardedVdb, FindsATileInsideANodeThatCannotBe)
{
    for (const openvdb::Index level : {1, 2}) {
        auto grid = openvdb::BoolGrid::create();
        grid->tree().addTile(level, openvdb::Coord(0, 0, 0), true, true);
        std::string bytes = vdbBytes({grid}, io::COMPRESS_NONE);
        EXPECT_EQ(saidOf(bytes), "");
        // Values stand at the end, behind the masks, but for the node's children.
        const std::size_t value = bytes.size() - (level == 1 ? 4096 : 32768);
        ASSERT_EQ(bytes.at(value), 1);
        bytes[value] = 2;
        expectSaid(bytes, "has a value that it cannot have");
    }
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
    overwrite<uint64_t>(bytes, count, uint64_t(1) << 62); // of four bytes each, 0 in 64 bits
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
    overwrite(bytes, inner, uint32_t(frustum.size()));
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
    overwrite<uint32_t>(bytes, kFirstName, 200u << 20);
    Pipe pipe(bytes);
    EXPECT_THROW(VdbGuard(pipe).takeAll(), openvdb::IoError);
    EXPECT_LE(pipe.most, 1u << 20);
}

TEST_F(GuardedVdb, FindsPointsWhoseNamesAndGroupsLeadNowhere)
{
    const std::string bytes = fileOf("points", kBlosc);
    // Names come after the types, each with its place; groups after these.
    std::string name = bytes, group = bytes;
    overwrite<uint64_t>(name, behind(bytes, "uniform"), 77);
    expectSaid(name, "an attribute has two names or none");
    overwrite<uint64_t>(group, behind(bytes, std::string("\4\0\0\0some", 8)), 8);
    expectSaid(group, "a group of points is nowhere stored");
}

TEST_F(GuardedVdb, FindsPointsWithPassesTooFewOrTooMany)
{
    auto grid = vdbSample("points");
    const std::string bytes = vdbBytes({grid}, kBlosc);
    const auto points = openvdb::gridPtrCast<openvdb::points::PointDataGrid>(grid);
    const auto attributes = points->tree().cbeginLeaf()->attributeSet().size();
    const auto passes = uint16_t(2 * attributes + 4);
    size_t refused = 0, places = 0;
    for (size_t at = 0; at + 2 < bytes.size(); ++at) {
        if (std::memcmp(&bytes[at], &passes, 2) != 0) continue;
        std::string damaged = bytes;
        overwrite<uint16_t>(damaged, at, uint16_t(passes + 2));
        ++places;
        refused += saidOf(damaged).find("attributes are missing") != std::string::npos;
    }
    EXPECT_EQ(refused, 1u) << "of " << places;
}

TEST_F(GuardedVdb, FindsAGridThatIsNotWhereTheFileSays)
{
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/a.vdb";
    io::File writer(path);
    writer.write(openvdb::GridCPtrVec{vdbSample("float")});
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
            overwrite(damaged, at, place + off);
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
