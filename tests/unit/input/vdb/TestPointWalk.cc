// SPDX-License-Identifier: Apache-2.0
/// @file TestPointWalk.cc
/// @brief Leaves of points, written by hand: OpenVDB writes none in which one number contradicts another.

#include "support/GuardedVdb.h"
#include "support/PointGrids.h"
#include "support/VdbBytes.h"
#include "support/VdbSamples.h"

#include <openvdb_spheretree/input/vdb/VdbGrids.h>

#include <openvdb/io/Compression.h>
#include <openvdb/points/AttributeGroup.h>
#include <openvdb/points/PointCount.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
namespace points = openvdb::points;

constexpr uint8_t kStrided = 1, kUniform = 2, kPaged = 8; // forms of an attribute
constexpr uint8_t kConstantStride = 8;                    // a flag of it
constexpr uint32_t kValues = 600;                         // of the attribute of each leaf
constexpr uint32_t kBytes = kValues * sizeof(float);
constexpr uint16_t kNotPacked = 65535;

/// A Blosc buffer of so many bytes. What it holds is its header's word alone: the guard unpacks none.
std::string packed(int32_t bytes, int32_t unpacked)
{
    const char begin[] = {2, 1, 1, 4};
    std::string buffer(begin, sizeof(begin));
    for (const int32_t number : {unpacked, unpacked, bytes}) {
        buffer.append(reinterpret_cast<const char*>(&number), sizeof(number));
    }
    buffer.resize(size_t(bytes));
    return buffer;
}

/// A `.vdb` of a grid with leaves side by side. Each has 600 points with an attribute of numbers, which is
/// what is changed here, and one for groups, of which there is one.
struct PointFile : private VdbBytes {
    uint32_t version = 224;
    int leaves = 1;
    uint16_t passes = 2 * 2 + 4;

    std::vector<uint16_t> offsetBytes = {kNotPacked}; // as told in advance, and then again
    std::string offsets = std::string(64 * 32, '\0');

    uint8_t header = 1;
    std::string extra; // of a header that has more
    uint64_t types = 2, groups = 1;
    uint64_t places[2] = {0, 1}; // of the names
    uint64_t group = 0;

    uint64_t stored = kBytes;
    uint8_t flags = kConstantStride, form = 0;
    uint32_t size = kValues, stride = 1;
    std::string page; // its header
    std::string body = std::string(1, '\0') + std::string(kBytes, '\0');

    std::string bytes()
    {
        mBytes.clear();
        head();
        nodes();
        put(passes);
        for (int i = 0; i < leaves; ++i) put(offsetBytes.front());
        for (int i = 0; i < leaves; ++i) attributes(i);
        if (form & kPaged) mBytes += page;
        for (int i = 0; i < leaves; ++i) {
            mBytes += std::string(1, '\1') + std::string(63, '\0'); // active voxels
            put(offsetBytes.back());
            mBytes += offsets;
        }
        for (int i = 0; i < leaves; ++i) {
            if (i == 0 || !(form & kPaged)) mBytes += body;
        }
        mBytes += std::string(size_t(leaves), '\0'); // the groups of all points
        return mBytes;
    }

    /// The numbers of all leaves in one page.
    void inAPage(int32_t packedBytes, int32_t unpackedBytes, const std::string& content)
    {
        form = kPaged;
        page.assign(reinterpret_cast<const char*>(&packedBytes), sizeof(packedBytes));
        if (packedBytes > 0) {
            page.append(reinterpret_cast<const char*>(&unpackedBytes), sizeof(unpackedBytes));
        }
        body = content;
    }

private:
    void head()
    {
        fileHead(version, 10);
        descriptorOf("points", "Tree_ptdataidx32_5_4_3");
        put<uint32_t>(openvdb::io::COMPRESS_ACTIVE_MASK);
        put<uint32_t>(0); // metadata
        unitScale();
    }
    void nodes()
    {
        put<int32_t>(1);                                     // buffers
        for (const uint32_t number : {0, 0, 1}) put(number); // background, tiles, children
        for (int i = 0; i < 3; ++i) put<int32_t>(0);
        const int masks[] = {32 * 32 * 32 / 8, 16 * 16 * 16 / 8};
        const char children[] = {1, char((1 << leaves) - 1)};
        for (int i = 0; i < 2; ++i) {
            mBytes += children[i] + std::string(size_t(2 * masks[i] - 1), '\0');
            put<int8_t>(0); // no value is stored
        }
        for (int i = 0; i < leaves; ++i) mBytes += '\1' + std::string(63, '\0');
    }
    void attributes(int leaf)
    {
        if (leaf == 0 || !(header & 1)) {
            put(header);
            descriptor();
            mBytes += extra;
        }
        constexpr uint64_t kSizes = 6; // bytes of flags and size, which are counted
        put(stored + kSizes);
        put(flags);
        put(form);
        put(size);
        if (form & kStrided) put(stride);
        put<uint64_t>(1 + kSizes);
        put(kConstantStride);
        put(kUniform);
        put(kValues);
    }
    void descriptor()
    {
        put(types);
        text("float");
        text("null");
        text(points::GroupAttributeArray::attributeType().first);
        text(points::GroupAttributeArray::attributeType().second);
        text("number");
        put(places[0]);
        text("groups");
        put(places[1]);
        put(groups);
        text("some");
        put(group);
        put<uint32_t>(0); // metadata
    }
};

