// SPDX-License-Identifier: Apache-2.0
/// @file TestCsvTable.cc
/// @brief Lines of tables from anywhere: what separates columns, what is skipped, and what is refused at its line.

#include "support/Messages.h"

#include <openvdb_spheretree/base/CsvTable.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <sstream>
#include <string>
#include <vector>

namespace {

using openvdb_spheretree::detail::CsvTable;
using spheretree_test::mentions;
using spheretree_test::messageOf;
using Lines = std::vector<std::vector<std::string>>;

Lines linesOf(const std::string& text)
{
    std::istringstream in(text);
    CsvTable table(in, "nothing");
    Lines lines;
    do {
        lines.emplace_back(table.fields().begin(), table.fields().end());
    } while (table.next());
    return lines;
}

std::string whyNot(const std::string& text)
{
    return messageOf<openvdb::IoError>([&] { linesOf(text); });
}

bool hasHeader(const std::string& text)
{
    std::istringstream in(text);
    return CsvTable(in, "nothing").hasHeader();
}

} // namespace

TEST(CsvTable, ColumnsAreSeparatedByWhatComesFirstInTheFirstLine)
{
    const Lines expected = {{"1", "2", "3"}, {"4", "", "6"}};
    EXPECT_EQ(linesOf("1;2;3\n4;;6\n"), expected);
    EXPECT_EQ(linesOf("1,2,3\n4,,6"), expected);
    EXPECT_EQ(linesOf("1\t2\t3\n4\t\t6\r\n"), expected);
    EXPECT_EQ(linesOf("  1 2  3 \n\n# 9\n 4\t5   6"), (Lines{{"1", "2", "3"}, {"4", "5", "6"}}));
    EXPECT_EQ(linesOf("1,5;2\n3;4,5"), (Lines{{"1,5", "2"}, {"3", "4,5"}}));
}

TEST(CsvTable, QuotesHoldSeparatorsAndAreDropped)
{
    EXPECT_EQ(linesOf("\"a,b\", \"c\" ,d"), (Lines{{"a,b", "c", "d"}}));
    EXPECT_EQ(linesOf("\xEF\xBB\xBF\"x\" y"), (Lines{{"x", "y"}}));
}

TEST(CsvTable, AHeaderHasAFieldThatIsAName)
{
    EXPECT_TRUE(hasHeader("x,1"));
    EXPECT_TRUE(hasHeader(",_x,1"));
    EXPECT_TRUE(hasHeader("\xc3\xa9,1"));
    EXPECT_FALSE(hasHeader("+1,-2e3"));
    for (const char* const damaged : {"+-1,2", "1e999,2", "1e-999,2", "0x1p3,2", ",2", "nan,-inf"})
        EXPECT_FALSE(hasHeader(damaged)) << damaged;
}

TEST(CsvTable, ADamagedNumberOfTheFirstLineIsNamedThere)
{
    const auto why = [](const std::string& field) {
        std::istringstream in("\n7," + field + "\n");
        const CsvTable table(in, "nothing");
        return messageOf<openvdb::IoError>([&] { table.number(1); });
    };
    EXPECT_TRUE(mentions(why("1e999"), "line 2: '1e999' is beyond the range"));
    EXPECT_TRUE(mentions(why("+1e-999"), "line 2: '+1e-999' is beyond the range"));
    EXPECT_TRUE(mentions(why(""), "line 2: column 2 is empty"));
    EXPECT_TRUE(mentions(why("0x1p3"), "line 2: '0x1p3' is no number: write it in decimal"));
    EXPECT_TRUE(mentions(why("1e999x"), "line 2: '1e999x' is no number"));
}

TEST(CsvTable, WhatIsInUtf16IsSaidToBe)
{
    using namespace std::string_literals;
    for (const std::string& text : {"\xff\xfe"s + "x\0,\0y\0\n\0"s, "\xfe\xff"s + "\0x\0,\0y\0\n"s,
             "\xff\xfe\x31"s, "1\0,\0"s}) {
        EXPECT_TRUE(mentions(whyNot(text), "line 1: it is not the text of a table"));
        EXPECT_TRUE(mentions(whyNot(text), "UTF-16"));
    }
    EXPECT_TRUE(mentions(whyNot("1,2\n3,\0 4\n"s), "line 2: it is not the text"));
}

TEST(CsvTable, NumbersAreReadOrNamed)
{
    std::istringstream in("a,b\n+1.5,two\n");
    CsvTable table(in, "nothing");
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.number(0), 1.5);
    const auto why = messageOf<openvdb::IoError>([&] { table.number(1); });
    EXPECT_TRUE(mentions(why, "line 2: 'two' is no number"));
}

TEST(CsvTable, WhatIsNoTableIsRefusedAtItsLine)
{
    EXPECT_TRUE(mentions(whyNot("\n# only this\n"), "nothing"));
    EXPECT_TRUE(mentions(whyNot("1,2\n3\n"), "line 2: it has 1 columns, and the first line has 2"));
    EXPECT_TRUE(mentions(whyNot("1\n" + std::string(70000, '2')), "line 2: it is longer"));
    EXPECT_EQ(linesOf(std::string(65536, '2')).size(), 1u);
    EXPECT_TRUE(mentions(whyNot(std::string(4096, ',')), "more than 4096 columns"));
    EXPECT_EQ(linesOf(std::string(4095, ',')).front().size(), 4096u);
}
