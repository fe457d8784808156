// SPDX-License-Identifier: Apache-2.0
/// @file PgmImage.cc
/// @brief Reader of Netpbm's gray pictures, P5 (bytes) and P2 (text): three numbers, width, height and
/// the largest value, with blanks and comments between; then the pixels.

#include "GrayImage.h"

#include <openvdb/Exceptions.h>

#include <cstring>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;

class PgmText {
public:
    explicit PgmText(const std::vector<uint8_t>& file) : mFile(file) {}

    bool atEnd() const { return mAt == mFile.size(); }
    std::size_t left() const { return mFile.size() - mAt; }
    const uint8_t* here() const { return mFile.data() + mAt; }
    void skip(std::size_t bytes) { mAt += bytes; }

    void skipBlanks()
    {
        while (!atEnd() && (isBlank(mFile[mAt]) || mFile[mAt] == '#')) {
            if (mFile[mAt] == '#') {
                while (!atEnd() && mFile[mAt] != '\n' && mFile[mAt] != '\r') ++mAt;
            } else {
                ++mAt;
            }
        }
    }

    /// @return the number after blanks and comments, which ends at a blank or the end.
    uint64_t number(const char* what, uint64_t lowest, uint64_t highest)
    {
        skipBlanks();
        uint64_t value = 0;
        std::size_t digits = 0;
        for (; !atEnd() && mFile[mAt] >= '0' && mFile[mAt] <= '9' && value <= highest; ++mAt) {
            value = 10 * value + (mFile[mAt] - '0');
            ++digits;
        }
        const bool ends = atEnd() || isBlank(mFile[mAt]) || mFile[mAt] == '#';
        if (digits > 0 && ends && value >= lowest && value <= highest) return value;
        throw IoError(std::string(what) + " is not a whole number from " + std::to_string(lowest)
            + " to " + std::to_string(highest));
    }

private:
    static bool isBlank(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    const std::vector<uint8_t>& mFile;
    std::size_t mAt = 2; ///< behind the magic number
};

void store(uint64_t value, int bytes, uint8_t* out)
{
    const auto narrow = uint8_t(value);
    const auto wide = uint16_t(value);
    if (bytes == 1) *out = narrow;
    else std::memcpy(out, &wide, 2);
}

void readText(PgmText& text, uint64_t largest, GrayImage& image)
{
    if (image.width * image.height > text.left()) { // a digit each, at least
        throw IoError("ends before its pixels do");
    }
    image.pixels.resize(image.bytes());
    for (uint64_t i = 0; i < image.width * image.height; ++i) {
        const uint64_t value = text.number("a pixel", 0, largest);
        store(value, image.bytesPerPixel, &image.pixels[i * uint64_t(image.bytesPerPixel)]);
    }
    text.skipBlanks();
}

/// Of two bytes, the first one is the higher.
void readBytes(PgmText& text, uint64_t largest, GrayImage& image)
{
    if (!text.atEnd()) text.skip(1); // the one blank after the header
    if (image.bytes() > text.left()) throw IoError("ends before its pixels do");
    image.pixels.resize(image.bytes());
    const uint8_t* in = text.here();
    for (uint64_t i = 0; i < image.width * image.height; ++i) {
        const uint64_t at = i * uint64_t(image.bytesPerPixel);
        const uint64_t value =
            image.bytesPerPixel == 1 ? in[at] : uint64_t(in[at] << 8 | in[at + 1]);
        if (value > largest) throw IoError("has a pixel larger than its largest value");
        store(value, image.bytesPerPixel, &image.pixels[at]);
    }
    text.skip(image.bytes());
}

} // namespace

GrayImage readPgm(const std::vector<uint8_t>& file)
{
    const auto begins = [&](const char* magic) {
        return file.size() > 2 && file[0] == magic[0] && file[1] == magic[1];
    };
    if (!begins("P5") && !begins("P2")) {
        throw IoError("is no .pgm: it does not begin with P2 or P5");
    }
    PgmText text(file);
    GrayImage image;
    image.width = text.number("its width", 1, kMaxImageSide);
    image.height = text.number("its height", 1, kMaxImageSide);
    const uint64_t largest = text.number("its largest value", 1, 65535);
    image.bytesPerPixel = largest < 256 ? 1 : 2;
    if (begins("P2")) readText(text, largest, image);
    else readBytes(text, largest, image);
    if (!text.atEnd()) throw IoError("has bytes behind its pixels");
    return image;
}

} // namespace openvdb_spheretree::detail
