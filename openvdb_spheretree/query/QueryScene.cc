// SPDX-License-Identifier: Apache-2.0
#include "QueryScene.h"

#include "PairAnswers.h"
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

/// What doubles may be off by in a pose and in the comparisons below, a part of the lengths in them: a dozen
/// roundings of 2^-53, and room to spare.
constexpr double kRounding = 1.0 / (1ll << 48);

Pair sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

} // namespace

QueryScene::Body QueryScene::placed(const QueryTree& tree, const RigidTransform& pose)
{
    Body body{tree, pose, pose * tree.center(), tree.radius()};
    const double size = tree.center().length() + pose.translation().length() + tree.radius();
    body.radius += kRounding * size;
    return body;
}

int QueryScene::add(const QueryTree& tree, const RigidTransform& pose)
{
    mBodies.push_back(placed(tree, pose));
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
    mBodies[std::size_t(number)] = placed(body(number).tree, pose);
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

/// The axis along which centers spread most: by their variance.
int QueryScene::widestAxis() const
{
    const auto count = std::count_if(
        mBodies.begin(), mBodies.end(), [](const auto& body) { return body.has_value(); });
    Vec3d mean(0.0), variance(0.0);
    for (const auto& body : mBodies) {
        if (body) mean += body->center / double(count);
    }
    for (const auto& body : mBodies) {
        if (!body) continue;
        const Vec3d off = body->center - mean;
        variance += off * off;
    }
    return int(
        std::max_element(variance.asPointer(), variance.asPointer() + 3) - variance.asPointer());
}

std::vector<Pair> QueryScene::nearPairs(double margin) const
{
    detail::requireLength(margin, "the margin");
    const int axis = widestAxis();
    const auto low = [&](int i) { return body(i).center[axis] - body(i).radius; };
    std::vector<int> order;
    for (int i = 0; i < size(); ++i) {
        if (has(i)) order.push_back(i);
    }
    std::sort(order.begin(), order.end(),
        [&](int a, int b) { return std::make_pair(low(a), a) < std::make_pair(low(b), b); });
    std::vector<Pair> pairs;
    for (auto first = order.begin(); first != order.end(); ++first) {
        const Body& a = body(*first);
        const double end = a.center[axis] + a.radius + margin;
        const double rounding = kRounding * (std::abs(end) + a.radius + margin);
        for (auto second = first + 1; second != order.end(); ++second) {
            if (low(*second) > end + rounding) break;
            const Body& b = body(*second);
            const double reach = a.radius + b.radius + margin;
            if ((a.center - b.center).length() > reach * (1 + kRounding)) continue;
            const Pair pair = sorted(*first, *second);
            if (!mIgnored.count(pair)) pairs.push_back(pair);
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
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
        try {
            pairs[i] = {a, b, collide(tree(a), pose(a), tree(b), pose(b), ofPair)};
        } catch (const openvdb::ValueError& error) {
            OPENVDB_THROW(openvdb::ValueError,
                "bodies " << a << " and " << b << ": " << detail::messageOf(error));
        }
    });
    const auto isApart = [](const ScenePair& p) { return p.result.verdict == Verdict::Apart; };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), isApart), pairs.end());
    return pairs;
}

} // namespace openvdb_spheretree
