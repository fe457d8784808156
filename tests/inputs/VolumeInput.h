// SPDX-License-Identifier: Apache-2.0
/// @file VolumeInput.h
/// @brief Volumes that are more than one file, or less than one: their bytes as one input all the same.
///
/// | kind of input | its bytes |
/// |---|---|
/// | `.raw`      | 16 bytes of settings, as a line of options has them (rawInput()), then the numbers |
/// | `.detached` | the header of a `.nhdr`, kPartEnd, the bytes of `input.raw`, a file beside it |
/// | `.stack`    | slices, kPartEnd between two: `.pgm` if the first begins with `P`, else `.png` |

#pragma once

#include "InputFile.h"

#include <openvdb_spheretree/input/volume/VolumeFile.h>

#include <string>

namespace spheretree_test {

/// Stands between two files of an input.
constexpr char kPartEnd[] = "\n%%\n";

/// Where such inputs are read. What holds of InputFile in a child process holds of it.
class VolumeInput {
public:
    /// @return whether it is a kind of the table above.
    static bool isKind(const std::string& extension);

    explicit VolumeInput(const std::string& kind) : mKind(kind) {}

    /// Replaces what is in the files.
    void set(const std::string& bytes);
    /// @return what messages name.
    const std::string& path() const { return mPath; }
    /// @throw what the reader of volumes throws
    void read() const;

private:
    std::string mKind, mPath, mRead;
    openvdb_spheretree::VolumeSettings mSettings;
    InputFolder mFolder;
};

/// @return what a `.raw` of such settings is as an input: the shape in three numbers of 4 bytes, the type, the order of
///         bytes, and the header's size in two; all little-endian.
std::string rawInput(
    const openvdb_spheretree::VolumeSettings& settings, const std::string& numbers);

} // namespace spheretree_test
