// SPDX-License-Identifier: Apache-2.0
// Inputs that the system fails to read: exit code 3, the file by its name, once, and the system's
// reason. A fault is no end of the file.

#include "FaultyCommand.h"

#include <cerrno>
#include <cstring>

namespace {

using namespace command_test;

class CommandFaultyRead : public FaultyCommandTest {
protected:
    /// The n-th reading fails, and so do all after it.
    void expectReason(const std::string& arguments, const std::string& file, long n) const
    {
        SCOPED_TRACE(arguments + ", reading " + std::to_string(n));
        const Result result = runWith(arguments, failing("read", n, EIO));
        expectFailure(result, 3, {file + ": ", std::strerror(EIO)}, {});
        const size_t first = result.err.find(file);
        EXPECT_EQ(result.err.find(file, first + 1), std::string::npos) << result.err;
        EXPECT_EQ(result.out, "") << "what came before the fault was done";
    }
};

TEST_F(CommandFaultyRead, OfAConfigFile)
{
    writeText(path("c.txt"), "version\n");
    mBefore = files();
    expectReason("-config c.txt", "c.txt", 1);
    expectReason("-config c.txt", "c.txt", 2); // where its end is looked for
    const Result memory = run("-config /proc/self/mem");
    expectFailure(memory, 3, {"/proc/self/mem: ", std::strerror(EIO)}, {});
}

TEST_F(CommandFaultyRead, OfAVolume)
{
    expectReason("-quiet -read a.vol", "a.vol", 1); // the header
    expectReason("-quiet -read a.vol", "a.vol", 2); // the values
}

TEST_F(CommandFaultyRead, OfAMesh)
{
    writeText(path("b.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    mBefore = files();
    expectReason("-quiet -read b.obj", "b.obj", 1);
}

} // namespace
