// SPDX-License-Identifier: Apache-2.0
/// @file VolumeFile.cc
/// @brief Each format says where its numbers are and how they stand there (VolumeHeader.h); the rest is
/// the same for all: gridOf() makes the grid (input/array/ArrayGrid.h).

#include "VolumeFile.h"

#include "ImageStack.h"
#include "VolumeHeader.h"
#include <openvdb_spheretree/base/FileStamp.h>
#include <openvdb_spheretree/base/NearbyFiles.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/input/array/ArrayFile.h>
#include <openvdb_spheretree/input/array/ArrayGrid.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>

namespace openvdb_spheretree {
namespace {

using detail::ArrayLayout;
using detail::ByteSource;
using detail::Encoding;
using detail::InflatedBytes;
using detail::RawBytes;
using detail::StackBytes;
using detail::TextNumbers;
using detail::VolumeHeader;
using openvdb::GridBase;
using openvdb::IoError;
using openvdb::util::NullInterrupter;

GridBase::Ptr gridOf(ByteSource& source, const VolumeHeader& header, const VolumeSettings& settings,
    NullInterrupter* interrupter)
{
    openvdb::math::Transform::Ptr transform;
    if (settings.spacing) transform = detail::transformOf(*settings.spacing);
    else if (header.indexToWorld) transform = detail::transformOf(*header.indexToWorld);
    detail::ArrayGridSettings grid;
    grid.background = settings.background;
    const GridBase::Ptr result = detail::gridOf(source, header.layout, grid, interrupter);
    if (transform) result->setTransform(transform);
    return result;
}

/// Leaves out bytes of a stream that may end before.
void skip(ByteSource& source, uint64_t bytes)
{
    std::vector<uint8_t> part(std::min<uint64_t>(bytes, 1 << 16));
    for (uint64_t left = bytes; left > 0;) {
        const uint64_t now = std::min<uint64_t>(left, part.size());
        source.read(part.data(), now);
        left -= now;
    }
}

/// The numbers of a header, from where @a file stands: after its header, or at the start of a file of
/// their own.
GridBase::Ptr readNumbers(std::ifstream& file, uint64_t fileBytes, const VolumeHeader& header,
    const VolumeSettings& settings, NullInterrupter* interrupter)
{
    detail::requireSides(header.layout);
    file.clear(); // a short header may have been read to the end of the file
    for (uint64_t line = 0; line < header.lineSkip && file; ++line) {
        file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    uint64_t start = file ? uint64_t(std::streamoff(file.tellg())) : fileBytes;
    const bool isGzip = header.encoding == Encoding::Gzip;
    const uint64_t bytes = header.layout.bytes();
    if (header.fromEnd) start = std::max(start, fileBytes - std::min(bytes, fileBytes));
    else if (!isGzip) start += std::min(header.byteSkip, fileBytes - std::min(start, fileBytes));
    const uint64_t held = fileBytes - std::min(start, fileBytes);
    file.clear();
    file.seekg(std::streamoff(start));
    std::unique_ptr<ByteSource> source;
    switch (header.encoding) {
    case Encoding::Raw:
        detail::requireHeld(header.layout, held, /*deflated=*/false);
        source = std::make_unique<RawBytes>(file);
        break;
    case Encoding::Gzip:
        detail::requireHeld(header.layout, held, /*deflated=*/true);
        source = std::make_unique<InflatedBytes>(file, InflatedBytes::Wrapper::Gzip);
        skip(*source, header.byteSkip);
        break;
    case Encoding::Text:
        if (bytes / uint64_t(bytesOf(header.layout.type)) > held) { // a digit each, at least
            throw IoError(describe(header.layout) + " cannot be in " + std::to_string(held)
                + " bytes of text; it is truncated, or its header wrong");
        }
        source = std::make_unique<TextNumbers>(file, header.layout.type);
    }
    return gridOf(*source, header, settings, interrupter);
}

VolumeHeader rawHeader(const VolumeSettings& settings)
{
    if (!settings.shape || !settings.type) {
        throw IoError("does not say what it holds: give its shape=X,Y,Z and its type, such as "
                      "type=uint8 or type=float32");
    }
    VolumeHeader header;
    header.layout.dim = *settings.shape;
    header.layout.type = *settings.type;
    header.layout.bigEndian = settings.bigEndian;
    header.byteSkip = settings.headerBytes;
    return header;
}

GridBase::Ptr readNifti(std::ifstream& file, uint64_t fileBytes, bool isGzip,
    const VolumeSettings& settings, NullInterrupter* interrupter)
{
    if (!isGzip) {
        RawBytes source(file);
        const VolumeHeader header = detail::readNiftiHeader(source);
        return readNumbers(file, fileBytes, header, settings, interrupter);
    }
    InflatedBytes source(file, InflatedBytes::Wrapper::Gzip);
    const VolumeHeader header = detail::readNiftiHeader(source);
    detail::requireSides(header.layout);
    detail::requireHeld(header.layout, fileBytes, /*deflated=*/true);
    skip(source, header.byteSkip);
    return gridOf(source, header, settings, interrupter);
}

/// @param name  that the header was read under: a data file is beside what it leads to
GridBase::Ptr readNrrd(std::ifstream& file, uint64_t fileBytes, const std::string& name,
    const VolumeSettings& settings, NullInterrupter* interrupter)
{
    const VolumeHeader header = detail::readNrrdHeader(file);
    if (header.dataFile.empty()) {
        return readNumbers(file, fileBytes, header, settings, interrupter);
    }
    const detail::NearbyFiles nearby(name);
    const std::string data = (nearby.folder() / header.dataFile).string();
    const std::string shown = "its data file " + detail::inQuotes(header.dataFile, 200);
    if (!nearby.hold(data)) {
        throw IoError(shown
            + " is not in the header's folder or below (links are followed): move it there, and "
              "mend 'data file' in the header");
    }
    const detail::FileStamp stamp(data);
    const auto requireUnchanged = [&] {
        if (!stamp.isUnchanged()) throw IoError(detail::kWasChanged);
    };
    return detail::readArrayFile(data, shown, [&](std::ifstream& numbers, uint64_t bytes) {
        GridBase::Ptr grid;
        try {
            grid = readNumbers(numbers, bytes, header, settings, interrupter);
        } catch (const openvdb::Exception&) {
            requireUnchanged(); // else it is truncated, or its numbers none
            throw;
        }
        requireUnchanged();
        return grid;
    });
}

GridBase::Ptr readImages(
    StackBytes& source, const VolumeSettings& settings, NullInterrupter* interrupter)
{
    VolumeHeader header;
    header.layout = source.layout();
    return gridOf(source, header, settings, interrupter);
}

/// @return the file's name without folder and extension.
std::string gridName(const std::string& name)
{
    const std::string file = std::filesystem::path(name).filename().string();
    return file.substr(0, file.size() - volumeExtension(name).size());
}

void requireSpacing(const VolumeSettings& settings)
{
    if (!settings.spacing) return;
    for (int a = 0; a < 3; ++a) {
        const double side = (*settings.spacing)[a];
        if (side > 0 && std::isfinite(side)) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "a spacing of " << side << " is none: sides of voxels are above 0");
    }
}

} // namespace

std::string volumeExtension(const std::string& path)
{
    const std::string extension = detail::lowerExtension(path);
    if (extension != ".gz") return extension;
    return detail::lowerExtension(std::filesystem::path(path).stem().string()) + extension;
}

bool isVolumeFileName(const std::string& path)
{
    const std::string extension = volumeExtension(path);
    constexpr const char* kExtensions[] = {
        ".npy", ".raw", ".nrrd", ".nhdr", ".nii", ".nii.gz", ".png", ".pgm"};
    return std::find(std::begin(kExtensions), std::end(kExtensions), extension)
        != std::end(kExtensions);
}

GridBase::Ptr readVolumeFile(const std::string& path, const VolumeSettings& settings,
    NullInterrupter* interrupter, const std::string& shownAs)
{
    requireSpacing(settings);
    const std::string& name = shownAs.empty() ? path : shownAs;
    const std::string extension = volumeExtension(name);
    const bool isStack = isStackName(path);
    const std::vector<std::string> files = isStack ? stackFiles(path) : std::vector{path};
    const auto read = [&](std::ifstream& file, uint64_t bytes) {
        if (detail::isImageFileName(name)) {
            StackBytes source(files, name);
            return readImages(source, settings, interrupter);
        }
        if (extension == ".npy") {
            const VolumeHeader header = detail::readNpyHeader(file, bytes, settings.zyx);
            return readNumbers(file, bytes, header, settings, interrupter);
        }
        if (extension == ".nrrd" || extension == ".nhdr") {
            return readNrrd(file, bytes, name, settings, interrupter);
        }
        if (extension == ".nii" || extension == ".nii.gz") {
            return readNifti(file, bytes, extension == ".nii.gz", settings, interrupter);
        }
        return readNumbers(file, bytes, rawHeader(settings), settings, interrupter);
    };
    const GridBase::Ptr grid = detail::readArrayFile(files.front(), name, read);
    grid->setName(isStack ? detail::stackTitle(name) : gridName(name));
    return grid;
}

} // namespace openvdb_spheretree
