// SPDX-License-Identifier: Apache-2.0
#include "NearbyFiles.h"

#include <algorithm>
#include <system_error>

namespace openvdb_spheretree::detail {
namespace {

namespace fs = std::filesystem;

/// @return the place without links, as far as it is there; empty if it cannot be found.
fs::path placeOf(const std::string& path)
{
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    if (error) return {};
    const fs::path place = fs::weakly_canonical(absolute, error);
    return error ? fs::path() : place;
}

} // namespace

NearbyFiles::NearbyFiles(const std::string& path) : mFolder(placeOf(path).parent_path()) {}

bool NearbyFiles::hold(const std::string& path) const
{
    const fs::path place = placeOf(path);
    if (mFolder.empty() || place.empty()) return false;
    return std::mismatch(mFolder.begin(), mFolder.end(), place.begin(), place.end()).first
        == mFolder.end();
}

} // namespace openvdb_spheretree::detail
