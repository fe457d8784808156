// SPDX-License-Identifier: Apache-2.0
/// @file NearbyFiles.h
/// @brief The files that a file may name as parts of itself: those in its folder, or below it.
///
/// A file of a stranger could name any other: what is private would become voxels or points, and leave with them.

#pragma once

#include <filesystem>
#include <string>

namespace openvdb_spheretree::detail {

class NearbyFiles {
public:
    /// @param path  of the file that names others
    explicit NearbyFiles(const std::string& path);

    /// @return where the file is, links followed: what it names is counted from there.
    const std::filesystem::path& folder() const { return mFolder; }

    /// @return whether @a path lies in the folder or below, links followed; nothing need be there.
    bool hold(const std::string& path) const;

private:
    std::filesystem::path mFolder; ///< empty where it cannot be found: then it holds nothing
};

} // namespace openvdb_spheretree::detail
