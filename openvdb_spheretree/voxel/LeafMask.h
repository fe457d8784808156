// SPDX-License-Identifier: Apache-2.0
/// @file LeafMask.h
/// @brief A set of voxels of an 8x8x8 leaf as 512 bits, in the order of OpenVDB's leaf nodes.
///
/// Voxel (x, y, z) of the leaf has the index 64 x + 8 y + z: bit 8 y + z of word x.

#pragma once

#include <openvdb/math/Coord.h>
#include <openvdb/util/NodeMasks.h>

#include <array>
#include <cstdint>

namespace openvdb_spheretree {

constexpr int kLeafDim = 8;
constexpr int kLeafVoxels = 512;

/// @return the index of a voxel in its leaf: 64 x + 8 y + z of the coordinates modulo 8.
inline uint32_t leafIndex(const openvdb::Coord& ijk)
{
    return uint32_t(ijk[0] & 7) << 6 | uint32_t(ijk[1] & 7) << 3 | uint32_t(ijk[2] & 7);
}

/// @return the voxel of an index, in the leaf whose first voxel is @a origin.
inline openvdb::Coord leafVoxel(const openvdb::Coord& origin, uint32_t index)
{
    return origin.offsetBy(int32_t(index >> 6), int32_t(index >> 3 & 7), int32_t(index & 7));
}

/// An aggregate: LeafMask{} is the empty set.
struct LeafMask : std::array<uint64_t, 8> {
    static LeafMask full() { return {{~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull}}; }
    static LeafMask from(const openvdb::util::NodeMask<3>& nodeMask)
    {
        LeafMask mask;
        for (int w = 0; w < 8; ++w) mask[w] = nodeMask.getWord<uint64_t>(w);
        return mask;
    }
    void copyTo(openvdb::util::NodeMask<3>& nodeMask) const
    {
        for (int w = 0; w < 8; ++w) nodeMask.getWord<uint64_t>(w) = (*this)[w];
    }

    bool isOn(uint32_t index) const { return (*this)[index >> 6] >> (index & 63) & 1; }
    void setOn(uint32_t index) { (*this)[index >> 6] |= uint64_t(1) << (index & 63); }

    bool none() const
    {
        uint64_t any = 0;
        for (const uint64_t word : *this) any |= word;
        return any == 0;
    }
    bool all() const
    {
        uint64_t every = ~uint64_t(0);
        for (const uint64_t word : *this) every &= word;
        return every == ~uint64_t(0);
    }
    int count() const
    {
        int count = 0;
        for (const uint64_t word : *this) count += int(openvdb::util::CountOn(word));
        return count;
    }
    /// Calls visit(index) for each voxel of the set, in ascending order.
    template <typename Visit>
    void visitOn(const Visit& visit) const
    {
        for (uint32_t w = 0; w < 8; ++w) {
            for (uint64_t word = (*this)[w]; word; word &= word - 1) {
                visit(64 * w + openvdb::util::FindLowestOn(word));
            }
        }
    }

    LeafMask& operator|=(const LeafMask& other)
    {
        for (int w = 0; w < 8; ++w) (*this)[w] |= other[w];
        return *this;
    }
    LeafMask& operator&=(const LeafMask& other)
    {
        for (int w = 0; w < 8; ++w) (*this)[w] &= other[w];
        return *this;
    }
    /// Takes the voxels of the other set away.
    LeafMask& operator-=(const LeafMask& other)
    {
        for (int w = 0; w < 8; ++w) (*this)[w] &= ~other[w];
        return *this;
    }
    friend LeafMask operator|(LeafMask a, const LeafMask& b) { return a |= b; }
    friend LeafMask operator&(LeafMask a, const LeafMask& b) { return a &= b; }
    friend LeafMask operator-(LeafMask a, const LeafMask& b) { return a -= b; }
};

} // namespace openvdb_spheretree
