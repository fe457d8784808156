// SPDX-License-Identifier: Apache-2.0
// The letters are encoded by arithmetic here, and are not cut apart as the library does.

#include <openvdb_spheretree/base/Utf8.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

using namespace openvdb_spheretree::detail;

namespace {

std::string encoded(unsigned letter)
{
    const auto tail = [letter](int shift) { return char(0x80 + (letter >> shift) % 64); };
    if (letter < 0x80) return {char(letter)};
    if (letter < 0x800) return {char(0xc0 + (letter >> 6)), tail(0)};
    if (letter < 0x10000) return {char(0xe0 + (letter >> 12)), tail(6), tail(0)};
    return {char(0xf0 + (letter >> 18)), tail(12), tail(6), tail(0)};
}

TEST(Utf8, KnowsEveryLetterOfUnicodeAndNoSurrogate)
{
    for (unsigned letter = 0; letter < 0x120000; ++letter) {
        const std::string bytes = encoded(letter);
        const bool isLetter = letter < 0x110000 && (letter < 0xd800 || letter > 0xdfff);
        ASSERT_EQ(utf8Length(bytes, 0), isLetter ? bytes.size() : 0) << letter;
        ASSERT_EQ(isUtf8("a" + bytes + "z"), isLetter) << letter;
    }
}

TEST(Utf8, KnowsNoOtherBytesForALetter)
{
    std::set<std::string> letters;
    for (unsigned letter = 0x80; letter < 0x10000; ++letter) {
        if (letter < 0xd800 || letter > 0xdfff) letters.insert(encoded(letter));
    }
    for (unsigned bytes = 0x800000; bytes < 0xf00000; bytes += 5) {
        const std::string text = {char(bytes >> 16), char(bytes >> 8), char(bytes)};
        const std::string letter = text.substr(0, bytes < 0xe00000 ? 2 : 3);
        ASSERT_EQ(utf8Length(text, 0), letters.count(letter) > 0 ? letter.size() : 0)
            << std::hex << bytes;
    }
}

TEST(Utf8, ALetterIsNotCutOff)
{
    const std::string letter = encoded(0x1f600);
    for (std::size_t length = 1; length < letter.size(); ++length)
        EXPECT_FALSE(isUtf8(letter.substr(0, length))) << length;
    EXPECT_TRUE(isUtf8(letter));
    EXPECT_TRUE(isUtf8(""));
    EXPECT_EQ(utf8Length("", 0), 0u);
}

} // namespace
