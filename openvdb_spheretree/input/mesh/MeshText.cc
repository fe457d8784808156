// SPDX-License-Identifier: Apache-2.0
/// @file MeshText.cc
/// @brief Lines, words and numbers of a text file.

#include "MeshText.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace openvdb_spheretree {
namespace detail {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

template <typename Number>
bool parse(std::string_view word, Number& number)
{
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const char* const last = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), last, number);
    return error == std::errc() && end == last;
}

} // namespace

bool MeshText::nextLine()
{
    if (mRest.empty()) {
        mLine = {};
        return false;
    }
    const std::size_t end = std::min(mRest.find('\n'), mRest.size());
    mLine = mRest.substr(0, end);
    mRest.remove_prefix(std::min(end + 1, mRest.size()));
    ++mNumber;
    return true;
}

void MeshText::dropComment() { mLine = mLine.substr(0, mLine.find('#')); }

void MeshText::needLine(const char* what)
{
    do {
        if (!nextLine()) fail(std::string("the file ends before ") + what);
        dropComment();
    } while (mLine.find_first_not_of(kBlanks) == std::string_view::npos);
}

std::string_view MeshText::word()
{
    const std::size_t begin = std::min(mLine.find_first_not_of(kBlanks), mLine.size());
    const std::size_t end = std::min(mLine.find_first_of(kBlanks, begin), mLine.size());
    const std::string_view found = mLine.substr(begin, end - begin);
    mLine.remove_prefix(end);
    return found;
}

std::string_view MeshText::wordOnAnyLine()
{
    std::string_view found = word();
    while (found.empty() && nextLine()) found = word();
    return found;
}

double MeshText::toNumber(std::string_view word, const char* what) const
{
    double number = 0;
    if (word.empty()) fail(std::string("ends before ") + what);
    if (parse(word, number)) return number;
    // Too small or too large for a double: 0 is near enough to the one, and the other an error.
    if (word.find("e-") != word.npos || word.find("E-") != word.npos) {
        const std::string_view mantissa = word.substr(0, word.find_first_of("eE"));
        std::int64_t exponent = 0;
        if (parse(mantissa, number) && parse(word.substr(mantissa.size() + 1), exponent)) return 0;
    }
    fail(inQuotes(word) + " is not " + what);
}

std::int64_t MeshText::toInteger(std::string_view word, const char* what) const
{
    std::int64_t number = 0;
    if (word.empty()) fail(std::string("ends before ") + what);
    if (!parse(word, number)) fail(inQuotes(word) + " is not " + what);
    return number;
}

double MeshText::number(const char* what) { return toNumber(word(), what); }

std::int64_t MeshText::integer(const char* what) { return toInteger(word(), what); }

openvdb::Vec3s MeshText::point()
{
    openvdb::Vec3s p;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = static_cast<float>(number("a coordinate"));
        if (!std::isfinite(p[axis])) fail("a coordinate is not finite, or too large for a float");
    }
    return p;
}

void MeshText::fail(const std::string& what) const
{
    throw openvdb::IoError("line " + std::to_string(mNumber) + ": " + what);
}

} // namespace detail
} // namespace openvdb_spheretree
