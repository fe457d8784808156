// SPDX-License-Identifier: Apache-2.0
// Files that have crashed the program or OpenVDB, or took gigabytes, each by its name: they end with the
// exit code of damaged input, in bounded memory. They are not part of the project: SPHERETREE_DATA names
// the folder.

#include "CommandRunner.h"
#include "support/Sanitizers.h"

#include <cstdlib>

#include <sys/resource.h>

namespace {

using command_test::CommandTest;
using command_test::Result;

struct DamagedFile {
    const char* name;
    int exitCode;
};

/// Sound files of objects at the ends of the coordinates are among them: reading these alone works.
constexpr DamagedFile kFiles[] = {
    {"ext.vdb.F13353.63a23fff.vdb", 3},
    {"ext.vdb.F17050.227e1900.vdb", 3},
    {"ls.vdb.F166.7d8d4e40.vdb", 3},
    {"ls.vdb.F74496.cd312bce.vdb", 3},
    {"mask.vdb.F8733.752f449e.vdb", 3},
    {"rev.vdb.F203.673b681f.vdb", 3},
    {"tight.vdb.F13322.50ce8475.vdb", 3},
    {"tight.vdb.F18811.2504579e.vdb", 3},
    {"tight.vdb.F3414.e9059454.vdb", 3},
    {"voln.vdb.F9078.867a31c0.vdb", 3},
    {"corner_max.vdb", 0},
    {"max_box0.vdb", 0},
    {"min_box0.vdb", 0},
    {"tilemax.vdb", 0},
};

class CommandDamaged : public CommandTest, public testing::WithParamInterface<DamagedFile> {
protected:
    /// What the command takes for any file, and some for each byte of this one. The process of a sanitizer has
    /// terabytes of addresses.
    static void limitMemory(uint64_t fileBytes)
    {
        if (spheretree_test::kSanitized) return;
        constexpr rlim_t kAnyFile = rlim_t(96) << 20, kPerByte = 300;
        const rlim_t bytes = kAnyFile + kPerByte * rlim_t(fileBytes);
        const rlimit limit{bytes, bytes};
        setrlimit(RLIMIT_DATA, &limit);
    }
};

TEST_P(CommandDamaged, IsRefusedOrRead)
{
    const char* folder = std::getenv("SPHERETREE_DATA");
    if (!folder) GTEST_SKIP() << "needs SPHERETREE_DATA";
    const std::string file = std::string(folder) + "/damaged/" + GetParam().name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file;
    for (const std::string delayed : {"delayed=0", "delayed=1"}) {
        const Result result =
            start({"-threads", "1", "-read", file, delayed, "-print"}, "/dev/null", [&] {
                limitMemory(std::filesystem::file_size(file));
            }).wait();
        EXPECT_EQ(result.exitCode, GetParam().exitCode) << delayed << "\n" << result.err;
        EXPECT_LT(result.err.size(), 3000u);
        EXPECT_EQ(result.err.find("not enough memory"), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find("more memory than"), std::string::npos) << result.err;
        if (result.exitCode == 0) continue;
        EXPECT_NE(result.err.find(GetParam().name), std::string::npos)
            << "the message must name the file: " << result.err;
    }
}

INSTANTIATE_TEST_SUITE_P(Files, CommandDamaged, testing::ValuesIn(kFiles),
    [](const testing::TestParamInfo<DamagedFile>& info) {
        std::string name = info.param.name;
        for (char& c : name) c = c == '.' ? '_' : c;
        return name;
    });

} // namespace
