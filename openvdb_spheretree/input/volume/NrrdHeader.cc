// SPDX-License-Identifier: Apache-2.0
/// @file NrrdHeader.cc
/// @brief The header of an `.nrrd` or `.nhdr`: a magic line, lines `field: value`, comments `#` and
/// notes `key:=value`; then an empty line and the numbers, or `data file` says where these are.
///
/// 1. readFields(): lines to fields; those twice are refused, those that do not matter are kept.
/// 2. axesOf():     sizes, steps and kinds, axis by axis; an axis that is none of space is refused,
///                  or left out if it has one number.
/// 3. readNrrdHeader(): type, encoding, where the numbers are.

#include "VolumeHeader.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/base/Trimmed.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;
using openvdb::Vec3d;

using Fields = std::map<std::string, std::string>;

[[noreturn]] void failOf(const std::string& field, const std::string& value)
{
    throw IoError(
        "field '" + field + "' of its header is " + inQuotes(value) + ", which is not read");
}

/// @return whether there was one. @param left  bytes that the header may still have
bool nextLine(std::istream& file, std::string& line, std::size_t& left)
{
    line.clear();
    std::streambuf& bytes = *file.rdbuf();
    constexpr auto kEnd = std::istream::traits_type::eof();
    int c = bytes.sbumpc();
    if (c == kEnd) return false;
    for (; c != kEnd && c != '\n'; c = bytes.sbumpc()) {
        if (left-- == 0) throw IoError("has a header of more than a MiB; is this an .nrrd?");
        line += char(c);
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
}

/// @param ended  whether an empty line came, behind which numbers may be
Fields readFields(std::istream& file, bool& ended)
{
    std::size_t left = 1 << 20;
    std::string line;
    if (!nextLine(file, line, left) || line.size() != 8 || line.compare(0, 7, "NRRD000") != 0
        || line[7] < '1' || line[7] > '5') {
        throw IoError("is no .nrrd: it does not begin with NRRD0001 to NRRD0005");
    }
    Fields fields;
    for (ended = false; nextLine(file, line, left);) {
        ended = line.empty();
        if (ended) break;
        if (line[0] == '#') continue;
        const auto colon = line.find(':');
        if (colon != std::string::npos && line.compare(colon, 2, ":=") == 0) continue;
        if (colon == std::string::npos || line.compare(colon, 2, ": ") != 0) {
            throw IoError("line " + inQuotes(line) + " of its header is not 'field: value'");
        }
        std::string field = lowerCase(trimmed(line.substr(0, colon)));
        for (const auto& [other, usual] : std::map<std::string, std::string>{
                 {"datafile", "data file"}, {"lineskip", "line skip"}, {"byteskip", "byte skip"}}) {
            if (field == other) field = usual;
        }
        if (!fields.emplace(field, trimmed(line.substr(colon + 1))).second) {
            throw IoError("field '" + onOneLine(field, 40) + "' of its header is given twice");
        }
    }
    return fields;
}

std::string valueOf(const Fields& fields, const std::string& field)
{
    const auto found = fields.find(field);
    if (found == fields.end()) throw IoError("its header has no field '" + field + "'");
    return found->second;
}

/// @return the words of a field; none if it is not there. What is in parentheses is one word.
std::vector<std::string> wordsOf(const Fields& fields, const std::string& field)
{
    std::vector<std::string> words;
    const auto found = fields.find(field);
    if (found == fields.end()) return words;
    bool inside = false, open = false;
    for (const char c : found->second) {
        inside = (inside || c == '(') && c != ')';
        const bool isBlank = c == ' ' || c == '\t';
        if (isBlank && !inside) open = false;
        if (isBlank) continue;
        if (!open) words.emplace_back();
        open = true;
        words.back() += c;
    }
    return words;
}

/// @return the vector of `(1,0,0)`, or of two numbers with a third one of 0.
Vec3d vectorOf(const std::string& field, const std::string& word)
{
    Vec3d vector(0);
    if (word.size() < 2 || word.front() != '(' || word.back() != ')') failOf(field, word);
    TextStream parts(word.substr(1, word.size() - 2));
    int count = 0;
    for (std::string part; std::getline(parts, part, ','); ++count) {
        const auto number = parseNumber<double>(part);
        if (!number || count == 3) failOf(field, word);
        vector[count] = *number;
    }
    if (count < 2) failOf(field, word);
    return vector;
}

struct Axis {
    uint64_t size = 0;
    bool ofSpace = true; ///< or of colors, components, ...
    Vec3d step{0, 0, 0}; ///< where directions are given
    double spacing = 0;  ///< 0 if not known
};

/// @return that word of a field that has one for each axis; nothing if the field is not there.
std::string wordOf(
    const Fields& fields, const std::string& field, std::size_t axis, std::size_t count)
{
    const std::vector<std::string> words = wordsOf(fields, field);
    if (words.empty()) return {};
    if (words.size() != count) failOf(field, valueOf(fields, field));
    return words[axis];
}

std::vector<Axis> axesOf(const Fields& fields)
{
    constexpr uint64_t kMost = 16; // as Teem has
    const auto count = parseNumber<uint64_t>(valueOf(fields, "dimension"));
    if (!count || *count < 1 || *count > kMost) failOf("dimension", valueOf(fields, "dimension"));
    std::vector<Axis> axes;
    for (std::size_t i = 0; i < *count; ++i) {
        Axis axis;
        valueOf(fields, "sizes");
        const auto size = parseNumber<uint64_t>(wordOf(fields, "sizes", i, *count));
        if (!size) failOf("sizes", valueOf(fields, "sizes"));
        axis.size = *size;
        const std::string kind = lowerCase(wordOf(fields, "kinds", i, *count));
        constexpr const char* kSpaces[] = {"", "space", "domain", "time", "none", "???", "list"};
        axis.ofSpace = std::count(std::begin(kSpaces), std::end(kSpaces), kind) > 0;
        const std::string direction = wordOf(fields, "space directions", i, *count);
        if (direction == "none") axis.ofSpace = false;
        else if (!direction.empty()) axis.step = vectorOf("space directions", direction);
        const std::string spacing = wordOf(fields, "spacings", i, *count);
        if (!spacing.empty()) {
            const auto number = parseNumber<double>(spacing);
            if (!number) failOf("spacings", valueOf(fields, "spacings"));
            axis.spacing = std::isnan(*number) ? 0 : *number;
        }
        if (!axis.ofSpace && axis.size != 1) {
            throw IoError("axis " + std::to_string(i) + " of its array has "
                + std::to_string(axis.size)
                + " components, and is none of space: a volume has one "
                  "number a voxel (unu slice -a "
                + std::to_string(i) + " -p 0 takes the first)");
        }
        if (axis.ofSpace) axes.push_back(axis);
    }
    for (std::size_t i = axes.size(); i-- > 0 && axes.size() > 3;) {
        if (axes[i].size == 1) axes.erase(axes.begin() + std::ptrdiff_t(i));
    }
    return axes;
}

std::optional<openvdb::Mat4d> placeOfAxes(const std::vector<Axis>& axes, const Fields& fields)
{
    const bool hasDirections = fields.count("space directions") > 0;
    const bool hasSpacings =
        std::any_of(axes.begin(), axes.end(), [](const Axis& axis) { return axis.spacing != 0; });
    if (!hasDirections && !hasSpacings) return std::nullopt;
    std::array<Vec3d, 3> steps = {Vec3d(0), Vec3d(0), Vec3d(0)};
    for (std::size_t a = 0; a < axes.size() && a < 3; ++a) {
        if (hasDirections) steps[a] = axes[a].step;
        else steps[a][int(a)] = axes[a].spacing;
    }
    Vec3d origin(0);
    if (const auto found = fields.find("space origin"); found != fields.end()) {
        const std::vector<std::string> words = wordsOf(fields, "space origin");
        if (words.size() != 1) failOf("space origin", found->second);
        origin = vectorOf("space origin", words[0]);
    }
    return placeOf(steps, origin);
}

NumberType typeOf(const std::string& name)
{
    static const std::map<std::string, NumberType> types = {{"signed char", NumberType::Int8},
        {"int8", NumberType::Int8}, {"int8_t", NumberType::Int8}, {"uchar", NumberType::UInt8},
        {"unsigned char", NumberType::UInt8}, {"uint8", NumberType::UInt8},
        {"uint8_t", NumberType::UInt8}, {"short", NumberType::Int16},
        {"short int", NumberType::Int16}, {"signed short", NumberType::Int16},
        {"signed short int", NumberType::Int16}, {"int16", NumberType::Int16},
        {"int16_t", NumberType::Int16}, {"ushort", NumberType::UInt16},
        {"unsigned short", NumberType::UInt16}, {"unsigned short int", NumberType::UInt16},
        {"uint16", NumberType::UInt16}, {"uint16_t", NumberType::UInt16},
        {"int", NumberType::Int32}, {"signed int", NumberType::Int32}, {"int32", NumberType::Int32},
        {"int32_t", NumberType::Int32}, {"uint", NumberType::UInt32},
        {"unsigned int", NumberType::UInt32}, {"uint32", NumberType::UInt32},
        {"uint32_t", NumberType::UInt32}, {"longlong", NumberType::Int64},
        {"long long", NumberType::Int64}, {"long long int", NumberType::Int64},
        {"signed long long", NumberType::Int64}, {"signed long long int", NumberType::Int64},
        {"int64", NumberType::Int64}, {"int64_t", NumberType::Int64},
        {"ulonglong", NumberType::UInt64}, {"unsigned long long", NumberType::UInt64},
        {"unsigned long long int", NumberType::UInt64}, {"uint64", NumberType::UInt64},
        {"uint64_t", NumberType::UInt64}, {"float", NumberType::Float32},
        {"double", NumberType::Float64}};
    const auto found = types.find(name);
    if (found == types.end()) failOf("type", name);
    return found->second;
}

Encoding encodingOf(const std::string& name)
{
    if (name == "raw") return Encoding::Raw;
    if (name == "gzip" || name == "gz") return Encoding::Gzip;
    if (name == "text" || name == "txt" || name == "ascii") return Encoding::Text;
    throw IoError("its encoding is " + inQuotes(name)
        + ", which is not read: raw, gzip and text are (unu save -f nrrd -e gzip makes one)");
}

uint64_t skipOf(const Fields& fields, const std::string& field)
{
    const auto found = fields.find(field);
    if (found == fields.end()) return 0;
    const auto number = parseNumber<uint64_t>(found->second);
    if (!number) failOf(field, found->second);
    return *number;
}

/// Where the numbers are. @param ended  whether they may come behind the header
void findNumbers(const Fields& fields, bool ended, VolumeHeader& header)
{
    const auto found = fields.find("data file");
    if (found == fields.end() && !ended) {
        throw IoError(
            "its header has no empty line to end it, and names no data file; it is truncated");
    }
    if (found != fields.end()) {
        header.dataFile = found->second;
        const bool isList = header.dataFile.compare(0, 4, "LIST") == 0;
        if (header.dataFile.empty() || isList || header.dataFile.find('%') != std::string::npos) {
            throw IoError("its numbers are in several files, " + inQuotes(header.dataFile)
                + "; make one of them first (unu save -f nrrd)");
        }
    }
    header.lineSkip = skipOf(fields, "line skip");
    const auto skip = fields.find("byte skip");
    header.fromEnd = skip != fields.end() && skip->second == "-1";
    if (!header.fromEnd) header.byteSkip = skipOf(fields, "byte skip");
    if (header.fromEnd && header.encoding != Encoding::Raw) failOf("byte skip", "-1");
}

} // namespace

VolumeHeader readNrrdHeader(std::istream& file)
{
    bool ended = false;
    const Fields fields = readFields(file, ended);
    VolumeHeader header;
    const std::vector<Axis> axes = axesOf(fields);
    std::vector<uint64_t> sides;
    for (const Axis& axis : axes) sides.push_back(axis.size);
    header.layout.dim = threeSides(sides);
    header.layout.type = typeOf(lowerCase(valueOf(fields, "type")));
    header.encoding = encodingOf(lowerCase(valueOf(fields, "encoding")));
    header.layout.bigEndian = isBigEndianMachine();
    if (bytesOf(header.layout.type) > 1 && header.encoding != Encoding::Text) {
        const std::string endian = lowerCase(valueOf(fields, "endian"));
        if (endian != "little" && endian != "big") failOf("endian", endian);
        header.layout.bigEndian = endian == "big";
    }
    header.indexToWorld = placeOfAxes(axes, fields);
    findNumbers(fields, ended, header);
    return header;
}

} // namespace openvdb_spheretree::detail
