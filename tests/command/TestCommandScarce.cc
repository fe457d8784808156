// SPDX-License-Identifier: Apache-2.0
// Memory and threads that are not to be had: an exit code and a sentence, whenever it happens, and
// no file touched.

#include "FaultyCommand.h"

#include "support/Sanitizers.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cerrno>
#include <filesystem>

#include <sys/resource.h>

namespace {

using namespace command_test;

const std::string kWork = "-threads 4 -generate ball voxels=20000 -spheretree "
                          "-write t.vdb t.csv t.png width=64 height=48";

const std::vector<std::string> kTargets = {"t.csv", "t.png", "t.vdb"};

class CommandScarce : public FaultyCommandTest {
protected:
    /// Notes what @a line writes where nothing is missing.
    void expectOf(const std::string& line)
    {
        ASSERT_EQ(run(line).exitCode, 0);
        for (const std::string& name : kTargets) mExpected.push_back(readText(path(name)));
        writeOld(kTargets);
    }

    /// Every file is the old one or the new one, and the message says what is missing.
    /// @return whether all are new
    bool expectOldOrNew(const Result& result, const std::string& missing)
    {
        const bool done = result.exitCode == 0;
        EXPECT_TRUE(done || result.exitCode == 3 || result.exitCode == 4)
            << result.exitCode << ", signal " << result.signal << "\n"
            << result.err;
        for (size_t i = 0; i < kTargets.size(); ++i) {
            bool isNew = readText(path(kTargets[i])) == mExpected[i];
            if (!isNew && done && kTargets[i] == "t.vdb") isNew = readsBackAsExpected();
            EXPECT_TRUE(isNew || (isOld(kTargets[i]) && !done)) << kTargets[i];
        }
        EXPECT_EQ(files(), mBefore);
        EXPECT_TRUE(done || result.err.find(missing) != std::string::npos) << result.err;
        writeOld(kTargets);
        return done;
    }

    /// Where Blosc lacks memory, OpenVDB stores values as they are: other bytes, and the same tree.
    bool readsBackAsExpected()
    {
        const int code = run("-read t.vdb -write again.csv").exitCode;
        const std::string again = readText(path("again.csv"));
        std::filesystem::remove(path("again.csv"));
        return code == 0 && again == mExpected.front();
    }

    std::vector<std::string> mExpected; ///< what kTargets hold afterwards
};

/// The first requests are made by constructors of libraries (draco's crash), before the program.
constexpr long kOfLibraries = 20;

TEST_F(CommandScarce, AnyRequestForMemoryMayFail)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "sanitizers have a malloc of their own";
    expectOf(kWork);
    int refused = 0;
    for (const std::string& kind : {std::string(), namedFilesOnly() + ";"}) {
        const long requests = callsOf(kWork, kind)["malloc"];
        writeOld(kTargets);
        for (const long moment : spread(requests - kOfLibraries, 60)) {
            const long n = kOfLibraries + moment;
            SCOPED_TRACE(n);
            const Result result = runWith(kWork, kind + failingOnce("malloc", n, ENOMEM));
            refused += !expectOldOrNew(result, "memory");
        }
    }
    EXPECT_GT(refused, 60);
}

