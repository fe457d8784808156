// SPDX-License-Identifier: Apache-2.0
/// @file EmptyObject.h
/// @brief What is thrown where there is no voxel to make anything of.

#pragma once

#include <openvdb/Exceptions.h>

#include <string>

namespace openvdb_spheretree {

/// A ValueError like others; by its type a caller knows that nothing else is wrong, as in an empty
/// frame of a sequence.
class EmptyObject : public openvdb::ValueError {
public:
    explicit EmptyObject(const std::string& message) : openvdb::ValueError(message) {}
};

} // namespace openvdb_spheretree
