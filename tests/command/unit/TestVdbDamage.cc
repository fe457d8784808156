// SPDX-License-Identifier: Apache-2.0
// The search for the place of damage, where something comes in between.

#include <base/Stop.h>
#include <files/VdbDamage.h>

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <gtest/gtest.h>
#include <openvdb/points/PointDataGrid.h>

#include <atomic>
#include <new>

namespace {

std::atomic<int> sAsked;

bool isStoppedLater() { return ++sAsked > 1; }

/// Of any request for memory meanwhile.
bool failsLater()
{
    if (++sAsked > 1) throw std::bad_alloc();
    return false;
}

/// The first question comes before the tree is looked at.
class VdbDamage : public testing::Test {
protected:
    void SetUp() override
    {
        mGrids = {openvdb_spheretree::toPoints(spheretree_test::sampleTree())};
        sAsked = 0;
    }
    void TearDown() override { command::setStopQuestion(nullptr); }

    openvdb::GridPtrVec mGrids;
};

TEST_F(VdbDamage, IsElsewhereIfTheTreesAreWhole)
{
    EXPECT_TRUE(spheretree_test::mentions(
        command::placeOfDamage(mGrids), "its trees are whole by their own checksums; what"));
}

TEST_F(VdbDamage, CanBeInterruptedWithinATree)
{
    command::setStopQuestion(isStoppedLater);
    EXPECT_THROW(command::placeOfDamage(mGrids), openvdb_spheretree::Interrupted);
}

TEST_F(VdbDamage, IsToldWithoutAPlaceWhereMemoryIsShort)
{
    command::setStopQuestion(failsLater);
    EXPECT_TRUE(
        spheretree_test::mentions(command::placeOfDamage(mGrids), "there is not enough memory"));
}

} // namespace
