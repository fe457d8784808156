// SPDX-License-Identifier: Apache-2.0
/// @file HeightField.h
/// @brief Hills of every size from 8 to 128 voxels: value noise, in integers.
///
/// The field is the sum of five octaves. Each has a random number at every corner of a square
/// lattice of L = 8, 16, ..., 128 voxels, and blends between them by 3 t^2 - 2 t^3 along x and y
/// (K. Perlin's smoothstep). It is L / 2 voxels high. The field has no border and no period.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class HeightField {
public:
    static constexpr int kHighest = 123; ///< heights are 0 to this

    explicit HeightField(uint64_t seed);

    /// @return the heights at x0 <= x < x0 + side and the same for y, at side (x - x0) + y - y0.
    std::vector<int> heights(int x0, int y0, int side) const;

private:
    static constexpr int kFewestBits = 3, kMostBits = 7; ///< L is 2 to the power of these
    struct Window {
        int x0, y0, side;
        std::vector<int>& sums;
    };
    /// @return the random number at a corner of the octave of L = 2^bits.
    int corner(int bits, int i, int j) const;
    /// Adds this octave between the corners i, j and i + 1, j + 1.
    void addCell(int bits, int i, int j, const Window& window) const;

    uint64_t mKey;
    std::array<std::array<int, 1 << kMostBits>, kMostBits + 1> mWeights; ///< by octave and place
};

} // namespace openvdb_spheretree::detail
