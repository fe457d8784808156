// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StepProgress.h>

#include <gtest/gtest.h>

#include <mutex>
#include <vector>

namespace {

using namespace openvdb_spheretree::detail;

/// Takes notes of what it is told, by any thread, and stops the work if it is to.
struct Listener : openvdb::util::NullInterrupter {
    bool wasInterrupted(int percent = -1) override
    {
        const std::lock_guard<std::mutex> lock(mutex);
        if (told.empty() || told.back() != percent) told.push_back(percent);
        return stops;
    }
    std::vector<int> told;
    std::mutex mutex;
    bool stops = false;
};

TEST(StepProgress, AddsStepsUpByTheirCosts)
{
    Listener listener;
    StepProgress progress(&listener);
    progress.expect(30);
    progress.expect(10);
    {
        const Step step(&progress, 10);
        for (const int percent : {0, 40, 100}) progress.wasInterrupted(percent);
    }
    {
        const Step step(&progress, 20);
        progress.wasInterrupted(50);
    }
    {
        const Step step(&progress, 10);
        progress.wasInterrupted(20);
    }
    progress.wasInterrupted();
    EXPECT_EQ(listener.told, (std::vector<int>{0, 10, 25, 50, 80, 99}));
}

TEST(StepProgress, NeverFalls)
{
    Listener listener;
    StepProgress progress(&listener);
    progress.expect(10);
    {
        const Step step(&progress, 10);
        for (const int percent : {60, 10, 61, 0}) progress.wasInterrupted(percent);
    }
    {
        const Step step(&progress, 90); // more than was expected
        progress.wasInterrupted(100);
    }
    EXPECT_EQ(listener.told, (std::vector<int>{60, 61, 99}));
}

TEST(StepProgress, TakesLoopsInAStageOfAStepAndStepsInAStepForDetails)
{
    Listener listener;
    StepProgress progress(&listener);
    progress.expect(100);
    const Step step(&progress, 100);
    progress.wasInterrupted(20);
    {
        const Stage stage("inside", &progress, nullptr);
        progress.wasInterrupted(90);
    }
    {
        const Step inner(&progress, 50);
        progress.wasInterrupted(95);
    }
    progress.wasInterrupted(30);
    EXPECT_EQ(listener.told, (std::vector<int>{20, 30}));
}

TEST(StepProgress, PassesOnWhenToStop)
{
    Listener listener;
    StepProgress progress(&listener);
    EXPECT_NO_THROW(parallelFor(100, &progress, [](std::size_t) {}));
    listener.stops = true;
    EXPECT_THROW(parallelFor(100, &progress, [](std::size_t) {}), openvdb_spheretree::Interrupted);
    StepProgress nobody(nullptr);
    EXPECT_FALSE(nobody.wasInterrupted(50));
    const Step step(nullptr, 1);
}

} // namespace
