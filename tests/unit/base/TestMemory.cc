// SPDX-License-Identifier: Apache-2.0
/// @file TestMemory.cc
/// @brief What needs more memory than the machine has is refused, with a sentence.

#include <openvdb_spheretree/base/Memory.h>

#include "support/Messages.h"

#include <openvdb/Exceptions.h>

#include <gtest/gtest.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(Memory, WhatTheMachineHasIsAllowedAndMoreIsRefused)
{
    const double there = detail::physicalMemory();
    ASSERT_GT(there, 0) << "a machine that does not say what memory it has";
    EXPECT_NO_THROW(detail::requireMemory(there, "spheres", "none"));
    const std::string why = messageOf<openvdb::ValueError>(
        [&] { detail::requireMemory(there * 1.01, "spheres", "use fewer"); });
    EXPECT_TRUE(mentions(why, "spheres need about"));
    EXPECT_TRUE(mentions(why, "GiB of this machine: use fewer"));
}

TEST(Memory, OfLeafNodesIsThatOfAllOfThem)
{
    const auto leaves = int64_t(detail::physicalMemory() / 1000);
    ASSERT_GT(leaves, 0) << "a machine that does not say what memory it has";
    EXPECT_NO_THROW(detail::requireMemory(leaves, 999));
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { detail::requireMemory(leaves, 1010); }),
            std::to_string(leaves) + " leaf nodes"));
}

TEST(Memory, IsNamedInBytesWhereItIsLittleAndAsItIsTyped)
{
    EXPECT_EQ(detail::asText(1, false), "1 byte");
    EXPECT_EQ(detail::asText(1023, false), "1023 bytes");
    EXPECT_EQ(detail::asText(1024, false), "1 KiB");
    EXPECT_EQ(detail::asMemoryOption(1), "memory=0.1KiB");
    EXPECT_EQ(detail::asMemoryOption(4.42 * (1 << 20)), "memory=4.5MiB");
    const std::string why = messageOf<openvdb::ValueError>(
        [] { detail::requireAllowed(3 << 20, 1 << 10, "spheres", "use fewer"); });
    EXPECT_TRUE(mentions(
        why, "spheres need about 3 MiB, and memory= allows 1 KiB: try memory=3MiB, use fewer"));
}

} // namespace
