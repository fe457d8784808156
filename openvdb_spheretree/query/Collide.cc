// SPDX-License-Identifier: Apache-2.0
#include "Collide.h"

#include "PairAnswers.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree {
namespace {

using detail::BodyPair;
using detail::LeafPair;
using detail::SearchEnd;
using detail::SearchLimits;

SearchLimits limitsOf(const CollisionRequest& request)
{
    detail::requireLength(request.securityMargin, "the security margin");
    return {request.securityMargin, detail::blocksOrAny(request.maxBlocks)};
}

/// @return whether the spheres around both bodies meet: only then are blocks asked.
bool rootsMeet(BodyPair& bodies, double margin)
{
    if (bodies.frame.rootGap() > margin + bodies.frame.rounding) return false;
    bodies.frame.enterFloats();
    return true;
}

void setApart(CollisionResult& result, const BodyPair& bodies, double lowerBound)
{
    result.verdict = Verdict::Apart;
    const bool isCertain = bodies.a.holdsObject() && bodies.b.holdsObject();
    result.objects = isCertain ? Verdict::Apart : Verdict::Undecided;
    result.distanceLowerBound = std::max(0.0, lowerBound - bodies.frame.rounding);
}

/// Objects meet for certain where leaves do that are shrunk: any pair that is deep enough shows it.
void decideObjects(CollisionResult& result, const BodyPair& bodies, int64_t maxBlocks)
{
    if (result.objects == Verdict::Touching || result.blocks >= maxBlocks) return;
    SearchLimits limits;
    limits.margin = -(bodies.a.leafInset() + bodies.b.leafInset()) - 2 * bodies.frame.rounding;
    limits.maxBlocks = maxBlocks - result.blocks;
    if (limits.margin == -std::numeric_limits<double>::infinity()) return;
    const SearchEnd end = findOverlap(bodies.frame, limits, false);
    result.blocks += end.blocks;
    if (end.pair.a >= 0) result.objects = Verdict::Touching;
}

void setTouching(
    CollisionResult& result, const BodyPair& bodies, const LeafPair& pair, bool enableContact)
{
    result.verdict = Verdict::Touching;
    result.nodes = {bodies.a.nodeId(pair.a), bodies.b.nodeId(pair.b)};
    if (enableContact) result.contact = bodies.contact(pair);
    // A pair within a margin says nothing of the objects.
    if (bodies.objectsMeet(pair)) result.objects = Verdict::Touching;
}

/// Any pair that touches.
CollisionResult anyContact(BodyPair& bodies, const CollisionRequest& request)
{
    CollisionResult result;
    const SearchLimits limits = limitsOf(request);
    SearchEnd end;
    end.pair = bodies.leaves(request.warmStart);
    if (!rootsMeet(bodies, limits.margin)) {
        setApart(result, bodies, bodies.frame.rootGap());
        return result;
    }
    if (end.pair.a < 0 || end.pair.gap > limits.margin) {
        end = findOverlap(bodies.frame, limits, request.enableDistanceLowerBound);
    }
    result.blocks = end.blocks;
    result.isDecided = end.isDecided;
    if (end.pair.a >= 0) setTouching(result, bodies, end.pair, request.enableContact);
    else if (end.isDecided)
        setApart(result, bodies, request.enableDistanceLowerBound ? end.lowerBound : 0);
    if (result.isCollision() && request.decideObjects)
        decideObjects(result, bodies, limits.maxBlocks);
    return result;
}

/// Pairs of leaves, the nearest first. A few have their place here; more take memory.
struct NearestPairs {
    static constexpr int kFew = 64;
    LeafPair few[kFew];
    std::vector<LeafPair> many;
    int count = 0;

