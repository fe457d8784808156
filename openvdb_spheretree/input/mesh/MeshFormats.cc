// SPDX-License-Identifier: Apache-2.0
/// OFF and STL files say how much they hold, so any cut is found. An OBJ does not: one that is cut
/// at the end of a line is a smaller mesh to any reader. Checked are every number, every index, and
/// that no face has fewer than three corners. The reader of PLY is in PlyFormat.cc.

#include "MeshFormats.h"

#include "MeshText.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <initializer_list>
#include <limits>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;
using openvdb::Vec3d;
using openvdb::util::NullInterrupter;

constexpr std::size_t kStlHeaderBytes = 84; // 80 of text, and the number of facets
constexpr std::size_t kStlFacetBytes = 50;  // a normal, three corners, and two bytes of colour

// OBJ

/// @param word  "point", "point/uv", "point//normal" or "point/uv/normal", each counted from 1, or
///              backwards from -1
std::int64_t objCorner(const MeshText& text, std::string_view word, std::size_t pointCount)
{
    const std::int64_t given =
        text.toInteger(word.substr(0, word.find('/')), "the number of a face's point");
    for (std::size_t slash = word.find('/'); slash != word.npos;) {
        const std::size_t next = word.find('/', slash + 1);
        const std::string_view part = word.substr(slash + 1, next - slash - 1);
        if (!part.empty()) text.toInteger(part, "the number of a face's normal or texture point");
        slash = next;
    }
    const std::int64_t index = given > 0 ? given - 1 : std::int64_t(pointCount) + given;
    if (given == 0 || index < 0) {
        text.fail("a face names point " + std::to_string(given) + " after "
            + std::to_string(pointCount) + " points; they are counted from 1");
    }
    return index;
}

/// @return the largest index of a corner, of which soup.corners gets the lower 32 bits. Faces may
/// name points that follow them, so indices are checked at the end of the file.
std::int64_t objFace(MeshText& text, PolygonSoup& soup)
{
    std::uint32_t count = 0;
    std::int64_t largest = -1;
    for (std::string_view word = text.word(); !word.empty(); word = text.word(), ++count) {
        const std::int64_t index = objCorner(text, word, soup.points.size());
        largest = std::max(largest, index);
        soup.corners.push_back(std::uint32_t(index));
    }
    if (count < 3) text.fail("a face has only " + std::to_string(count) + " points");
    soup.counts.push_back(count);
    return largest;
}

/// A backslash at the end of a line joins it with the next one.
void joinLines(std::string& text)
{
    for (std::size_t at = text.find('\\'); at != text.npos; at = text.find('\\', at + 1)) {
        std::size_t end = at + 1;
        if (end < text.size() && text[end] == '\r') ++end;
        if (end >= text.size() || text[end] != '\n') continue;
        std::fill_n(text.begin() + std::ptrdiff_t(at), end + 1 - at, ' ');
    }
}

// STL

std::uint32_t littleEndian(const char* bytes)
{
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= std::uint32_t(std::uint8_t(bytes[i])) << (8 * i);
    return bits;
}

/// @return how many bytes a binary STL of this header has.
std::uint64_t binaryStlSize(const std::string& bytes)
{
    return kStlHeaderBytes + littleEndian(bytes.data() + 80) * std::uint64_t(kStlFacetBytes);
}

void addTriangle(PolygonSoup& soup)
{
    const auto n = static_cast<std::uint32_t>(soup.points.size());
    for (std::uint32_t i = n - 3; i < n; ++i) soup.corners.push_back(i);
    soup.counts.push_back(3);
}

PolygonSoup parseBinaryStl(const std::string& bytes, NullInterrupter* interrupter)
{
    PolygonSoup soup;
    InterruptSteps steps(interrupter);
    for (std::size_t at = kStlHeaderBytes; at < bytes.size(); at += kStlFacetBytes) {
        for (int corner = 1; corner <= 3; ++corner) { // the normal, at 0, is not needed
            Vec3d point;
            for (int axis = 0; axis < 3; ++axis) {
                const std::uint32_t bits = littleEndian(bytes.data() + at + 12 * corner + 4 * axis);
                float coordinate;
                std::memcpy(&coordinate, &bits, sizeof(bits));
                point[axis] = double(coordinate);
            }
            if (!point.isFinite()) {
                throw IoError("facet " + std::to_string((at - kStlHeaderBytes) / kStlFacetBytes)
                    + ": a coordinate is not finite");
            }
            soup.points.push_back(point);
        }
        addTriangle(soup);
        steps.add();
    }
    return soup;
}

void needWords(MeshText& text, std::initializer_list<const char*> expectedWords)
{
    for (const char* expected : expectedWords) {
        const std::string_view word = text.wordOnAnyLine();
        if (lowerCase(word) == expected) continue;
        text.fail(word.empty() ? std::string("the file ends before '") + expected + "'"
                               : inQuotes(word) + " instead of '" + expected + "'");
    }
}

