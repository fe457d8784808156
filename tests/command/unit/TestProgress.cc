// SPDX-License-Identifier: Apache-2.0
// The parts that show progress: one bar that never falls and fits any terminal, lines for a log, and what
// would be faster. What takes ten seconds in the command takes none here.

#include <base/Progress.h>
#include <base/Terminal.h>

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace {

using command::Progress;
using command::ProgressShare;
using command::ProgressState;
using command::ProgressStyle;
using std::chrono::milliseconds;

TEST(ProgressShare, NeverFallsAndStaysBelowItsEnd)
{
    ProgressShare share({"long", 3, ""});
    double last = 0;
    for (int stage = 0; stage < 40; ++stage) {
        share.startStage(stage == 20 ? "long" : "short");
        for (int pass = 0; pass < 5; ++pass) {
            for (const int percent : {0, 30, 100, 250, 12, 9, -5}) {
                share.report(percent);
                ASSERT_GE(share.done(), last);
                ASSERT_LT(share.done(), 1);
                last = share.done();
            }
        }
        share.endStage();
        share.report(50); // between stages
    }
    EXPECT_GT(last, 0.9);
}

TEST(ProgressShare, TheLongestStageFillsMostOfTheBarEvenly)
{
    ProgressShare share({"long", 1, ""});
    for (int stage = 0; stage < 10; ++stage) {
        share.startStage("short");
        share.report(100);
        share.endStage();
    }
    EXPECT_LT(share.done(), 0.05);
    share.startStage("long");
    double before = share.done();
    share.report(10);
    const double step = share.done() - before;
    EXPECT_GT(step, 0.07);
    for (int percent = 20; percent <= 100; percent += 10) {
        before = share.done();
        share.report(percent);
        EXPECT_NEAR(share.done() - before, step, 1e-9);
    }
    EXPECT_LT(share.secondsLeft(1), 0) << "it should have ended";
    share.endStage();
    EXPECT_NEAR(share.done(), 0.9, 1e-9);
}

TEST(ProgressShare, TellsTheTimeLeftOfTheLongestStage)
{
    ProgressShare share({"long", 1, ""});
    EXPECT_LT(share.secondsLeft(1), 0);
    share.startStage("short");
    share.report(50);
    EXPECT_LT(share.secondsLeft(1), 0) << "what is to come takes longer";
    share.startStage("long");
    EXPECT_LT(share.secondsLeft(1), 0) << "nothing is done yet";
    share.report(25);
    EXPECT_NEAR(share.secondsLeft(60), 180, 1e-6);
    share.report(50);
    EXPECT_NEAR(share.secondsLeft(60), 60, 1e-6);
    share.startStage("short");
    EXPECT_LT(share.secondsLeft(1), 0);
}

TEST(ProgressShare, AFallingPercentageBeginsAPass)
{
    ProgressShare one({"long", 4, ""}), four({"long", 4, ""});
    one.startStage("long");
    four.startStage("long");
    one.report(100);
    for (int pass = 0; pass < 4; ++pass) {
        four.report(0);
        four.report(95); // a little out of order, as threads report
        four.report(93);
        four.report(100);
    }
    EXPECT_NEAR(four.done(), 4 * one.done(), 1e-9);
    const double before = four.done();
    for (int pass = 0; pass < 100; ++pass) {
        four.report(0);
        four.report(100);
    }
    EXPECT_GT(four.done(), before) << "passes that nobody expected creep on";
    EXPECT_LT(four.done(), 0.9);
}

TEST(ProgressBar, FitsAnyTerminal)
{
    ProgressState state;
    state.label = "-spheretree spheres=512,256,128,64,32 name=\u00fcberlang\u4e16\u754c keep=1";
    state.stage = "distances and power labels";
    state.seconds = 100;
    for (const double done : {0.0, 0.004, 0.5, 1.0}) {
        for (const double left : {-1.0, 3.0, 40000.0}) {
            for (size_t columns = 0; columns < 200; ++columns) {
                state.done = done;
                state.left = left;
                const std::string line = progressBar(state, columns);
                ASSERT_LE(command::columnsOf(line), columns > 0 ? columns - 1 : 0) << line;
                if (columns >= 40) {
                    EXPECT_EQ(line.find("%") != line.npos, done > 0) << line;
                    EXPECT_EQ(line.rfind("-spheretree", 0), 0u) << line;
                }
            }
        }
    }
    EXPECT_NE(progressBar(state, 199).find("[####################] 100%"), std::string::npos);
}

TEST(ProgressBar, TellsTheTimeLeftOnceItIsKnown)
{
    ProgressState state{"-spheretree", "merging", 0.25, 60, 180};
    EXPECT_EQ(progressText(state), "-spheretree | merging: 25%, about 3 min left");
    state.left = -1;
    EXPECT_EQ(progressText(state), "-spheretree | merging: 25%");
    state.done = 0;
    EXPECT_EQ(progressText(state), "-spheretree | merging: 60 s so far");
    EXPECT_EQ(command::roughSeconds(0.2), "1 s");
    EXPECT_EQ(command::roughSeconds(7300), "2 h");
}

TEST(Terminal, TextIsCutBetweenCharacters)
{
    EXPECT_EQ(command::cutToColumns("a\u4e16b", 4), "a\u4e16b");
    EXPECT_EQ(command::cutToColumns("aaa\u4e16\u754c", 6), "aaa...");
    EXPECT_EQ(command::cutToColumns("aa\u4e16\u754caa", 7), "aa\u4e16...");
    EXPECT_EQ(command::cutToColumns("abc", 2), "..");
    EXPECT_EQ(
        command::brokenAt("one two three four\nfive\n", 9), "one two\n    three\n    four\nfive\n");
    EXPECT_EQ(command::brokenAt("   one\nlonglonglong\n", 5), "   one\nlonglonglong\n");
    EXPECT_EQ(command::brokenAt("one two three\n", 0), "one two three\n");
    EXPECT_EQ(command::cutToColumns("abc", 0), "");
    EXPECT_EQ(command::counted(1, "sphere"), "1 sphere");
    EXPECT_EQ(command::counted(2000, "sphere"), "2,000 spheres");
}

/// What an action shows that has come half way and asks three times.
std::string shown(const ProgressStyle& style, bool enabled = true)
{
    testing::internal::CaptureStderr();
    Progress progress(style);
    progress.setEnabled(enabled);
    progress.beginAction("-work", {"stage", 1, "do less"});
    progress.start("stage");
    progress.start("detail");
    progress.wasInterrupted(99); // is none of the action's business
    progress.end();
    for (int i = 0; i < 3; ++i) progress.wasInterrupted(50);
    progress.end();
    progress.endAction(true);
    progress.wasInterrupted(10); // nothing is shown outside of actions
    return testing::internal::GetCapturedStderr();
}

TEST(Progress, ALogGetsLinesAndTheAdviceOnce)
{
    const milliseconds now(0), never(1000000);
    // The first is shown before anything has been reported.
    const std::string all = shown({false, now, now, now});
    EXPECT_EQ(all,
        "vdb_spheretree: note: do less\n"
        "-work | stage: 1 s so far\n-work | stage: 40%\n-work | stage: 40%\n-work | stage: 40%\n");
    EXPECT_EQ(shown({false, never, now, now}), "");
    EXPECT_EQ(shown({false, now, never, never}), "-work | stage: 1 s so far\n");
    EXPECT_EQ(shown({false, now, now, now}, /*enabled=*/false), "");
}

TEST(Progress, ATerminalGetsABarThatIsFullAtTheEndAndThenGone)
{
    const milliseconds now(0), never(1000000);
    const std::string all = shown({true, now, now, never});
    const std::string full = "[####################] 100%\r\033[K";
    ASSERT_GT(all.size(), full.size());
    EXPECT_EQ(all.substr(all.size() - full.size()), full);
    EXPECT_EQ(all.find('\n'), std::string::npos);
    EXPECT_EQ(shown({true, never, now, never}), "");
}

} // namespace
