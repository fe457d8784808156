// SPDX-License-Identifier: Apache-2.0
/// @file Hash.h
/// @brief Numbers that look random and depend on their input alone.

#pragma once

#include <cstdint>

namespace openvdb_spheretree::detail {

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014): a permutation of 64-bit numbers.
inline uint64_t hash(uint64_t key)
{
    key += 0x9e3779b97f4a7c15u;
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
    return key ^ (key >> 31);
}

/// @return a number in [0, 1) from the upper half of @a bits.
inline double unitInterval(uint64_t bits) { return double(bits >> 32) / 4294967296.0; }

} // namespace openvdb_spheretree::detail
