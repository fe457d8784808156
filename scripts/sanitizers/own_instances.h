// SPDX-License-Identifier: Apache-2.0
/// @file own_instances.h
/// @brief Included before all else in builds with the thread sanitizer: OpenVDB's tools (dilation, meshes to level sets and
/// back) are then compiled here, with the sanitizer, and not taken from OpenVDB's library, in which it does not see that a
/// loop has ended.

#pragma once

#include <openvdb/version.h>

#undef OPENVDB_USE_EXPLICIT_INSTANTIATION
