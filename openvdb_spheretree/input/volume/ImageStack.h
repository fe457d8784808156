// SPDX-License-Identifier: Apache-2.0
/// @file ImageStack.h
/// @brief Pictures of one size as the slices of a volume, read as they are asked for.

#pragma once

#include <openvdb_spheretree/input/array/ByteSource.h>
#include <openvdb_spheretree/input/image/GrayImage.h>

#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// @return what a stack's grid is named: what stands before the number in the name of its files.
std::string stackTitle(const std::string& name);

/// Slices must be of the size and number of bits of the first one.
class StackBytes final : public ByteSource {
public:
    /// @param shownAs  whose extension says the format of a picture that is alone
    /// @throw openvdb::IoError as readGrayImage(); naming the file, where it is one of several
    StackBytes(std::vector<std::string> files, std::string shownAs);

    const ArrayLayout& layout() const { return mLayout; }

    /// Slices that are asked for at once are read in parallel.
    /// @param bytes  a number of whole slices
    void read(uint8_t* out, uint64_t bytes) override;

private:
    GrayImage imageOf(const std::string& file) const;

    const std::vector<std::string> mFiles;
    const std::string mShownAs;
    ArrayLayout mLayout;
    std::size_t mNext = 0;
};

} // namespace openvdb_spheretree::detail
