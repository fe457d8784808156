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

/// Whole, and node by node as values are asked for: what is in the file is walked over first.
TEST_F(CommandFaultyRead, OfATree)
{
    for (const std::string line : {"-quiet -read tree.vdb", "-quiet -read tree.vdb delayed=1"}) {
        const long calls = callsOf(line)["read"];
        ASSERT_GE(calls, 2);
        for (const long n : spread(calls, 6)) expectReason(line, "tree.vdb", n);
    }
}

struct SmallFile {
    std::string name, content;
    std::string options = {};
};

/// At its beginning, and where its end is looked for.
TEST_F(CommandFaultyRead, OfOtherFiles)
{
    const std::string mesh =
        "4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string stl = "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\nendsolid t\n";
    const std::string nrrd =
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n\n\1\2";
    for (const SmallFile& file : std::vector<SmallFile>{
             {"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}, {"b.off", "OFF\n" + mesh},
             {"b.ply", ply}, {"b.stl", stl}, {"b.pgm", "P5 2 1 255\n\1\2"}, {"b.nrrd", nrrd},
             {"b.raw", "\1\2", " shape=2,1,1 type=uint8"}, {"b.csv", "x,y,z,radius\n0,0,0,1\n"},
             {"b.json", "[{\"center\": [0, 0, 0], \"radius\": 1}]"}}) {
        writeText(path(file.name), file.content);
        mBefore = files();
        const std::string line = "-quiet -read " + file.name + file.options;
        const long calls = callsOf(line)["read"];
        EXPECT_GE(calls, 1) << line;
        expectReason(line, file.name, 1);
        if (calls > 1) expectReason(line, file.name, calls);
    }
}

/// Where it comes between two lines, a table would be taken for a shorter one.
TEST_F(CommandFaultyRead, OfATableOfQuestions)
{
    std::string points = "x,y,z\n";
    for (int i = 0; i < 5000; ++i) points += std::to_string(i) + ",0,0\n";
    writeText(path("points.csv"), points);
    mBefore = files();
    const std::string line = "-quiet -read tree.vdb -contains points=points.csv";
    const long calls = callsOf(line)["read"], first = callsOf("-quiet -read tree.vdb")["read"] + 1;
    ASSERT_GT(calls, first + 2);
    for (long n = first; n <= calls; ++n) {
        const Result result = runWith(line, failing("read", n, EIO));
        expectFailure(result, 3, {"points.csv: cannot be read: ", std::strerror(EIO)}, {});
        EXPECT_EQ(result.out, "");
    }
}

} // namespace
