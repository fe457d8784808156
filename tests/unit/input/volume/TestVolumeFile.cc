// SPDX-License-Identifier: Apache-2.0
/// @file TestVolumeFile.cc
/// @brief Volumes that were written by the tools of others (tests/data/volumes/make.py), voxel by
/// voxel.

#include <openvdb_spheretree/input/volume/VolumeFile.h>

#include <openvdb_spheretree/base/Interrupted.h>

#include "support/DataFolder.h"
#include "support/Messages.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::GridBase;
using openvdb::Vec3d;
using spheretree_test::TemporaryFolder;

std::string sample(const std::string& name) { return spheretree_test::dataPath("volumes/" + name); }

std::string bytesOfFile(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The rule of make.py.
int valueAt(const Coord& ijk)
{
    const int x = ijk[0], y = ijk[1], z = ijk[2];
    return (x + y + z) % 3 == 0 ? 0 : x + 5 * y + 20 * z;
}

const CoordBBox kAll(Coord(0), Coord(3, 2, 4));

/// Values are those of the rule, and zeros are inactive. @param voxels  of the rule that are there
template <typename GridT>
void expectRule(const GridBase::Ptr& base, const CoordBBox& voxels = kAll, double factor = 1)
{
    const auto grid = openvdb::gridPtrCast<GridT>(base);
    ASSERT_TRUE(grid) << base->type();
    const auto values = grid->getConstAccessor();
    openvdb::Index64 active = 0;
    for (auto ijk = voxels.begin(); ijk; ++ijk) {
        const Coord at = *ijk - voxels.min();
        const bool isBool = std::is_same_v<GridT, openvdb::BoolGrid>;
        const double expected = isBool ? valueAt(*ijk) != 0 : factor * valueAt(*ijk);
        ASSERT_EQ(double(values.getValue(at)), expected) << at;
        ASSERT_EQ(values.isValueOn(at), expected != 0) << at;
        active += expected != 0;
    }
    EXPECT_EQ(grid->activeVoxelCount(), active);
}

std::string errorOf(const std::string& path, const VolumeSettings& settings = {})
{
    try {
        readVolumeFile(path, settings);
    } catch (const openvdb::IoError& error) {
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
        return error.what();
    }
    return {};
}

bool mentions(const std::string& error, const std::string& what)
{
    return error.find(what) != std::string::npos || (ADD_FAILURE() << error, false);
}

TEST(VolumeFile, ReadsEveryTypeOfNumpy)
{
    expectRule<openvdb::BoolGrid>(readVolumeFile(sample("bool.npy")));
    for (const char* name : {"i1", "u1", "little_i2", "big_i2", "little_u2", "big_u2", "little_i4",
             "big_i4", "version2", "version3"}) {
        SCOPED_TRACE(name);
        expectRule<openvdb::Int32Grid>(readVolumeFile(sample(std::string(name) + ".npy")));
    }
    for (const char* name : {"little_u4", "little_i8", "big_i8", "little_u8"}) {
        SCOPED_TRACE(name);
        expectRule<openvdb::Int64Grid>(readVolumeFile(sample(std::string(name) + ".npy")));
    }
    for (const char* name : {"little_f2", "big_f2", "little_f4", "big_f4"}) {
        SCOPED_TRACE(name);
        expectRule<openvdb::FloatGrid>(readVolumeFile(sample(std::string(name) + ".npy")));
    }
    for (const char* name : {"little_f8", "big_f8"}) {
        SCOPED_TRACE(name);
        expectRule<openvdb::DoubleGrid>(readVolumeFile(sample(std::string(name) + ".npy")));
    }
}

TEST(VolumeFile, ReadsEveryOrderOfNumpy)
{
    expectRule<openvdb::Int32Grid>(readVolumeFile(sample("fortran.npy")));
    expectRule<openvdb::Int32Grid>(readVolumeFile(sample("four_axes.npy")));
    VolumeSettings zyx;
    zyx.zyx = true;
    expectRule<openvdb::Int32Grid>(readVolumeFile(sample("zyx.npy"), zyx));
    expectRule<openvdb::Int32Grid>(readVolumeFile(sample("zyx_fortran.npy"), zyx));
    const CoordBBox slice(Coord(0, 0, 4), Coord(3, 2, 4));
    expectRule<openvdb::Int32Grid>(readVolumeFile(sample("slice.npy")), slice);
    expectRule<openvdb::Int32Grid>(readVolumeFile(sample("slice_rows.npy"), zyx), slice);
}

TEST(VolumeFile, RefusesArraysThatAreNoNumbers)
{
    mentions(errorOf(sample("objects.npy")), "Python objects");
    mentions(errorOf(sample("records.npy")), "records");
    mentions(errorOf(sample("complex.npy")), "'c8'");
}

TEST(VolumeFile, ReadsPlainNumbers)
{
    VolumeSettings settings;
    mentions(errorOf(sample("little_u2.raw")), "shape=X,Y,Z");
    settings.shape = {4, 3, 5};
    settings.type = NumberType::UInt16;
    expectRule<openvdb::Int32Grid>(readVolumeFile(sample("little_u2.raw"), settings));
    settings.type = NumberType::Float32;
    mentions(errorOf(sample("little_u2.raw"), settings), "take 240 bytes, but the file holds 120");
    settings.bigEndian = true;
    expectRule<openvdb::FloatGrid>(readVolumeFile(sample("big_f4.raw"), settings));
    settings.shape = {4, 3, 4}; // without the first slice
    settings.headerBytes = 48;
    expectRule<openvdb::FloatGrid>(
        readVolumeFile(sample("big_f4.raw"), settings), CoordBBox(Coord(0, 0, 1), Coord(3, 2, 4)));
    settings.headerBytes = 49;
    mentions(errorOf(sample("big_f4.raw"), settings), "truncated");
    settings.headerBytes = 500;
    mentions(errorOf(sample("big_f4.raw"), settings), "holds 0");
}

/// The place that make.py has given: (x, y, z) to (10 - 2 y, 2 x - 5, 1 + 2 z).
void expectPlace(const GridBase& grid, double z = 2)
{
    const Vec3d at = grid.indexToWorld(Vec3d(1, 2, 3));
    EXPECT_TRUE(at.eq(Vec3d(6, -3, 1 + 3 * z), 1e-5)) << at;
    EXPECT_TRUE(grid.indexToWorld(Vec3d(0)).eq(Vec3d(10, -5, 1), 1e-5));
}

TEST(VolumeFile, ReadsNiftiInItsPlace)
{
    for (const char* name : {"sform.nii", "sform.nii.gz", "qform.nii", "big.nii"}) {
        SCOPED_TRACE(name);
        const GridBase::Ptr grid = readVolumeFile(sample(name));
        expectRule<openvdb::Int32Grid>(grid);
        expectPlace(*grid);
        EXPECT_EQ(grid->getName() + ".", std::string(name).substr(0, grid->getName().size() + 1));
    }
    expectPlace(*readVolumeFile(sample("mirrored.nii")), -2);
    const GridBase::Ptr scaled = readVolumeFile(sample("pixdim.nii"));
    expectRule<openvdb::FloatGrid>(scaled);
    EXPECT_EQ(scaled->indexToWorld(Vec3d(1)), Vec3d(0.5, 0.5, 1));
    expectRule<openvdb::FloatGrid>(readVolumeFile(sample("slope.nii")), kAll, 0.5);
    mentions(errorOf(sample("nifti2.nii")), "NIfTI-2");
}

TEST(VolumeFile, ReadsNrrdInItsPlace)
{
    for (const char* name : {"raw.nrrd", "gzip.nrrd", "text.nrrd", "detached.nhdr"}) {
        SCOPED_TRACE(name);
        const GridBase::Ptr grid = readVolumeFile(sample(name));
        expectRule<openvdb::Int32Grid>(grid);
        EXPECT_EQ(grid->indexToWorld(Vec3d(1)), Vec3d(0.5, 0.5, 1));
    }
    const GridBase::Ptr placed = readVolumeFile(sample("placed.nrrd"));
    expectRule<openvdb::FloatGrid>(placed);
    expectPlace(*placed);
    mentions(errorOf(sample("hex.nrrd")), "'hex'");
}

TEST(VolumeFile, DataFilesAreBelowTheFolderOfTheirHeader)
{
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const fs::path top = folder.path();
    fs::create_directories(top / "in/deep");
    for (const char* name : {"in/b.raw", "in/deep/b.raw", "b.raw"}) {
        std::ofstream(top / name) << std::string(60, 'x');
    }
    fs::create_symlink("../b.raw", top / "in/link.raw");
    const std::string header = (top / "in/a.nhdr").string();
    const auto write = [&](const std::string& data) {
        std::ofstream(header) << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 3 5\nencoding: "
                                 "raw\ndata file: "
                              << data << '\n';
    };
    for (const std::string data : {"b.raw", "deep/b.raw", "../in/b.raw"}) {
        write(data);
        EXPECT_EQ(readVolumeFile(header)->activeVoxelCount(), 60u) << data;
    }
    write((top / "in/b.raw").string());
    EXPECT_EQ(readVolumeFile(header)->activeVoxelCount(), 60u);
    for (const std::string& data :
        {std::string("../b.raw"), (top / "b.raw").string(), std::string("link.raw")}) {
        write(data);
        const std::string why = errorOf(header);
        mentions(why, "a.nhdr: its data file");
        mentions(why, "not in the header's folder or below");
        mentions(why, "move it there");
    }
    write("none.raw");
    mentions(errorOf(header), "no such file");
    fs::create_symlink("in/a.nhdr", top / "link.nhdr"); // beside what it leads to
    for (const std::string data : {"deep/b.raw", "../in/b.raw"}) {
        write(data);
        EXPECT_EQ(readVolumeFile((top / "link.nhdr").string())->activeVoxelCount(), 60u) << data;
    }
    write("../b.raw");
    mentions(errorOf((top / "link.nhdr").string()), "not in the header's folder or below");
}

/// Each time it is asked, it cuts a file.
class FileCutter : public openvdb::util::NullInterrupter {
public:
    explicit FileCutter(const std::string& path) : mPath(path) {}
    bool wasInterrupted(int = -1) override
    {
        std::filesystem::resize_file(mPath, 100);
        return false;
    }

private:
    const std::string mPath;
};

TEST(VolumeFile, ADataFileThatIsCutWhileItIsReadHasChanged)
{
    const TemporaryFolder folder;
    const std::string header = folder.path() + "/a.nhdr", data = folder.path() + "/a.raw";
    std::ofstream(header) << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 64 64 64\nencoding: "
                             "raw\ndata file: a.raw\n";
    std::ofstream(data) << std::string(64 * 64 * 64, 'x');
    FileCutter cutter(data);
    const auto whyNot = [&](openvdb::util::NullInterrupter* interrupter) {
        return spheretree_test::messageOf<openvdb::IoError>(
            [&] { readVolumeFile(header, {}, interrupter); });
    };
    mentions(whyNot(&cutter), "'a.raw': the file was changed while it was read");
    mentions(whyNot(nullptr), "truncated"); // it was before
}

TEST(VolumeFile, ReadsPicturesAsOneSlice)
{
    const CoordBBox slice(Coord(0, 0, 4), Coord(3, 2, 4));
    for (const char* name : {"slice_012.png", "wide.png", "rgb.png", "alpha.png", "palette.png",
             "interlaced.png", "s12.pgm", "text.pgm", "wide.pgm"}) {
        SCOPED_TRACE(name);
        expectRule<openvdb::Int32Grid>(readVolumeFile(sample(name)), slice);
    }
    const auto bits = openvdb::gridPtrCast<openvdb::Int32Grid>(readVolumeFile(sample("bits.png")));
    EXPECT_EQ(bits->tree().getValue(Coord(0)), 1); // one bit stays a one
    EXPECT_EQ(bits->tree().getValue(Coord(2, 0, 0)), 0);
    mentions(errorOf(sample("color.png")), "pixel (2, 1) is not gray");
}

TEST(VolumeFile, ReadsPicturesAsAStack)
{
    for (const char* name : {"slice_%03d.png", "slice_###.png", "s%d.pgm", "s#.pgm"}) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(isStackName(sample(name)));
        const GridBase::Ptr grid = readVolumeFile(sample(name));
        expectRule<openvdb::Int32Grid>(grid);
        EXPECT_EQ(grid->getName(), name[1] == 'l' ? "slice" : "s");
    }
    EXPECT_FALSE(isStackName(sample("slice_012.png")));
    EXPECT_FALSE(isStackName(sample("%d_%d.png")));
    EXPECT_FALSE(isStackName(sample("slice_%03d.npy")));
    EXPECT_FALSE(isStackName(sample("slice_%3d.png"))); // blanks are no digits
    mentions(errorOf(sample("slice_%04d.png")), "no file");
}

