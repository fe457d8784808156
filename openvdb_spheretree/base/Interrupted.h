// SPDX-License-Identifier: Apache-2.0
/// @file Interrupted.h
/// @brief What long work throws when its interrupter stops it.

#pragma once

#include <stdexcept>

namespace openvdb_spheretree {

/// Nothing has been changed or written by the call that throws this, unless it says otherwise.
class Interrupted : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("interrupted") {}
};

} // namespace openvdb_spheretree
