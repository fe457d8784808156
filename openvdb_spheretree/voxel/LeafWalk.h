// SPDX-License-Identifier: Apache-2.0
/// @file LeafWalk.h
/// @brief The 26 leaves around one leaf after the other, and for a neighbour that is not there, the
/// next leaf behind its place. Leaves of a layout are ordered: from one leaf to the next, its
/// neighbours move on as well. Nothing is stored.

#pragma once

#include "LeafLayout.h"

#include <array>
#include <cstdint>
#include <tuple>

namespace openvdb_spheretree::detail {

/// The origin of a place for a leaf, in 64 bits: coordinates next to the ends of 32 bits do not
/// wrap around.
struct LeafPlace {
    int64_t x, y, z;

    LeafPlace(int64_t atX, int64_t atY, int64_t atZ) : x(atX), y(atY), z(atZ) {}
    explicit LeafPlace(const openvdb::Coord& origin) : LeafPlace(origin[0], origin[1], origin[2]) {}
    /// @param dx, dy, dz  in leaves
    LeafPlace offsetBy(int dx, int dy, int dz) const
    {
        return {x + dx * kLeafDim, y + dy * kLeafDim, z + dz * kLeafDim};
    }
    bool operator<(const LeafPlace& o) const { return std::tie(x, y, z) < std::tie(o.x, o.y, o.z); }
    bool sameColumn(const LeafPlace& o) const { return x == o.x && y == o.y; }
};

/// Moves along the leaves of a layout. Offsets are in leaves, -1 to 1 an axis.
class LeafWalk {
public:
    static constexpr uint32_t kNone = ~uint32_t(0);
    static int index(int dx, int dy, int dz) { return 9 * (dx + 1) + 3 * (dy + 1) + dz + 1; }

    /// Starts before leaf @a first; O(log leaves).
    LeafWalk(const LeafLayout& layout, uint32_t first) : mLayout(layout)
    {
        const LeafPlace place(layout.origin(first));
        for (int i = 0; i < 27; ++i) {
            mFrom[i] = lowerBound(place.offsetBy(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
        }
    }

    /// To a leaf no earlier than the one before; amortised O(1) where leaves come in order.
    void moveTo(uint32_t leaf)
    {
        const LeafPlace place(mLayout.origin(leaf));
        for (int i = 0; i < 27; ++i) {
            const LeafPlace beside = place.offsetBy(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
            uint32_t& from = mFrom[i];
            if (i % 3 > 0 && from < mFrom[i - 1]) from = mFrom[i - 1];
            while (from < mLayout.leafCount() && placeOf(from) < beside) ++from;
            const bool found = from < mLayout.leafCount() && !(beside < placeOf(from));
            mLeaf[i] = found ? from : kNone;
        }
    }

    /// @return the leaf there, or kNone.
    uint32_t at(int dx, int dy, int dz) const { return mLeaf[index(dx, dy, dz)]; }
    /// @return the same of all, by index().
    const std::array<uint32_t, 27>& all() const { return mLeaf; }
    /// @return the first leaf, in order, that stands there or later; leafCount() if none does.
    uint32_t firstFrom(int dx, int dy, int dz) const { return mFrom[index(dx, dy, dz)]; }

private:
    LeafPlace placeOf(uint32_t leaf) const { return LeafPlace(mLayout.origin(leaf)); }

    uint32_t lowerBound(const LeafPlace& place) const
    {
        uint32_t low = 0, high = mLayout.leafCount();
        while (low < high) {
            const uint32_t middle = low + (high - low) / 2;
            if (placeOf(middle) < place) low = middle + 1;
            else high = middle;
        }
        return low;
    }

    const LeafLayout& mLayout;
    std::array<uint32_t, 27> mFrom{}, mLeaf{};
};

} // namespace openvdb_spheretree::detail
