// SPDX-License-Identifier: Apache-2.0
/// @file TestBase64.cc
/// @brief Numbers as base64: against texts that other programs made.

#include "support/Messages.h"

#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/viewer/Base64.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <vector>

namespace {

using openvdb_spheretree::detail::Base64;
using openvdb_spheretree::detail::TextStream;

template <typename Number>
std::string base64Of(const std::vector<Number>& numbers)
{
    TextStream out;
    Base64 base64(out);
    for (const Number number : numbers) base64.add(number);
    base64.finish();
    return out.str();
}

// python3: base64.b64encode(struct.pack('<i', 1)) and so on
TEST(Base64, HasLittleEndianNumbersOfEachSize)
{
    EXPECT_EQ(base64Of<int32_t>({}), "");
    EXPECT_EQ(base64Of<int32_t>({1}), "AQAAAA==");
    EXPECT_EQ(base64Of<int32_t>({1, -2}), "AQAAAP7///8=");
    EXPECT_EQ(base64Of<int32_t>({1, -2, 67305985}), "AQAAAP7///8BAgME");
    EXPECT_EQ(base64Of<float>({0.1f}), "zczMPQ==");
    EXPECT_EQ(base64Of<double>({0.1, -1e300}), "mpmZmZmZuT+cdQCIPOQ3/g==");
}

TEST(Base64, IsTheSameTextHoweverOftenItIsWrittenOut)
{
    const std::string text = base64Of(std::vector<uint32_t>(300000, 0));
    EXPECT_EQ(text, std::string(1600000, 'A'));
}

TEST(Base64, AStreamThatFailsIsAnError)
{
    std::ostream out(nullptr);
    Base64 base64(out);
    base64.add(int32_t(1));
    EXPECT_TRUE(spheretree_test::mentions(
        spheretree_test::messageOf<openvdb::IoError>([&] { base64.finish(); }), "disk full"));
}

} // namespace
