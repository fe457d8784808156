// SPDX-License-Identifier: Apache-2.0
/// @file VolumeHeader.h
/// @brief What the header of a volume says, whatever its format; and the readers of headers.

#pragma once

#include <openvdb_spheretree/input/array/ArrayLayout.h>
#include <openvdb_spheretree/input/array/ByteSource.h>

#include <openvdb/Types.h>
#include <openvdb/math/Mat4.h>

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

enum class Encoding { Raw, Gzip, Text };

struct VolumeHeader {
    ArrayLayout layout;
    std::optional<openvdb::Mat4d> indexToWorld; ///< for row vectors; if the file says so
    Encoding encoding = Encoding::Raw;
    std::string dataFile;  ///< where the numbers are; empty: behind the header
    uint64_t lineSkip = 0; ///< lines of the data file before the numbers
    uint64_t byteSkip = 0; ///< bytes after these
    bool fromEnd = false;  ///< the numbers are the last of the data file
};

/// What all headers have: sides of any number of axes, the fastest first.
/// @return three of them. Axes of one number are left out where there are more than three.
/// @throw openvdb::IoError if that leaves more, or there is only one
std::array<uint64_t, 3> threeSides(std::vector<uint64_t> sides);

/// @return a matrix whose voxels have these steps, for row vectors. A step of a flat volume that
///         nobody knows (0) is as long as the shortest other one, and at right angles to both.
openvdb::Mat4d placeOf(std::array<openvdb::Vec3d, 3> steps, const openvdb::Vec3d& origin);

/// @name Readers; they leave the file where the numbers begin, but for what the header says to skip
/// @{
/// Of numpy, versions 1 to 3. (numpy, "The NPY format", numpy.lib.format)
/// @param zyx  whether the first index is z
VolumeHeader readNpyHeader(std::istream& file, uint64_t fileBytes, bool zyx);
/// (Teem, "Definition of NRRD File Format")
VolumeHeader readNrrdHeader(std::istream& file);
/// NIfTI-1 in one file, of its first 348 bytes; byteSkip says how many follow before the numbers.
/// (NIfTI-1 Data Format)
VolumeHeader readNiftiHeader(ByteSource& source);
/// @}

} // namespace openvdb_spheretree::detail