TEST(VolumeFile, RefusesStacksThatAreNone)
{
    const TemporaryFolder folder;
    const auto put = [&](const std::string& from, const std::string& to) {
        std::filesystem::copy_file(sample(from), folder.path() + "/" + to);
    };
    put("slice_008.png", "a08.png");
    put("slice_009.png", "a09.png");
    put("slice_010.png", "a010.png"); // another number of digits: none of the stack
    put("slice_011.png", "a11.png");
    const std::string stack = folder.path() + "/a%02d.png";
    put("slice_012.png", "a99999999999999999999.png");
    EXPECT_TRUE(mentions(errorOf(stack), "the number of a99999999999999999999.png is too large"));
    std::filesystem::remove(folder.path() + "/a99999999999999999999.png");
    EXPECT_TRUE(mentions(errorOf(stack), "a10.png, but"));
    put("wide.png", "a10.png");
    EXPECT_TRUE(mentions(errorOf(stack), "a10.png is 4 x 3 of 16 bits"));
    std::filesystem::remove(folder.path() + "/a10.png");
    std::ofstream(folder.path() + "/a10.png") << "no picture";
    EXPECT_TRUE(mentions(errorOf(stack), "a10.png: is no sound .png"));
    put("slice_008.png", "b9.png");
    put("slice_009.png", "b10.png");
    EXPECT_TRUE(mentions(
        errorOf(folder.path() + "/b##.png"), "b9.png as well, whose number has fewer digits"));
    EXPECT_EQ("", errorOf(folder.path() + "/b%d.png"));
}

