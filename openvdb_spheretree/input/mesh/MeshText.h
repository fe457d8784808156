// SPDX-License-Identifier: Apache-2.0
/// @file MeshText.h
/// @brief Lines, words and numbers of a text file, with errors that say in which line.

#pragma once

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Types.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace openvdb_spheretree {
namespace detail {

/// Walks through a text line by line, word by word.
class MeshText {
public:
    explicit MeshText(std::string_view text) : mRest(text) {}

    /// Go to the next line. @return false at the end of the text.
    bool nextLine();
    /// Go to the next line that has a word before any @a comment character; none is an error.
    void needLine(const char* what);
    /// Cut the line off at its first '#'.
    void dropComment();

    /// @return the next word of the line, empty at its end.
    std::string_view word();
    /// @return the same, going on to following lines; empty at the end of the text.
    std::string_view wordOnAnyLine();

    /// @return the next word of the line as a number; none, or no number, is an error.
    double number(const char* what);
    std::int64_t integer(const char* what);
    /// @return the next three words as a point; coordinates that are not finite are an error.
    openvdb::Vec3s point();

    double toNumber(std::string_view word, const char* what) const;
    std::int64_t toInteger(std::string_view word, const char* what) const;

    /// @return what follows the current line.
    std::string_view rest() const { return mRest; }
    std::uint64_t lineNumber() const { return mNumber; }

    /// @throw openvdb::IoError "line N: what"
    [[noreturn]] void fail(const std::string& what) const;

private:
    std::string_view mRest, mLine;
    std::uint64_t mNumber = 0;
};

} // namespace detail
} // namespace openvdb_spheretree
