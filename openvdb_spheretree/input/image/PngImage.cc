// SPDX-License-Identifier: Apache-2.0
/// @file PngImage.cc
/// @brief Reader of PNG by libpng.
///
/// libpng leaves an error by longjmp(), which skips destructors: the two functions that call it hold
/// nothing but numbers and pointers, and all else belongs to their caller. (Its simplified interface has
/// no jumps, but converts values by their gamma.)

#include "GrayImage.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <utility>

#include <png.h>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;

/// What callbacks see.
struct PngState {
    const uint8_t* file;
    std::size_t left;
    char error[120];
};

void onError(png_structp png, png_const_charp message)
{
    auto* const state = static_cast<PngState*>(png_get_error_ptr(png));
    std::snprintf(state->error, sizeof(state->error), "%s", message);
    png_longjmp(png, 1);
}

/// More data than the header says is a warning of libpng; other warnings are of what is not read here.
void onWarning(png_structp png, png_const_charp message)
{
    for (const char* surplus : {"Extra compressed data", "Too much image data"}) {
        if (std::strstr(message, surplus))
            png_error(png, "there is more image data than its header says");
    }
}

void onRead(png_structp png, png_bytep out, std::size_t bytes)
{
    auto* const state = static_cast<PngState*>(png_get_io_ptr(png));
    if (bytes > state->left) png_error(png, "the file ends early");
    std::memcpy(out, state->file, bytes);
    state->file += bytes;
    state->left -= bytes;
}

/// What libpng will deliver.
struct PngHead {
    png_uint_32 width = 0, height = 0;
    int bits = 0, channels = 0;
    bool isTransparent = false;
    std::size_t rowBytes = 0;
};

