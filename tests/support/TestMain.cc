// SPDX-License-Identifier: Apache-2.0
/// @file TestMain.cc
/// @brief The main function of all test programs: GoogleTest's, on a vector target that the
/// environment may name (VectorTarget.h).

#include "support/VectorTarget.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace spheretree_test {
namespace {

class ForcedTarget : public testing::Environment {
    void SetUp() override
    {
        const char* name = std::getenv(kTargetVariable);
        if (!name) return;
        for (const int64_t target : allTargets()) {
            if (name == targetName(target)) return forceTarget(target);
        }
        FAIL() << kTargetVariable << " is " << name
               << ", which is no target of this program and machine";
    }
    /// No test has gone back to another one.
    void TearDown() override
    {
        const char* name = std::getenv(kTargetVariable);
        if (!name) return;
        EXPECT_EQ(runningTarget(), name);
        std::cout << "all tests ran on " << runningTarget() << '\n';
    }
};

} // namespace
} // namespace spheretree_test

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    testing::AddGlobalTestEnvironment(new spheretree_test::ForcedTarget);
    return RUN_ALL_TESTS();
}
