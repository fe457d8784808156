// SPDX-License-Identifier: Apache-2.0
/// @file TestVectorTargets.cc
/// @brief Vector kernels are compiled once for each instruction set, and the processor's best one
/// runs: that of the machine at hand, so the others would never be tested. Here each of them is
/// forced, the plainest one included, and the tests of all that kernels do run again, in processes
/// of their own: what they compare with knows nothing of vectors. The best one needs no such run.

#include "support/VectorTarget.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace spheretree_test {
namespace {

/// The tests of everything that runs kernels, on its own or in the course of things; but for those
/// of tight trees that go through all targets themselves (FineBalls.h).
const std::vector<std::string> kSuites = {"MinPlus", "MaxPlus", "LargestValue", "LeafTranspose",
    "XGaps", "SlabRows", "OffsetBits", "LaneBits", "TransformsOracle", "LargeRadiiOracle",
    "DistanceTransform", "PowerMap", "MedialAxis", "MedialLevel", "LabelStream", "LargestDistSq",
    "SphereDag", "SphereUnion", "NormBallShape", "VoxelShape", "RayScene", "NormsOracle"};

/// Whole trees of norms and their errors take as long as all the rest, and run no kernel that the others do not;
/// labels by one plan and another are compared with each other; and the reference of lines has no kernel.
const std::string kLeftOut =
    "-NormsOracle.*Trees*:NormsOracle.Errors*:LabelStream.Large*AnyPlan:*LineReference*";

/// The test programs that hold them.
std::vector<std::string> programs()
{
    std::vector<std::string> all;
    std::istringstream list(SPHERETREE_TEST_PROGRAMS);
    for (std::string path; std::getline(list, path, ':');) all.push_back(path);
    return all;
}

std::string filterOfTests()
{
    std::string filter;
    for (const std::string& suite : kSuites) filter += suite + ".*:";
    return filter + kLeftOut;
}

/// @return what the tests of a program print on @a target; `code` receives how they end.
std::string outputOfTests(const std::string& program, int64_t target, int& code)
{
    const std::string command = std::string(kTargetVariable) + "=" + targetName(target) + " '"
        + program + "' --gtest_filter='" + filterOfTests() + "' 2>&1";
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

} // namespace

TEST(VectorTargets, CanBeForcedOneAfterTheOther)
{
    if (std::getenv(kTargetVariable)) GTEST_SKIP() << "this process has one target for good";
    const std::vector<int64_t> targets = allTargets();
    EXPECT_EQ(runningTarget(), targetName(targets.front()));
    for (const int64_t target : targets) {
        forceTarget(target);
        EXPECT_EQ(runningTarget(), targetName(target));
    }
    EXPECT_EQ(targets.back(), HWY_STATIC_TARGET);
    forceTarget(0);
    EXPECT_EQ(runningTarget(), targetName(targets.front()));
}

TEST_P(EveryVectorTarget, PassesTheTestsOfAllKernels)
{
    std::string all;
    for (const std::string& program : programs()) {
        int code = -1;
        const std::string output = outputOfTests(program, GetParam(), code);
        EXPECT_EQ(code, 0) << program << '\n' << output;
        EXPECT_NE(output.find("all tests ran on " + targetName(GetParam())), std::string::npos)
            << program << '\n'
            << output;
        all += output;
    }
    for (const std::string& suite : kSuites) { // a filter of a name that is gone runs nothing
        EXPECT_TRUE(hasRun(all, suite)) << "no test has run of the suite " << suite;
    }
}

std::vector<int64_t> otherTargets()
{
    std::vector<int64_t> targets = allTargets();
    targets.erase(targets.begin()); // all other tests run on this one
    return targets;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryVectorTarget); // of a machine with one target
INSTANTIATE_TEST_SUITE_P(Of, EveryVectorTarget, testing::ValuesIn(otherTargets()),
    [](const auto& info) { return targetName(info.param); });

} // namespace spheretree_test
