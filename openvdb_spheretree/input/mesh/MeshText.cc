// SPDX-License-Identifier: Apache-2.0
#include "MeshText.h"

#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree::detail {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

/// Unlike parseNumber(), allows a plus sign.
template <typename Number>
std::optional<Number> parse(std::string_view word)
{
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    return parseNumber<Number>(word);
}

} // namespace

bool MeshText::nextLine()
{
    mSteps.add();
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
    mSteps.add();
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
    if (word.empty()) fail(std::string("ends before ") + what);
    if (const auto number = parse<double>(word)) return *number;
    // What is too small for a double is read as 0. What is too large is an error.
    if (word.find("e-") != word.npos || word.find("E-") != word.npos) {
        const std::size_t e = word.find_first_of("eE");
        if (parse<double>(word.substr(0, e)) && parse<std::int64_t>(word.substr(e + 1))) return 0;
    }
    fail(inQuotes(word) + " is not " + what);
}

std::int64_t MeshText::toInteger(std::string_view word, const char* what) const
{
    if (word.empty()) fail(std::string("ends before ") + what);
    const auto number = parse<std::int64_t>(word);
    if (!number) fail(inQuotes(word) + " is not " + what);
    return *number;
}

openvdb::Vec3d MeshText::point()
{
    openvdb::Vec3d p;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = toNumber(word(), "a coordinate");
        if (!isMeshCoordinate(p[axis])) fail("a coordinate is not finite, or too large");
    }
    return p;
}

void MeshText::fail(const std::string& what) const
{
    throw openvdb::IoError("line " + std::to_string(mNumber) + ": " + what);
}

} // namespace openvdb_spheretree::detail
