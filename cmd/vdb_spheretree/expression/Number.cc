// SPDX-License-Identifier: Apache-2.0
#include "Number.h"

#include "base/Errors.h"

#include <openvdb_spheretree/base/Text.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace command {

namespace {

/// @return the number with six decimals, or the shortest text of it if that loses too much.
template <typename Real>
std::string realText(Real number)
{
    if (!std::isfinite(number)) throwUsage("the result is not a finite number");
    constexpr double kEnough = 1e-5; // of the number
    char text[400];                  // the largest double has 309 digits before the point
    std::snprintf(text, sizeof(text), "%.6f", double(number));
    const double lost = std::abs(std::strtod(text, nullptr) - double(number));
    if (lost <= kEnough * std::abs(double(number))) return text;
    return {text, std::to_chars(text, text + sizeof(text), number).ptr};
}

} // namespace

std::optional<Number> numberOf(const std::string& text)
{
    using openvdb_spheretree::detail::parseNumber;
    std::string digits = text.substr(std::min(text.find_first_not_of(' '), text.size()));
    const bool isSigned = digits.size() > 1 && digits[0] == '+' && digits[1] != '-';
    if (isSigned) digits.erase(0, 1);
    if (const auto whole = parseNumber<int64_t>(digits)) return *whole;
    const auto real = parseNumber<float>(digits);
    if (!real || !std::isfinite(*real)) return {};
    return *real;
}

float realOf(const Number& number)
{
    return std::visit([](auto value) { return float(value); }, number);
}

std::string textOf(const Number& number)
{
    if (const auto* whole = std::get_if<int64_t>(&number)) return std::to_string(*whole);
    return realText(std::get<float>(number));
}

std::string textOfReal(double number) { return realText(number); }

} // namespace command
