// SPDX-License-Identifier: Apache-2.0
/// @file TestFileStamp.cc
/// @brief A file that is written to is another one; what takes its place, or goes, is no concern.

#include <openvdb_spheretree/base/FileStamp.h>

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>

namespace {

using openvdb_spheretree::detail::FileStamp;
namespace fs = std::filesystem;

class FileStampTest : public testing::Test {
protected:
    void SetUp() override { std::ofstream(path()) << "abc"; }
    std::string path(const char* name = "file") const { return mFolder.path() + "/" + name; }

private:
    const spheretree_test::TemporaryFolder mFolder;
};

TEST_F(FileStampTest, TellsWhatIsWrittenTo)
{
    const FileStamp stamp(path());
    EXPECT_TRUE(stamp.isUnchanged());
    EXPECT_EQ(stamp.path(), path());
    std::ofstream(path(), std::ios::app) << "d";
    EXPECT_FALSE(stamp.isUnchanged());
}

TEST_F(FileStampTest, TellsTheTimeToTheNanosecond)
{
    timespec times[] = {{1000, 5}, {1000, 5}};
    ASSERT_EQ(utimensat(AT_FDCWD, path().c_str(), times, 0), 0);
    const FileStamp stamp(path());
    EXPECT_TRUE(stamp.isUnchanged());
    for (const timespec other : {timespec{1000, 6}, timespec{1001, 5}}) {
        times[1] = other;
        ASSERT_EQ(utimensat(AT_FDCWD, path().c_str(), times, 0), 0);
        EXPECT_FALSE(stamp.isUnchanged());
    }
}

TEST_F(FileStampTest, OneFileHasManyNames)
{
    fs::create_hard_link(path(), path("link"));
    std::ofstream(path("other")) << "abc";
    struct stat file, link, other;
    ASSERT_EQ(stat(path().c_str(), &file), 0);
    ASSERT_EQ(stat(path("link").c_str(), &link), 0);
    ASSERT_EQ(stat(path("other").c_str(), &other), 0);
    EXPECT_TRUE(openvdb_spheretree::detail::isSameFile(file, link));
    EXPECT_TRUE(openvdb_spheretree::detail::isUnwritten(file, link));
    EXPECT_FALSE(openvdb_spheretree::detail::isSameFile(file, other));
}

TEST_F(FileStampTest, LeavesAloneWhatIsReplacedOrGone)
{
    const FileStamp stamp(path()), none(path("none")), folder(path(""));
    std::ofstream(path("new")) << "other";
    fs::rename(path("new"), path());
    EXPECT_TRUE(stamp.isUnchanged());
    fs::remove(path());
    EXPECT_TRUE(stamp.isUnchanged());
    std::ofstream(path("none")) << "later";
    EXPECT_TRUE(none.isUnchanged());
    EXPECT_TRUE(folder.isUnchanged());
}

} // namespace
