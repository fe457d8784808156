// SPDX-License-Identifier: Apache-2.0
#include "ArrayFile.h"

#include <openvdb_spheretree/base/Text.h>

#include <filesystem>
#include <ios>
#include <new>
#include <sstream>
#include <system_error>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;
using openvdb::math::Transform;

[[noreturn]] void fail(const std::string& name, const std::string& what)
{
    throw IoError(name + ": " + what);
}

/// @return the size of the file, after making sure that it is one.
uint64_t fileSizeOf(const std::string& path, const std::string& name)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail(name, "no such file");
    if (std::filesystem::is_directory(status)) fail(name, "is a directory, not a file");
    if (!std::filesystem::is_regular_file(status)) {
        fail(name, "is not a regular file; copy the volume to one first");
    }
    const uint64_t bytes = std::filesystem::file_size(path, error);
    if (error) fail(name, "cannot be read: " + error.message());
    return bytes;
}

} // namespace

openvdb::GridBase::Ptr readArrayFile(
    const std::string& path, const std::string& name, const ReadArray& read)
{
    const uint64_t bytes = fileSizeOf(path, name);
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(name, "cannot be opened for reading");
    file.exceptions(std::ios::badbit); // a reading that fails is no end of the file
    try {
        return read(file, bytes);
    } catch (const IoError& error) {
        fail(name, messageOf(error));
    } catch (const openvdb::ValueError& error) {
        fail(name, messageOf(error));
    } catch (const std::bad_alloc&) {
        fail(name, "not enough memory for the volume that its header asks for");
    } catch (const std::ios_base::failure& error) {
        fail(name, "cannot be read: " + error.code().message());
    }
}

Transform::Ptr transformOf(const openvdb::Vec3d& voxelSize)
{
    try {
        if (voxelSize[0] == voxelSize[1] && voxelSize[1] == voxelSize[2]) {
            return Transform::createLinearTransform(voxelSize[0]);
        }
        return std::make_shared<Transform>(
            openvdb::math::MapBase::Ptr(new openvdb::math::ScaleMap(voxelSize)));
    } catch (const openvdb::ArithmeticError&) { // OpenVDB takes tiny voxels for none
        std::ostringstream size;
        size << "voxels of " << voxelSize[0] << " x " << voxelSize[1] << " x " << voxelSize[2]
             << " are too small for OpenVDB, which takes cubes of 1.5e-5 and larger: give "
                "a larger spacing=, of a smaller unit of length, and let scale= of -write make the "
                "numbers of other tools' files smaller";
        throw IoError(size.str());
    }
}

Transform::Ptr transformOf(const openvdb::Mat4d& indexToWorld)
{
    if (!indexToWorld.isFinite())
        throw IoError("its place in space has numbers that are not finite");
    try {
        return Transform::createLinearTransform(indexToWorld); // the simplest map that it is
    } catch (const openvdb::Exception&) {
        throw IoError("its voxels have no volume, or are smaller than the cubes of 1.5e-5 that "
                      "OpenVDB takes");
    }
}

} // namespace openvdb_spheretree::detail