TEST(VolumeFile, SpacingComesInPlaceOfWhatTheFileSays)
{
    VolumeSettings settings;
    settings.spacing = Vec3d(1, 2, 0.25);
    for (const char* name : {"i1.npy", "sform.nii", "raw.nrrd", "slice_%03d.png"}) {
        EXPECT_EQ(
            readVolumeFile(sample(name), settings)->indexToWorld(Vec3d(1)), Vec3d(1, 2, 0.25));
    }
    EXPECT_EQ(readVolumeFile(sample("i1.npy"))->indexToWorld(Vec3d(1)), Vec3d(1));
    settings.spacing = Vec3d(1, 0, 1);
    EXPECT_THROW(readVolumeFile(sample("i1.npy"), settings), openvdb::ValueError);
}

TEST(VolumeFile, TheBackgroundIsWhatVoxelsWithoutAValueHave)
{
    VolumeSettings settings;
    settings.background = 81;
    const auto grid =
        openvdb::gridPtrCast<openvdb::Int32Grid>(readVolumeFile(sample("i1.npy"), settings));
    EXPECT_EQ(grid->background(), 81);
    EXPECT_EQ(grid->activeVoxelCount(), 59u);
    EXPECT_FALSE(grid->tree().isValueOn(Coord(1, 0, 4))); // 81
    EXPECT_TRUE(grid->tree().isValueOn(Coord(0)));        // 0
    settings.background = 0.5;
    EXPECT_TRUE(mentions(errorOf(sample("i1.npy"), settings), "background=0.5"));
    settings.background = 1e20;
    EXPECT_TRUE(mentions(errorOf(sample("little_i8.npy"), settings), "background=1e+20"));
}

