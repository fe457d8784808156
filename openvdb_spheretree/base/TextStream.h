// SPDX-License-Identifier: Apache-2.0
/// @file base/TextStream.h
/// @brief Streams over strings that throw when memory is not to be had.

#pragma once

#include <sstream>
#include <string>

namespace openvdb_spheretree::detail {

/// Writes to a string, or reads from one. Those of the standard library catch `bad_alloc`, drop what
/// they were asked to write, and go on as if nothing had happened; here it reaches the caller.
class TextStream : public std::stringstream {
public:
    TextStream() { exceptions(std::ios::badbit); }
    explicit TextStream(const std::string& text) : std::stringstream(text)
    {
        exceptions(std::ios::badbit);
    }
};

} // namespace openvdb_spheretree::detail
