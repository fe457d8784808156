// SPDX-License-Identifier: Apache-2.0
/// @file TestVdbGrids.cc
/// @brief What OpenVDB reads is read, to the byte, whatever the type, the compression and the version.

#include "support/DataFolder.h"
#include "support/TemporaryFolder.h"
#include "support/VdbBytes.h"
#include "support/VdbSamples.h"

#include <openvdb_spheretree/input/vdb/VdbGrids.h>

#include <openvdb/io/DelayedLoadMetadata.h>
#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
namespace io = openvdb::io;

class VdbGrids : public testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

openvdb::GridPtrVec readGuarded(const std::string& bytes)
{
    std::stringbuf source(bytes);
    return readVdbGrids(source);
}

openvdb::GridPtrVec readByOpenVdb(const std::string& bytes)
{
    std::istringstream in(bytes);
    return *io::Stream(in, /*delayLoad=*/false).getGrids();
}

void expectSame(const openvdb::GridPtrVec& grids, const openvdb::GridPtrVec& expected)
{
    ASSERT_EQ(grids.size(), expected.size());
    for (size_t i = 0; i < grids.size(); ++i) {
        EXPECT_TRUE(contentOf(grids[i]) == contentOf(expected[i])) << expected[i]->getName();
    }
}

TEST_F(VdbGrids, AreThoseOfOpenVdbForEveryTypeAndCompression)
{
    for (const uint32_t compression : vdbCompressions()) {
        SCOPED_TRACE(io::compressionToString(compression));
        const std::string bytes = vdbBytes(vdbSamples(), compression);
        expectSame(readGuarded(bytes), readByOpenVdb(bytes));
    }
}

TEST_F(VdbGrids, ThatShareNodesStillDo)
{
    const auto grids = readGuarded(vdbBytes(vdbSamples(), io::COMPRESS_BLOSC));
    const size_t last = grids.size() - 1;
    EXPECT_EQ(grids[last]->baseTreePtr(), grids[last - 1]->baseTreePtr());
}

TEST_F(VdbGrids, OfFilesForDelayedLoadingAreSoundAndRead)
{
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/samples.vdb";
    for (const uint32_t compression : vdbCompressions()) {
        SCOPED_TRACE(io::compressionToString(compression));
        io::File writer(path);
        writer.setCompression(compression);
        writer.write(vdbSamples());
        writer.close();

        std::filebuf source;
        ASSERT_TRUE(source.open(path, std::ios::in | std::ios::binary));
        const auto names = requireSoundVdb(source);
        ASSERT_TRUE(names);
        EXPECT_EQ(names->size(), vdbSamples().size());

        io::File file(path);
        file.open(/*delayLoad=*/true);
        openvdb::GridPtrVec delayed;
        for (const auto& name : *names) delayed.push_back(file.readGrid(name));
        std::filebuf again;
        again.open(path, std::ios::in | std::ios::binary);
        // Shared nodes stand where they belong in the first reading alone: io::File reads them anew.
        auto whole = readVdbGrids(again);
        expectSame(whole, delayed);
    }
}

TEST_F(VdbGrids, OfAPipeDoNotSayWhereTheyAre)
{
    std::stringbuf source(vdbBytes(vdbSamples(), io::COMPRESS_ZIP));
    EXPECT_FALSE(requireSoundVdb(source));
}

TEST_F(VdbGrids, WithASizeForDelayedLoadingThatIsWrongAreNotSound)
{
    std::string bytes = vdbBytes({vdbSamples().front()}, io::COMPRESS_ACTIVE_MASK);
    const std::string type = io::DelayedLoadMetadata::staticTypeName();
    char& selection = bytes.at(bytes.rfind(type) + type.size() + 12);
    selection = char(selection ^ 1);
    std::stringbuf source(bytes), again(bytes);
    EXPECT_THROW(requireSoundVdb(source), openvdb::IoError);
    EXPECT_EQ(readVdbGrids(again).size(), 1u);
}

/// Houdini's, OpenVDB's own and others, as their makers compressed them.
TEST_F(VdbGrids, OfOtherProgramsAreThoseOfOpenVdb)
{
    const char* data = std::getenv("SPHERETREE_DATA");
    if (!data) GTEST_SKIP() << "needs SPHERETREE_DATA";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(data) + "/vdb")) {
        if (entry.path().extension() != ".vdb") continue;
        SCOPED_TRACE(entry.path());
        io::File file(entry.path().string());
        file.open(/*delayLoad=*/false);
        std::filebuf source;
        ASSERT_TRUE(source.open(entry.path(), std::ios::in | std::ios::binary));
        expectSame(readVdbGrids(source), *file.getGrids());
        ++files;
    }
    EXPECT_GE(files, 5);
}

/// What metadata says of half precision holds for real values alone.
TEST_F(VdbGrids, OfIntegersSaidToBeInHalfPrecision)
{
    for (const auto& grid : vdbSamples()) {
        if (grid->getName() != "int32" && grid->getName() != "vec3i") continue;
        grid->setSaveFloatAsHalf(true);
        for (const uint32_t compression : vdbCompressions()) {
            const std::string bytes = vdbBytes({grid}, compression);
            expectSame(readGuarded(bytes), readByOpenVdb(bytes));
        }
    }
}

