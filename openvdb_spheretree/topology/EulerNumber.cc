// SPDX-License-Identifier: Apache-2.0
/// @file EulerNumber.cc
/// @brief Voxels are added one by one in the order x, y, z. A voxel adds those of its faces of any
/// dimension (the cube, 6 faces, 12 edges, 8 vertices) that no voxel before it has.
///
/// Such a face lies in direction d of the cube's center, with components -1, 0, 1. It belongs to
/// the voxels v + e where each component of e is 0 or that of d. For dx = 1 and dx = 0, with equal
/// dy and dz, the voxels *before* v are the same, and the two faces count with opposite signs: they
/// cancel out. The 9 directions with dx = -1 remain: 9 bit counts for a word of 64 voxels.

#include "EulerNumber.h"

#include <openvdb_spheretree/voxel/LeafPlanes.h>

#include <openvdb/util/NodeMasks.h>

#include <array>

namespace openvdb_spheretree::detail {

namespace {

/// Something for each step of -1, 0, 1 along y and z: [dy + 1][dz + 1].
template <typename T>
using Beside = std::array<std::array<T, 3>, 3>;

const LeafMask kEmpty{};

/// The masks of the leaves beside one, and its own, all moved by @a dx leaves along x.
Beside<const LeafMask*> masksBeside(const LeafLayout& layout, const LeafWalk& around, int dx)
{
    Beside<const LeafMask*> masks;
    for (int y = 0; y < 3; ++y) {
        for (int z = 0; z < 3; ++z) {
            const uint32_t leaf = around.at(dx, y - 1, z - 1);
            masks[y][z] = leaf == LeafWalk::kNone ? &kEmpty : &layout.mask(leaf);
        }
    }
    return masks;
}

/// @return words whose bit for voxel v tells whether v + (0, dy, dz) is on, in plane @a x.
Beside<uint64_t> neighbourWords(const Beside<const LeafMask*>& masks, int x)
{
    Beside<uint64_t> alongZ; // in the three leaves along y
    for (int y = 0; y < 3; ++y) {
        const uint64_t before = (*masks[y][0])[x], here = (*masks[y][1])[x],
                       behind = (*masks[y][2])[x];
        alongZ[y][0] = movedPlane(here, 0, 1) | movedPlane(before, 0, -7);
        alongZ[y][1] = here;
        alongZ[y][2] = movedPlane(here, 0, -1) | movedPlane(behind, 0, 7);
    }
    Beside<uint64_t> words;
    for (int z = 0; z < 3; ++z) {
        words[0][z] = alongZ[1][z] << 8 | alongZ[0][z] >> 56;
        words[1][z] = alongZ[1][z];
        words[2][z] = alongZ[1][z] >> 8 | alongZ[2][z] << 56;
    }
    return words;
}

/// @param below  of the plane at x - 1
int64_t eulerOfWord(const Beside<uint64_t>& below, const Beside<uint64_t>& here)
{
    int64_t sum = 0;
    for (int y = 0; y < 3; ++y) {
        for (int z = 0; z < 3; ++z) {
            // The voxels before v of the face in direction (-1, y - 1, z - 1).
            uint64_t before = below[1][1] | below[y][1] | below[1][z] | below[y][z];
            if (y == 0) before |= here[0][1] | here[0][z];
            if (z == 0) before |= here[1][0];
            const int added = int(openvdb::util::CountOn(here[1][1] & ~before));
            sum += (y == 1) == (z == 1) ? added : -added;
        }
    }
    return sum;
}

} // namespace

int64_t eulerOfLeaf(const LeafLayout& layout, const LeafWalk& around)
{
    const auto own = masksBeside(layout, around, 0);
    Beside<uint64_t> below = neighbourWords(masksBeside(layout, around, -1), 7);
    int64_t sum = 0;
    for (int x = 0; x < 8; ++x) {
        const Beside<uint64_t> here = neighbourWords(own, x);
        if (here[1][1]) sum += eulerOfWord(below, here);
        below = here;
    }
    return sum;
}

} // namespace openvdb_spheretree::detail
