// SPDX-License-Identifier: Apache-2.0
/// @file MeshText.h
/// @brief Lines, words and numbers of a text file. Errors name the line.

#pragma once

#include <openvdb_spheretree/base/InterruptSteps.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Types.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace openvdb_spheretree::detail {

/// Goes through a text line by line and word by word.
class MeshText {
public:
    /// @param interrupter  is asked now and then by whatever goes on; may be null
    MeshText(std::string_view text, openvdb::util::NullInterrupter* interrupter)
        : mRest(text), mSteps(interrupter)
    {}

    /// Go to the next line. @return false at the end of the text.
    bool nextLine();
    /// Go to the next line that has a word before its first '#', and drop what follows that.
    /// @throw openvdb::IoError "the file ends before what"
    void needLine(const char* what);
    /// Cut the line off at its first '#'.
    void dropComment();

    /// @return the next word of the line; empty at its end.
    std::string_view word();
    /// @return the next word of this line or of those that follow; empty at the end of the text.
    std::string_view wordOnAnyLine();
    /// @return the next three words of the line as a point.
    /// @throw openvdb::IoError if a coordinate is missing, or is not finite
    openvdb::Vec3d point();

    /// @name A word of this line as a number
    /// @throw openvdb::IoError if it is empty, or is not @a what
    /// @{
    double toNumber(std::string_view word, const char* what) const;
    std::int64_t toInteger(std::string_view word, const char* what) const;
    /// @}

    /// @return what follows the current line.
    std::string_view rest() const { return mRest; }
    std::uint64_t lineNumber() const { return mNumber; }

    /// @throw openvdb::IoError "line N: what"
    [[noreturn]] void fail(const std::string& what) const;

private:
    std::string_view mRest, mLine;
    std::uint64_t mNumber = 0;
    InterruptSteps mSteps;
};

} // namespace openvdb_spheretree::detail
