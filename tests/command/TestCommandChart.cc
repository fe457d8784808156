// SPDX-License-Identifier: Apache-2.0
// -write of curves of errors: .svg, and .png and .csv where format=curve says so.

#include "CommandRunner.h"

#include "support/Messages.h"

#include <algorithm>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using spheretree_test::mentions;

class CommandChart : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
    }

    Result runFine(const std::string& line) const
    {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result;
    }
};

std::size_t count(const std::string& text, const std::string& word)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++n;
    return n;
}

TEST_F(CommandChart, OneLineATreeWithItsName)
{
    runFine("-read a.vol -spheretree spheres=6,1 name=tight keep=1 -spheretree tree=extended "
            "name=paper "
            "-write errors.svg errors.csv errors.png format=curve width=320 height=240");
    const std::string svg = readText(path("errors.svg"));
    EXPECT_EQ(svg.rfind("<svg", 0), 0u);
    EXPECT_EQ(count(svg, ">tight</text>"), 1u);
    EXPECT_EQ(count(svg, ">paper</text>"), 1u);
    const std::string csv = readText(path("errors.csv"));
    EXPECT_EQ(csv.rfind("tree,level,spheres,hamming_percent,hausdorff\ntight,", 0), 0u);
    EXPECT_EQ(count(csv, "\ntight,"), 2u);
    EXPECT_TRUE(mentions(csv, "\npaper,0,"));
    EXPECT_EQ(readText(path("errors.png")).substr(1, 3), "PNG");
}

TEST_F(CommandChart, NumbersAreThoseOfStats)
{
    runFine("-read a.vol -spheretree spheres=6,1 -stats s.csv -write c.csv format=curve");
    const auto cell = [](const std::string& text, int row, int column) {
        std::size_t at = 0;
        for (; row > 0; --row) at = text.find('\n', at) + 1;
        for (; column > 0; --column) at = text.find(',', at) + 1;
        return text.substr(at, text.find_first_of(",\n", at) - at);
    };
    const std::string stats = readText(path("s.csv")), chart = readText(path("c.csv"));
    // The table has level 0 first, the chart the fewest spheres.
    EXPECT_EQ(cell(chart, 2, 2), cell(stats, 1, 1));
    EXPECT_EQ(cell(chart, 2, 3), cell(stats, 1, 11));
    EXPECT_EQ(cell(chart, 1, 3), cell(stats, 2, 11));
    EXPECT_EQ(cell(chart, 1, 4), cell(stats, 2, 12));
}

TEST_F(CommandChart, PicturesAndTablesAreWhatTheyWere)
{
    runFine("-read a.vol -spheretree spheres=6,1 -write p.png t.csv e.svg width=64 height=48");
    EXPECT_EQ(readText(path("t.csv")).rfind("level,id,parent", 0), 0u);
    runFine("-read a.vol -spheretree spheres=6,1 -write q.png width=64 height=48");
    EXPECT_EQ(readText(path("p.png")), readText(path("q.png")));
}

TEST_F(CommandChart, ErrorsAreCountedIfTheObjectIsThere)
{
    runFine("-read a.vol -spheretree spheres=6,1 errors=0 -write tree.vdb");
    runFine("-read a.vol tree.vdb -write e.svg vdb=0");
    runFine("-read a.vol -spheretree spheres=6,1 -write f.svg");
    EXPECT_EQ(readText(path("e.svg")), readText(path("f.svg")));
    const Result alone = run("-read tree.vdb -write e.svg");
    EXPECT_EQ(alone.exitCode, 3);
    EXPECT_TRUE(mentions(alone.err, "its object is not on the stack"));
}

TEST_F(CommandChart, TheOrderOfFilesChangesNone)
{
    runFine("-read a.vol -spheretree spheres=6,1 errors=0 -write 1.svg 1.json");
    runFine("-read a.vol -spheretree spheres=6,1 errors=0 -write 2.json 2.svg");
    EXPECT_EQ(readText(path("1.json")), readText(path("2.json")));
}

TEST_F(CommandChart, GoesToStdout)
{
    const Result svg = runFine("-read a.vol -spheretree spheres=6,1 -write stdout.svg");
    EXPECT_EQ(svg.out.rfind("<svg", 0), 0u);
    const Result csv =
        runFine("-read a.vol -spheretree spheres=6,1 -write stdout.csv format=curve");
    EXPECT_EQ(csv.out.rfind("tree,level", 0), 0u);
}

TEST_F(CommandChart, AnEmptyFrameHasAxesAlone)
{
    runFine("-read a.vol -mask below=0 -spheretree spheres=4 empty=write -write e.svg");
    EXPECT_TRUE(mentions(readText(path("e.svg")), "No errors are known."));
}

TEST_F(CommandChart, WhatDoesNotFitIsRefused)
{
    const auto refused = [&](const std::string& line, int exitCode, const std::string& why) {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, exitCode) << line;
        EXPECT_TRUE(mentions(result.err, why)) << result.err;
    };
    refused("-read a.vol -write e.svg", 3, "there is none: put -spheretree before");
    refused("-read a.vol -spheretree -write e.urdf format=curve", 2,
        "files that end in .svg, .png, .csv");
    refused("-read a.vol -spheretree -write e.svg level=1", 2, "level is for pictures and files");
    refused(
        "-read a.vol -spheretree -write e.png format=curve color=id", 2, "color is for pictures");
    refused(
        "-read a.vol -spheretree -write e.svg units=mm", 2, "units is for files of other tools");
    EXPECT_FALSE(exists("e.svg"));
}

} // namespace
