// SPDX-License-Identifier: Apache-2.0
#include "Picture.h"

#include <openvdb/Exceptions.h>

#include <png.h>

#include <ostream>

namespace openvdb_spheretree {

void writePng(const Picture& picture, std::ostream& out)
{
    const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
    if (picture.width < 1 || picture.height < 1 || picture.rgb.size() != 3 * pixels) {
        OPENVDB_THROW(openvdb::ValueError,
            "a picture of " << picture.width << " x " << picture.height << " pixels and "
                            << picture.rgb.size() << " bytes cannot be written");
    }
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
    out.write(file.data(), std::streamsize(bytes));
    out.flush();
    if (!out) OPENVDB_THROW(openvdb::IoError, "cannot write the .png: is the disk full?");
}

} // namespace openvdb_spheretree
