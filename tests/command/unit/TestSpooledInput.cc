// SPDX-License-Identifier: Apache-2.0
// What a shell gives for standard input, and the tests' own way to start commands cannot.

#include <base/Errors.h>
#include <files/FdBuffer.h>
#include <files/SpooledInput.h>

#include "support/Messages.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <string>

#include <fcntl.h>
#include <unistd.h>

using namespace spheretree_test;

namespace {

std::string whyNot(const std::string& path)
{
    const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    command::FdBuffer input(fd);
    const std::string message =
        messageOf<command::CommandError>([&] { command::requireInput(input, "stdin.obj"); });
    close(fd);
    return message;
}

} // namespace

TEST(SpooledInput, AnInputThatCannotBeReadIsNamed)
{
    const TemporaryFolder folder;
    EXPECT_EQ(whyNot(folder.path()), "stdin.obj: Is a directory");
    EXPECT_TRUE(mentions(whyNot("/dev/null"), "stdin.obj: the input is empty"));
}
