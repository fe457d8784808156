// SPDX-License-Identifier: Apache-2.0
// Frame numbers in names of files, ranges of frames, and the values of loops.

#include <base/Errors.h>
#include <expression/FrameName.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace {

using command::framesOfRange;
using command::hasFrame;
using command::withFrame;
using Frames = std::vector<int64_t>;

TEST(FrameName, HasItsNumberAsPrintfHasIt)
{
    EXPECT_EQ(withFrame("a_####.vdb", 12), "a_0012.vdb");
    EXPECT_EQ(withFrame("a_%04d.vdb", 12), "a_0012.vdb");
    EXPECT_EQ(withFrame("a_##.vdb", 1234), "a_1234.vdb");
    EXPECT_EQ(withFrame("a.%d", 12), "a.12");
    EXPECT_EQ(withFrame("%4d", 12), "  12");
    EXPECT_EQ(withFrame("####", -1), "-001");
    EXPECT_EQ(withFrame("s##/a_##_%d", 7), "s07/a_07_7");
}

TEST(FrameName, AllElseIsAPartOfTheName)
{
    for (const char* name : {"a#1.vdb", "50%", "a%", "%s", "%%", "%12d", "100%done", "#", ""}) {
        EXPECT_EQ(hasFrame(name), std::string(name) == "100%done") << name; // %d of %done
    }
}

TEST(FrameName, APatternHasAllNamesThatDifferByOneNumber)
{
    using command::patternOf;
    EXPECT_EQ(patternOf({"a_0001.vdb", "a_0002.vdb"}), "a_####.vdb");
    EXPECT_EQ(
        patternOf({"s/a_0999.v2.png", "s/a_1000.v2.png", "s/a_0998.v2.png"}), "s/a_####.v2.png");
    EXPECT_EQ(patternOf({"a9.png", "a10.png", "a11.png"}), "a%d.png");
    EXPECT_EQ(patternOf({"1", "2"}), "%d");
    EXPECT_EQ(patternOf({"a_19", "a_11"}), "a_##");
    EXPECT_EQ(patternOf({"a_1.vdb", "b_2.vdb"}), "");
    EXPECT_EQ(patternOf({"a_1.vdb", "a_1.vdb"}), "");
    EXPECT_EQ(patternOf({"a_1.vdb", "a_.vdb"}), "");
    EXPECT_EQ(patternOf({"a_1.vdb"}), "");
    EXPECT_EQ(patternOf({"a_1_1.vdb", "a_2_2.vdb"}), "");
}

TEST(FrameName, RangesAreThoseOfRenderFarms)
{
    EXPECT_EQ(framesOfRange("7"), Frames({7}));
    EXPECT_EQ(framesOfRange("1-4"), Frames({1, 2, 3, 4}));
    EXPECT_EQ(framesOfRange("1-8x3"), Frames({1, 4, 7}));
    EXPECT_EQ(framesOfRange("5,1-2,9"), Frames({5, 1, 2, 9}));
    EXPECT_EQ(framesOfRange("-2-1"), Frames({-2, -1, 0, 1}));
    EXPECT_EQ(framesOfRange("-3--2"), Frames({-3, -2}));
    for (const char* bad : {"", "a", "1-", "1,", ",1", "3-1", "1-3x0", "1-3x", "1-3x-1", "1.5",
             "1-2-3", "1-9999999999", "1,1", "99999999999999999999", "1 "}) {
        EXPECT_THROW(framesOfRange(bad), command::CommandError) << bad;
    }
}

TEST(FrameName, RangesAreToldAsTheyAreTyped)
{
    EXPECT_EQ(command::rangeOfFrames({1, 2, 3, 5, 8, 9}), "1-3, 5, 8, 9");
    EXPECT_EQ(command::rangeOfFrames({}), "");
}

TEST(FrameName, NamesWithAnyDigitsTakeAllNumbers)
{
    EXPECT_EQ(command::withAnyDigits("a_####.vdb"), "a_%d.vdb");
    EXPECT_EQ(command::withAnyDigits("f_%04d/a_##.vdb"), "f_%d/a_%d.vdb");
    EXPECT_EQ(command::withAnyDigits("a_#.vdb"), "a_#.vdb");
}

TEST(FrameName, FramesOnDiskAreThoseWithExactlySuchNames)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("frames_" + std::to_string(getpid()));
    fs::create_directory(folder);
    for (const char* name : {"a_0002.vdb", "a_0010.vdb", "a_12345.vdb", "a_2.vdb", "a_00003.vdb",
             "a_0004.vdb.bak", "b_0005.vdb", "a_-006.vdb", "a_.vdb"}) {
        std::ofstream(folder / name) << "x";
    }
    EXPECT_EQ(command::framesOnDisk(folder / "a_####.vdb"), Frames({-6, 2, 10, 12345}));
    EXPECT_EQ(command::framesOnDisk(folder / "a_%d.vdb"), Frames({2, 12345}));
    EXPECT_EQ(command::framesOnDisk(folder / "c_####.vdb"), Frames());
    EXPECT_EQ(command::framesOnDisk(folder / "none" / "a_####.vdb"), Frames());
    // Numbers that are no frame's: passed over, the file would be missing without a word.
    for (const char* const number :
        {"99999999999999999999", "-9223372036854775808", "1000000000000001"}) {
        const fs::path file = folder / ("a_" + std::string(number) + ".vdb");
        std::ofstream(file) << "x";
        EXPECT_THROW(command::framesOnDisk(folder / "a_####.vdb"), command::CommandError) << number;
        EXPECT_EQ(command::framesOnDisk(folder / "b_####.vdb"), Frames({5}));
        fs::remove(file);
    }
    fs::remove_all(folder);
}

} // namespace