PolygonSoup parseAsciiStl(const std::string& bytes, NullInterrupter* interrupter)
{
    PolygonSoup soup;
    MeshText text(bytes, interrupter);
    for (std::string_view solid = text.wordOnAnyLine(); !solid.empty();
         solid = text.wordOnAnyLine()) {
        if (lowerCase(solid) != "solid") text.fail(inQuotes(solid) + " instead of 'solid'");
        text.nextLine(); // the rest of the line is the solid's name
        for (;;) {
            const std::string word = lowerCase(text.wordOnAnyLine());
            if (word == "endsolid") break;
            if (word.empty()) text.fail("the file ends before 'endsolid'; it is truncated");
            if (word != "facet") text.fail(inQuotes(word) + " instead of 'facet' or 'endsolid'");
            needWords(text, {"normal"});
            for (int i = 0; i < 3; ++i) text.wordOnAnyLine(); // some write nan there
            needWords(text, {"outer", "loop"});
            for (int corner = 0; corner < 3; ++corner) {
                needWords(text, {"vertex"});
                soup.points.push_back(text.point());
            }
            addTriangle(soup);
            needWords(text, {"endloop", "endfacet"});
        }
        text.nextLine();
    }
    return soup;
}

// OFF

std::uint64_t offCount(MeshText& text, std::string_view word, const char* what)
{
    const std::int64_t count = text.toInteger(word, what);
    if (count < 0 || count > std::numeric_limits<std::uint32_t>::max()) {
        text.fail(std::to_string(count) + " is not " + what);
    }
    return std::uint64_t(count);
}

void offFace(MeshText& text, PolygonSoup& soup)
{
    text.needLine("the last face; it is truncated");
    const std::uint64_t count = offCount(text, text.word(), "the number of a face's points");
    if (count == 0) text.fail("a face has no points");
    const std::size_t begin = soup.corners.size();
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::int64_t index = text.toInteger(text.word(), "the number of a face's point");
        if (index < 0 || std::uint64_t(index) >= soup.points.size()) {
            text.fail("a face names point " + std::to_string(index) + " of "
                + std::to_string(soup.points.size()) + "; they are counted from 0");
        }
        soup.corners.push_back(std::uint32_t(index));
    }
    if (count >= 3) soup.counts.push_back(std::uint32_t(count));
    else soup.corners.resize(begin); // a point or a line has no area
}

PolygonSoup parseObj(std::string bytes, NullInterrupter* interrupter)
{
    joinLines(bytes);
    PolygonSoup soup;
    std::int64_t largest = -1; // index, and where it is
    std::uint64_t line = 0;
    const auto isStrange = [](unsigned char c) {
        return !std::isalnum(c) && c != '_' && c != '-' && c != '.';
    };
    MeshText text(bytes, interrupter);
    while (text.nextLine()) {
        text.dropComment();
        const std::string_view word = text.word();
        if (word == "v") {
            soup.points.push_back(text.point());
        } else if (word == "f" || word == "fo") {
            const std::int64_t index = objFace(text, soup);
            if (index > largest) line = text.lineNumber();
            largest = std::max(largest, index);
        } else if (std::any_of(word.begin(), word.end(), isStrange)) {
            text.fail(inQuotes(word) + " begins no line of an OBJ file");
        }
    }
    if (largest >= std::int64_t(soup.points.size())) {
        throw IoError("line " + std::to_string(line) + ": a face names point "
            + std::to_string(largest + 1) + ", but there are "
            + std::to_string(soup.points.size()));
    }
    return soup;
}

PolygonSoup parseOff(const std::string& bytes, NullInterrupter* interrupter)
{
    PolygonSoup soup;
    MeshText text(bytes, interrupter);
    text.needLine("the keyword OFF");
    std::string_view word = text.word();
    for (const std::string_view prefix : {"ST", "C", "N"}) { // what points have besides coordinates
        if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
    }
    if (word != "OFF") {
        text.fail("the file does not begin with OFF (points in four or n dimensions are not read)");
    }
    word = text.word();
    if (word.empty()) {
        text.needLine("the number of points");
        word = text.word();
    }
    const std::uint64_t points = offCount(text, word, "the number of points");
    const std::uint64_t faces = offCount(text, text.word(), "the number of faces");
    for (std::uint64_t i = 0; i < points; ++i) {
        text.needLine("the last point; it is truncated");
        soup.points.push_back(text.point());
    }
    for (std::uint64_t i = 0; i < faces; ++i) offFace(text, soup);
    while (text.nextLine()) {
        text.dropComment();
        if (!text.word().empty()) text.fail("more follows than the points and faces promised");
    }
    return soup;
}

PolygonSoup parseStl(const std::string& bytes, NullInterrupter* interrupter)
{
    const bool hasHeader = bytes.size() >= kStlHeaderBytes;
    if (hasHeader && bytes.size() == binaryStlSize(bytes))
        return parseBinaryStl(bytes, interrupter);
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    const bool isAscii = first != bytes.npos && lowerCase(bytes.substr(first, 5)) == "solid";
    if (isAscii) return parseAsciiStl(bytes, interrupter);
    if (!hasHeader) throw IoError("too short for an STL file; it is truncated");
    throw IoError("neither an ASCII STL nor a whole binary one: its header asks for "
        + std::to_string(binaryStlSize(bytes)) + " bytes, the file holds "
        + std::to_string(bytes.size()));
}

} // namespace

bool isStrictFormat(const std::string& extension)
{
    return extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl";
}

PolygonSoup parseMesh(const std::string& extension, std::string bytes, NullInterrupter* interrupter)
{
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max() * std::uint64_t(4)) {
        throw IoError("files of more than 16 GiB cannot be read"); // points have 32-bit numbers
    }
    if (extension == ".obj") return parseObj(std::move(bytes), interrupter);
    if (extension == ".off") return parseOff(bytes, interrupter);
    if (extension == ".ply") return parsePly(bytes, interrupter);
    return parseStl(bytes, interrupter);
}

} // namespace openvdb_spheretree::detail
