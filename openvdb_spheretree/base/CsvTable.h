// SPDX-License-Identifier: Apache-2.0
/// @file CsvTable.h
/// @brief Strict reader of tables of numbers, line by line, from whatever wrote them.
///
/// The first line that is not skipped decides: its first semicolon, comma or tab is what separates
/// columns, in this order, or else blanks; and it is a header if one of its fields begins with a letter and is no
/// number. Empty lines are skipped, and those that begin with '#'. Fields may stand in quotes.
///
/// Memory: a line of 65536 characters at most. Tests: TestCsvTable.cc.

#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace openvdb_spheretree::detail {

class CsvTable {
public:
    /// @brief Goes to the first line.
    /// @param in       binary
    /// @param noLines  the error of a table without a line
    /// @throw openvdb::IoError
    CsvTable(std::istream& in, const std::string& noLines);

    /// @return whether the first line names the columns.
    bool hasHeader() const { return mHasHeader; }
    /// @brief Goes to the next line.
    /// @return false at the end
    /// @throw openvdb::IoError if it has not as many fields as the first one
    bool next();

    /// Of the line, without blanks and quotes around them: until the next one.
    const std::vector<std::string_view>& fields() const { return mFields; }
    std::uint64_t lineNumber() const { return mNumber; } ///< from 1, of all lines of the file
    /// @throw openvdb::IoError if the field is no number
    double number(std::size_t column) const;
    /// @throw openvdb::IoError that says which line it is
    [[noreturn]] void fail(const std::string& what) const;

private:
    bool findLine();
    bool readLine();
    void split();

    std::istream& mIn;
    std::vector<char> mBuffer;
    std::string mLine;
    std::uint64_t mNumber = 0;
    std::size_t mColumns = 0;
    char mSeparator = ',';
    bool mHasHeader = false;
    std::vector<std::string_view> mFields;
};

} // namespace openvdb_spheretree::detail