class PngReader {
public:
    explicit PngReader(const std::vector<uint8_t>& file) : mState{file.data(), file.size(), {}}
    {
        mPng = png_create_read_struct(PNG_LIBPNG_VER_STRING, &mState, onError, onWarning);
        mInfo = mPng ? png_create_info_struct(mPng) : nullptr;
        if (!mInfo) {
            png_destroy_read_struct(&mPng, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngReader() { png_destroy_read_struct(&mPng, &mInfo, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    PngHead head()
    {
        PngHead head;
        if (!readHead(head)) fail();
        return head;
    }
    void rows(png_bytepp rows)
    {
        if (!readRows(rows)) fail();
    }

private:
    [[noreturn]] void fail() const
    {
        throw IoError("is no sound .png: " + onOneLine(mState.error, sizeof(mState.error)));
    }

    bool readHead(PngHead& head)
    {
        if (setjmp(png_jmpbuf(mPng))) return false;
        png_set_read_fn(mPng, &mState, onRead);
        png_set_user_limits(mPng, kMaxImageSide, kMaxImageSide);
        png_read_info(mPng, mInfo);
        head.isTransparent = png_get_valid(mPng, mInfo, PNG_INFO_tRNS) != 0;
        if (png_get_color_type(mPng, mInfo) == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(mPng);
        else png_set_packing(mPng); // a byte a pixel, not another number
        const uint16_t one = 1;
        uint8_t first;
        std::memcpy(&first, &one, 1);
        if (first == 1) png_set_swap(mPng); // two bytes in the order of this machine
        png_set_interlace_handling(mPng);
        png_read_update_info(mPng, mInfo);
        head.width = png_get_image_width(mPng, mInfo);
        head.height = png_get_image_height(mPng, mInfo);
        head.bits = png_get_bit_depth(mPng, mInfo);
        head.channels = png_get_channels(mPng, mInfo);
        head.rowBytes = png_get_rowbytes(mPng, mInfo);
        return true;
    }

    bool readRows(png_bytepp rows)
    {
        if (setjmp(png_jmpbuf(mPng))) return false;
        png_read_image(mPng, rows);
        png_read_end(mPng, nullptr);
        return true;
    }

    PngState mState;
    png_structp mPng = nullptr;
    png_infop mInfo = nullptr;
};

/// libpng takes memory for as many bytes as a chunk says that it has: there must be so many.
void requireChunks(const std::vector<uint8_t>& file)
{
    constexpr std::size_t kSignature = 8, kAround = 12; // length, name and checksum of a chunk
    for (std::size_t at = kSignature; at + kAround <= file.size();) {
        const auto length = std::size_t(png_get_uint_32(&file[at]));
        if (length > file.size() - at - kAround) {
            throw IoError("is no sound .png: a chunk of " + std::to_string(length)
                + " bytes does not end in the file");
        }
        if (std::memcmp(&file[at + 4], "IEND", 4) == 0) return;
        at += kAround + length;
    }
}

/// Deflate makes no more of the file than this: what claims more is refused before memory is taken.
void requireHeld(const PngHead& head, std::size_t fileBytes)
{
    constexpr uint64_t kMaxRatio = 1032, kMostBitsLess = 24; // a bit a pixel becomes three bytes
    const uint64_t bytes = uint64_t(head.rowBytes) * head.height;
    if (bytes / (kMaxRatio * kMostBitsLess) > fileBytes) {
        throw IoError("is no sound .png: " + std::to_string(head.width) + " x "
            + std::to_string(head.height) + " pixels cannot be in a file that small");
    }
}

template <typename Pixel>
void takeGray(const std::vector<uint8_t>& rows, const PngHead& head, GrayImage& image)
{
    constexpr auto kOpaque = Pixel(~Pixel(0));
    const bool isColor = head.channels >= 3, hasAlpha = head.channels == 2 || head.channels == 4;
    const auto channels = std::size_t(head.channels);
    std::vector<Pixel> pixel(channels);
    for (std::size_t i = 0; i < std::size_t(head.width) * head.height; ++i) {
        std::memcpy(pixel.data(), &rows[i * channels * sizeof(Pixel)], channels * sizeof(Pixel));
        const bool isGray = !isColor || (pixel[0] == pixel[1] && pixel[1] == pixel[2]);
        if (!isGray || (hasAlpha && pixel.back() != kOpaque)) {
            throw IoError("pixel (" + std::to_string(i % head.width) + ", "
                + std::to_string(i / head.width) + (isGray ? ") is transparent" : ") is not gray")
                + "; make it a gray picture first (ImageMagick: convert in.png -alpha off "
                  "-colorspace Gray out.png)");
        }
        std::memcpy(&image.pixels[i * sizeof(Pixel)], pixel.data(), sizeof(Pixel));
    }
}

} // namespace

GrayImage readPng(const std::vector<uint8_t>& file)
{
    requireChunks(file);
    PngReader reader(file);
    const PngHead head = reader.head();
    requireHeld(head, file.size());
    if (head.isTransparent) {
        throw IoError("has a transparent color; make it a gray picture first (ImageMagick: convert "
                      "in.png -alpha off -colorspace Gray out.png)");
    }
    const double pixels = double(head.rowBytes) * head.height;
    requireMemory(
        2 * pixels, "its pixels", "make smaller pictures of it"); // as they come, and gray
    std::vector<uint8_t> bytes(head.rowBytes * head.height);
    std::vector<png_bytep> rows(head.height);
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = bytes.data() + y * head.rowBytes;
    reader.rows(rows.data());

    GrayImage image;
    image.width = head.width;
    image.height = head.height;
    image.bytesPerPixel = head.bits == 16 ? 2 : 1;
    if (head.channels == 1) {
        image.pixels = std::move(bytes);
        return image;
    }
    image.pixels.resize(image.bytes());
    if (image.bytesPerPixel == 2) takeGray<uint16_t>(bytes, head, image);
    else takeGray<uint8_t>(bytes, head, image);
    return image;
}

} // namespace openvdb_spheretree::detail
