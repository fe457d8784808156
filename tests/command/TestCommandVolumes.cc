// SPDX-License-Identifier: Apache-2.0
// Volumes and pictures of other tools, read by the command: options, stacks, pipes, and what is said of
// lines that cannot be.

#include "CommandRunner.h"

#include "support/DataFolder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;

/// Samples of tests/data/volumes are copied to the folder that the command runs in.
class CommandVolumes : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        for (const auto& file :
            std::filesystem::directory_iterator(spheretree_test::dataPath("volumes"))) {
            std::filesystem::copy_file(file.path(), path(file.path().filename().string()));
        }
    }

    /// Of the object of a line.
    nlohmann::json statsOf(const std::string& read)
    {
        const Result result =
            run("-quiet " + read + " -spheretree tree=reversible -stats json=numbers.json");
        EXPECT_EQ(result.exitCode, 0) << read << ": " << result.err;
        return nlohmann::json::parse(readText(path("numbers.json")));
    }

    void expectError(const std::string& line, int code, const std::string& text)
    {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, code) << line << ": " << result.err;
        EXPECT_NE(result.err.find(text), std::string::npos) << line << ": " << result.err;
    }
};

constexpr int kVoxels = 40; ///< of 60 that are not 0

TEST_F(CommandVolumes, AreTheSameObjectInEveryFormat)
{
    for (const char* read :
        {"-read bool.npy", "-read big_f8.npy", "-read zyx.npy axes=zyx",
            "-read little_u2.raw shape=4,3,5 type=uint16",
            "-read big_f4.raw shape=4,3,5 type=float32 endian=big", "-read placed.nrrd",
            "-read sform.nii.gz", "-read slice_%03d.png", "-read slice_###.png", "-read s%d.pgm"}) {
        SCOPED_TRACE(read);
        const auto object = statsOf(read)["object"];
        EXPECT_EQ(object["voxels"], kVoxels);
        EXPECT_EQ(object["bbox_max"], nlohmann::json({3, 2, 4}));
    }
}

TEST_F(CommandVolumes, TakeTheOptionsOfOtherGrids)
{
    // Values above 80 are those of the last slice without its 80 and zeros.
    EXPECT_EQ(statsOf("-read little_i2.npy -mask threshold=80")["object"]["voxels"], 7);
    EXPECT_EQ(statsOf("-read gzip.nrrd spacing=2 -mask label=81,83")["object"]["voxels"], 2);
    EXPECT_NEAR(statsOf("-read qform.nii scale=0.5")["object"]["voxel_size"], 1, 1e-9);
    EXPECT_EQ(statsOf("-read i1.npy units=mm")["object"]["voxel_size"], 0.001);
    EXPECT_EQ(statsOf("-read slice_012.png spacing=0.25")["object"]["voxel_size"], 0.25);
    // Below 3 are the zeros and two voxels more; of what lies beyond the file, nobody knows.
    EXPECT_EQ(statsOf("-read little_i2.npy background=1000 -mask below=3")["object"]["voxels"], 22);
    expectError("-read little_i2.npy -mask below=3 -write m.vdb", 3, "background");
}

TEST_F(CommandVolumes, WithBoxesForVoxelsGoThroughResample)
{
    expectError("-read raw.nrrd -spheretree -write t.vdb", 3, "-resample voxel=0.5");
    EXPECT_EQ(statsOf("-read raw.nrrd -resample")["object"]["voxel_size"], 0.5);
    expectError("-read s%d.pgm spacing=1,1,2 -spheretree -write t.vdb", 3, "-resample voxel=1");
    EXPECT_EQ(statsOf("-read raw.nrrd spacing=1,1,1")["object"]["voxel_size"], 1);
    const std::string printed = run("-read raw.nrrd -print").out;
    EXPECT_NE(printed.find("0.5 x 0.5 x 1 (-resample makes cubes)"), std::string::npos) << printed;
}

TEST_F(CommandVolumes, APictureIsAnObjectIn2D)
{
    const Result result = run("-read slice_012.png -spheretree dim=2 -check");
    EXPECT_EQ(result.exitCode, 0) << result.err;
}

TEST_F(CommandVolumes, AVolTakesASpacingToo)
{
    writeBlock("a.vol");
    EXPECT_EQ(statsOf("-read a.vol spacing=0.25")["object"]["voxel_size"], 0.25);
    expectError("-read a.vol spacing=1e-5 -print", 3, "a.vol: voxels of 1e-05 x 1e-05 x 1e-05 are");
}

