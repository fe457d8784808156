// SPDX-License-Identifier: Apache-2.0
// Loops, conditions, expressions and defaults of a command line, and vdb_tool as the judge of those that it
// has too.

#include "CommandRunner.h"

#include <openvdb/openvdb.h>

#include <algorithm>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;

bool holds(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

class CommandLoops : public CommandTest {
protected:
    void writeSpheres() const
    {
        writeGrids("two.vdb", {sphereGrid("large", 9), sphereGrid("small", 5)});
        writeGrids("one.vdb", {sphereGrid("density", 8)});
    }

    std::string printed(const std::vector<std::string>& words) const
    {
        const Result result = runWords(words);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.out;
    }
};

TEST_F(CommandLoops, NumbersGoUpToTheEndWithoutIt)
{
    EXPECT_EQ(printed({"-for", "i=0,3", "-eval", "{$i} {$#i}", "-end"}), "0 0\n1 1\n2 2\n");
    EXPECT_EQ(printed({"-for", "i=4,9,2", "-eval", "{$i} {$#i}", "-end"}), "4 0\n6 1\n8 2\n");
    EXPECT_EQ(printed({"-for", "i=3,0,-1", "-eval", "{$i}", "-end"}), "3\n2\n1\n");
    EXPECT_EQ(printed({"-for", "x=0,1,0.25", "-eval", "{$x}", "-end"}),
        "0.000000\n0.250000\n0.500000\n0.750000\n");
}

TEST_F(CommandLoops, RoundingOfStepsDoesNotAddUp)
{
    const std::string out = printed({"-for", "x=0,10,0.1", "-eval", "{$x}", "-end"});
    EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 100);
    EXPECT_TRUE(holds(out, "9.900000\n")) << out;
}

TEST_F(CommandLoops, AnEmptyRangeDoesNothingAndIsNoted)
{
    const Result result = run("-for i=5,5 -eval never -end");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(holds(result.err, "-for i=5,5 has nothing to go through")) << result.err;
}

TEST_F(CommandLoops, ValuesOfAListMayBeSeveralWords)
{
    EXPECT_EQ(printed({"-each", "s=a,b", "c", "d=e", "-eval", "{$s}{$#s}", "-end"}),
        "a0\nb1\nc2\nd=e3\n");
    EXPECT_EQ(printed({"-each", "s=", "a", "b", "-eval", "{$s}", "-end"}), "a\nb\n");
    EXPECT_EQ(
        printed({"-each", "s={a b c: :tokenize:squash}", "-eval", "{$s}", "-end"}), "a\nb\nc\n");
}

TEST_F(CommandLoops, LoopsMayBeWithinEachOther)
{
    EXPECT_EQ(
        printed({"-for", "x=0,2", "-for", "y=0,{$x:1:+}", "-eval", "{$x}{$y}", "-end", "-end"}),
        "00\n10\n11\n");
}

TEST_F(CommandLoops, VariablesStayFromTurnToTurn)
{
    EXPECT_EQ(printed({"-eval", "{0:@n}", "-for", "i=1,5", "-eval", "{$n:$i:+:@n}", "-end", "-eval",
                  "{$n}"}),
        "10\n");
}

TEST_F(CommandLoops, ConditionsChoose)
{
    EXPECT_EQ(
        printed({"-for", "i=0,5", "-if", "{$i:2:>}", "-eval", "{$i}", "-end", "-end"}), "3\n4\n");
    EXPECT_EQ(
        printed({"-if", "0", "-eval", "a", "-end", "-if", "true", "-eval", "b", "-end"}), "b\n");
}

TEST_F(CommandLoops, WhatIsOnTheStackIsAskedWhenItIsThere)
{
    writeSpheres();
    EXPECT_EQ(printed({"-read", "two.vdb", "-eval",
                  "{gridCount} {0:gridName} {1:gridName} {0:gridClass}"}),
        "2 small large ls\n");
    EXPECT_EQ(printed({"-generate", "gyroid", "voxels=1e4", "-spheretree", "spheres=8,1", "-eval",
                  "{0:gridType} {0:gridName} {0:levelCount} {0:sphereCount:0:>}"}),
        "sphere-tree spheretree 2 1\n");
}

TEST_F(CommandLoops, NamesOfFilesMayComeFromTheStack)
{
    writeSpheres();
    const Result result = run("-read two.vdb -spheretree vdb=0 spheres=4 name={0:gridName} "
                              "-write {0:gridName}_{0:sphereCount}.csv vdb=0");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(exists("small_1.csv")) << result.err;
}

