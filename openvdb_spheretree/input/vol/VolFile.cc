// SPDX-License-Identifier: Apache-2.0
/// @file VolFile.cc
/// @brief Reader of `.vol` and `.longvol` files that never holds the whole volume.
///
/// 1. readVolHeader(): VolHeader.h.
/// 2. RawBytes or InflatedBytes: the values in file order (input/array/ByteSource.h).
/// 3. gridOf(): eight z-slices at a time become leaves (input/array/ArrayGrid.h).

#include "VolFile.h"

#include "VolHeader.h"
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/input/array/ArrayFile.h>
#include <openvdb_spheretree/input/array/ArrayGrid.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace openvdb_spheretree {
namespace {

using detail::ArrayGridSettings;
using detail::ArrayLayout;
using detail::ByteSource;
using detail::InflatedBytes;
using detail::RawBytes;
using detail::VolHeader;
using openvdb::IoError;

ArrayLayout layoutOf(const VolHeader& header)
{
    ArrayLayout layout;
    layout.dim = header.dim;
    layout.type = header.bytesPerValue == 8 ? NumberType::UInt64 : NumberType::UInt8;
    return layout; // little-endian
}

openvdb::GridBase::Ptr readValues(
    std::ifstream& file, const VolHeader& header, openvdb::util::NullInterrupter* interrupter)
{
    std::unique_ptr<ByteSource> source;
    if (header.version == 3) {
        source = std::make_unique<InflatedBytes>(file, InflatedBytes::Wrapper::Zlib);
    } else {
        source = std::make_unique<RawBytes>(file); // whose length was checked by its header
    }
    ArrayGridSettings settings;
    settings.tiles = false; // as these grids always were
    return detail::gridOf(*source, layoutOf(header), settings, interrupter);
}

openvdb::math::Transform::Ptr transformOf(const VolHeader& header)
{
    try {
        return detail::transformOf(openvdb::Vec3d(header.voxelSize.data()));
    } catch (const openvdb::Exception&) { // OpenVDB refuses transforms that are nearly singular
        throw IoError("header key 'Voxel-Size' is too small for an OpenVDB transform");
    }
}

} // namespace

bool isVolFileName(const std::string& path)
{
    const std::string extension = detail::lowerExtension(path);
    return extension == ".vol" || extension == ".longvol";
}

openvdb::GridBase::Ptr readVolFile(const std::string& path,
    openvdb::util::NullInterrupter* interrupter, const std::string& shownAs)
{
    const std::string& name = shownAs.empty() ? path : shownAs;
    return detail::readArrayFile(path, name, [&](std::ifstream& file, std::uint64_t fileBytes) {
        const VolHeader header = detail::readVolHeader(name, file, fileBytes);
        const openvdb::math::Transform::Ptr transform = transformOf(header);
        const openvdb::GridBase::Ptr grid = readValues(file, header, interrupter);
        grid->setName(std::filesystem::path(name).stem().string());
        grid->setTransform(transform);
        return grid;
    });
}

} // namespace openvdb_spheretree
