// SPDX-License-Identifier: Apache-2.0
/// @file TestVdbGuard.cc
/// @brief Damaged `.vdb`: a length that is wrong is found before OpenVDB acts on it.
///
/// The guard alone reads here, so that a miss is a failed test and no crash. tests/mutation goes on to
/// OpenVDB.

#include "support/VdbSamples.h"

#include <openvdb_spheretree/input/vdb/VdbGuard.h>

#include <openvdb/io/File.h>

#include <gtest/gtest.h>

#include <cstdint>
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

void expectSaid(const std::string& bytes, const std::string& words)
{
    const std::string said = saidOf(bytes);
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
    for (const int64_t wrong : {said - 8, said + 8, -(int64_t(1) << 40), INT64_MIN}) {
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

TEST_F(GuardedVdb, FindsMetadataThatIsLongerThanItsType)
{
    auto grid = openvdb::FloatGrid::create();
    grid->insertMeta("number", openvdb::Int32Metadata(7));
    std::string bytes = vdbBytes({grid}, io::COMPRESS_NONE);
    EXPECT_EQ(saidOf(bytes), "");
    write<uint32_t>(bytes, behind(bytes, "number") + 4 + 5, 8);
    expectSaid(bytes, "longer or shorter than its type");
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
    std::string between = bytes, twice = bytes, before = bytes, leaf = bytes;
    write<int32_t>(between, second, 4095);
    expectSaid(between, "where no node can be");
    write<int32_t>(twice, second, 0);
    expectSaid(twice, "out of order");
    write<int32_t>(before, second, -4096);
    expectSaid(before, "out of order");
    write<int32_t>(leaf, bytes.rfind(pattern), 8192);
    expectSaid(leaf, "a leaf is where no leaf can be");
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
    std::string all(std::istreambuf_iterator<char>(in), {});
    in.clear();
    EXPECT_LT(all.size(), source.str().size());
    EXPECT_EQ(size_t(in.tellg()), source.str().size());
}

} // namespace
