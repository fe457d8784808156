// SPDX-License-Identifier: Apache-2.0
/// @file InputStamp.h
/// @brief An input file that must stay what it was while it is read.

#pragma once

#include <openvdb_spheretree/base/FileStamp.h>

#include <string>

namespace command {

class InputStamp {
public:
    /// @param path  what is no regular file, or not there, is never compared
    explicit InputStamp(const std::string& path) : mStamp(path) {}
    /// @throw CommandError (input) if the file has been written to since
    void requireUnchanged() const;

private:
    openvdb_spheretree::detail::FileStamp mStamp;
};

} // namespace command