    const LeafPair* begin() const { return many.empty() ? few : many.data(); }
    const LeafPair* end() const { return begin() + count; }
};

/// There is room for a few at first, and sixteen times as many in each search that finds more: how many there are is not
/// known before.
/// @param pairs  receives limits.wanted of them at most
SearchEnd findNearestOf(const BodyPair& bodies, detail::NearestLimits limits, NearestPairs& pairs)
{
    constexpr int64_t kFirst = NearestPairs::kFew, kMore = 16;
    const int64_t wanted = limits.wanted;
    int64_t blocks = 0;
    for (int64_t room = std::min(wanted, kFirst);; room = std::min(wanted, kMore * room)) {
        if (room > kFirst) pairs.many.resize(std::size_t(room));
        limits.wanted = int(room);
        int count = 0;
        LeafPair* const place = room > kFirst ? pairs.many.data() : pairs.few;
        SearchEnd end = findNearest(bodies.frame, limits, place, count);
        blocks += end.blocks;
        if (count < room || room == wanted) {
            pairs.count = count;
            end.blocks = blocks;
            return end;
        }
    }
}

/// The search for the deepest pairs knows no more of bodies that are apart than the margin.
void boundDistance(CollisionResult& result, const BodyPair& bodies, const SearchLimits& limits)
{
    const SearchEnd end = findOverlap(bodies.frame, limits, true);
    result.blocks += end.blocks;
    if (end.isDecided && end.lowerBound > limits.margin) setApart(result, bodies, end.lowerBound);
}

/// The deepest pairs: the nearest ones with gaps up to the margin.
CollisionResult deepestContacts(
    BodyPair& bodies, const CollisionRequest& request, std::vector<Contact>& contacts)
{
    CollisionResult result;
    const SearchLimits search = limitsOf(request);
    if (!rootsMeet(bodies, search.margin)) {
        setApart(result, bodies, bodies.frame.rootGap());
        return result;
    }
    detail::NearestLimits limits;
    limits.wanted = request.maxContacts;
    limits.below = std::nextafter(search.margin + bodies.frame.rounding, INFINITY);
    limits.maxBlocks = search.maxBlocks;
    NearestPairs pairs;
    const SearchEnd end = findNearestOf(bodies, limits, pairs);
    result.blocks = end.blocks;
    result.isDecided = end.isDecided;
    contacts.reserve(std::size_t(pairs.count));
    for (const LeafPair& pair : pairs) contacts.push_back(bodies.contact(pair));
    if (pairs.count > 0) setTouching(result, bodies, *pairs.begin(), request.enableContact);
    else if (end.isDecided) {
        setApart(result, bodies, search.margin);
        if (request.enableDistanceLowerBound) boundDistance(result, bodies, search);
    }
    if (result.isCollision() && request.decideObjects)
        decideObjects(result, bodies, limits.maxBlocks);
    return result;
}

} // namespace

CollisionResult collide(const QueryTree& a, const RigidTransform& poseA, const QueryTree& b,
    const RigidTransform& poseB, const CollisionRequest& request, std::vector<Contact>* contacts)
{
    if (request.maxContacts < 1) {
        OPENVDB_THROW(openvdb::ValueError,
            "collide() was asked for " << request.maxContacts << " contacts: ask for 1 or more");
    }
    BodyPair bodies(a, poseA, b, poseB);
    if (contacts) contacts->clear();
    if (contacts && request.maxContacts > 1) return deepestContacts(bodies, request, *contacts);
    if (!contacts) return anyContact(bodies, request);
    CollisionRequest wanted = request;
    wanted.enableContact = true;
    const CollisionResult result = anyContact(bodies, wanted);
    if (result.contact) contacts->push_back(*result.contact);
    return result;
}

CollisionResult collideAll(const QueryTree& a, const RigidTransform& poseA, const QueryTree& b,
    const RigidTransform& poseB, double securityMargin, const ContactCallback& callback)
{
    CollisionRequest request;
    request.securityMargin = securityMargin;
    const SearchLimits limits = limitsOf(request);
    BodyPair bodies(a, poseA, b, poseB);
    CollisionResult result;
    if (!rootsMeet(bodies, limits.margin)) {
        setApart(result, bodies, 0);
        return result;
    }
    const ContactCallback* context = &callback;
    const detail::PairSink sink{&context,
        [](void* given, const NodePair* pairs, int count) {
            return (**static_cast<const ContactCallback**>(given))(pairs, count);
        },
        a.nodeId(0), b.nodeId(0)};
    const SearchEnd end = findAllOverlaps(bodies.frame, limits, sink);
    result.blocks = end.blocks;
    if (end.pair.a < 0) {
        setApart(result, bodies, 0);
        return result;
    }
    result.verdict = Verdict::Touching;
    result.nodes = {a.nodeId(end.pair.a), b.nodeId(end.pair.b)};
    return result;
}

void collideBatch(const QueryTree& a, const QueryTree& b, const std::vector<RigidTransform>& poses,
    Verdict* verdicts, const CollisionRequest& request, openvdb::util::NullInterrupter* interrupter)
{
    CollisionRequest each = request;
    each.enableDistanceLowerBound = each.enableContact = false;
    each.warmStart = {};
    limitsOf(each); // errors before any thread starts
    const RigidTransform here;
    detail::parallelFor(poses.size(), interrupter, [&](std::size_t i) {
        BodyPair bodies(a, here, b, poses[i]);
        const CollisionResult result = anyContact(bodies, each);
        verdicts[i] = each.decideObjects ? result.objects : result.verdict;
    });
}

} // namespace openvdb_spheretree
