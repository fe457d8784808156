// SPDX-License-Identifier: Apache-2.0
/// @file TestMain.cc
/// @brief The main function of all test programs: GoogleTest's, on a vector target that the
/// environment may name (VectorTarget.h), with memory that is kept for the next small object.

#include "support/VectorTarget.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#ifdef __GLIBC__
#include <malloc.h>
#endif

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

/// Every tree of a few voxels has nodes of 300 kB. Tests make and drop such trees a million times, and
/// without this each of them would be given back to the system, and its pages cleared anew.
void keepFreedMemory()
{
#ifdef __GLIBC__
    constexpr int kMegabyte = 1 << 20;
    mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte); // the most that glibc takes
    mallopt(M_TRIM_THRESHOLD, 1024 * kMegabyte);
    mallopt(M_TOP_PAD, 16 * kMegabyte);
#endif
}

} // namespace
} // namespace spheretree_test

int main(int argc, char** argv)
{
    spheretree_test::keepFreedMemory();
    testing::InitGoogleTest(&argc, argv);
    testing::AddGlobalTestEnvironment(new spheretree_test::ForcedTarget);
    return RUN_ALL_TESTS();
}
