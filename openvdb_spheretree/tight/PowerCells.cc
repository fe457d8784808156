// SPDX-License-Identifier: Apache-2.0
#include "PowerCells.h"

#include "../detail/Parallel.h"
#include "ExtremePoints.h"
#include "LeafBalls.h"

#include <algorithm>
#include <array>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// A part of a cell.
struct CellLeaf {
    int32_t ball;
    LeafMask mask;
};

/// The power of a ball at every voxel of a leaf is a sum of three terms, one for each axis.
struct PowerTerms {
    std::array<int64_t, 8> axis[3];

    PowerTerms(const FineBall& ball, const openvdb::Coord& origin)
    {
        for (int a = 0; a < 3; ++a) {
            for (int i = 0; i < 8; ++i) {
                const int64_t d = kFine * (int64_t(origin[a]) + i) - ball.center[a];
                axis[a][i] = (a == 0 ? ball.radiusSq : 0) - d * d;
            }
        }
    }
};

/// @return the parts of cells in a leaf, by ball.
std::vector<CellLeaf> partsOf(std::size_t leaf, const std::vector<FineBall>& balls,
    const SampleLevel& object, const LeafBalls& lists)
{
    std::array<int64_t, kLeafVoxels> best;
    std::array<int32_t, kLeafVoxels> label;
    best.fill(-1); // a ball without a power of 0 or more does not hold the voxel
    label.fill(-1);
    for (const int32_t ball : lists.of(leaf)) {
        const PowerTerms terms(balls[ball], object.origin(leaf));
        for (int i = 0; i < kLeafVoxels; ++i) {
            const int64_t power =
                terms.axis[0][i >> 6] + terms.axis[1][i >> 3 & 7] + terms.axis[2][i & 7];
            const bool wins = power > best[i]
                || (power == best[i] && power >= 0
                    && balls[ball].radiusSq > balls[label[i]].radiusSq);
            best[i] = wins ? power : best[i];
            label[i] = wins ? ball : label[i];
        }
    }
    std::vector<CellLeaf> parts;
    for (const int32_t ball : lists.of(leaf)) {
        CellLeaf part{ball, {}};
        uint64_t any = 0;
        for (int i = 0; i < kLeafVoxels; ++i) {
            part.mask[i >> 6] |= uint64_t(label[i] == ball) << (i & 63);
        }
        for (int word = 0; word < 8; ++word) {
            part.mask[word] &= object.mask(leaf)[word];
            any |= part.mask[word];
        }
        if (any) parts.push_back(part);
    }
    return parts;
}

} // namespace

std::vector<std::vector<openvdb::Coord>> cellPoints(const std::vector<FineBall>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    const LeafBalls lists(balls, object, interrupter);
    std::vector<std::vector<CellLeaf>> parts(object.leafCount());
    detail::parallelFor(parts.size(), interrupter,
        [&](std::size_t leaf) { parts[leaf] = partsOf(leaf, balls, object, lists); });

    std::vector<std::vector<std::pair<uint32_t, const LeafMask*>>> cells(balls.size());
    for (std::size_t leaf = 0; leaf < parts.size(); ++leaf) {
        for (const CellLeaf& part : parts[leaf]) {
            cells[part.ball].emplace_back(uint32_t(leaf), &part.mask);
        }
    }
    std::vector<std::vector<openvdb::Coord>> points(balls.size());
    detail::parallelForWithScratch<ExtremePoints>(
        balls.size(), interrupter, [&](std::size_t ball, ExtremePoints& extreme) {
            extreme.clear();
            for (const auto& [leaf, mask] : cells[ball]) extreme.add(object.origin(leaf), *mask);
            points[ball] = extreme.finish();
        });
    return points;
}

} // namespace tight
} // namespace openvdb_spheretree
