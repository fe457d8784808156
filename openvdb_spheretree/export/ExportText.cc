// SPDX-License-Identifier: Apache-2.0
#include "ExportText.h"

#include <openvdb_spheretree/store/JsonWriter.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace openvdb_spheretree::detail {

namespace {

bool isWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

} // namespace

ExportText::ExportText(const ExportSink& out, int decimals)
    : ExportBuffer(out), mDecimals(decimals), mUnits(std::pow(10.0, decimals))
{}

ExportText& ExportText::writeWhole(int64_t number)
{
    std::array<char, 24> digits;
    mBytes.append(
        digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
    return *this;
}

ExportText& ExportText::operator<<(double length)
{
    const double units = std::nearbyint(length * mUnits);
    std::array<char, 24> digits;
    const auto whole = uint64_t(std::abs(units)); // at most 2^53: decimalsFor()
    const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), whole).ptr;
    const auto count = int(end - digits.data());
    if (units < 0) mBytes += '-';
    const int beforePoint = count - mDecimals;
    if (beforePoint <= 0) {
        mBytes += "0.";
        mBytes.append(std::size_t(-beforePoint), '0');
        mBytes.append(digits.data(), std::size_t(count));
    } else {
        mBytes.append(digits.data(), std::size_t(beforePoint));
        mBytes += '.';
        mBytes.append(digits.data() + beforePoint, std::size_t(mDecimals));
    }
    while (mBytes.back() == '0') mBytes.pop_back();
    if (mBytes.back() == '.') mBytes += '0';
    return *this;
}

ExportText& ExportText::lengths(const openvdb::Vec3d& vector, std::string_view separator)
{
    *this << vector[0] << separator << vector[1] << separator << vector[2];
    return *this;
}

ExportText& ExportText::asFloat(double number)
{
    std::array<char, 32> digits;
    mBytes.append(digits.data(),
        std::to_chars(digits.data(), digits.data() + digits.size(), float(number)).ptr);
    return *this;
}

ExportText& ExportText::floats(const openvdb::Vec3d& vector, std::string_view separator)
{
    asFloat(vector[0]) << separator;
    asFloat(vector[1]) << separator;
    return asFloat(vector[2]);
}

ExportText& ExportText::real(double number)
{
    std::array<char, 32> digits;
    mBytes.append(
        digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
    return *this;
}

ExportText& ExportText::reals(const double* numbers, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) mBytes += ' ';
        real(numbers[i]);
    }
    return *this;
}

std::string xmlText(std::string_view text)
{
    std::string escaped;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        switch (c) {
        case '&': escaped += "&amp;"; break;
        case '<': escaped += "&lt;"; break;
        case '>': escaped += "&gt;"; break;
        case '"': escaped += "&quot;"; break;
        default: escaped += byte < 32 || byte >= 127 ? '?' : c;
        }
    }
    return escaped;
}

std::string jsonString(const std::string& text)
{
    JsonWriter json;
    json.beginArray({}, /*onOneLine=*/true);
    json.value({}, text);
    return json.text().substr(1);
}

std::string identifier(std::string_view text)
{
    std::string word;
    for (const char c : text) word += isWordLetter(c) ? c : '_';
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word.front())) != 0)
        word.insert(0, "_");
    return word;
}

std::string oneWord(std::string_view text)
{
    std::string word;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        word += byte <= 32 || byte >= 127 ? '_' : c;
    }
    return word.empty() ? "_" : word;
}

} // namespace openvdb_spheretree::detail
