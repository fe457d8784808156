// SPDX-License-Identifier: Apache-2.0
/// @file TestVolFile.cc
/// @brief `.vol` and `.longvol` files: every voxel where it belongs, and every broken file refused.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/vol/VolFile.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using spheretree_test::mentions;

constexpr std::uint64_t kInt64Max = std::numeric_limits<std::int64_t>::max();

struct Volume {
    std::array<int, 3> dim;
    std::vector<std::uint64_t> values; // x fastest

    std::uint64_t at(int x, int y, int z) const
    {
        return values[(std::size_t(z) * dim[1] + y) * dim[0] + x];
    }
};

/// About @a percent of the voxels are set, to any value from 1 to @a max.
Volume randomVolume(std::array<int, 3> dim, int percent, std::uint64_t max)
{
    std::mt19937_64 random(1009 * dim[0] + 31 * dim[1] + dim[2] + percent);
    Volume volume{dim, std::vector<std::uint64_t>(std::size_t(dim[0]) * dim[1] * dim[2])};
    for (auto& value : volume.values) {
        if (int(random() % 100) < percent) value = 1 + random() % max;
    }
    return volume;
}

std::string headerOf(const std::array<int, 3>& dim, int version)
{
    return "Center-X: 7\nX: " + std::to_string(dim[0]) + "\nY: " + std::to_string(dim[1])
        + "\nZ: " + std::to_string(dim[2])
        + "\nAlpha-Color: 0\nInt-Endian: 0123\nVersion: " + std::to_string(version) + "\n.\n";
}

std::string bytesOf(const Volume& volume, int bytesPerValue)
{
    std::string bytes;
    for (const std::uint64_t value : volume.values) {
        for (int i = 0; i < bytesPerValue; ++i) bytes.push_back(char(value >> (8 * i)));
    }
    return bytes;
}

