// SPDX-License-Identifier: Apache-2.0
#include "LeafPower.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/tight/region/LeafPower.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::tight {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The power at a voxel is a sum of three terms, one for each axis.
struct PowerTerms {
    PowerTerms(const ExactSphere& ball, const openvdb::Coord& origin)
    {
        for (int a = 0; a < 3; ++a) {
            for (int i = 0; i < kLeafDim; ++i) {
                const int64_t d = kFine * (int64_t(origin[a]) + i) - ball.center[a];
                axis[a][i] = (a == 0 ? ball.radiusSq : 0) - d * d;
            }
        }
    }

    HWY_ALIGN int64_t axis[3][kLeafDim];
};

/// Claims the voxels of a column along z where the power is above the most so far.
/// @param rest    the terms of the column's x and y
/// @param within  a bit a voxel
HWY_INLINE void claimColumn(const int64_t* terms, int64_t rest, uint32_t within, int64_t claim,
    int64_t* HWY_RESTRICT most, int64_t* HWY_RESTRICT winners)
{
    const hn::CappedTag<int64_t, kLeafDim> d;
    for (uint32_t z = 0; z < kLeafDim; z += uint32_t(hn::Lanes(d))) {
        const uint8_t bits[8] = {uint8_t(within >> z)}; // as many as LoadMaskBits may read
        const auto power = hn::Add(hn::Load(d, terms + z), hn::Set(d, rest));
        const auto before = hn::Load(d, most + z);
        const auto wins = hn::And(hn::Gt(power, before), hn::LoadMaskBits(d, bits));
        hn::Store(hn::IfThenElse(wins, power, before), d, most + z);
        hn::Store(
            hn::IfThenElse(wins, hn::Set(d, claim), hn::Load(d, winners + z)), d, winners + z);
    }
}

void strongestClaims(const openvdb::Coord& origin, const std::vector<LeafClaim>& claims,
    std::array<int64_t, kLeafVoxels>& winners)
{
    HWY_ALIGN int64_t most[kLeafVoxels], places[kLeafVoxels];
    std::fill_n(most, kLeafVoxels, -1);
    std::fill_n(places, kLeafVoxels, -1);
    for (std::size_t k = 0; k < claims.size(); ++k) {
        const PowerTerms terms(*claims[k].ball, origin);
        for (int x = 0; x < kLeafDim; ++x) {
            uint64_t columns = (*claims[k].within)[std::size_t(x)];
            for (int y = 0; columns != 0; ++y, columns >>= 8) {
                const int64_t rest = terms.axis[0][x] + terms.axis[1][y];
                const auto within = uint32_t(columns & 0xff);
                if (within == 0 || rest < 0) continue; // the term of z is never positive
                const int first = 64 * x + 8 * y;
                claimColumn(terms.axis[2], rest, within, int64_t(k), most + first, places + first);
            }
        }
    }
    std::copy_n(places, kLeafVoxels, winners.data());
}

} // namespace HWY_NAMESPACE
} // namespace openvdb_spheretree::tight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree::tight {

HWY_EXPORT(strongestClaims);

std::array<int64_t, kLeafVoxels> strongestClaims(
    const openvdb::Coord& origin, const std::vector<LeafClaim>& claims)
{
    std::array<int64_t, kLeafVoxels> winners;
    HWY_DYNAMIC_DISPATCH(strongestClaims)(origin, claims, winners);
    return winners;
}

} // namespace openvdb_spheretree::tight

#endif // HWY_ONCE
