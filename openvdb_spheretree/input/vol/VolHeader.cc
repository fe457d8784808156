// SPDX-License-Identifier: Apache-2.0
#include "VolHeader.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/base/Trimmed.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::IoError;

constexpr std::size_t kMaxHeaderBytes = 1 << 16;
constexpr std::uint64_t kMaxSide = 1 << 20;      // so X*Y*Z values of eight bytes stay below 2^64
constexpr std::uint64_t kMaxDeflateRatio = 1032; // 258 bytes in two bits, as zlib documents it
constexpr std::uint64_t kDeflateSlack = 64; // bytes of the stream, for rounding and block headers

using HeaderFields = std::map<std::string, std::string>;

/// @return the fields; @a offset becomes that of the first value.
HeaderFields splitHeader(const std::string& text, std::uint64_t& offset)
{
    HeaderFields fields;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string::npos) {
            throw IoError("header has no line '.' to end it"
                + std::string(text.size() < kMaxHeaderBytes
                        ? "; the file is truncated or no .vol file"
                        : " within " + std::to_string(kMaxHeaderBytes) + " bytes"));
        }
        std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line == ".") {
            offset = begin;
            return fields;
        }
        const auto colon = line.find(':');
        const std::string key = trimmed(line.substr(0, colon));
        if (colon == std::string::npos || key.empty()) {
            throw IoError(
                "header line " + inQuotes(line) + " is not 'Key: value'; is this a .vol file?");
        }
        if (!fields.emplace(key, trimmed(line.substr(colon + 1))).second) {
            throw IoError("header key " + inQuotes(key) + " is given twice");
        }
    }
}

std::uint64_t sideOf(const HeaderFields& fields, const std::string& key)
{
    const auto it = fields.find(key);
    if (it == fields.end()) throw IoError("header has no key '" + key + "'");
    const auto side = parseNumber<std::uint64_t>(it->second);
    if (side && *side >= 1 && *side <= kMaxSide) return *side;
    throw IoError("header key '" + key + "' is " + inQuotes(it->second)
        + ", not a whole number from 1 to " + std::to_string(kMaxSide));
}

int versionOf(const std::string& text)
{
    if (text == "2") return 2;
    if (text == "3") return 3;
    throw IoError("header key 'Version' is " + inQuotes(text)
        + "; versions 2 (raw) and 3 (zlib) can be read");
}

/// One number, or three with blanks between.
std::array<double, 3> voxelSizeOf(const std::string& text)
{
    detail::TextStream words(text);
    std::vector<double> sizes;
    for (std::string word; words >> word;) {
        const auto size = parseNumber<double>(word);
        if (!size || !std::isfinite(*size) || !(*size > 0)) sizes.resize(4); // refused below
        else sizes.push_back(*size);
    }
    if (sizes.size() == 1) return {sizes[0], sizes[0], sizes[0]};
    if (sizes.size() == 3) return {sizes[0], sizes[1], sizes[2]};
    throw IoError("header key 'Voxel-Size' is " + inQuotes(text)
        + ", not a number above 0, or three of them");
}

/// Refuses a header whose file cannot hold the values, or holds more.
void checkSize(const VolHeader& header)
{
    const std::string claim = "header keys X, Y, Z ask for " + std::to_string(header.volumeBytes())
        + " bytes of values, but the file holds " + std::to_string(header.dataBytes);
    if (header.version == 2 && header.dataBytes < header.volumeBytes()) {
        throw IoError(claim + "; it is truncated, or its header wrong");
    }
    if (header.version == 2 && header.dataBytes > header.volumeBytes()) {
        throw IoError(claim + "; nothing may follow the values");
    }
    if (header.version == 3
        && header.volumeBytes() / kMaxDeflateRatio > header.dataBytes + kDeflateSlack) {
        throw IoError(claim
            + " compressed bytes, which cannot expand to that many; it is truncated, "
              "or its header wrong");
    }
}

} // namespace

VolHeader readVolHeader(const std::string& path, std::ifstream& file, std::uint64_t fileBytes)
{
    std::string text(std::min<std::uint64_t>(kMaxHeaderBytes, fileBytes), '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));

    VolHeader header;
    HeaderFields fields = splitHeader(text, header.dataOffset);
    fields.insert({{"Version", "2"}, {"Voxel-Size", "1"}}); // where they are not given
    header.dim = {sideOf(fields, "X"), sideOf(fields, "Y"), sideOf(fields, "Z")};
    header.version = versionOf(fields["Version"]);
    header.voxelSize = voxelSizeOf(fields["Voxel-Size"]);
    header.bytesPerValue = lowerExtension(path) == ".longvol" ? 8 : 1;
    header.dataBytes = fileBytes - header.dataOffset;
    checkSize(header);
    file.clear(); // reading a short file to its end has set eofbit
    file.seekg(static_cast<std::streamoff>(header.dataOffset));
    return header;
}

} // namespace openvdb_spheretree::detail