class PointWalk : public GuardedVdb {
protected:
    static void expectSound(PointFile file) { EXPECT_EQ(saidOf(file.bytes()), ""); }
    static void expectSaid(PointFile file, const std::string& words)
    {
        GuardedVdb::expectSaid(file.bytes(), words);
    }
};

/// @return how many leaves OpenVDB reads, behind the guard.
uint32_t leavesOf(PointFile file)
{
    std::stringbuf source(file.bytes());
    const auto grids = readVdbGrids(source);
    const auto grid = openvdb::gridPtrCast<points::PointDataGrid>(grids.at(0));
    for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
        EXPECT_EQ(leaf->attributeSet().size(), 2u);
        EXPECT_EQ(leaf->constAttributeArray("number").size(), kValues);
        EXPECT_TRUE(leaf->attributeSet().descriptor().hasGroup("some"));
    }
    return grid->tree().leafCount();
}

TEST_F(PointWalk, ReadsWhatIsWrittenByHand)
{
    PointFile file;
    EXPECT_EQ(leavesOf(file), 1u);
    file.leaves = 3;
    EXPECT_EQ(leavesOf(file), 3u);
    file.inAPage(-3 * int32_t(kBytes), 0, std::string(3 * kBytes, '\0'));
    EXPECT_EQ(leavesOf(file), 3u);
}

TEST_F(PointWalk, ReadsLeavesWithADescriptorEach)
{
    PointFile file;
    file.leaves = 3;
    file.header = 0;
    EXPECT_EQ(leavesOf(file), 3u);
}

TEST_F(PointWalk, SkipsWhatLaterVersionsMayHaveInAHeader)
{
    PointFile file;
    file.header = 3;
    file.extra = std::string("\5\0\0\0\0\0\0\0later", 13);
    EXPECT_EQ(leavesOf(file), 1u);
    file.header = 4;
    expectSaid(file, "points are of a version that is not known");
}

TEST_F(PointWalk, RefusesAVersionThatStoredPointsInAnotherOrder)
{
    PointFile file;
    file.version = 223;
    expectSaid(file, "points are of a version that is no longer read");
}

TEST_F(PointWalk, FindsPassesThatAreNotThoseOfTheAttributes)
{
    PointFile file;
    for (const uint16_t passes : {7, 9, 10}) {
        file.passes = passes;
        expectSaid(file, "attributes are missing");
    }
}

TEST_F(PointWalk, FindsADescriptorThatLeadsNowhere)
{
    PointFile file;
    file.places[1] = 2;
    expectSaid(file, "an attribute has two names or none");
    file.places[1] = 0;
    expectSaid(file, "an attribute has two names or none");
    file = PointFile();
    file.group = 7;
    expectSound(file);
    file.group = 8;
    expectSaid(file, "a group of points is nowhere stored");
    file = PointFile();
    const uint64_t many = uint64_t(1) << 61; // of eight bytes each, 0 in 64 bits
    file.types = many;
    expectSaid(file, "more attributes than a file can hold");
    file = PointFile();
    file.groups = many;
    expectSaid(file, "more attributes than a file can hold");
}

TEST_F(PointWalk, FindsAnAttributeOfAWrongSize)
{
    const std::string wrong = "an attribute has a wrong size";
    PointFile file;
    file.size = 0;
    file.stored = 0;
    expectSaid(file, wrong);
    file.size = 0x20000000; // of four bytes, 1 more than a number with a sign can be
    expectSaid(file, wrong);
    file.form = kStrided;
    file.size = 1380655685; // their product is 2^62 + 1: of four bytes, 4 in 64 bits
    file.stride = 3340214413;
    file.stored = 4;
    file.body = std::string(5, '\0');
    expectSaid(file, wrong);
    file = PointFile();
    file.form = 0x10;
    expectSaid(file, "stored in a way that is not known");
}