TEST_F(CommandLoops, ATestMayComeFromTheStackAndSetVariables)
{
    writeSpheres();
    EXPECT_EQ(printed({"-eval", "{0:@found}", "-each", "f=one.vdb,two.vdb", "-read", "{$f}",
                  "grids=*", "-if", "{gridCount:1:>}", "-eval", "{$f:@found}", "-end", "-clear",
                  "-end", "-eval", "{$found}"}),
        "two.vdb\n");
}

TEST_F(CommandLoops, WhatMayNotBeDoneIsNotTakenForDone)
{
    writeSpheres();
    for (const char* file : {"one", "two"}) {
        EXPECT_EQ(printed({"-eval", "{0:@found}", "-read", std::string(file) + ".vdb", "-if",
                      "{gridCount:1:>}", "-eval", "{5:@found}", "-end", "-eval", "{$found}"}),
            std::string(file) == "two" ? "5\n" : "0\n");
    }
}

TEST_F(CommandLoops, AValueThatIsFoundLaterIsFoundOnce)
{
    writeSpheres();
    EXPECT_EQ(printed({"-read", "two.vdb", "-eval", "{1:@a}{gridCount:@a}", "-eval", "{7:@b}",
                  "-eval", "{$a}{$b}"}),
        "27\n");
}

TEST_F(CommandLoops, AnOpenFileIsCheckedWhenItIsReached)
{
    writeSpheres();
    const Result result = run("-read one.vdb -write {0:gridName}.nothing");
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(holds(result.err, "-write: density.nothing: ")) << result.err;
    const Result other = run("-read one.vdb -read {0:gridName}.vdb -print");
    EXPECT_EQ(other.exitCode, 3);
    EXPECT_TRUE(holds(other.err, "density.vdb")) << other.err;
}

TEST_F(CommandLoops, AnAgeThatIsNotThereIsAnErrorOfTheInput)
{
    writeSpheres();
    const Result result = run("-read one.vdb -eval {1:gridName}");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(holds(
        result.err, "asks for the grid or tree of age 1, and there is 1 (the newest has age 0)"))
        << result.err;
}

TEST_F(CommandLoops, FilesOfAFolderGoByName)
{
    writeSpheres();
    std::filesystem::create_directories(path("in/more"));
    for (const char* name :
        {"in/b.vdb", "in/a.vdb", "in/more/c.VDB", "in/more/d.txt", "in/.e.vdb"}) {
        command_test::writeText(path(name), "");
    }
    EXPECT_EQ(
        printed({"-files", "in", "ext=vdb", "-eval", "{$file}", "-end"}), "in/a.vdb\nin/b.vdb\n");
    EXPECT_EQ(printed({"-files", "path=in", "ext=.vdb,txt", "recursive=1", "-eval",
                  "{$#file} {$file:name}", "-end"}),
        "0 a\n1 b\n2 c\n3 d\n");
    EXPECT_EQ(printed({"-files", "in", "include=vdb", "exclude=a,x", "-eval", "{$file}", "-end"}),
        "in/b.vdb\n");
}

