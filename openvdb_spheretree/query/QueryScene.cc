// SPDX-License-Identifier: Apache-2.0
#include "QueryScene.h"

#include "MotionFrame.h"
#include "MotionRequest.h"
#include "PairAnswers.h"
#include "SweepPairs.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>

namespace openvdb_spheretree {
namespace {

using Pair = std::pair<int, int>;
using openvdb::Vec3d;

Pair sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Where a body stands.
detail::BodySphere sphereAround(int number, const QueryTree& tree, const RigidTransform& pose)
{
    const double lengths = tree.center().length() + pose.translation().length() + tree.radius();
    return {number, pose * tree.center(), tree.radius() + detail::kPlaceRounding * lengths};
}

/// Around all the way of a body until @a end. From the middle of its way, which is a helix, its center is never farther than
/// half the length of that.
detail::BodySphere sphereAround(
    int number, const QueryTree& tree, const RigidMotion& motion, double end)
{
    detail::BodySphere sphere = sphereAround(number, tree, motion.at(0.5 * end));
    const Vec3d start = motion.start() * tree.center();
    const double turned = motion.radians() * motion.axis().cross(start - motion.point()).length();
    const double way = end * std::hypot(turned, motion.slide());
    detail::requireWay(way);
    sphere.radius += 0.5 * way + detail::kPlaceRounding * (start.length() + way);
    return sphere;
}

/// Runs @a ask of two bodies; an error names them.
template <typename Ask>
auto naming(int a, int b, const Ask& ask)
{
    try {
        return ask();
    } catch (const openvdb::ValueError& error) {
        OPENVDB_THROW(openvdb::ValueError,
            "bodies " << a << " and " << b << ": " << detail::messageOf(error));
    }
}

} // namespace

int QueryScene::add(const QueryTree& tree, const RigidTransform& pose)
{
    mBodies.push_back(Body{tree, pose});
    return size() - 1;
}

bool QueryScene::has(int body) const
{
    return body >= 0 && body < size() && mBodies[std::size_t(body)];
}

void QueryScene::remove(int number)
{
    body(number);
    mBodies[std::size_t(number)].reset();
    for (auto pair = mIgnored.begin(); pair != mIgnored.end();) {
        const bool isOf = pair->first == number || pair->second == number;
        pair = isOf ? mIgnored.erase(pair) : std::next(pair);
    }
}

const QueryScene::Body& QueryScene::body(int number) const
{
    if (has(number)) return *mBodies[std::size_t(number)];
    if (number >= 0 && number < size()) {
        OPENVDB_THROW(openvdb::IndexError, "body " << number << " of the scene was removed");
    }
    OPENVDB_THROW(openvdb::IndexError,
        "the scene has no body " << number << ": it has " << size() << ", counted from 0");
}

void QueryScene::setPose(int number, const RigidTransform& pose)
{
    body(number);
    mBodies[std::size_t(number)]->pose = pose;
}

const RigidTransform& QueryScene::pose(int number) const { return body(number).pose; }
const QueryTree& QueryScene::tree(int number) const { return body(number).tree; }

void QueryScene::ignore(int a, int b, bool isIgnored)
{
    body(a), body(b);
    if (isIgnored) mIgnored.insert(sorted(a, b));
    else mIgnored.erase(sorted(a, b));
}

bool QueryScene::isIgnored(int a, int b) const
{
    body(a), body(b);
    return mIgnored.count(sorted(a, b)) > 0;
}

QueryScene::Pairs QueryScene::withoutIgnored(Pairs pairs) const
{
    const auto isOut = [&](const Pair& pair) { return mIgnored.count(pair) > 0; };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), isOut), pairs.end());
    return pairs;
}

std::vector<Pair> QueryScene::nearPairs(double margin) const
{
    detail::requireLength(margin, "the margin");
    std::vector<detail::BodySphere> spheres;
    for (int i = 0; i < size(); ++i) {
        if (has(i)) spheres.push_back(sphereAround(i, tree(i), pose(i)));
    }
    return withoutIgnored(detail::sweepPairs(std::move(spheres), margin));
}

std::vector<ScenePair> QueryScene::touchingPairs(
    const CollisionRequest& request, openvdb::util::NullInterrupter* interrupter) const
{
    CollisionRequest ofPair = request;
    ofPair.warmStart = {};
    const std::vector<Pair> near = nearPairs(request.securityMargin);
    std::vector<ScenePair> pairs(near.size());
    detail::parallelFor(near.size(), interrupter, [&](std::size_t i) {
        const auto [a, b] = near[i];
        ScenePair& pair = pairs[i];
        pair.a = a, pair.b = b;
        auto* const contacts = request.maxContacts > 1 ? &pair.contacts : nullptr;
        pair.result = naming(a, b, [&, a = a, b = b] {
            return collide(tree(a), pose(a), tree(b), pose(b), ofPair, contacts);
        });
    });
    const auto isApart = [](const ScenePair& p) { return p.result.verdict == Verdict::Apart; };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), isApart), pairs.end());
    return pairs;
}

std::vector<MovingPair> QueryScene::firstContacts(const std::vector<RigidMotion>& motions,
    const ContinuousCollisionRequest& request, openvdb::util::NullInterrupter* interrupter) const
{
    if (int64_t(motions.size()) != size()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the scene has " << size() << " bodies, and there are " << motions.size()
                             << " motions: give one a body, by number");
    }
    double largestRadius = 0;
    for (int i = 0; i < size(); ++i) {
        if (has(i)) largestRadius = std::max(largestRadius, tree(i).radius());
    }
    // Bodies that pass within the tolerance may be found to touch. No pair's own is larger than this.
    const detail::MotionLimits limits = detail::motionLimits(request, largestRadius);
    std::vector<detail::BodySphere> spheres;
    for (int i = 0; i < size(); ++i) {
        if (has(i))
            spheres.push_back(sphereAround(i, tree(i), motions[std::size_t(i)], limits.end));
    }
    const Pairs near =
        withoutIgnored(detail::sweepPairs(std::move(spheres), limits.margin + limits.tolerance));
    std::vector<MovingPair> pairs(near.size());
    detail::parallelFor(near.size(), interrupter, [&](std::size_t i) {
        const auto [a, b] = near[i];
        pairs[i] = {a, b, naming(a, b, [&, a = a, b = b] {
                        return continuousCollide(tree(a), motions[std::size_t(a)], tree(b),
                            motions[std::size_t(b)], request);
                    })};
    });
    const auto isFree = [](const MovingPair& p) {
        return !p.result.isCollide && p.result.isDecided;
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), isFree), pairs.end());
    return pairs;
}

} // namespace openvdb_spheretree
