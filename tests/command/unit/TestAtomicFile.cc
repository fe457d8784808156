// SPDX-License-Identifier: Apache-2.0
// Names of outputs that no command line can give: those of the library's Python module, and of expressions.

#include <base/Errors.h>
#include <files/AtomicFile.h>

#include "support/Messages.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace spheretree_test;

TEST(AtomicFile, ANameWithANullByteIsNoOtherFile)
{
    const TemporaryFolder folder;
    const std::string kept = folder.path() + "/kept";
    std::ofstream(kept) << "precious";
    const std::string name = kept + std::string("\0.vdb", 5);
    EXPECT_TRUE(mentions(messageOf<command::CommandError>([&] { command::AtomicFile file(name); }),
        "its name has a null byte"));
    std::string content;
    std::ifstream(kept) >> content;
    EXPECT_EQ(content, "precious");
    EXPECT_EQ(std::filesystem::file_size(kept), 8u);
}