TEST_F(CommandVolumes, NumbersThatAreNoneAreTold)
{
    std::string bytes;
    for (const float number : {1.0f, std::nanf(""), 2.0f, std::nanf("")})
        bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
    command_test::writeText(path("holes.raw"), bytes);
    const Result result = run("-read holes.raw shape=4,1,1 type=float32 -mask -write m.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const std::string told =
        "warning: holes.raw: 2 values are no numbers (NaN), and count as background";
    EXPECT_NE(result.err.find(told), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("NaN"), result.err.rfind("NaN")) << "once: " << result.err;
}

TEST_F(CommandVolumes, ComeFromAPipe)
{
    for (const std::string name : {"sform.nii.gz", "i1.npy", "text.nrrd", "s12.pgm", "wide.png"}) {
        const std::string extension = name.substr(name.find('.'));
        const Result result =
            shell("$VDB_SPHERETREE -quiet -read stdin" + extension + " -print < " + name);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_NE(result.out.find("grid 'stdin'"), std::string::npos) << result.out;
    }
}

TEST_F(CommandVolumes, OptionsWithoutAFileOfTheirKindAreRefused)
{
    writeBlock("a.vol");
    writeText(path("some.csv"), "x,y,z,r\n0,0,0,1\n");
    expectError("-read i1.npy shape=4,3,5 -print", 2, "shape is for numbers of a .raw");
    expectError("-read i1.npy type=int8 -print", 2, "type is for numbers of a .raw");
    expectError("-read i1.npy endian=big -print", 2, "endian is for numbers of a .raw");
    expectError("-read raw.nrrd axes=zyx -print", 2, "axes is for arrays of a .npy");
    expectError("-read some.csv spacing=2 -print", 2, "spacing is for volumes");
    expectError("-read a.vol background=2 -print", 2, "background is for volumes");
    expectError("-read little_u2.raw -print", 2, "give its shape=X,Y,Z and its type");
    expectError("-read little_u2.raw shape=4,3,5 -print", 2, "give its shape=X,Y,Z and its type");
}

TEST_F(CommandVolumes, OptionsThatAreNoneAreRefused)
{
    for (const char* spacing : {"0", "1,2", "1,2,-3", "a", "1,2,3,4", "nan", ","}) {
        expectError(std::string("-read i1.npy spacing=") + spacing + " -print", 2, "spacing=");
    }
    for (const char* shape :
        {"4", "4,3,0", "4,3,5,6", "4,3,-5", "4;3;5", "1048577,1,1", "1e3,1,1"}) {
        expectError(
            std::string("-read little_u2.raw type=int16 shape=") + shape + " -print", 2, "shape=");
    }
    expectError("-read little_u2.raw shape=4,3,5 type=uint12 -print", 2, "type");
}

TEST_F(CommandVolumes, FilesThatAreNoneAreNamed)
{
    expectError("-read objects.npy -print", 3, "objects.npy: its numbers");
    expectError("-read color.png -print", 3, "color.png: pixel (2, 1) is not gray");
    expectError("-read hex.nrrd -print", 3, "hex.nrrd: its encoding is 'hex'");
    expectError("-read nifti2.nii -print", 3, "nifti2.nii: is a NIfTI-2");
    expectError("-read little_u2.raw shape=4,3,6 type=uint16 -print", 3, "holds 120");
    expectError("-read none_%04d.png -print", 3, "none_%04d.png: no file");
    std::filesystem::remove(path("slice_010.png"));
    expectError("-read slice_%03d.png -print", 3, "there is no slice_010.png");
    std::filesystem::remove(path("detached.raw.gz"));
    expectError("-read detached.nhdr -print", 3, "its data file './detached.raw.gz': no such file");
    std::filesystem::create_directory(path("in"));
    std::string header = readText(path("detached.nhdr"));
    header.replace(header.find("./detached.raw.gz"), 17, "../i1.npy");
    writeText(path("in/other.nhdr"), header);
    expectError("-read in/other.nhdr -print", 3,
        "in/other.nhdr: its data file '../i1.npy' is not in the header's folder");
}

TEST_F(CommandVolumes, OfOtherKindsAreRefusedWithWhatToDo)
{
    for (const char* name : {"a.tif", "a.mha", "a.dcm", "a.npz", "a.hdr", "a.jpg"}) {
        writeText(path(name), "something");
        expectError(std::string("-read ") + name + " -print", 3, "of this kind are not read");
    }
}

} // namespace
