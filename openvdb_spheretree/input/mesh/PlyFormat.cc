// SPDX-License-Identifier: Apache-2.0
/// @file PlyFormat.cc
/// @brief Strict reader of PLY files, ASCII and binary of either byte order (G. Turk, 1994).
///
/// A header lists elements, how many there are of each, and their properties. The values follow in
/// that order. Only the elements `vertex` and `face` matter here. No memory is reserved by a count
/// of the header: values are appended as they are read, so a count too large fails with "the file
/// ends".

#include "MeshFormats.h"

#include "MeshText.h"
#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <limits>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;

enum class Kind { kSigned, kUnsigned, kReal };

struct PlyType {
    Kind kind = Kind::kReal;
    int bytes = 0;
};

struct PlyProperty {
    std::string name;
    PlyType type;
    PlyType countType; ///< of a list; 0 bytes where this is none
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// @return the index of the property of one of these names, or -1. @throw openvdb::IoError if there are two: nobody
    /// could say which is meant
    int find(std::initializer_list<const char*> names) const
    {
        int found = -1;
        for (std::size_t i = 0; i < properties.size(); ++i) {
            if (std::find(names.begin(), names.end(), properties[i].name) == names.end()) continue;
            if (found >= 0) {
                throw IoError("the property " + inQuotes(properties[i].name) + " of element "
                    + inQuotes(name) + " is there twice");
            }
            found = int(i);
        }
        return found;
    }
};

enum class Encoding { kNone, kAscii, kLittle, kBig };

struct PlyHeader {
    Encoding encoding = Encoding::kNone;
    std::vector<PlyElement> elements;
};

// Header

PlyType typeOf(const MeshText& text, std::string_view word)
{
    struct Name {
        const char *old, *sized;
        PlyType type;
    };
    static const Name kNames[] = {{"char", "int8", {Kind::kSigned, 1}},
        {"uchar", "uint8", {Kind::kUnsigned, 1}}, {"short", "int16", {Kind::kSigned, 2}},
        {"ushort", "uint16", {Kind::kUnsigned, 2}}, {"int", "int32", {Kind::kSigned, 4}},
        {"uint", "uint32", {Kind::kUnsigned, 4}}, {"float", "float32", {Kind::kReal, 4}},
        {"double", "float64", {Kind::kReal, 8}}};
    for (const Name& name : kNames) {
        if (word == name.old || word == name.sized) return name.type;
    }
    text.fail(inQuotes(word) + " is no type of a PLY property");
}

Encoding encodingOf(MeshText& text)
{
    const std::string_view format = text.word();
    if (text.word() != "1.0") text.fail("only version 1.0 of PLY is known");
    if (format == "ascii") return Encoding::kAscii;
    if (format == "binary_little_endian") return Encoding::kLittle;
    if (format == "binary_big_endian") return Encoding::kBig;
    text.fail(inQuotes(format) + " is no format of PLY");
}

PlyElement elementOf(MeshText& text)
{
    const std::string_view name = text.word();
    const std::int64_t count = text.toInteger(text.word(), "the number of elements");
    if (count < 0 || count > std::numeric_limits<std::uint32_t>::max()) {
        text.fail(std::to_string(count) + " is not a number of elements that can be read");
    }
    return {std::string(name), std::uint64_t(count), {}};
}

PlyProperty propertyOf(MeshText& text)
{
    PlyProperty property;
    std::string_view word = text.word();
    if (word == "list") {
        property.countType = typeOf(text, text.word());
        if (property.countType.kind == Kind::kReal) text.fail("a list's count is no whole number");
        word = text.word();
    }
    property.type = typeOf(text, word);
    property.name = text.word();
    if (property.name.empty()) text.fail("a property has no name");
    return property;
}

PlyHeader headerOf(MeshText& text)
{
    PlyHeader header;
    if (!text.nextLine() || text.word() != "ply") text.fail("the file does not begin with 'ply'");
    for (;;) {
        if (!text.nextLine()) text.fail("the file ends before 'end_header'");
        const std::string_view word = text.word();
        if (word == "end_header") break;
        if (word.empty() || word == "comment" || word == "obj_info") continue;
        if (word == "format") {
            if (header.encoding != Encoding::kNone) text.fail("a second line 'format'");
            header.encoding = encodingOf(text);
        } else if (word == "element") {
            header.elements.push_back(elementOf(text));
        } else if (word == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(propertyOf(text));
        } else {
            text.fail(inQuotes(word) + " does not belong in a PLY header");
        }
    }
    if (header.encoding == Encoding::kNone) text.fail("the header has no line 'format'");
    for (const char* name : {"vertex", "face"}) {
        const auto isIt = [&](const PlyElement& element) { return element.name == name; };
        if (std::count_if(header.elements.begin(), header.elements.end(), isIt) > 1) {
            text.fail(std::string("the element '") + name + "' is there twice");
        }
    }
    return header;
}

// Values

/// Reads the values after the header in their order.
class PlyValues {
public:
    PlyValues(Encoding encoding, const MeshText& text, openvdb::util::NullInterrupter* interrupter)
        : mEncoding(encoding), mText(text), mBytes(text.rest()), mSteps(interrupter)
    {
        mText.nextLine();
    }