/// Their layout is the present one, but for types and compressions that came later.
TEST_F(VdbGrids, AreReadFromFilesOfVersions222And223)
{
    const auto samples = vdbSamples();
    for (const uint32_t compression : vdbCompressions()) {
        if (compression & io::COMPRESS_BLOSC) continue;
        for (const char version : {'\xde', '\xdf'}) {
            std::string bytes = vdbBytes({samples.begin(), samples.begin() + 8}, compression);
            ASSERT_EQ(bytes.at(8), '\xe0');
            bytes.at(8) = version;
            expectSame(readGuarded(bytes), readByOpenVdb(bytes));
        }
    }
}

TEST_F(VdbGrids, OfPointIndicesAreReadFromOneLeafAndRefusedFromMore)
{
    const std::string one = vdbBytes({pointIndexSample(1)}, io::COMPRESS_BLOSC);
    expectSame(readGuarded(one), readByOpenVdb(one));
    const std::string more = vdbBytes({pointIndexSample(2)}, io::COMPRESS_BLOSC);
    EXPECT_THROW(readGuarded(more), openvdb::IoError);
}

TEST_F(VdbGrids, TakeNothingBehindTheLastGridForTheirOwn)
{
    const std::string bytes = vdbBytes({vdbSamples().front()}, io::COMPRESS_NONE);
    EXPECT_EQ(readGuarded(bytes + "more").size(), 1u);
}

/// A `.vdb` of one leaf as early versions wrote it: 219 and 220 have no more than their header in common.
class EarlyFile : VdbBytes {
public:
    /// @param zip  versions that can do without say so
    EarlyFile(uint32_t version, uint32_t library, bool zip) : mVersion(version), mZip(zip)
    {
        fileHead(version, library, zip);
    }

    std::string levelSet(bool frustum = false)
    {
        const bool zip = mZip;
        descriptorOf("density", "Tree_float_5_4_3");
        put<uint32_t>(0); // metadata
        if (frustum) frustumMap();
        unitScale();
        put<int32_t>(1);  // buffers
        put<float>(2.5f); // background
        put<uint32_t>(0);
        put<uint32_t>(1);
        for (int i = 0; i < 3; ++i) put<int32_t>(4096 * i);
        internal<4096>(32768, zip);
        internal<512>(4096, zip);
        mask<64>(5);
        leaf(zip);
        return mBytes;
    }

private:
    /// Up to the linear map that is part of it.
    void frustumMap()
    {
        text("NonlinearFrustumMap");
        for (const int corner : {0, 0, 0, 8, 9, 10}) {
            if (mVersion < 221) put<int32_t>(corner);
            if (mVersion >= 221) put<double>(corner);
        }
        put<double>(0.5); // taper
        put<double>(2);   // depth
    }
    /// A mask of so many bytes with its bit @a on set.
    template <size_t Bytes>
    void mask(int on)
    {
        std::string bytes(Bytes, '\0');
        if (on >= 0) bytes[size_t(on) / 8] = char(1 << on % 8);
        mBytes += bytes;
    }
    /// One child, the first, and all other values zero.
    template <size_t MaskBytes>
    void internal(uint32_t values, bool zip)
    {
        mask<MaskBytes>(0);
        mask<MaskBytes>(-1);
        if (zip) put<int64_t>(-int64_t(4 * (values - 1)));
        mBytes += std::string(4 * (values - 1), '\0');
    }
    void leaf(bool zip)
    {
        mask<64>(5);
        for (int i = 0; i < 3; ++i) put<int32_t>(4096 * i); // origin
        put<int8_t>(2);                                     // buffers
        for (int buffer = 0; buffer < 2; ++buffer) {
            if (zip) put<int64_t>(-2048);
            for (int i = 0; i < 512; ++i) put(float(i + buffer));
        }
    }

    uint32_t mVersion;
    bool mZip;
};

TEST_F(VdbGrids, AreReadFromFilesOfEarlyVersions)
{
    for (const uint32_t version : {219u, 220u, 221u}) {
        SCOPED_TRACE(version);
        const std::string bytes = EarlyFile(version, 1, /*zip=*/true).levelSet();
        const auto grids = readGuarded(bytes);
        expectSame(grids, readByOpenVdb(bytes));
        const std::string frustum = EarlyFile(version, 1, /*zip=*/true).levelSet(/*frustum=*/true);
        expectSame(readGuarded(frustum), readByOpenVdb(frustum));
        if (version > 219) {
            const std::string plain = EarlyFile(version, 1, /*zip=*/false).levelSet();
            expectSame(readGuarded(plain), readByOpenVdb(plain));
        }
        const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(grids.at(0));
        EXPECT_EQ(grid->activeVoxelCount(), 1u);
        EXPECT_EQ(grid->tree().getValue(openvdb::Coord(0, 4096, 8197)), 5.0f);
    }
}

TEST_F(VdbGrids, OfFilesOlderThanOpenVdbOneAreRefused)
{
    const std::string bytes = EarlyFile(218, 0, /*zip=*/true).levelSet();
    try {
        readGuarded(bytes);
        FAIL() << "it was read";
    } catch (const openvdb::IoError& error) {
        EXPECT_NE(std::string(error.what()).find("version 218"), std::string::npos) << error.what();
    }
}

TEST_F(VdbGrids, OfTheFilesOfEarlierVersions)
{
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(dataPath(""))) {
        const std::string name =
            std::filesystem::relative(entry.path(), dataPath("")).replace_extension();
        if (entry.path().extension() != ".gz" || name.find(".vdb") == std::string::npos) continue;
        SCOPED_TRACE(name);
        const std::string bytes = unpackedData(name);
        expectSame(readGuarded(bytes), readByOpenVdb(bytes));
        ++files;
    }
    EXPECT_GE(files, 21);
}

} // namespace
