// SPDX-License-Identifier: Apache-2.0
/// @file TestNearbyFiles.cc
/// @brief A file may name those of its folder and below, however they are spelt, and no others.

#include <openvdb_spheretree/base/NearbyFiles.h>

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace {

using openvdb_spheretree::detail::NearbyFiles;
namespace fs = std::filesystem;

TEST(NearbyFiles, AreThoseOfTheFolderAndBelow)
{
    const spheretree_test::TemporaryFolder temporary;
    const fs::path top = temporary.path(), folder = top / "in";
    fs::create_directories(folder / "deep/er");
    fs::create_directories(top / "in2");
    for (const char* name : {"in/a", "in/deep/er/b", "out", "in2/c"})
        std::ofstream(top / name) << 1;
    fs::create_symlink("../out", folder / "link_out");
    fs::create_symlink("deep/er/b", folder / "link_in");
    fs::create_symlink("..", folder / "up");
    fs::create_symlink("in/a", top / "link_a");
    // Of the file itself, by a link too: its parts are beside the file that the link leads to.
    for (const fs::path& file : {folder / "a", folder / "not_there", top / "link_a"}) {
        const NearbyFiles nearby(file.string());
        EXPECT_EQ(nearby.folder(), fs::canonical(folder)) << file;
        for (const char* name :
            {"a", "deep/er/b", "deep/../a", "link_in", "./not_there", "../in/a"})
            EXPECT_TRUE(nearby.hold((folder / name).string())) << file << ' ' << name;
        for (const char* name : {"../out", "deep/../../out", "link_out", "up/out", "../in2/c",
                 "up/not_there", "/etc/passwd", "/dev/zero"})
            EXPECT_FALSE(nearby.hold((folder / name).string())) << file << ' ' << name;
    }
}

TEST(NearbyFiles, AreCountedFromWhereTheProcessIs)
{
    const spheretree_test::TemporaryFolder temporary;
    const fs::path before = fs::current_path();
    fs::create_directory(temporary.path() + "/in");
    fs::current_path(temporary.path() + "/in");
    const NearbyFiles nearby("a");
    EXPECT_TRUE(nearby.hold("b"));
    EXPECT_TRUE(nearby.hold("in/b"));
    EXPECT_FALSE(nearby.hold("../b"));
    EXPECT_FALSE(nearby.hold(""));
    fs::current_path(before);
}

} // namespace