/// Where there are no files without a name, labels that do not fit into memory= go to one that is taken away at once.
TEST_F(CommandScarce, NoTemporaryFileIsLeftWhereFilesHaveNames)
{
    const std::filesystem::path folder = mFolder / "temporary";
    std::filesystem::create_directory(folder);
    setenv("TMPDIR", folder.c_str(), 1);
    const Result result = runWith("-threads 2 -generate ball voxels=270000 -spheretree "
                                  "tree=extended errors=0 memory=1500000 -write t.csv",
        namedFilesOnly());
    unsetenv("TMPDIR");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(CommandScarce, LimitsOnMemoryInSteps)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "memory is not limited under sanitizers";
    const std::string line =
        "-threads 2 -generate ball voxels=8000000 -spheretree quality=fast "
        "spheres=64 errors=0 topology=0 -write t.vdb t.csv t.png width=64 height=48";
    expectOf(line);
    int refused = 0, done = 0;
    for (rlim_t megabytes = 150; megabytes <= 400; megabytes += megabytes < 200 ? 10 : 50) {
        SCOPED_TRACE(megabytes);
        const Result result = start(split(line), "/dev/null", [=] {
            const rlimit limit = {megabytes << 20, megabytes << 20};
            setrlimit(RLIMIT_AS, &limit);
        }).wait();
        (expectOldOrNew(result, "memory") ? done : refused) += 1;
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(done, 0);
}

/// Each voxel has nodes of 340 KB of its own: 15 MiB in all, from a file of 0.4 MB.
TEST_F(CommandScarce, VoxelsFarApartAreRefusedWithTheMemoryThatTheyNeed)
{
    openvdb::initialize();
    const auto object = openvdb::BoolGrid::create();
    object->setName("dust");
    for (int i = 0; i < 50; ++i) object->tree().setValueOn(openvdb::Coord(5000 * i, 0, 0));
    openvdb::io::File(path("dust.vdb")).write({object});
    mBefore = files();

    const std::string spheres = " -spheretree tree=extended errors=0";
    for (const std::string read : {"-read dust.vdb", "-read dust.vdb delayed=1"}) {
        EXPECT_EQ(runWithin(70, read + spheres).exitCode, 0);
        expectFailure(runWithin(30, read + spheres), 3,
            {"151 nodes", "need about 43.6 MiB", "more than the 30 MiB of this machine"}, {});
        expectFailure(runWithin(14, read), 3,
            {"dust.vdb", "'dust'", "need about 14.6 MiB", "more than the 14 MiB of this machine"},
            {});
    }
}

TEST_F(CommandScarce, AMeshWhoseSurfaceDoesNotFitTheMemoryIsRefused)
{
    std::string faces;
    for (const char* face : {"1 3 2", "1 2 4", "1 4 3", "2 3 4"}) {
        faces += std::string("f ") + face + "\n";
    }
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    command_test::writeText(path("once.obj"), points + faces);
    std::string often = points;
    for (int i = 0; i < 101; ++i) often += faces; // an odd number, so that it is closed
    command_test::writeText(path("often.obj"), often);
    mBefore = files();
    expectFailure(runWithin(20, "-read once.obj -mesh2ls voxel=0.002"), 3,
        {"-mesh2ls", "voxels at the surface of mesh 'once' need about",
            "more than the 20 MiB of this machine: use a larger voxel"},
        {});
    // By the area alone it would need six times as much as there is.
    const Result result = runWithin(20, "-read often.obj -mesh2ls voxel=0.01");
    EXPECT_EQ(result.exitCode, 0) << result.err;
}

TEST_F(CommandScarce, LeafBallsThatCannotBeMergedInMemoryAreRefusedWithTheirNumber)
{
    const std::string noise = "-generate noise voxels=50000 -spheretree errors=0 topology=0 ";
    for (const std::string tree : {"quality=fast", "quality=best", "cover=balls"}) {
        expectFailure(runWithin(20, noise + tree), 3,
            {"-spheretree", "leaf balls need about", "more than the 20 MiB of this machine"}, {});
    }
    EXPECT_EQ(runWithin(20, noise + "tree=extended").exitCode, 0);
}

TEST_F(CommandScarce, APictureThatDoesNotFitTheMemoryIsRefusedBeforeItIsDrawn)
{
    for (const std::string drawn : {"tree.vdb", "a.vol"}) {
        const std::string line = "-read " + drawn + " -write t.png ";
        expectFailure(runWithin(5, line + "width=2000 height=1000"), 4,
            {"-write", "shapes and the 2000 x 1000 pixels of a picture need about 5.8 MiB",
                "more than the 5 MiB of this machine: draw a coarser level, or fewer pixels"},
            {});
        EXPECT_EQ(runWithin(5, line + "width=200 height=100").exitCode, 0);
        std::filesystem::remove(path("t.png"));
    }
}

TEST_F(CommandScarce, NoThreadIsAnErrorOfItsOwn)
{
    expectOf(kWork);
    const long threads = callsOf(kWork)["thread"];
    writeOld(kTargets);
    int refused = 0;
    for (long n = 1; n <= threads; ++n) {
        SCOPED_TRACE(n);
        const Result result = runWith(kWork, failing("thread", n, EAGAIN));
        if (expectOldOrNew(result, "no thread can be started")) continue;
        EXPECT_EQ(result.exitCode, 3) << result.err;
        ++refused;
    }
    EXPECT_GT(refused, 1);
}

TEST_F(CommandScarce, NoThreadIsSaidByEachActionThatNeedsOne)
{
    const long beforeWork = callsOf("-version")["thread"];
    const std::string fault = failing("thread", beforeWork + 1, EAGAIN);
    writeOld({"t.vdb"});
    for (const std::string line : {"-generate ball voxels=50000", "-read a.vol -spheretree",
             "-read tree.vdb -spheres2ls voxel=0.3", "-read tree.vdb -write t.png"}) {
        expectFailure(runWith("-threads 4 " + line, fault), 3, {"no thread can be started"}, {});
        const Result alone = runWith("-threads 1 " + line, fault);
        EXPECT_EQ(alone.exitCode, 0) << "the message promises that: " << alone.err;
        std::filesystem::remove(path("t.png"));
    }
}

TEST_F(CommandScarce, NoThreadBeforeTheProgramBegins)
{
    expectFailure(runWith("-version", failing("thread", 1, EAGAIN)), 3,
        {"vdb_spheretree: error: no thread can be started"}, {});
}

} // namespace
