// SPDX-License-Identifier: Apache-2.0
/// @file TestGrayImage.cc
/// @brief Pictures byte by byte: what is read of them, and what is refused. (Files of others are read in
/// volume/TestVolumeFile.cc.)

#include <openvdb_spheretree/input/image/GrayImage.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>
#include <zlib.h>

#include <cstring>
#include <string>

namespace {

using namespace openvdb_spheretree::detail;

std::vector<uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

/// @return the pixels of a picture, or why it is none.
template <typename Read>
std::string pixelsOf(const Read& read, const std::string& file)
{
    try {
        const GrayImage image = read(bytesOf(file));
        std::string text = std::to_string(image.width) + "x" + std::to_string(image.height) + ":";
        for (uint64_t i = 0; i < image.width * image.height; ++i) {
            uint16_t wide = image.pixels[i];
            if (image.bytesPerPixel == 2) std::memcpy(&wide, &image.pixels[2 * i], 2);
            text += " " + std::to_string(wide);
        }
        return text;
    } catch (const openvdb::IoError& error) {
        return error.what();
    }
}

std::string pgm(const std::string& file) { return pixelsOf(readPgm, file); }
std::string png(const std::string& file) { return pixelsOf(readPng, file); }

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos || (ADD_FAILURE() << text, false);
}

TEST(GrayImage, PgmIsReadAsBytesAndAsText)
{
    EXPECT_EQ(pgm("P5 2 1 255\n\x01\xff"), "2x1: 1 255");
    EXPECT_EQ(pgm("P5\n#c\n2#c\n1\n255\n 7"), "2x1: 32 55"); // one blank ends the header, no more
    EXPECT_EQ(pgm(std::string("P5 1 2 300 \x01\x2c\0\x05", 15)), "1x2: 300 5");
    EXPECT_EQ(pgm("P2 2 2 9 1 2\n#c\n3 9"), "2x2: 1 2 3 9");
    EXPECT_EQ(pgm("P2 2 1 1000 1000 7\n \n"), "2x1: 1000 7");
}

TEST(GrayImage, PgmThatIsNoneIsRefused)
{
    has(pgm("P6 1 1 255\nabc"), "P2 or P5");
    has(pgm(""), "P2 or P5");
    has(pgm("P5 0 1 255\n"), "its width");
    has(pgm("P5 1 -1 255\n"), "its height");
    has(pgm("P5 1 1 255xA"), "largest value");
    has(pgm("P5 1 1 65536\n  "), "largest value");
    has(pgm("P5 99999999999999999999 1 255\n"), "its width");
    has(pgm("P5 1048576 1048576 255\n"), "ends before its pixels do");
    has(pgm("P2 1048576 1048576 255\n"), "ends before its pixels do");
    has(pgm("P5 2 1 255\na"), "ends before its pixels do");
    has(pgm("P5 2 1 255\nabc"), "behind its pixels");
    has(pgm("P5 1 1 7\n\x08"), "larger than its largest");
    has(pgm("P2 1 1 7 8"), "a pixel");
    has(pgm("P2 2 1 7 1 x"), "a pixel");
}

std::string big(uint32_t value)
{
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

std::string chunk(const std::string& name, const std::string& bytes)
{
    const std::string body = name + bytes;
    const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
    return big(uint32_t(bytes.size())) + body + big(uint32_t(crc));
}

/// @param rows  each with the byte of its filter before it
std::string pngOf(uint32_t width, uint32_t height, char bits, char type, const std::string& rows,
    const std::string& more = {})
{
    uLongf size = compressBound(uLong(rows.size()));
    std::string deflated(size, '\0');
    compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
        reinterpret_cast<const Bytef*>(rows.data()), uLong(rows.size()));
    deflated.resize(size);
    return "\x89PNG\r\n\x1a\n"
        + chunk("IHDR", big(width) + big(height) + bits + type + std::string(3, '\0')) + more
        + chunk("IDAT", deflated) + chunk("IEND", "");
}

TEST(GrayImage, PngOfFewBitsKeepsItsNumbers)
{
    EXPECT_EQ(png(pngOf(4, 1, 1, 0, std::string("\0\x50", 2))), "4x1: 0 1 0 1");
    EXPECT_EQ(png(pngOf(4, 1, 2, 0, std::string("\0\x1b", 2))), "4x1: 0 1 2 3");
    EXPECT_EQ(png(pngOf(2, 1, 4, 0, std::string("\0\xf1", 2))), "2x1: 15 1");
    EXPECT_EQ(png(pngOf(2, 1, 8, 0, std::string("\0\xf1\1", 3))), "2x1: 241 1");
    EXPECT_EQ(png(pngOf(2, 1, 16, 0, std::string("\0\x01\x02\0\x05", 5))), "2x1: 258 5");
}

TEST(GrayImage, PngInColorIsReadWhereItIsGray)
{
    EXPECT_EQ(png(pngOf(2, 1, 8, 2, std::string("\0\5\5\5\6\6\6", 7))), "2x1: 5 6");
    EXPECT_EQ(png(pngOf(1, 1, 8, 6, std::string("\0\5\5\5\xff", 5))), "1x1: 5");
    EXPECT_EQ(png(pngOf(1, 1, 16, 4, std::string("\0\1\5\xff\xff", 5))), "1x1: 261");
    has(png(pngOf(2, 1, 8, 2, std::string("\0\5\5\5\6\6\7", 7))), "pixel (1, 0) is not gray");
    has(png(pngOf(1, 1, 8, 6, std::string("\0\5\5\5\xfe", 5))), "pixel (0, 0) is transparent");
    has(png(pngOf(1, 1, 8, 0, std::string("\0\5", 2), chunk("tRNS", std::string("\0\5", 2)))),
        "transparent");
}

TEST(GrayImage, PngThatIsNoneIsRefused)
{
    const std::string sound = pngOf(1, 1, 8, 0, std::string("\0\5", 2));
    for (std::size_t length = 0; length < sound.size(); ++length) {
        has(png(sound.substr(0, length)), "is no sound .png");
    }
    for (std::size_t i = 0; i < sound.size(); ++i) { // a checksum holds each byte
        std::string damaged = sound;
        damaged[i] = char(damaged[i] ^ 0x10);
        has(png(damaged), "is no sound .png");
    }
    has(png(pngOf(1 << 20, 1 << 20, 16, 6, "x")), "cannot be in a file that small");
    for (const std::size_t surplus : {1, 100000}) {
        const std::string rows = std::string("\0\5", 2) + std::string(surplus, '\0');
        has(png(pngOf(1, 1, 8, 0, rows)), "more image data than its header says");
    }
    const std::string longer = chunk("tEXt", "a text");
    const std::string tooLong = big(0x7c000025) + longer.substr(4); // no memory is taken for it
    has(png(pngOf(1, 1, 8, 0, std::string("\0\5", 2), tooLong)), "does not end in the file");
    has(png(pngOf((1 << 20) + 1, 1, 8, 0, "x")), "is no sound .png");
}

} // namespace