TEST_F(PointWalk, FindsAnAttributeThatIsStoredShorterOrLonger)
{
    const std::string wrong = "an attribute has more or fewer values than it stores";
    PointFile file;
    file.stored = kBytes + 4;
    expectSaid(file, wrong);
    file.stored = kBytes - 4;
    file.body = std::string(1, '\0') + std::string(kBytes - 4, '\0');
    expectSaid(file, wrong);
    file.stored = 40;
    file.body = '\1' + packed(40, kBytes);
    expectSound(file);
    for (const int32_t unpacked : {int32_t(kBytes) - 4, int32_t(kBytes) + 4, 128}) {
        file.body = '\1' + packed(40, unpacked);
        expectSaid(file, wrong);
    }
    file.body = '\2' + packed(40, kBytes); // which OpenVDB would not unpack
    expectSaid(file, "stored in a way that is not known");

    file = PointFile();
    file.inAPage(-int32_t(kBytes), 0, std::string(kBytes, '\0'));
    expectSound(file);
    file.stored = kBytes - 4;
    expectSaid(file, wrong);
}

TEST_F(PointWalk, FindsAPageThatIsShorterOrLongerThanItsAttributes)
{
    PointFile file;
    file.leaves = 2;
    file.inAPage(-2 * int32_t(kBytes), 0, std::string(2 * kBytes, '\0'));
    expectSound(file);
    file.inAPage(-int32_t(kBytes) - 4, 0, std::string(kBytes + 4, '\0'));
    expectSaid(file, "an attribute is longer than its page");
    file.inAPage(-2 * int32_t(kBytes) - 4, 0, std::string(2 * kBytes + 4, '\0'));
    expectSaid(file, "a page is longer than its attributes");
}

/// A sum of 32 bits would come to the page's end again.
TEST_F(PointWalk, FindsAttributesThatGoRoundBehindTheirPage)
{
    PointFile file;
    file.leaves = 5;
    file.size = 0xd0000000u / sizeof(float) / 4;
    file.stored = uint64_t(file.size) * sizeof(float);
    const auto page = int32_t(uint32_t(5 * file.stored));
    ASSERT_EQ(uint64_t(page), 0x4000000u);
    file.inAPage(40, page, packed(40, page));
    expectSaid(file, "an attribute is longer than its page");
}

TEST_F(PointWalk, FindsAPageThatHoldsMoreOrLessThanItSays)
{
    PointFile file;
    file.inAPage(40, int32_t(kBytes), packed(40, int32_t(kBytes)));
    expectSound(file);
    for (const int32_t unpacked : {int32_t(kBytes) - 4, int32_t(kBytes) + 4, 128}) {
        file.body = packed(40, unpacked);
        expectSaid(file, "a page has more or fewer values than it stores");
    }
    file.size = 20;
    file.stored = 80; // few enough for OpenVDB to fill them up
    file.inAPage(40, 80, packed(40, 128));
    expectSound(file);
}

TEST_F(PointWalk, FindsVoxelsOfPointsThatAreTooManyOrTooFew)
{
    PointFile file;
    file.offsetBytes = {40};
    file.offsets = packed(40, 2048);
    expectSound(file);
    for (const int32_t unpacked : {2044, 2052}) {
        file.offsets = packed(40, unpacked);
        expectSaid(file, "voxels of points are missing");
    }
    file.offsets = packed(40, 2048);
    file.offsetBytes = {kNotPacked, 40};
    expectSaid(file, "voxels of points have two lengths");
}

TEST_F(PointWalk, ReadsAttributesOfMoreThanOnePage)
{
    std::mt19937 random(3);
    std::vector<openvdb::Vec3d> places;
    for (int i = 0; i < 100000; ++i) { // 1.2 MB, and a page has one
        places.emplace_back(random() % 64, random() % 64, random() % 997 / 16.0);
    }
    const auto grid = pointsAt(places);
    std::stringbuf source(spheretree_test::vdbBytes(
        {grid}, openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK));
    const auto read = openvdb::gridPtrCast<points::PointDataGrid>(readVdbGrids(source).at(0));
    EXPECT_EQ(points::pointCount(read->tree()), places.size());
}

} // namespace
