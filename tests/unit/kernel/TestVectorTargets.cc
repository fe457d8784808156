// SPDX-License-Identifier: Apache-2.0
/// @file TestVectorTargets.cc
/// @brief Vector kernels are compiled once for each instruction set, and the processor's best one
/// runs: that of the machine at hand, so the others would never be tested. Here each of them is
/// forced, the plainest one included, and the tests of all that kernels do run again, in a process
/// of their own: what they compare with knows nothing of vectors.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/unit/kernel/TestVectorTargets.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheretree_test {
namespace HWY_NAMESPACE {

/// A kernel that says what it was compiled for.
int64_t OwnTarget() { return HWY_TARGET; }

} // namespace HWY_NAMESPACE
} // namespace spheretree_test
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace spheretree_test {
namespace {

HWY_EXPORT(OwnTarget);

/// In the environment of a process: the name of the target that it is to run.
constexpr const char* kVariable = "SPHERETREE_TEST_TARGET";

/// The tests of everything that runs kernels, on its own or in the course of things; but for those
/// of tight trees that go through all targets themselves (FineBalls.h).
const std::vector<std::string> kSuites = {"MinPlus", "MaxPlus", "LargestValue", "LeafTranspose",
    "XGaps", "SlabRows", "OffsetBits", "LaneBits", "TransformsOracle", "LargeRadiiOracle",
    "DistanceTransform", "PowerMap", "MedialAxis", "MedialLevel", "LabelStream", "LargestDistSq",
    "SphereDag", "SphereUnion", "NormBallShape", "VoxelShape", "RayScene", "NormsOracle"};

std::string filterOfTests()
{
    std::string filter = "VectorTargets.RunsWhatTheEnvironmentSays";
    for (const std::string& suite : kSuites) filter += ":" + suite + ".*";
    return filter;
}

std::string runningTarget() { return hwy::TargetName(HWY_DYNAMIC_DISPATCH(OwnTarget)()); }

void force(int64_t target)
{
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// @return those of this binary that the processor can run; the plainest one comes last.
std::vector<int64_t> allTargets()
{
    std::vector<int64_t> targets;
    for (int64_t left = HWY_TARGETS; left != 0; left &= left - 1) {
        const int64_t target = left & -left;
        if ((hwy::SupportedTargets() & target) || target == HWY_STATIC_TARGET) {
            targets.push_back(target);
        }
    }
    return targets;
}

/// Forces the target of the environment before the first test.
class ForcedTarget : public testing::Environment {
    void SetUp() override
    {
        const char* name = std::getenv(kVariable);
        if (!name) return;
        for (const int64_t target : allTargets()) {
            if (name == std::string(hwy::TargetName(target))) return force(target);
        }
        FAIL() << kVariable << " is " << name << ", which is no target of this binary and machine";
    }
    /// No test has gone back to another one.
    void TearDown() override
    {
        const char* name = std::getenv(kVariable);
        if (name) {
            EXPECT_EQ(runningTarget(), name);
        }
    }
};

const testing::Environment* const kForcedTarget =
    testing::AddGlobalTestEnvironment(new ForcedTarget);

TEST(VectorTargets, RunsWhatTheEnvironmentSays)
{
    const char* name = std::getenv(kVariable);
    if (name) {
        EXPECT_EQ(runningTarget(), name);
    } else EXPECT_EQ(runningTarget(), hwy::TargetName(allTargets().front()));
}

TEST(VectorTargets, CanBeForcedOneAfterTheOther)
{
    if (std::getenv(kVariable)) GTEST_SKIP() << "this process has one target for good";
    const std::vector<int64_t> targets = allTargets();
    for (const int64_t target : targets) {
        force(target);
        EXPECT_EQ(runningTarget(), hwy::TargetName(target));
    }
    force(0); // whatever the processor has
    EXPECT_EQ(runningTarget(), hwy::TargetName(targets.front()));
    EXPECT_EQ(targets.back(), HWY_STATIC_TARGET);
}

/// @return what the tests print on @a target; `code` receives how they end.
std::string outputOfTests(int64_t target, int& code)
{
    const std::string command = std::string(kVariable) + "=" + hwy::TargetName(target) + " '"
        + SPHERETREE_TESTS + "' --gtest_filter='" + filterOfTests() + "' 2>&1";
    std::string output;
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return output;
    std::array<char, 4096> part;
    while (const std::size_t size = fread(part.data(), 1, part.size(), pipe)) {
        output.append(part.data(), size);
    }
    code = pclose(pipe);
    return output;
}

/// @return whether a suite of this name has run tests, and ended.
bool hasRun(const std::string& output, const std::string& suite)
{
    for (const char* of : {" tests from ", " test from "}) {
        if (output.find(of + suite + " (") != std::string::npos) return true;
    }
    return false;
}

class EveryVectorTarget : public testing::TestWithParam<int64_t> {};

TEST_P(EveryVectorTarget, PassesTheTestsOfAllKernels)
{
    int code = -1;
    const std::string output = outputOfTests(GetParam(), code);
    EXPECT_EQ(code, 0) << output;
    EXPECT_NE(output.find("[       OK ] VectorTargets.RunsWhat"), std::string::npos) << output;
    for (const std::string& suite : kSuites) { // a filter of a name that is gone runs nothing
        EXPECT_TRUE(hasRun(output, suite)) << "no test has run of the suite " << suite;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, EveryVectorTarget, testing::ValuesIn(allTargets()),
    [](const auto& info) { return std::string(hwy::TargetName(info.param)); });

} // namespace
} // namespace spheretree_test
#endif