    double next(PlyType type)
    {
        mSteps.add();
        if (mEncoding != Encoding::kAscii) return nextBinary(type);
        const std::string_view word = mText.wordOnAnyLine();
        if (word.empty()) fail("the file ends before its last element; it is truncated");
        if (type.kind == Kind::kReal) return mText.toNumber(word, "a number");
        return double(mText.toInteger(word, "a whole number"));
    }

    bool atEnd()
    {
        if (mEncoding == Encoding::kAscii) return mText.wordOnAnyLine().empty();
        return mBytes.empty();
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        if (mEncoding == Encoding::kAscii) mText.fail(what);
        throw IoError(what);
    }

private:
    double nextBinary(PlyType type)
    {
        const auto size = std::size_t(type.bytes);
        if (mBytes.size() < size) fail("the file ends before its last element; it is truncated");
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t at = mEncoding == Encoding::kLittle ? i : size - 1 - i;
            bits |= std::uint64_t(std::uint8_t(mBytes[at])) << (8 * i);
        }
        mBytes.remove_prefix(size);
        if (type.kind == Kind::kUnsigned) return double(bits);
        if (type.kind == Kind::kSigned) {
            const int unused = 64 - 8 * type.bytes;
            return double(std::int64_t(bits << unused) >> unused);
        }
        float single;
        double value;
        const auto lower = std::uint32_t(bits);
        std::memcpy(&single, &lower, sizeof(single));
        std::memcpy(&value, &bits, sizeof(value));
        return size == sizeof(single) ? double(single) : value;
    }

    Encoding mEncoding;
    MeshText mText;
    std::string_view mBytes;
    InterruptSteps mSteps;
};

/// Reads one property, and calls use(value) for each of its values.
/// @return how many there are
template <typename Use>
std::uint32_t readProperty(PlyValues& values, const PlyProperty& property, const Use& use)
{
    std::uint32_t count = 1;
    if (property.countType.bytes > 0) {
        const double given = values.next(property.countType);
        if (given < 0 || given > std::numeric_limits<std::uint32_t>::max()) {
            values.fail("a list has a negative number of values");
        }
        count = std::uint32_t(given);
    }
    for (std::uint32_t i = 0; i < count; ++i) use(values.next(property.type));
    return count;
}

void skip(PlyValues& values, const PlyElement& element)
{
    if (element.properties.empty()) return; // nothing to read, however large the count
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) {
            readProperty(values, property, [](double) {});
        }
    }
}

void readVertices(PlyValues& values, const PlyElement& element, PolygonSoup& soup)
{
    const std::array<int, 3> axes = {element.find({"x"}), element.find({"y"}), element.find({"z"})};
    for (const int axis : axes) {
        if (axis < 0 || element.properties[axis].countType.bytes > 0) {
            values.fail("element 'vertex' needs the properties x, y, z");
        }
    }
    for (std::uint64_t n = 0; n < element.count; ++n) {
        openvdb::Vec3d point;
        for (int i = 0; i < int(element.properties.size()); ++i) {
            double value = 0;
            readProperty(values, element.properties[i], [&](double v) { value = v; });
            for (int axis = 0; axis < 3; ++axis) {
                if (axes[axis] == i) point[axis] = value;
            }
        }
        if (!isMeshPoint(point)) {
            values.fail(
                "a coordinate of vertex " + std::to_string(n) + " is not finite, or too large");
        }
        soup.points.push_back(point);
    }
}

/// The vertices may follow, so corners are not compared to their number yet.
void readFaces(PlyValues& values, const PlyElement& element, PolygonSoup& soup)
{
    const int list = element.find({"vertex_indices", "vertex_index"});
    if (list < 0 || element.properties[list].countType.bytes == 0
        || element.properties[list].type.kind == Kind::kReal) {
        values.fail("element 'face' needs a list of whole numbers, vertex_indices");
    }
    for (std::uint64_t n = 0; n < element.count; ++n) {
        for (int i = 0; i < int(element.properties.size()); ++i) {
            const std::size_t begin = soup.corners.size();
            const std::uint32_t count =
                readProperty(values, element.properties[i], [&](double value) {
                    if (i != list) return;
                    if (value < 0 || value > std::numeric_limits<std::uint32_t>::max()) {
                        values.fail("face " + std::to_string(n) + " names a negative vertex");
                    }
                    soup.corners.push_back(std::uint32_t(value));
                });
            if (i != list) continue;
            if (count >= 3) soup.counts.push_back(count);
            else soup.corners.resize(begin); // a point or a line has no area
        }
    }
}

} // namespace

PolygonSoup parsePly(const std::string& bytes, openvdb::util::NullInterrupter* interrupter)
{
    MeshText text(bytes, interrupter);
    const PlyHeader header = headerOf(text);
    PlyValues values(header.encoding, text, interrupter);
    PolygonSoup soup;
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") readVertices(values, element, soup);
        else if (element.name == "face") readFaces(values, element, soup);
        else skip(values, element);
    }
    if (!values.atEnd()) values.fail("more follows than the elements of the header");
    for (const std::uint32_t corner : soup.corners) {
        if (corner < soup.points.size()) continue;
        throw IoError("a face names vertex " + std::to_string(corner) + " of "
            + std::to_string(soup.points.size()) + "; they are counted from 0");
    }
    return soup;
}

} // namespace openvdb_spheretree::detail