/// All samples that are read without settings.
std::vector<std::string> soundFiles()
{
    return {"bool.npy", "little_i2.npy", "big_f8.npy", "version2.npy", "sform.nii", "sform.nii.gz",
        "qform.nii", "raw.nrrd", "gzip.nrrd", "text.nrrd", "placed.nrrd", "wide.png", "rgb.png",
        "palette.png", "s12.pgm", "text.pgm", "wide.pgm"};
}

TEST(VolumeFile, RefusesEveryTruncation)
{
    const TemporaryFolder folder;
    for (const std::string& name : soundFiles()) {
        const std::string whole = bytesOfFile(sample(name));
        const std::string path = folder.path() + "/" + name;
        // The last bytes of text, a digit or a blank, may be missed by nobody.
        const bool isText = name == "text.nrrd" || name == "text.pgm";
        const std::size_t last = whole.size() - (isText ? 8 : 1);
        for (std::size_t length = 0; length <= last;
             length += length < 64 || length + 32 > last ? 1 : 7) {
            std::ofstream(path, std::ios::binary) << whole.substr(0, length);
            ASSERT_NE(errorOf(path), "") << name << " cut to " << length << " bytes";
        }
    }
}

TEST(VolumeFile, RefusesWhatFollowsTheNumbers)
{
    const TemporaryFolder folder;
    for (const std::string& name : soundFiles()) {
        if (name.find(".png") != std::string::npos) continue; // a chunk says that it is the last
        const std::string path = folder.path() + "/" + name;
        std::ofstream(path, std::ios::binary) << bytesOfFile(sample(name)) << " 7 7";
        EXPECT_NE(errorOf(path), "") << name;
    }
}

