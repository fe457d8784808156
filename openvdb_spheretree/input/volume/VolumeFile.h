// SPDX-License-Identifier: Apache-2.0
/// @file VolumeFile.h
/// @brief Volumes of other tools as grids: arrays of numpy (`.npy`), plain numbers (`.raw`), `.nrrd`
/// and `.nhdr`, NIfTI-1 (`.nii`, `.nii.gz`), and gray pictures (`.png`, `.pgm`), alone or as a stack of
/// slices.

#pragma once

#include <openvdb_spheretree/input/array/NumberType.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// What a file does not say.
struct VolumeSettings {
    /// Sides of a voxel along x, y, z, in world units, each > 0: in place of all that the file says of
    /// its place in space. By default what the file says, or 1.
    std::optional<openvdb::Vec3d> spacing;
    /// The value of empty voxels, which are inactive, and of all beyond the file.
    double background = 0;
    /// Of a `.npy`: whether the first index is z, as in stacks of slices, rather than x, as in
    /// OpenVDB's own arrays.
    bool zyx = false;

    /// @name Of a `.raw`, x fastest: both of the first two must be there
    /// @{
    std::optional<std::array<uint64_t, 3>> shape; ///< numbers along x, y, z
    std::optional<NumberType> type;
    bool bigEndian = false;
    uint64_t headerBytes = 0; ///< to be skipped
    /// @}
};

/// @return whether a file of this name is read, by its extension, in any case; of a stack, too.
bool isVolumeFileName(const std::string& path);

/// @return the extension in small letters; of `a.nii.gz` that is `.nii.gz`.
std::string volumeExtension(const std::string& path);

/// @return whether the name stands for a stack of slices: it has one `%d` or `%04d`, or `####`, and
///         ends with `.png` or `.pgm`. A file of that very name is no stack.
bool isStackName(const std::string& path);

/// @return the slices of a stack, by number: all files of the folder that the name stands for. The
///         first number may be any.
/// @throw openvdb::IoError naming the file if there is none, or one is missing between others
std::vector<std::string> stackFiles(const std::string& name);

/// @brief Read a volume as a sparse grid, named after the file: of bools a BoolGrid, of integers an
/// Int32Grid or Int64Grid, of floats a FloatGrid or DoubleGrid.
///
/// Voxel (0, 0, 0) is the first number. Voxels with the background, and NaN, are inactive; where there
/// are NaN, metadata `nan_values` (an int64) says how many. Leaves of one value are tiles. The
/// transform is that of the file: spacings, or the matrix of an `.nrrd` or NIfTI, in its own axes and
/// units. What a number stands for by the slope of a NIfTI is taken, as a float. A picture is one voxel
/// thick along z; its columns are x, its rows y, from the top.
/// Axes of one number are left out, so a fourth one is no obstacle.
/// Memory: the result, and sixteen slices along the slowest axis.
/// @param shownAs  in place of @a path, what messages and the grid are named after, and whose
///                 extension says the format: for files without a name of their own
/// @throw openvdb::IoError that names the file and what is wrong, if it cannot be read, is damaged, has
///        more or fewer numbers than its header says, or numbers of a kind that is not read; or if its
///        data file is not in its folder or below, or was written to meanwhile
/// @throw Interrupted if the interrupter said so
/// Cost: one pass over the numbers. Parallel; the result does not depend on threads.
openvdb::GridBase::Ptr readVolumeFile(const std::string& path, const VolumeSettings& settings = {},
    openvdb::util::NullInterrupter* interrupter = nullptr, const std::string& shownAs = {});

} // namespace openvdb_spheretree
