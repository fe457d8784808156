// SPDX-License-Identifier: Apache-2.0
/// @file ExportText.h
/// @brief Writes text with numbers to a stream, in no locale.

#pragma once

#include "ExportBuffer.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace openvdb_spheretree::detail {

class ExportText : public ExportBuffer {
public:
    /// @param decimals  at most so many of a length; all lengths must be multiples of 10^-decimals (ExportScene)
    ExportText(const ExportSink& out, int decimals);
    /// The same for lengths that follow.
    void useDecimals(int decimals);

    ExportText& operator<<(std::string_view text)
    {
        mBytes += text;
        flushIfLong();
        return *this;
    }
    ExportText& operator<<(char c)
    {
        mBytes += c;
        return *this;
    }
    template <typename Number, typename = std::enable_if_t<std::is_integral_v<Number>>>
    ExportText& operator<<(Number number)
    {
        return writeWhole(int64_t(number));
    }
    /// A length with one decimal at least, and never with an exponent: YAML takes `1` for no float, and
    /// `5e-05` for no number.
    ExportText& operator<<(double length);
    /// Three lengths with @a separator between.
    ExportText& lengths(const openvdb::Vec3d& vector, std::string_view separator);
    /// A number that is a float: the shortest text that reads back to the same float.
    ExportText& asFloat(double number);
    ExportText& floats(const openvdb::Vec3d& vector, std::string_view separator);
    /// Any other number: the shortest text that reads back to the same double.
    ExportText& real(double number);
    /// The same for each of @a count numbers, with spaces between.
    ExportText& reals(const double* numbers, std::size_t count);

private:
    ExportText& writeWhole(int64_t number);

    int mDecimals;
    double mUnits;
};

/// @name Names as formats take them
/// @{
std::string xmlText(std::string_view text); ///< with entities; what XML cannot hold becomes U+FFFD
bool isXmlText(std::string_view text);      ///< whether XML can hold all of it
std::string yamlString(const std::string& text); ///< in double quotes, as JSON writes it as well
std::string yamlKey(
    const std::string& text); ///< the same. @throw openvdb::ValueError if it is too long for one
std::string identifier(std::string_view text); ///< letters, digits and `_`, and no digit first
std::string oneWord(std::string_view text);    ///< on one line, without spaces
/// @}

} // namespace openvdb_spheretree::detail
