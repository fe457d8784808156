// SPDX-License-Identifier: Apache-2.0
/// @file PlaceActions.cc
/// @brief -raycast and -contains: rays and points against one tree.

#include "base/Errors.h"
#include "base/Terminal.h"
#include "line/Actions.h"
#include "QueryOptions.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/query/DigitalLeaves.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/RayQuery.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using openvdb::Vec3d;
using spheretree::PointDistance;
using spheretree::QueryRay;
using spheretree::QueryTree;
using spheretree::RayHit;

namespace {

Vec3d vecOf(const ActionCall& call, const std::string& option)
{
    const auto v = call.vector(option);
    return Vec3d(v[0], v[1], v[2]);
}

/// @throw CommandError (usage) unless all of @a typed are given, or the file of @a table
void requireQuestion(
    const ActionCall& call, const std::vector<std::string>& typed, const std::string& table)
{
    for (const std::string& option : typed) {
        if (call.given(option) || call.given(table)) continue;
        throwUsage("asks nothing: " + option + "= is missing, or " + table + "=file.csv");
    }
}

// -raycast

std::vector<QueryRay> raysOf(const ActionCall& call, Session& session)
{
    std::vector<QueryRay> rays;
    if (call.given("rays")) rays = rowsOf(call, "rays", session, spheretree::readRayTable);
    else rays = {QueryRay{vecOf(call, "origin"), vecOf(call, "direction")}};
    for (QueryRay& ray : rays) {
        ray.origin *= unitOf(call);
        ray.direction *= unitOf(call); // t stays what it is
        ray.leavesStart = call.flag("leaves_start");
    }
    return rays;
}

Cells cellsOf(const QueryTree& tree, const QueryRay& ray, const RayHit& hit, double unit)
{
    Cells cells = {bool(hit)};
    if (!hit) {
        addNothing(cells, 8);
    } else {
        const Vec3d point = ray.at(hit.t);
        Vec3d normal = point - tree.leafCenter(hit.leaf);
        const double length = normal.length();
        cells.push_back(hit.t);
        addCells(cells, point, unit);
        addCells(cells, length > 0 ? normal / length : Vec3d(0.0));
        cells.push_back(int64_t(tree.nodeId(hit.leaf)));
    }
    cells.push_back(int64_t(hit.blocks));
    return cells;
}

AnswerSheet sheetOf(const QueryBody& body, const std::string& format, std::size_t count)
{
    AnswerSheet sheet;
    sheet.format = format;
    sheet.facts = {{"tree", body.name}};
    sheet.count = count;
    return sheet;
}

/// Calls @a cast, whose errors name a ray, and not where it is from.
template <typename Cast>
void namingTable(const ActionCall& call, const Cast& cast)
{
    try {
        cast();
    } catch (const openvdb::ValueError&) {
        if (!call.given("rays")) throw;
        rethrowNamed(call.text("rays"), kInput);
    }
}

void runRaycast(const ActionCall& call, Session& session)
{
    const QueryBody body = bodiesOf(call, session, 1).front();
    const std::vector<QueryRay> rays = raysOf(call, session);
    AnswerSheet sheet = sheetOf(body, "vdb_spheretree.raycast.1", rays.size());
    std::vector<RayHit> hits(call.flag("any") ? 0 : rays.size());
    std::vector<uint8_t> blocked(rays.size());
    if (call.flag("any")) {
        namingTable(call, [&] {
            spheretree::occluded(
                body.tree, rays.data(), rays.size(), blocked.data(), &session.progress);
        });
        sheet.columns = {"ray", "hit"};
        sheet.row = [&](std::size_t i) { return Cells{int64_t(i), bool(blocked[i])}; };
    } else {
        namingTable(call, [&] {
            spheretree::intersect(
                body.tree, rays.data(), rays.size(), hits.data(), &session.progress);
        });
        for (std::size_t i = 0; i < hits.size(); ++i) blocked[i] = bool(hits[i]);
        sheet.columns = {"ray", "hit", "t", "x", "y", "z", "nx", "ny", "nz", "node", "blocks"};
        sheet.row = [&](std::size_t i) {
            Cells cells = cellsOf(body.tree, rays[i], hits[i], unitOf(call));
            cells.insert(cells.begin(), int64_t(i));
            return cells;
        };
    }
    const auto hitCount = std::count(blocked.begin(), blocked.end(), 1);
    sheet.summary = counted(int64_t(rays.size()), "ray") + ": " + counted(hitCount, "hit");
    giveAnswers(call, session, sheet);
}

void checkRaycast(const ActionCall& call, Plan& plan)
{
    checkQuestion(call, plan, 1, "rays", "ray,hit");
    checkTable(call, plan, "rays", {"origin", "direction"});
    requireQuestion(call, {"origin", "direction"}, "rays");
    if (call.given("direction") && vecOf(call, "direction") == Vec3d(0.0)) {
        throwUsage("direction=" + call.text("direction") + " has no length");
    }
}

// -contains

/// What is known of a point.
struct PointAnswer {
    PointDistance nearest;
    std::optional<bool> inObject; ///< nothing: nobody can know by spheres
};

std::optional<spheretree::DigitalLeaves> digitalLeaves(const QueryBody& body, Session& session)
{
    try {
        return spheretree::DigitalLeaves(*body.spheres, body.settings);
    } catch (const openvdb::ValueError& error) {
        session.remark(std::string("whether points lie in the object is known within bounds: ")
            + spheretree::detail::messageOf(error));
        return {};
    }
}

/// @param leaves  null where they are not the object
PointAnswer answerOf(
    const QueryTree& tree, const spheretree::DigitalLeaves* leaves, const Vec3d& point, double upTo)
{
    constexpr double kRounding = 1e-6; // doubles and floats are off by less than this part
    PointAnswer answer;
    PointDistance& nearest = answer.nearest;
    // Whether the point is outside of all spheres is to be known even where nothing else is asked.
    nearest = spheretree::nearest(tree, point, std::max(upTo, kRounding * tree.radius()));
    if (leaves) {
        answer.inObject = spheretree::contains(tree, *leaves, point);
    } else if (nearest.distance > 0 && tree.holdsObject()) {
        answer.inObject = false;
    } else if (nearest) {
        // A leaf that is shrunk lies in the object.
        const double radius = tree.leafRadius(nearest.leaf);
        const double fromCenter = (point - tree.leafCenter(nearest.leaf)).length();
        const double shrunk = radius * (1 - kRounding) - tree.leafInset();
        if (fromCenter < shrunk - kRounding * tree.radius()) answer.inObject = true;
    }
    if (nearest.distance > upTo) nearest.leaf = -1;
    return answer;
}

const char* nameOf(const std::optional<bool>& inObject)
{
    if (!inObject) return "undecided";
    return *inObject ? "inside" : "outside";
}

Cells cellsOf(const QueryTree& tree, const PointAnswer& answer, double unit)
{
    const PointDistance& nearest = answer.nearest;
    Cells cells = {nameOf(answer.inObject), bool(nearest && nearest.distance <= 0)};
    if (nearest) {
        cells.push_back(nearest.distance / unit);
        addCells(cells, nearest.gradient);
        cells.push_back(int64_t(tree.nodeId(nearest.leaf)));
    } else {
        addNothing(cells, 5);
    }
    cells.push_back(int64_t(nearest.blocks));
    return cells;
}

std::string summaryOf(const std::vector<PointAnswer>& answers)
{
    std::string text = counted(int64_t(answers.size()), "point");
    const char* separator = ": ";
    for (const std::optional<bool> inObject :
        {std::optional(true), std::optional(false), std::optional<bool>()}) {
        const auto count = std::count_if(answers.begin(), answers.end(),
            [&](const PointAnswer& answer) { return answer.inObject == inObject; });
        if (!count) continue;
        text += separator + withCommas(count) + " " + nameOf(inObject);
        separator = ", ";
    }
    return text;
}

void runContains(const ActionCall& call, Session& session)
{
    const QueryBody body = bodiesOf(call, session, 1).front();
    const auto leaves = digitalLeaves(body, session);
    std::vector<Vec3d> points;
    if (call.given("points")) points = rowsOf(call, "points", session, spheretree::readPointTable);
    else points = {vecOf(call, "point")};
    const double unit = unitOf(call);
    const double upTo =
        call.given("upto") ? lengthOf(call, "upto") : std::numeric_limits<double>::infinity();
    std::vector<PointAnswer> answers(points.size());
    spheretree::detail::parallelFor(points.size(), &session.progress, [&](std::size_t i) {
        answers[i] = answerOf(body.tree, leaves ? &*leaves : nullptr, points[i] * unit, upTo);
    });
    AnswerSheet sheet = sheetOf(body, "vdb_spheretree.contains.1", points.size());
    sheet.facts.emplace_back("object_is", leaves ? "exact" : "within bounds");
    sheet.columns = {
        "point", "object", "in_spheres", "distance", "gx", "gy", "gz", "node", "blocks"};
    sheet.row = [&](std::size_t i) {
        Cells cells = cellsOf(body.tree, answers[i], unit);
        cells.insert(cells.begin(), int64_t(i));
        return cells;
    };
    sheet.summary = summaryOf(answers);
    giveAnswers(call, session, sheet);
}

void checkContains(const ActionCall& call, Plan& plan)
{
    checkQuestion(call, plan, 1, "points", "point,object");
    checkTable(call, plan, "points", {"point"});
    requireQuestion(call, {"point"}, "points");
}

} // namespace

