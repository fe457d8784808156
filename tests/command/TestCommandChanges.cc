// SPDX-License-Identifier: Apache-2.0
// The world changes while the command runs, or is not as it seems: links that lead nowhere, folders
// that vanish or are locked, inputs cut short or written over, readers that go away.

#include "FaultyCommand.h"

#include <openvdb/openvdb.h>

#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

namespace {

using namespace command_test;

class CommandChanges : public FaultyCommandTest {
protected:
    void link(const std::string& to, const std::string& name) const
    {
        std::filesystem::create_symlink(to, path(name));
    }

    /// A run that stands still just before a call. What @a change does meanwhile, it meets.
    Result changedAt(const std::string& arguments, const std::string& call, long n,
        const std::function<void()>& change, const std::string& faults = "") const
    {
        Running command = startWith(arguments, faults + signalled(call, n, SIGSTOP));
        EXPECT_TRUE(command.waitUntilStopped()) << call << " " << n;
        change();
        command.send(SIGCONT);
        return command.wait();
    }

    void expectWhole(const std::string& name) const
    {
        const Result result = run("-read " + name + " -stats");
        EXPECT_EQ(result.exitCode, 0) << name << ": " << result.err;
    }
};

TEST_F(CommandChanges, ALinkToAFileThatIsNotThereMakesIt)
{
    std::filesystem::create_directory(path("folder"));
    link("later.vdb", "link.vdb");
    link("folder/far.vdb", "link2.vdb");
    link("link4.vdb", "link3.vdb");
    link((path("folder") / "end.vdb").string(), "link4.vdb");
    for (const auto& [name, target] : {std::pair("link.vdb", "later.vdb"),
             std::pair("link2.vdb", "folder/far.vdb"), std::pair("link3.vdb", "folder/end.vdb")}) {
        const Result result = run(std::string("-read a.vol -spheretree -write ") + name);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_TRUE(std::filesystem::is_symlink(path(name))) << name << " was replaced";
        EXPECT_TRUE(std::filesystem::is_regular_file(path(target))) << target;
        if (exists(target)) expectWhole(target);
    }
    EXPECT_TRUE(leftovers().empty());
}

TEST_F(CommandChanges, ALinkThatCannotBeFollowedIsFoundBeforeAnyWork)
{
    link("nowhere/later.vdb", "link.vdb");
    link("b.vdb", "c.vdb");
    link("c.vdb", "b.vdb");
    writeOld({});
    const std::string start = "-read a.vol -spheretree -write ";
    const Result missing = run(start + "link.vdb");
    expectFailure(missing, 4, {"link.vdb", "link to nowhere/later.vdb", "No such file"}, {});
    EXPECT_EQ(missing.err.find("completed"), std::string::npos) << missing.err;
    expectFailure(run(start + "b.vdb"), 4, {"b.vdb", "Too many levels"}, {});
}

/// Also where no file is there yet.
TEST_F(CommandChanges, TwoSpellingsOfANameAreOneOutput)
{
    link(".", "here");
    for (const std::string other : {"./later.json", "here/later.json"}) {
        for (const std::string& names :
            {"later.json -write " + other, other + " -write later.json"}) {
            const Result result = run("-read a.vol -spheretree -stats " + names);
            EXPECT_EQ(result.exitCode, 2) << names << '\n' << result.err;
            EXPECT_NE(result.err.find("written more than once"), std::string::npos) << result.err;
            EXPECT_FALSE(exists("later.json"));
        }
    }
}

TEST_F(CommandChanges, ALinkAndItsTargetAreOneOutput)
{
    link("later.vdb", "link.vdb");
    const Result result = run("-read a.vol -spheretree -write link.vdb later.vdb");
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_NE(result.err.find("written more than once"), std::string::npos) << result.err;
    EXPECT_FALSE(exists("later.vdb"));
}

TEST_F(CommandChanges, AFolderThatVanishesIsAnError)
{
    const std::string line = "-read a.vol -spheretree -write folder/t.vdb";
    // In between: the place was looked at, and is gone when the work is done.
    const std::pair<const char*, long> moments[] = {{"tmpfile", 2}, {"fsync", 1}, {"link", 1}};
    for (const auto& [call, n] : moments) {
        SCOPED_TRACE(call);
        std::filesystem::create_directory(path("folder"));
        const Result moved = changedAt(
            line, call, n, [&] { std::filesystem::rename(path("folder"), path("moved")); });
        EXPECT_EQ(moved.exitCode, 4) << moved.err;
        EXPECT_NE(moved.err.find("folder/t.vdb: "), std::string::npos) << moved.err;
        EXPECT_FALSE(exists("folder"));
        EXPECT_TRUE(std::filesystem::is_empty(path("moved")));
        const auto removeMoved = [&] { std::filesystem::remove_all(path("moved")); };
        removeMoved();
        std::filesystem::create_directory(path("folder"));
        const Result removed =
            changedAt(line, call, n, [&] { std::filesystem::remove_all(path("folder")); });
        EXPECT_EQ(removed.exitCode, 4) << removed.err;
        EXPECT_FALSE(exists("folder"));
    }
}

/// Labels that do not fit into memory= go there.
TEST_F(CommandChanges, ATemporaryFolderThatVanishesIsAnError)
{
    const std::string line = "-threads 1 -generate ball voxels=270000 -spheretree tree=extended "
                             "errors=0 memory=1500000 -write t.csv";
    writeOld({"t.csv"});
    const std::filesystem::path folder = mFolder / "temporary";
    std::filesystem::create_directory(folder);
    setenv("TMPDIR", folder.c_str(), 1);
    const auto remove = [&] { std::filesystem::remove(folder); };
    const Result result =
        changedAt(line, "tmpfile", 2, remove); // the first is a trial of the output
    unsetenv("TMPDIR");
    expectFailure(result, 4, {folder.string(), "No such file", "set TMPDIR"}, {"t.csv"});
}

TEST_F(CommandChanges, AFolderRemovedWithTheNamedFileInItIsAnError)
{
    std::filesystem::create_directory(path("folder"));
    const Result result = changedAt(
        "-read a.vol -spheretree -write folder/t.vdb", "rename", 1,
        [&] { std::filesystem::remove_all(path("folder")); }, namedFilesOnly() + ";");
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_FALSE(exists("folder"));
}

TEST_F(CommandChanges, AFolderOrFileThatIsProtectedFromUsers)
{
    if (geteuid() != 0) GTEST_SKIP() << "only root can be somebody else; others are tested as such";
    for (const auto& folder : {mFolder, mWork}) chmod(folder.c_str(), 0755);
    std::filesystem::create_directory(path("open"));
    chmod(path("open").c_str(), 0777);
    writeText(path("open/old.vdb"), "precious");
    const auto asNobody = [&](const std::string& arguments) {
        return start(split(arguments), "/dev/null", [] {
            if (setgid(65534) != 0 || setuid(65534) != 0) _exit(126);
        }).wait();
    };
    if (asNobody("-version").exitCode != 0) GTEST_SKIP() << "others may not run the program";
    for (const std::string target : {"t.vdb", "open/old.vdb"}) {
        const Result result = asNobody("-read a.vol -spheretree -write " + target);
        EXPECT_EQ(result.exitCode, 4) << result.err;
        EXPECT_NE(result.err.find("Permission denied"), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find("completed"), std::string::npos) << "work was done";
    }
    EXPECT_EQ(readText(path("open/old.vdb")), "precious");
    EXPECT_EQ(asNobody("-read a.vol -spheretree -write open/new.vdb").exitCode, 0);
}

TEST_F(CommandChanges, AnInputCutShortWhileItIsRead)
{
    const std::string whole = readText(path("tree.vdb")), volume = readText(path("a.vol"));
    for (const std::string input : {"tree.vdb", "a.vol"}) {
        const std::string line = "-read " + input + " -write t.vdb";
        ASSERT_EQ(run(line).exitCode, 0);
        const std::string expected = readText(path("t.vdb"));
        int refused = 0;
        for (const long n : spread(callsOf(line)["read"], 6)) {
            SCOPED_TRACE(input + " " + std::to_string(n));
            writeOld({"t.vdb"});
            const Result result =
                changedAt(line, "read", n, [&] { std::filesystem::resize_file(path(input), 300); });
            // Other files are read as well, before and after.
            if (result.exitCode != 0) {
                expectFailure(result, 3, {input}, {"t.vdb"});
                ++refused;
            } else {
                EXPECT_TRUE(readText(path("t.vdb")) == expected)
                    << "a part was taken for the whole";
            }
            writeText(path("tree.vdb"), whole);
            writeText(path("a.vol"), volume);
        }
        EXPECT_GT(refused, 0);
    }
}

TEST_F(CommandChanges, AnInputWrittenOverWhileItIsRead)
{
    const std::string volume = readText(path("a.vol"));
    writeOld({"t.vdb"});
    Running command =
        startWith("-read a.vol -spheretree -write t.vdb", signalled("read", 3, SIGSTOP));
    ASSERT_TRUE(command.waitUntilStopped());
    writeText(path("a.vol"), volume); // the same bytes, so that nothing but the clock can tell
    command.send(SIGCONT);
    expectFailure(command.wait(), 3, {"a.vol", "changed while it was read"}, {"t.vdb"});
}

/// The header stays as it was.
TEST_F(CommandChanges, ADataFileWrittenOverWhileItIsRead)
{
    const std::string numbers(32 * 32 * 32, 'x'), line = "-read a.nhdr -write t.vdb";
    writeText(path("a.nhdr"),
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 32 32 32\nencoding: raw\ndata file: a.raw\n");
    writeText(path("a.raw"), numbers);
    ASSERT_EQ(run(line).exitCode, 0);
    int refused = 0;
    for (const long n : spread(callsOf(line)["read"], 12)) {
        SCOPED_TRACE(n);
        writeOld({"t.vdb"});
        const Result result =
            changedAt(line, "read", n, [&] { writeText(path("a.raw"), numbers); });
        if (result.exitCode == 0) continue; // before its first byte, or after its last
        expectFailure(result, 3, {"a.nhdr", "'a.raw'", "changed while it was read"}, {"t.vdb"});
        ++refused;
    }
    EXPECT_GT(refused, 0);
}

/// The values of a file that is read with delayed=1 are still in it when the output is begun.
class CommandDelayed : public CommandChanges {
protected:
    void SetUp() override
    {
        CommandChanges::SetUp();
        if (IsSkipped()) return;
        writeGrids("big.vdb", {sphereGrid("ball", 30)});
        writeOld({"t.vdb"});
        mWhole = readText(path("big.vdb"));
    }

    /// The second file without a name is that of the output; the first was a trial.
    Result changedBeforeWriting(
        const std::function<void()>& change, const std::string& faults = "") const
    {
        return changedAt("-read big.vdb delayed=1 -write t.vdb", "tmpfile", 2, change, faults);
    }

    std::string mWhole;
};

TEST_F(CommandDelayed, AnInputCutShortIsAnErrorAndNoSignal)
{
    const auto cut = [&] { std::filesystem::resize_file(path("big.vdb"), 5000); };
    expectFailure(changedBeforeWriting(cut), 3, {"became shorter"}, {"t.vdb"});
    writeText(path("big.vdb"), mWhole);
    const Result named = changedBeforeWriting(cut, namedFilesOnly() + ";");
    expectFailure(named, 3, {"became shorter"}, {"t.vdb"});
}

TEST_F(CommandDelayed, AnInputWrittenOverIsAnError)
{
    const Result result = changedBeforeWriting([&] {
        std::fstream file(path("big.vdb"), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(std::streamoff(mWhole.size() - 1));
        file.put(mWhole.back());
    });
    expectFailure(result, 3, {"big.vdb", "changed while it was read"}, {"t.vdb"});
}

TEST_F(CommandDelayed, AnInputReplacedByRenameIsReadToItsEnd)
{
    ASSERT_EQ(run("-read big.vdb -write expected.vdb").exitCode, 0);
    const Result result = changedBeforeWriting([&] {
        writeText(path("new.vdb"), "other");
        std::filesystem::rename(path("new.vdb"), path("big.vdb"));
    });
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readText(path("t.vdb")), readText(path("expected.vdb")));
}

TEST_F(CommandChanges, APipeThatEndsEarlyIsAnInputThatIsCutShort)
{
    ASSERT_EQ(mkfifo(path("pipe.vdb").c_str(), 0600), 0);
    writeOld({"t.vdb"});
    expectFailure(shell("head -c 2000 tree.vdb > pipe.vdb & "
                        "$VDB_SPHERETREE -read pipe.vdb -write t.vdb"),
        3, {"pipe.vdb"}, {"t.vdb"});
    EXPECT_EQ(shell("cat tree.vdb > pipe.vdb & $VDB_SPHERETREE -read pipe.vdb -stats").exitCode, 0);
}

TEST_F(CommandChanges, ReadersThatGoAway)
{
    const std::string write =
        "$VDB_SPHERETREE -read a.vol -spheretree -spheres2ls voxel=0.05 -write ";
    writeOld({"t.vdb"});
    // Data that nobody takes is an error; it comes before any file takes its place.
    expectFailure(shell("{ " + write
                      + "t.vdb stdout.vdb codec=none; echo $? >&2; } | head -c 1000"
                        " > /dev/null"),
        0, {"the reading end of the pipe is closed", "\n4\n"}, {"t.vdb"});
    expectFailure(shell(write + "t.vdb stdout.vdb codec=none > /dev/full"), 4,
        {"No space left on device"}, {"t.vdb"});
    // Text that nobody reads is none.
    EXPECT_EQ(
        shell("{ $VDB_SPHERETREE -read tree.vdb -stats -write u.vdb; echo $? > code; } | true")
            .exitCode,
        0);
    EXPECT_EQ(readText(path("code")), "0\n");
    expectWhole("u.vdb");
    EXPECT_EQ(shell("$VDB_SPHERETREE -read tree.vdb -print > /dev/full").exitCode, 4);
    EXPECT_EQ(shell("$VDB_SPHERETREE -read tree.vdb -write v.vdb 2> /dev/full").exitCode, 0);
    EXPECT_EQ(shell("$VDB_SPHERETREE -read tree.vdb -write w.vdb <&- >&- 2>&-").exitCode, 0);
    expectWhole("v.vdb");
    expectWhole("w.vdb");
}

} // namespace