std::string zipped(const std::string& bytes)
{
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    EXPECT_EQ(Z_OK,
        compress(reinterpret_cast<Bytef*>(out.data()), &size,
            reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    out.resize(size);
    return out;
}

/// A file in the folder for temporary files, gone when the test is over.
struct TempFile {
    std::string path;

    TempFile(const std::string& name, const std::string& contents)
        : path(testing::TempDir() + "VolFile_" // tests may run at the same time
            + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name)
    {
        std::ofstream(path, std::ios::binary) << contents;
    }
    ~TempFile() { std::filesystem::remove(path); }
};

/// @return what readVolFile() says of the file, or nothing if it read it.
std::string errorOf(const std::string& path)
{
    try {
        readVolFile(path);
    } catch (const openvdb::IoError& error) {
        return error.what();
    }
    return {};
}

std::string errorOf(const std::string& name, const std::string& contents)
{
    const TempFile file(name, contents);
    const std::string error = errorOf(file.path);
    EXPECT_TRUE(error.empty() || error.find(file.path) != std::string::npos) << error;
    return error;
}

template <typename GridT>
void expectVoxels(const Volume& volume, const openvdb::GridBase::Ptr& base)
{
    const auto grid = openvdb::gridPtrCast<GridT>(base);
    ASSERT_TRUE(grid) << base->type();
    openvdb::Index64 active = 0;
    for (int z = 0; z < volume.dim[2]; ++z) {
        for (int y = 0; y < volume.dim[1]; ++y) {
            for (int x = 0; x < volume.dim[0]; ++x) {
                const std::uint64_t value = volume.at(x, y, z);
                active += value != 0;
                ASSERT_EQ(value != 0, grid->tree().isValueOn(Coord(x, y, z))) << Coord(x, y, z);
                ASSERT_EQ(std::min(value, kInt64Max),
                    std::uint64_t(grid->tree().getValue(Coord(x, y, z))))
                    << Coord(x, y, z);
            }
        }
    }
    EXPECT_EQ(active, grid->activeVoxelCount()); // so nothing is active outside the volume
    EXPECT_EQ(0, grid->background());
}

const std::vector<std::array<int, 3>> kShapes = {
    {1, 1, 1}, {8, 8, 8}, {13, 9, 17}, {7, 30, 8}, {40, 1, 9}, {1, 3, 25}, {16, 24, 32}};

TEST(VolFile, ReadsEveryVoxelOfBothVersions)
{
    for (const auto& shape : kShapes) {
        for (const int percent : {3, 50, 100}) {
            const Volume volume = randomVolume(shape, percent, 255);
            const std::string bytes = bytesOf(volume, 1);
            const TempFile raw("raw.vol", headerOf(shape, 2) + bytes);
            expectVoxels<openvdb::Int32Grid>(volume, readVolFile(raw.path));
            const TempFile zip("zip.vol", headerOf(shape, 3) + zipped(bytes));
            expectVoxels<openvdb::Int32Grid>(volume, readVolFile(zip.path));
        }
    }
}

TEST(VolFile, ReadsEveryVoxelOfALongvolAndSaturatesWhatInt64CannotHold)
{
    for (const auto& shape : kShapes) {
        Volume volume = randomVolume(shape, 40, std::numeric_limits<std::uint64_t>::max());
        volume.values[0] = kInt64Max + 1;
        const std::string bytes = bytesOf(volume, 8);
        const TempFile raw("raw.longvol", headerOf(shape, 2) + bytes);
        expectVoxels<openvdb::Int64Grid>(volume, readVolFile(raw.path));
        const TempFile zip("zip.LongVol", headerOf(shape, 3) + zipped(bytes));
        expectVoxels<openvdb::Int64Grid>(volume, readVolFile(zip.path));
    }
}

TEST(VolFile, NamesTheGridAfterTheFileAndUsesTheIdentity)
{
    const TempFile file("my.scan.vol", "X: 2\nY: 1\nZ: 1\n.\nab");
    const auto grid = readVolFile(file.path);
    EXPECT_EQ(std::filesystem::path(file.path).stem().string(), grid->getName());
    EXPECT_EQ("my.scan", grid->getName().substr(grid->getName().size() - 7));
    EXPECT_EQ(*openvdb::math::Transform::createLinearTransform(1), grid->transform());
}

TEST(VolFile, AFileMayBeShownUnderAnotherName)
{
    const TempFile file("nothing", "X: 1\nY: 1\nZ: 1\n.\n" + std::string(8, '\1'));
    const auto grid = readVolFile(file.path, nullptr, "stdin.longvol");
    EXPECT_EQ("stdin", grid->getName());
    EXPECT_TRUE(grid->isType<openvdb::Int64Grid>()) << "the other name says the format";
    try {
        readVolFile(
            file.path, nullptr, "stdin.vol"); // of which it is none: there are 7 values too many
        ADD_FAILURE() << "it was read";
    } catch (const openvdb::IoError& error) {
        EXPECT_NE(std::string(error.what()).find("stdin.vol: "), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find(file.path), std::string::npos) << error.what();
    }
}

TEST(VolFile, ScalesByVoxelSizeAndIgnoresCenterAndUnknownKeys)
{
    const TempFile file("size.vol",
        "Center-X: 5\r\nVoxel-Size: 0.25\r\nX:2\r\nY : 1\r\nZ: 1 \r\nNew: a: b\r\n.\r\nab");
    const auto grid = readVolFile(file.path);
    EXPECT_EQ(openvdb::Vec3d(0.25), grid->voxelSize());
    EXPECT_EQ(openvdb::Vec3d(0.25, 0, 0), grid->indexToWorld(Coord(1, 0, 0)));
    EXPECT_EQ(2u, grid->activeVoxelCount());
}

TEST(VolFile, ReadsAVolumeOfZerosAsAnEmptyGrid)
{
    const Volume volume = randomVolume({20, 20, 20}, 0, 1);
    const TempFile file("zeros.vol", headerOf(volume.dim, 3) + zipped(bytesOf(volume, 1)));
    const auto grid = readVolFile(file.path);
    EXPECT_TRUE(grid->empty());
}

TEST(VolFile, KnowsItsFilesByTheirExtensionInAnyCase)
{
    for (const char* name : {"a.vol", "b/c.VOL", "x.LongVol", "Al.100.vol"}) {
        EXPECT_TRUE(isVolFileName(name)) << name;
    }
    for (const char* name : {"vol", "a.vol.gz", "a.vdb", "", "a.volume", "dir.vol/file"}) {
        EXPECT_FALSE(isVolFileName(name)) << name;
    }
}

TEST(VolFile, RejectsEveryTruncationOfASmallFile)
{
    for (const int bytesPerValue : {1, 8}) {
        const Volume volume = randomVolume({9, 4, 10}, 30, 255);
        const std::string bytes = bytesOf(volume, bytesPerValue);
        const std::string name = bytesPerValue == 1 ? "cut.vol" : "cut.longvol";
        for (const int version : {2, 3}) {
            const std::string whole =
                headerOf(volume.dim, version) + (version == 2 ? bytes : zipped(bytes));
            ASSERT_EQ("", errorOf(name, whole));
            for (std::size_t length = 0; length < whole.size(); ++length) {
                ASSERT_NE("", errorOf(name, whole.substr(0, length)))
                    << "version " << version << " cut to " << length << " of " << whole.size();
            }
        }
    }
}

TEST(VolFile, RejectsAWholeStreamOfTooFewValues)
{
    const Volume volume = randomVolume({9, 4, 10}, 30, 255);
    const std::string bytes = bytesOf(volume, 1);
    for (const std::size_t missing : {std::size_t(1), bytes.size() / 2, bytes.size()}) {
        const std::string some = bytes.substr(0, bytes.size() - missing);
        EXPECT_TRUE(mentions(errorOf("few.vol", headerOf(volume.dim, 3) + zipped(some)),
            "ends before the values of the header"))
            << missing;
    }
}

TEST(VolFile, RejectsADamagedStreamWhicheverByteIsHit)
{
    const Volume volume = randomVolume({9, 4, 10}, 30, 255);
    const std::string header = headerOf(volume.dim, 3);
    const std::string stream = zipped(bytesOf(volume, 1));
    for (std::size_t i = 0; i < stream.size(); ++i) {
        std::string damaged = stream;
        damaged[i] = char(damaged[i] ^ 0x55);
        ASSERT_NE("", errorOf("damaged.vol", header + damaged)) << "byte " << i;
    }
}

TEST(VolFile, RejectsWhatFollowsTheValues)
{
    const Volume volume = randomVolume({9, 4, 10}, 30, 255);
    const std::string bytes = bytesOf(volume, 1);
    EXPECT_NE("", errorOf("tail.vol", headerOf(volume.dim, 2) + bytes + "\n"));
    EXPECT_NE("", errorOf("tail.vol", headerOf(volume.dim, 3) + zipped(bytes) + "\n"));
    EXPECT_NE("", errorOf("tail.vol", headerOf(volume.dim, 3) + zipped(bytes + "x")));
}

TEST(VolFile, RejectsSidesThatAreNotPositiveNumbersInRange)
{
    for (const char* key : {"X", "Y", "Z"}) {
        for (const char* side : {"0", "-1", "", "1.5", "1 1", "+1", "0x1", "one", "1048577",
                 "4294967297", "18446744073709551617", "99999999999999999999999999", "1e3"}) {
            std::string header = "X: 1\nY: 1\nZ: 1\n.\na";
            header.replace(header.find(key) + 3, 1, side);
            const std::string error = errorOf("side.vol", header);
            EXPECT_NE(std::string::npos, error.find("'" + std::string(key) + "'"))
                << key << ": " << side << ": " << error;
        }
    }
}

TEST(VolFile, RejectsAHeaderWhoseVolumeTheFileCannotHold)
{
    for (const char* version : {"2", "3"}) {
        const std::string rest = std::string("Version: ") + version + "\n.\nabc";
        for (const char* sides : {"X: 1\nY: 4\nZ: 100000\n",
                 "X: 65536\nY: 65536\nZ: 1\n",              // 2^32: 0 in 32 bits
                 "X: 1048576\nY: 1048576\nZ: 1048576\n"}) { // 2^63 bytes in a .longvol
            for (const char* name : {"lie.vol", "lie.longvol"}) {
                const std::string error = errorOf(name, sides + rest);
                EXPECT_NE(std::string::npos, error.find("X, Y, Z")) << error;
            }
        }
    }
}

TEST(VolFile, ReadsAVolumeAsCompressibleAsDeflateAllows)
{
    const std::string zeros(20000000, '\0');
    const TempFile file("flat.vol", "X: 2000\nY: 1000\nZ: 10\nVersion: 3\n.\n" + zipped(zeros));
    EXPECT_TRUE(readVolFile(file.path)->empty());
}

TEST(VolFile, RejectsAMissingKeyAndNamesIt)
{
    EXPECT_NE(std::string::npos, errorOf("key.vol", "Y: 1\nZ: 1\n.\na").find("'X'"));
    EXPECT_NE(std::string::npos, errorOf("key.vol", "X: 1\nZ: 1\n.\na").find("'Y'"));
    EXPECT_NE(std::string::npos, errorOf("key.vol", "X: 1\nY: 1\n.\na").find("'Z'"));
}

TEST(VolFile, RejectsAKeyGivenTwice)
{
    const std::string error = errorOf("twice.vol", "X: 1\nY: 1\nX: 1\nZ: 1\n.\na");
    EXPECT_NE(std::string::npos, error.find("'X'")) << error;
}

TEST(VolFile, RejectsOtherVersionsAndVoxelSizes)
{
    for (const char* text : {"1", "4", "", "2.0", "three", "-3"}) {
        const std::string line = "Version: " + std::string(text) + "\n";
        const std::string error = errorOf("version.vol", "X: 1\nY: 1\nZ: 1\n" + line + ".\na");
        EXPECT_NE(std::string::npos, error.find("'Version'")) << text << ": " << error;
    }
    for (const char* text : {"0", "-1", "", "nan", "inf", "1e999", "1e-300", "1 1", "small"}) {
        const std::string line = "Voxel-Size: " + std::string(text) + "\n";
        const std::string error = errorOf("size.vol", "X: 1\nY: 1\nZ: 1\n" + line + ".\na");
        EXPECT_NE(std::string::npos, error.find("'Voxel-Size'")) << text << ": " << error;
    }
}

TEST(VolFile, RejectsAHeaderThatIsNoHeader)
{
    EXPECT_NE("", errorOf("empty.vol", ""));
    EXPECT_NE("", errorOf("nodot.vol", "X: 1\nY: 1\nZ: 1\na"));
    EXPECT_NE("", errorOf("nocolon.vol", "X: 1\nY: 1\nZ 1\n.\na"));
    EXPECT_NE("", errorOf("noise.vol", std::string(1000000, 'x')));
    EXPECT_NE("", errorOf("lines.vol", std::string(1000000, '\n')));

    std::string endless;
    for (int i = 0; i < 100000; ++i) endless += "K" + std::to_string(i) + ": 1\n";
    EXPECT_NE("", errorOf("endless.vol", endless + "X: 1\nY: 1\nZ: 1\n.\na"));
}

TEST(VolFile, KeepsItsMessagesShortAndPrintable)
{
    const std::string error =
        errorOf("noise.vol", "X: \x1b[2J" + std::string(60000, 'x') + "\nY: 1\nZ: 1\n.\na");
    EXPECT_LT(error.size(), 400u);
    EXPECT_EQ(std::string::npos, error.find('\x1b'));
}

TEST(VolFile, RejectsAMissingFileAndADirectory)
{
    const std::string missing = testing::TempDir() + "spheretree_no_such_file.vol";
    EXPECT_NE(std::string::npos, errorOf(missing).find(missing));
    EXPECT_NE(std::string::npos, errorOf(testing::TempDir()).find("directory"));
}

/// Says stop at its second question.
struct ImpatientInterrupter final : openvdb::util::NullInterrupter {
    int started = 0, asked = 0, ended = 0;
    void start(const char* = nullptr) override { ++started; }
    void end() override { ++ended; }
    bool wasInterrupted(int = -1) override { return ++asked >= 2; }
};

TEST(VolFile, StopsWhenInterrupted)
{
    const Volume volume = randomVolume({8, 8, 64}, 50, 255);
    const TempFile file("long.vol", headerOf(volume.dim, 2) + bytesOf(volume, 1));
    ImpatientInterrupter interrupter;
    EXPECT_THROW(readVolFile(file.path, &interrupter), Interrupted);
    EXPECT_EQ(2, interrupter.asked);
    EXPECT_EQ(1, interrupter.started);
    EXPECT_EQ(1, interrupter.ended);
}

TEST(VolFile, CountsTheVoxelsOfTheSampleFiles)
{
    const char* folder = std::getenv("SPHERETREE_DATA");
    if (!folder) GTEST_SKIP() << "needs SPHERETREE_DATA";
    const std::vector<std::pair<std::string, openvdb::Index64>> counts = {{"cat10.vol", 8043},
        {"Al.100.vol", 70413}, {"lobster.vol", 3831352}, {"dragon-128.vol", 112328},
        {"dragon-512.vol", 7446783}, {"lucy-boundary-512.vol", 381772}};
    for (const auto& [name, count] : counts) {
        const auto grid = readVolFile(folder + ("/vol/" + name));
        EXPECT_EQ(count, grid->activeVoxelCount()) << name;
        if (name == "Al.100.vol") {
            EXPECT_EQ(Coord(37, 92, 100), grid->evalActiveVoxelDim());
        }
        if (name == "dragon-512.vol") {
            EXPECT_EQ(19263u, openvdb::gridPtrCast<openvdb::Int32Grid>(grid)->tree().leafCount());
        }
    }
    const auto labels = readVolFile(std::string(folder) + "/vol/test.longvol");
    EXPECT_TRUE(labels->isType<openvdb::Int64Grid>());
}

} // namespace