TEST(VolumeFile, KnowsItsFilesByTheirExtensionInAnyCase)
{
    for (const char* name :
        {"a.npy", "A.NRRD", "a.nhdr", "b.nii", "b.NII.gz", "a.raw", "a.PNG", "c.pgm"}) {
        EXPECT_TRUE(isVolumeFileName(name)) << name;
    }
    for (const char* name : {"a.vol", "a.gz", "nii.gz", "a.tif", "npy", ".npy/a", "a.nii.gz.txt"}) {
        EXPECT_FALSE(isVolumeFileName(name)) << name;
    }
}

TEST(VolumeFile, AFileMayBeShownUnderAnotherName)
{
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/x";
    std::filesystem::copy_file(sample("sform.nii.gz"), path);
    const GridBase::Ptr grid = readVolumeFile(path, {}, nullptr, "stdin.nii.gz");
    expectRule<openvdb::Int32Grid>(grid);
    EXPECT_EQ(grid->getName(), "stdin");
}

TEST(VolumeFile, IsTheSameForAnyNumberOfThreads)
{
    const auto all =
        openvdb::gridPtrCast<openvdb::Int32Grid>(readVolumeFile(sample("slice_%03d.png")));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto same =
        openvdb::gridPtrCast<openvdb::Int32Grid>(readVolumeFile(sample("slice_%03d.png")));
    EXPECT_TRUE(all->tree().hasSameTopology(same->tree()));
}

TEST(VolumeFile, CanBeInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    EXPECT_THROW(readVolumeFile(sample("i1.npy"), {}, &stop), Interrupted);
}

} // namespace
