// SPDX-License-Identifier: Apache-2.0
#include "Distance.h"

#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>

namespace openvdb_spheretree {

namespace {

/// @return the largest cost of any path from voxel to voxel that is at most @a limit. `face` steps
///         of
/// another kind cost a multiple of `face`, as steps across faces do: fewer of them suffice.
int64_t largestCost(int64_t limit, int64_t face, int64_t edge, int64_t corner)
{
    int64_t best = 0;
    for (int64_t k = 0; k < face && corner * k <= limit; ++k) {
        for (int64_t j = 0; j < face && corner * k + edge * j <= limit; ++j) {
            const int64_t left = limit - corner * k - edge * j;
            best = std::max(best, limit - left % face);
            if (best == limit) return best;
        }
    }
    return best;
}

std::string flatText(int face, int edge)
{
    return "chamfer:" + std::to_string(face) + ',' + std::to_string(edge);
}

std::string chamferText(int face, int edge, int corner)
{
    return flatText(face, edge) + ',' + std::to_string(corner);
}

void requireWeights(std::initializer_list<int> weights, const std::string& text)
{
    for (const int weight : weights) {
        if (weight >= 1 && weight <= Distance::kMaxWeight) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "dist=" << text << ": weights are 1 to " << Distance::kMaxWeight << ", not " << weight);
    }
}

[[noreturn]] void throwUnknown(const std::string& text)
{
    OPENVDB_THROW(openvdb::ValueError,
        "dist=" << detail::inQuotes(text)
                << " is unknown: choose l2, l1, linf, or chamfer:a,b,c with the costs of a step "
                   "across a face, an edge and a corner, such as chamfer:3,4,5 (with dim=2 "
                   "chamfer:a,b)");
}

} // namespace

Distance Distance::chamfer(int face, int edge, int corner)
{
    const std::string text = chamferText(face, edge, corner);
    requireWeights({face, edge, corner}, text);
    if (face < edge - face || edge - face < corner - edge || corner < edge || edge < face) {
        OPENVDB_THROW(openvdb::ValueError,
            "dist=" << text
                    << " is not a norm: with the weights a,b,c it must hold that a <= b <= c, "
                       "b <= 2 a and a + c <= 2 b, as for chamfer:3,4,5");
    }
    return {face, edge, corner};
}

Distance Distance::flatChamfer(int face, int edge)
{
    // The largest corner that makes a norm of any weights that are one in the plane. l1 and l-infinity
    // are themselves.
    const std::string text = flatText(face, edge);
    requireWeights({face, edge}, text);
    if (edge < face || edge > 2 * face) {
        OPENVDB_THROW(openvdb::ValueError,
            "dist=" << text
                    << " is not a norm: with the weights a,b it must hold that a <= b <= 2 a, as "
                       "for chamfer:3,4");
    }
    Distance flat(face, edge, 2 * edge - face);
    flat.mFlat = flat != l1() && flat != linf();
    return flat;
}

int64_t Distance::farReach(int64_t leftSq) { return detail::floorSqrt(leftSq); }

int64_t Distance::normReach(int64_t x, int64_t y, int64_t limitSq) const
{
    const int64_t limit = detail::floorSqrt(limitSq);
    const int64_t most = std::max(std::abs(x), std::abs(y)),
                  least = std::abs(x) + std::abs(y) - most;
    const int64_t a = mFace, b = mEdge - mFace, c = mCorner - mEdge;
    // The norm is the largest sum over all orders of the coordinates: none may exceed the limit. A
    // coordinate of no weight is bounded by the others.
    int64_t reach = (limit - b * most - c * least) / a;
    if (b > 0) reach = std::min(reach, (limit - a * most - c * least) / b);
    if (c > 0) reach = std::min(reach, (limit - a * most - b * least) / c);
    return reach;
}

int64_t Distance::closedSq(int64_t radiusSq) const
{
    if (isEuclidean()) return radiusSq - 1;
    const int corner = mFlat ? mFace : mCorner; // costs no more than a step across a face
    const int64_t radius = largestCost(detail::floorSqrt(radiusSq) - 1, mFace, mEdge, corner);
    return radius * radius;
}

std::string toString(const Distance& distance)
{
    if (distance.isEuclidean()) return "l2";
    if (distance == Distance::l1()) return "l1";
    if (distance == Distance::linf()) return "linf";
    return distance.isFlat() ? flatText(distance.face(), distance.edge())
                             : chamferText(distance.face(), distance.edge(), distance.corner());
}

Distance distanceFromString(const std::string& text)
{
    if (text == "l2") return {};
    if (text == "l1") return Distance::l1();
    if (text == "linf") return Distance::linf();
    const std::string prefix = "chamfer:";
    if (text.compare(0, prefix.size(), prefix) != 0) throwUnknown(text);
    int weights[3];
    const auto count = 1 + std::count(text.begin(), text.end(), ',');
    if (count != 2 && count != 3) throwUnknown(text);
    const char* at = text.data() + prefix.size();
    const char* const end = text.data() + text.size();
    for (int i = 0; i < count; ++i) {
        if (i > 0 && (at == end || *at++ != ',')) throwUnknown(text);
        const auto parsed = std::from_chars(at, end, weights[i]);
        if (parsed.ec != std::errc()) throwUnknown(text);
        at = parsed.ptr;
    }
    if (at != end) throwUnknown(text);
    if (count == 2) return Distance::flatChamfer(weights[0], weights[1]);
    return Distance::chamfer(weights[0], weights[1], weights[2]);
}

} // namespace openvdb_spheretree
