// SPDX-License-Identifier: Apache-2.0
/// @file OpenVdb.h
/// @brief OpenVDB made ready, whole.

#pragma once

namespace command {

/// Registers the types of OpenVDB.
/// @throw std::bad_alloc also where OpenVDB says nothing of it: the name of a type of grid is made in a stream, which
///        drops the rest of it where memory is lacking. Files would have the part that is left.
void initializeOpenVdb();

} // namespace command
