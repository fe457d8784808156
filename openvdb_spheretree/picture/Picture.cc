// SPDX-License-Identifier: Apache-2.0
#include "Picture.h"

#include <openvdb/Exceptions.h>

#include <png.h>

#include <csetjmp>
#include <cstdio> // that of libjpeg needs it
#include <cstdlib>
#include <memory>
#include <ostream>

#ifdef SPHERETREE_WITH_JPEG
#include <jpeglib.h>
#endif

namespace openvdb_spheretree {

namespace {

void requireSize(const Picture& picture)
{
    const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
    if (picture.width >= 1 && picture.height >= 1 && picture.rgb.size() == 3 * pixels) return;
    OPENVDB_THROW(openvdb::ValueError,
        "a picture of " << picture.width << " x " << picture.height << " pixels and "
                        << picture.rgb.size() << " bytes cannot be written");
}

void writeBytes(const char* data, std::size_t size, const char* what, std::ostream& out)
{
    out.write(data, std::streamsize(size));
    out.flush();
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the " << what << ": is the disk full?");
}

#ifdef SPHERETREE_WITH_JPEG

struct JpegFailure {
    jpeg_error_mgr base;
    std::jmp_buf jump;
    char why[JMSG_LENGTH_MAX];
};

/// libjpeg wants that this does not return, and an exception must not cross C.
[[noreturn]] void failJpeg(j_common_ptr info)
{
    auto* const failure = reinterpret_cast<JpegFailure*>(info->err);
    failure->base.format_message(info, failure->why);
    std::longjmp(failure->jump, 1);
}

/// Nothing here has a destructor that a jump could leave out.
/// @param file  is set to memory of malloc(), or stays null
/// @return whether it went well
bool compressJpeg(const Picture& picture, int quality, JpegFailure& failure, unsigned char** file,
    unsigned long* size)
{
    jpeg_compress_struct info;
    info.err = jpeg_std_error(&failure.base);
    failure.base.error_exit = failJpeg;
    jpeg_create_compress(&info);
    if (setjmp(failure.jump)) {
        jpeg_destroy_compress(&info);
        return false;
    }
    jpeg_mem_dest(&info, file, size);
    info.image_width = JDIMENSION(picture.width);
    info.image_height = JDIMENSION(picture.height);
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality, TRUE);
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < info.image_height) {
        const std::size_t row = std::size_t(info.next_scanline) * info.image_width * 3;
        JSAMPROW pixels = const_cast<JSAMPROW>(picture.rgb.data() + row); // is only read
        jpeg_write_scanlines(&info, &pixels, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    return true;
}

#endif

} // namespace

void writePng(const Picture& picture, std::ostream& out)
{
    requireSize(picture);
    // libpng's simplified interface: no jumps over destructors, and no callback that a stream's
    // exception would have to cross. It wants the whole file in memory.
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(picture.width);
    image.height = png_uint_32(picture.height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<char> file(bytes);
    if (!png_image_write_to_memory(
            &image, file.data(), &bytes, 0, picture.rgb.data(), 0, nullptr)) {
        OPENVDB_THROW(openvdb::IoError, "cannot make a .png: " << image.message);
    }
    writeBytes(file.data(), bytes, ".png", out);
}

bool writesJpeg()
{
#ifdef SPHERETREE_WITH_JPEG
    return true;
#else
    return false;
#endif
}

void writeJpeg(const Picture& picture, std::ostream& out, int quality)
{
    requireSize(picture);
    if (quality < 1 || quality > 100) {
        OPENVDB_THROW(
            openvdb::ValueError, "quality=" << quality << " is out of range: it takes 1 to 100");
    }
#ifdef SPHERETREE_WITH_JPEG
    JpegFailure failure;
    unsigned char* file = nullptr;
    unsigned long size = 0;
    const bool isDone = compressJpeg(picture, quality, failure, &file, &size);
    const std::unique_ptr<unsigned char, void (*)(void*)> owner(file, std::free);
    if (!isDone) OPENVDB_THROW(openvdb::IoError, "cannot make a .jpg: " << failure.why);
    writeBytes(reinterpret_cast<const char*>(file), size, ".jpg", out);
#else
    static_cast<void>(out);
    OPENVDB_THROW(openvdb::IoError,
        "this build writes pictures as .png only; for .jpg install libjpeg (Debian: libjpeg-dev) "
        "and configure with -DSPHERETREE_WITH_JPEG=ON");
#endif
}

} // namespace openvdb_spheretree