TEST_F(CommandLoops, StacksGrowFromTurnToTurn)
{
    writeSpheres();
    const Result result = run("-each f=one,two -read {$f}.vdb -end -write all.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readGrids("all.vdb").size(), 3u);
}

TEST_F(CommandLoops, WhatWasReadBeforeMayBeWrittenInEachTurn)
{
    writeSpheres();
    const Result result = run("-read one.vdb -for i=0,2 -write {$i}.vdb -end");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(exists("0.vdb") && exists("1.vdb"));
}

TEST_F(CommandLoops, FilesOfActionsMayHaveLoops)
{
    writeSpheres();
    command_test::writeText(path("loop.txt"),
        "vdb_tool 10.6.1\n"
        "for i=1,3   # a comment\n"
        "eval 'i is {$i}'\n"
        "end\n");
    EXPECT_EQ(printed({"-config", "loop.txt"}), "i is 1\ni is 2\n");
}

TEST_F(CommandLoops, FilesWithSuchNamesAreFiles)
{
    writeGrids("a{1}.vdb", {sphereGrid("density", 8)});
    writeGrids("b####.vdb", {sphereGrid("density", 8)});
    const Result result = run("-read a{1}.vdb b####.vdb -print");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(holds(result.out, "from a{1}.vdb") && holds(result.out, "from b####.vdb"));
}

TEST_F(CommandLoops, DefaultsAreForWhatComesAfterThem)
{
    writeSpheres();
    const Result result =
        run("-read one.vdb -default keep=1 quality=fast -spheretree spheres=4 -print");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(holds(result.out, "grid 'density'")) << result.out;
    EXPECT_TRUE(holds(result.err, "-spheretree quality=fast spheres=4 keep=1 ...")) << result.err;
    const Result given = run("-default keep=1 quality=fast -read one.vdb "
                             "-spheretree spheres=4 quality=normal keep=0 -print");
    EXPECT_FALSE(holds(given.out, "grid 'density'")) << given.out;
    EXPECT_TRUE(holds(given.err, "quality=normal")) << given.err;
}

TEST_F(CommandLoops, DefaultsGiveWayToWhatExcludesThem)
{
    writeSpheres();
    const Result result = run("-default quality=fast padding=voxels -read one.vdb -spheretree "
                              "side=inner spheres=4 -print");
    EXPECT_EQ(result.exitCode, 0) << result.err;
}

TEST_F(CommandLoops, TheListOfFunctionsIsTold)
{
    const Result all = runWords({"-eval", "help=*"});
    EXPECT_EQ(all.exitCode, 0);
    for (const char* name : {"pad0", "tokenize", "gridCount", "r2d", "==", "sphereCount"}) {
        EXPECT_TRUE(holds(all.out, std::string("\n") + name + " ")) << name;
    }
    const Result one = runWords({"-eval", "help=pad0"});
    EXPECT_EQ(one.out, "pad0             {12:4:pad0} -> 0012\n");
}

struct BadLoop {
    const char* name;
    std::vector<std::string> words;
    const char* message;
};

void PrintTo(const BadLoop& bad, std::ostream* out) { *out << bad.name; }

class CommandBadLoop : public CommandLoops, public testing::WithParamInterface<BadLoop> {};

TEST_P(CommandBadLoop, IsRefusedBeforeAnyWork)
{
    writeSpheres();
    const auto before = files();
    std::vector<std::string> words{"-read", "one.vdb", "-write", "t.vdb"};
    words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
    const Result result = runWords(words);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_TRUE(holds(result.err, GetParam().message)) << result.err;
    EXPECT_EQ(files(), before);
    EXPECT_EQ(result.out, "");
}

const BadLoop kBadLoops[] = {
    {"NoEnd", {"-for", "i=0,3", "-print"}, "-for has no -end: put it after the last"},
    {"NoEndOfTheInner", {"-for", "i=0,3", "-if", "1", "-print", "-end"}, "-for has no -end"},
    {"NoBegin", {"-print", "-end"}, "-end ends nothing"},
    {"NoVariable", {"-for", "0,3", "-end"}, "-for"},
    {"NoRange", {"-for", "-end"}, "-for: names no variable"},
    {"NoList", {"-each", "a,b", "-end"}, "-each: names no variable: -each s="},
    {"NoNumber", {"-for", "i=a,b", "-end"}, "i=a,b has what is no number"},
    {"OneNumber", {"-for", "i=3", "-end"}, "i=3 has 1 number, and takes two or three"},
    {"NoStep", {"-for", "i=0,3,0", "-end"}, "a step of 0, and no end"},
    {"TooMany", {"-for", "i=0,1000000000", "-end"}, "more than 100000 turns"},
    {"TooManyOfReals", {"-for", "i=0,1,1e-9", "-end"}, "more than 100000 turns"},
    {"TooManyOfAll", {"-for", "i=0,1000", "-for", "j=0,1000", "-eval", "x", "-end", "-end"},
        "come to more than 100000 actions"},
    {"TooManyBeforeTheFirstTurn", {"-for", "i=0,40000", "-eval", "{", "-eval", "x", "-end"},
        "come to more than 100000 actions"},
    {"BadName", {"-for", "3i=0,3", "-end"}, "'3i' is no name of a variable"},
    {"SameName", {"-for", "i=0,3", "-for", "i=0,3", "-end", "-end"}, "is that of a loop around"},
    {"EmptyValue", {"-each", "s=a,,b", "-end"}, "a value of s is empty"},
    {"NoTest", {"-if", "-end"}, "-if: has no test"},
    {"BadTest", {"-if", "maybe", "-end"}, "'maybe' is neither true nor false"},
    {"UnknownVariable", {"-for", "i=0,3", "-eval", "{$j}", "-end"},
        "i=0: -eval: {$j}: there is no variable $j"},
    {"VariableAfterItsLoop", {"-for", "i=0,3", "-end", "-eval", "{$i}"}, "there is no variable $i"},
    {"TwoValues", {"-write", "{1:2}.vdb"}, "it ends in 2 values and not in one"},
    {"NoBrace", {"-write", "{1.vdb"}, "has a '{' without a '}'"},
    {"DoubleQuotes", {"-for", "i=0,3", "-write", "t_{}.vdb", "-end"}, "put single quotes around"},
    {"ValueOutOfRange", {"-for", "i=0,3", "-level", "level={$i:1:-}", "-end"},
        "i=0: -level: level=-1 is out of range"},
    {"OpenRange", {"-for", "i=0,{gridCount}", "-end"}, "must be known before any work"},
    {"NoFolder", {"-files", "-end"}, "-files: names no folder"},
    {"NothingToEvaluate", {"-eval"}, "has nothing to evaluate"},
    {"NoSuchFunction", {"-eval", "help=padd"}, "there is no function padd (did you mean pad0?)"},
    {"NoDefault", {"-default"}, "-default gives no value"},
    {"BadDefault", {"-default", "quality=good"}, "quality=good is unknown"},
    {"BadOnError", {"-onerror", "go"}, "go is unknown: it takes continue, stop"},
};

INSTANTIATE_TEST_SUITE_P(Loops, CommandBadLoop, testing::ValuesIn(kBadLoops),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(CommandLoops, AFolderThatIsNotThereIsAnErrorOfTheInput)
{
    const Result result = run("-files nowhere -print -end");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(holds(result.err, "cannot read the folder nowhere: No such file")) << result.err;
}

// vdb_tool

/// Values of which both have the same text.
const char* const kOfBoth[] = {"{1:2:+}", "{1:2.5:+}", "{7:2:/}", "{-7:2:/}", "{7.0:2:/}",
    "{5:2:-}", "{2:3:*}", "{5:++}", "{5.5:++}", "{5:--}", "{2:3:pow}", "{2:0.5:pow}", "{2:-1:pow}",
    "{3:pow2}", "{1.5:pow3}", "{4:sqrt}", "{1:sin}", "{1:cos}", "{1:tan}", "{1:asin}", "{0.5:acos}",
    "{1:atan}", "{1:exp}", "{10:ln}", "{100:log}", "{5:inv}", "{0:sign}", "{-2.5:sign}",
    "{1.2:floor}", "{-1.2:ceil}", "{2.7:to_int}", "{-2.7:to_int}", "{3:to_float}", "{-3:abs}",
    "{-3.5:neg}", "{1:2:max}", "{1:2.5:max}", "{1.5:2:min}", "{180:d2r}", "{1:r2d}", "{$pi:r2d}",
    "{$pi}", "{$e}", "{pi:is_set}", "{pi:get}", "{1:1.0:==}", "{1:2:!=}", "{10:9:>}", "{a:b:<}",
    "{1:2:<=}", "{2:2:>=}", "{1:0:&}", "{true:0:|}", "{1:!}", "{12:4:pad0}", "{12345:4:pad0}",
    "{-12:4:pad0}", "{abc:6:pad0}", "{a:b:append}", "{foo bar:length}", "{HeLlO:lower}",
    "{HeLlO:upper}", "{foo bar:a:erase}", "{for bar:a:b:replace}", "{foobar:oba:match}",
    "{a b c: :tokenize:depth:scrape}", "{p/base0123.ext:path}", "{base.ext:path}",
    "{p/base0123.ext:file}", "{p/base0123.ext:name}", "{p/base0123.ext:base}",
    "{p/base0123.ext:number}", "{p/base0123.ext:ext}", "{a.b.c:ext}", "{a.b.c:name}",
    "{smoke.0012.vdb:base}", "{0012.vdb:number}", "{x:y:nip}", "{x:y:drop}", "{1:2:swap:-}",
    "{1:2:3:rot:-:-}", "{1:2:3:tuck:-:-}", "{3:dup:*}", "{1:2:over:-:-}", "{x:y:z:scrape}",
    "{a:b:clear:d}", "{depth}", "{1:@a:2:@b:$a:$b:+}", "{5:G:set:G:get}", "{1:if(2?3)}",
    "{0:if(2?3)}", "{1:if(2:3:+?4)}", "{2:switch(1:first?2:second?3:third)}", "{x:switch(x:a?y:b)}",
    "{1:2:+:quit:4:*}", "a{1}b{2}c", "{ 1:2:+}", "{+3:1:+}", "{1e3:1:+}", "{.5:1:+}", "{a:a:!=}",
    "{1:squash}", "{100.5:1:+}"};

class CommandVdbTool : public CommandLoops {
protected:
    void SetUp() override
    {
        CommandLoops::SetUp();
        if (!isInstalled("vdb_tool")) GTEST_SKIP() << "vdb_tool is not installed";
    }

    /// What vdb_tool prints, which goes to its stderr.
    std::string judged(const std::string& line) const
    {
        const Result result = shell("vdb_tool -quiet " + line);
        EXPECT_EQ(result.exitCode, 0) << line << "\n" << result.err;
        return result.out + result.err;
    }
};

TEST_F(CommandVdbTool, GivesTheSameValues)
{
    std::string line = "-eval";
    for (const char* text : kOfBoth) line += " '" + std::string(text) + "'";
    const Result own = shell("$VDB_SPHERETREE -quiet " + line);
    EXPECT_EQ(own.exitCode, 0) << own.err;
    EXPECT_EQ(own.out, judged(line));
}

TEST_F(CommandVdbTool, RefusesTheSameValues)
{
    for (const char* text : {"{1:2}", "{1:+}", "{$nosuch}", "{@a}", "{1", "1}", "{a:{b}}", "{2:!}",
             "{1:if(a?b?c)}", "{3:switch(1:a?2:b)}", "{a:1:+}", "{abc:to_int}", "{12:x:pad0}",
             "{drop}", "{base:ext}", "{base:number}", "{1:if(a?b}"}) {
        EXPECT_NE(runWords({"-eval", text}).exitCode, 0) << text;
        EXPECT_NE(shell("vdb_tool -quiet -eval '" + std::string(text) + "'").exitCode, 0) << text;
    }
}

TEST_F(CommandVdbTool, TurnsTheSameLoops)
{
    for (const char* line :
        {"-for i=0,3 -eval '{$i} {$#i}' -end", "-for n=3,20,5 -eval '{$n:3:pad0}' -end",
            "-for x=0,1,0.25 -eval '{$x}' -end", "-for i=5,0 -eval '{$i}' -end",
            "-each s=a,b,c -eval '{$s} {$#s}' -end",
            "-for x=0,2 -each y=a,b -eval '{$x} {$y} {$#y}' -end -end",
            "-for i=0,5 -if '{$i:2:>}' -eval '{$i}' -end -end",
            "-if 0 -eval a -end -if true -eval b -end", "-for i=0,4 -eval '{$i:1:==:if(two)}' -end",
            "-eval '{0:@n}' -for i=1,5 -eval '{$n:$i:+:@n}' -end -eval '{$n}'"}) {
        const Result own = shell("$VDB_SPHERETREE -quiet " + std::string(line));
        EXPECT_EQ(own.exitCode, 0) << own.err;
        EXPECT_EQ(own.out, judged(line)) << line;
    }
}

TEST_F(CommandVdbTool, TellsTheSameOfGrids)
{
    writeSpheres();
    for (const char* fact : {"gridName", "gridType", "gridClass", "gridRadius", "voxelSize",
             "voxelCount", "isLS", "isFOG", "isGridEmpty", "gridDim", "gridDim:length", "gridBBox",
             "gridBBox:length", "gridCenter", "gridCenter:length"}) {
        for (const char* age : {"0", "1"}) {
            const std::string line =
                std::string("-read two.vdb -eval '{") + age + ":" + fact + "}' -eval '{gridCount}'";
            const Result own = shell("$VDB_SPHERETREE -quiet " + line);
            std::string expected = judged(line), told = own.out;
            const auto isSpace = [](char c) { return c == ' ' || c == '\n' || c == ','; };
            for (std::string* text : {&expected, &told}) { // it breaks lines at commas
                text->erase(std::remove_if(text->begin(), text->end(), isSpace), text->end());
            }
            EXPECT_EQ(told, expected) << line;
        }
    }
}

} // namespace
