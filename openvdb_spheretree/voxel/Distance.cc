// SPDX-License-Identifier: Apache-2.0
#include "Distance.h"

#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <charconv>

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

std::string chamferText(int face, int edge, int corner)
{
    return "chamfer:" + std::to_string(face) + ',' + std::to_string(edge) + ','
        + std::to_string(corner);
}

[[noreturn]] void throwUnknown(const std::string& text)
{
    OPENVDB_THROW(openvdb::ValueError,
        "dist=" << detail::inQuotes(text)
                << " is unknown: choose l2, l1, linf, or chamfer:a,b,c with the costs of a step "
                   "across a face, an edge and a corner, such as chamfer:3,4,5");
}

} // namespace

Distance Distance::chamfer(int face, int edge, int corner)
{
    const std::string text = chamferText(face, edge, corner);
    for (const int weight : {face, edge, corner}) {
        if (weight >= 1 && weight <= kMaxWeight) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "dist=" << text << ": weights are 1 to " << kMaxWeight << ", not " << weight);
    }
    if (face < edge - face || edge - face < corner - edge || corner < edge || edge < face) {
        OPENVDB_THROW(openvdb::ValueError,
            "dist=" << text
                    << " is not a norm: with the weights a,b,c it must hold that a <= b <= c, "
                       "b <= 2 a and a + c <= 2 b, as for chamfer:3,4,5");
    }
    return {face, edge, corner};
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
    const int64_t radius = largestCost(detail::floorSqrt(radiusSq) - 1, mFace, mEdge, mCorner);
    return radius * radius;
}

std::string toString(const Distance& distance)
{
    if (distance.isEuclidean()) return "l2";
    if (distance == Distance::l1()) return "l1";
    if (distance == Distance::linf()) return "linf";
    return chamferText(distance.face(), distance.edge(), distance.corner());
}

Distance distanceFromString(const std::string& text)
{
    if (text == "l2") return {};
    if (text == "l1") return Distance::l1();
    if (text == "linf") return Distance::linf();
    const std::string prefix = "chamfer:";
    if (text.compare(0, prefix.size(), prefix) != 0) throwUnknown(text);
    int weights[3];
    const char* at = text.data() + prefix.size();
    const char* const end = text.data() + text.size();
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && (at == end || *at++ != ',')) throwUnknown(text);
        const auto parsed = std::from_chars(at, end, weights[i]);
        if (parsed.ec != std::errc()) throwUnknown(text);
        at = parsed.ptr;
    }
    if (at != end) throwUnknown(text);
    return Distance::chamfer(weights[0], weights[1], weights[2]);
}

} // namespace openvdb_spheretree
