// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/Utf8.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>
#include <string>

using namespace openvdb_spheretree::detail;

namespace {

// Letters of one to four bytes.
const std::string kLetters = "a\xc3\xa4\xe2\x82\xac\xf0\x9f\x94\xb5z";

TEST(Text, NoLetterIsCut)
{
    for (std::size_t longest = 0; longest < 2 * kLetters.size(); ++longest) {
        const std::string text = kLetters + kLetters;
        const std::string start(startOf(text, longest));
        EXPECT_TRUE(isUtf8(start)) << longest;
        EXPECT_LE(start.size(), longest);
        EXPECT_GT(start.size() + 4, longest);
        EXPECT_EQ(text.substr(0, start.size()), start);
        EXPECT_EQ(onOneLine(text, longest), start + "...");
    }
    EXPECT_EQ(startOf(kLetters, kLetters.size()), kLetters);
    EXPECT_EQ(onOneLine(kLetters, 100), kLetters);
}

TEST(Text, BytesThatAreNoLettersAreCutWhereTheyAreToBe)
{
    const std::string damaged(100, '\x80');
    for (std::size_t longest = 0; longest < 100; ++longest) {
        EXPECT_EQ(startOf(damaged, longest).size(), longest);
    }
}

TEST(Text, AMessageIsItsFirstLineWithoutTheType)
{
    EXPECT_EQ(messageOf(std::runtime_error("ValueError: too far\nand more")), "too far");
    std::string letters;
    while (letters.size() < 1000) letters += "\xe2\x82\xac";
    EXPECT_EQ(messageOf(std::runtime_error(letters)), letters.substr(0, 399));
}

} // namespace
