// SPDX-License-Identifier: Apache-2.0
#include "LeafCoarsener.h"

#include <openvdb_spheretree/voxel/LeafPlanes.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

LeafCoarsener::LeafCoarsener(const PyramidStep& step)
{
    for (int axis = 0; axis < 3; ++axis) {
        AxisMap& map = mAxes[axis];
        map.factor = axis < step.dim ? step.factor : 1;
        map.origin = step.origin[axis];
        for (int taken = 1; taken <= 8; ++taken) {
            for (int i = taken; i < 8; ++i) {
                map.steps[taken][i] = uint8_t(1 + (i - taken) / map.factor);
            }
        }
    }
    for (int taken = 1; taken <= 8; ++taken) {
        for (uint32_t bits = 1; bits < 256; ++bits) {
            const uint32_t last = bits & (bits - 1); // without the lowest bit
            const int lowest = __builtin_ctz(bits);
            mRows[taken][bits] = uint8_t(mRows[taken][last] | 1u << mAxes[2].steps[taken][lowest]);
        }
    }
}

openvdb::CoordBBox LeafCoarsener::parentLeaves(const openvdb::Coord& origin) const
{
    openvdb::CoordBBox leaves;
    for (int axis = 0; axis < 3; ++axis) {
        const AxisMap& map = mAxes[axis];
        const int at = origin[axis] - map.origin;
        leaves.min()[axis] = floorDiv(at, map.factor) & ~7;
        leaves.max()[axis] = floorDiv(at + 7, map.factor) & ~7;
    }
    return leaves;
}

LeafCoarsener::Fall LeafCoarsener::fall(int axis, int origin, int parentOrigin) const
{
    const AxisMap& map = mAxes[axis];
    const int first = floorDiv(origin - map.origin, map.factor);
    const int64_t past = (int64_t(first) + 1) * map.factor + map.origin - origin;
    return {first - parentOrigin, int(std::min<int64_t>(8, past))};
}

uint64_t LeafCoarsener::foldRows(uint64_t word, const Fall& y, const Fall& z) const
{
    uint64_t result = 0;
    for (int row = 0; row < 8; ++row) {
        const int to = y.base + mAxes[1].steps[y.taken][row];
        if (to < 0 || to > 7) continue;
        result |= uint64_t(mRows[z.taken][word >> 8 * row & 0xff]) << 8 * to;
    }
    return movedPlane(result, 0, z.base); // -7 to 7: some parent of the row is here
}

void LeafCoarsener::add(const LeafMask& leaf, const openvdb::Coord& origin,
    const openvdb::Coord& parentOrigin, LeafMask& parent) const
{
    const Fall x = fall(0, origin[0], parentOrigin[0]);
    const Fall y = fall(1, origin[1], parentOrigin[1]);
    const Fall z = fall(2, origin[2], parentOrigin[2]);
    LeafMask folded{};
    for (int i = 0; i < 8; ++i) {
        const int to = x.base + mAxes[0].steps[x.taken][i];
        if (to >= 0 && to <= 7) folded[to] |= leaf[i];
    }
    for (int i = 0; i < 8; ++i) {
        if (folded[i] != 0) parent[i] |= foldRows(folded[i], y, z);
    }
}

} // namespace openvdb_spheretree::detail