ActionSpec raycastAction()
{
    ActionSpec action{"raycast", "", "files",
        "where rays enter a sphere-tree: never later than the object, never a miss where it is "
        "hit"};
    action.options = questionOptions(1,
        {vector("origin", "", "where the ray starts"),
            vector("direction", "", "where it goes, of any length: t counts by it"),
            tableOption("rays", "in place of one ray, those"),
            flag("any", false, "only whether there is a hit, in less time"),
            flag("leaves_start", false,
                "spheres that hold the start do not count, as for rays that leave a surface")});
    action.more = {
        {"rays", "x,y,z,dx,dy,dz (tnear,tfar). Without a header: 6 columns, the first of these"}};
    action.givesOut = true;
    action.check = checkRaycast;
    action.run = runRaycast;
    return action;
}

ActionSpec containsAction()
{
    ActionSpec action{"contains", "", "files",
        "whether points lie in the object of a sphere-tree, how far they are from its spheres, and "
        "in which direction away from them"};
    action.options = questionOptions(1,
        {vector("point", "", "the point"), tableOption("points", "in place of one point, those"),
            length("upto", "", 0, 1e30,
                "look for no sphere farther than this, in world units: takes a part of the time")});
    action.more = {{"points", "x,y,z. Without a header: 3 columns"}};
    action.givesOut = true;
    action.check = checkContains;
    action.run = runContains;
    return action;
}

} // namespace command
