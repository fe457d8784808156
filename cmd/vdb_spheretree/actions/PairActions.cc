// SPDX-License-Identifier: Apache-2.0
/// @file PairActions.cc
/// @brief -collide and -distance: two trees, in one pose or in many.

#include "base/Errors.h"
#include "base/Terminal.h"
#include "line/Actions.h"
#include "PoseOptions.h"
#include "QueryOptions.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::CollisionResult;
using spheretree::DistanceResult;
using spheretree::QueryTree;
using spheretree::RigidTransform;
using spheretree::Verdict;
using spheretree::detail::shortNumber;

namespace {

const char* nameOf(Verdict verdict)
{
    if (verdict == Verdict::Apart) return "apart";
    return verdict == Verdict::Touching ? "touching" : "undecided";
}

int64_t blocksOf(const ActionCall& call)
{
    return call.given("blocks") ? call.integer("blocks") : -1;
}

/// The two bodies of a question and where the second one is.
struct PairQuestion {
    std::vector<QueryBody> bodies;
    std::vector<RigidTransform> poses;
    double unit;

    PairQuestion(const ActionCall& call, Session& session)
        : bodies(bodiesOf(call, session, 2)), poses(posesOf(call, session)), unit(unitOf(call))
    {
        noteUnlikeUnits(session);
    }

    /// @param ask  of both trees and the second one's pose
    /// @return its answers, one a pose
    template <typename Result, typename Ask>
    std::vector<Result> answers(Session& session, const Ask& ask) const
    {
        std::vector<Result> results(poses.size());
        spheretree::detail::parallelFor(poses.size(), &session.progress,
            [&](std::size_t i) { results[i] = ask(bodies[0].tree, bodies[1].tree, poses[i]); });
        return results;
    }

    /// Metres and millimetres are mistaken for each other most easily.
    void noteUnlikeUnits(Session& session) const
    {
        constexpr double kMuch = 100;
        const QueryTree &a = bodies[0].tree, &b = bodies[1].tree;
        const double larger = std::max(a.radius(), b.radius());
        const double smaller = std::min(a.radius(), b.radius());
        if (larger > kMuch * smaller) {
            const bool isFirst = a.radius() > b.radius();
            session.note(bodies[isFirst ? 0 : 1].name + " is " + shortNumber(larger / smaller)
                + " times as large as " + bodies[isFirst ? 1 : 0].name
                + ": are both in one unit of length?");
        }
        double nearest = std::numeric_limits<double>::infinity();
        for (const RigidTransform& pose : poses) {
            nearest = std::min(nearest, (pose * b.center() - a.center()).length());
        }
        if (nearest > kMuch * (a.radius() + b.radius())) {
            session.note("in every pose the trees are more than a hundred times their size apart: "
                         "are numbers here in their unit of length (units=)?");
        }
    }

    AnswerSheet sheet(const std::string& format) const
    {
        AnswerSheet sheet;
        sheet.format = format;
        sheet.facts = {{"a", bodies[0].name}, {"b", bodies[1].name}};
        sheet.count = poses.size();
        return sheet;
    }
};

std::vector<OptionSpec> pairOptions(const std::vector<OptionSpec>& own)
{
    std::vector<OptionSpec> options = poseOptions();
    options.insert(options.end(), own.begin(), own.end());
    options.push_back(integer("blocks", "", 1, std::numeric_limits<int32_t>::max(),
        "test no more blocks of eight spheres for a pose than this; what is not known then is "
        "said"));
    return questionOptions(2, options);
}

void checkPair(const ActionCall& call, Plan& plan, const std::string& columns)
{
    checkQuestion(call, plan, 2, "poses", columns);
    checkPoses(call, plan);
}

// -collide

spheretree::CollisionRequest collisionRequest(const ActionCall& call)
{
    spheretree::CollisionRequest request;
    request.securityMargin = lengthOf(call, "margin");
    request.maxBlocks = blocksOf(call);
    request.enableContact = request.enableDistanceLowerBound = true;
    request.decideObjects = call.flag("objects");
    return request;
}

Cells cellsOf(const CollisionResult& result, double unit)
{
    Cells cells = {nameOf(result.verdict), nameOf(result.objects)};
    if (const auto& contact = result.contact) {
        cells.push_back(lengthCell(contact->distance, unit));
        addCells(cells, contact->point(), unit);
        addCells(cells, contact->normal);
        cells.insert(cells.end(), {int64_t(contact->nodes.a), int64_t(contact->nodes.b)});
    } else {
        addNothing(cells, 9);
    }
    const bool isApart = result.verdict == Verdict::Apart;
    cells.insert(cells.begin() + 3, isApart ? Cell(result.distanceLowerBound / unit) : Cell());
    cells.push_back(result.blocks);
    return cells;
}

/// @return how many of the poses have a verdict, by spheres or by objects.
int64_t countOf(
    const std::vector<CollisionResult>& results, Verdict CollisionResult::*which, Verdict verdict)
{
    return std::count_if(results.begin(), results.end(),
        [&](const CollisionResult& result) { return result.*which == verdict; });
}

std::string summaryOf(const std::vector<CollisionResult>& results)
{
    std::string text = counted(int64_t(results.size()), "pose");
    const char* separator = ": ";
    const auto add = [&](Verdict verdict) {
        const int64_t count = countOf(results, &CollisionResult::verdict, verdict);
        if (!count) return;
        text += separator + withCommas(count) + " " + nameOf(verdict);
        separator = ", ";
    };
    add(Verdict::Apart), add(Verdict::Touching), add(Verdict::Undecided);
    const int64_t certain = countOf(results, &CollisionResult::objects, Verdict::Touching);
    if (certain) text += "; the objects themselves touch in " + withCommas(certain);
    return text;
}

/// @throw CommandError (check failed) that names the first pose that is not as expected
void requireExpected(const ActionCall& call, const std::vector<CollisionResult>& results)
{
    if (!call.given("expect")) return;
    const auto which = call.flag("objects") ? &CollisionResult::objects : &CollisionResult::verdict;
    const bool expectsApart = call.text("expect") == "apart";
    const Verdict expected = expectsApart ? Verdict::Apart : Verdict::Touching;
    const auto other = std::find_if(results.begin(), results.end(),
        [&](const CollisionResult& result) { return result.*which != expected; });
    if (other == results.end()) return;
    const int64_t count = int64_t(results.size()) - countOf(results, which, expected);
    throw CommandError(kCheckFailed,
        "expect=" + call.text("expect") + " does not hold in " + withCommas(count) + " of "
            + counted(int64_t(results.size()), "pose") + ", the first: pose "
            + std::to_string(other - results.begin()) + " is " + nameOf(*other.*which));
}

/// Says what spheres cannot tell of the objects, where it is asked.
void noteWhatIsUnknown(const ActionCall& call, const PairQuestion& question, Session& session)
{
    const bool isOne = question.bodies[0].spheres == question.bodies[1].spheres;
    for (const QueryBody& body : question.bodies) {
        if (isOne && &body != &question.bodies[0]) return; // asked against itself
        if (call.flag("objects") && std::isinf(body.tree.leafInset())) {
            session.note("objects=1: spheres of " + body.name
                + " are not known to hold a part of the object, so it touches in no pose for "
                  "certain; build the tree without spheres=, error= or distance=");
        }
        const bool expectsApart = call.given("expect") && call.text("expect") == "apart";
        if (expectsApart && !call.flag("objects") && !body.tree.holdsObject()) {
            session.note("expect=apart: spheres of " + body.name
                + " do not hold the object, so it may touch where they are apart");
        }
    }
}

void runCollide(const ActionCall& call, Session& session)
{
    const PairQuestion question(call, session);
    noteWhatIsUnknown(call, question, session);
    const auto request = collisionRequest(call);
    const auto results = question.answers<CollisionResult>(
        session, [&](const auto& a, const auto& b, const RigidTransform& pose) {
            return spheretree::collide(a, {}, b, pose, request);
        });
    AnswerSheet sheet = question.sheet("vdb_spheretree.collide.1");
    sheet.columns = {"pose", "spheres", "objects", "distance", "lower", "x", "y", "z", "nx", "ny",
        "nz", "a", "b", "blocks"};
    sheet.row = [&](std::size_t i) {
        Cells cells = cellsOf(results[i], question.unit);
        cells.insert(cells.begin(), int64_t(i));
        return cells;
    };
    sheet.summary = summaryOf(results);
    giveAnswers(call, session, sheet);
    requireExpected(call, results);
}

void checkCollide(const ActionCall& call, Plan& plan) { checkPair(call, plan, "pose,spheres"); }

// -distance

spheretree::DistanceRequest distanceRequest(const ActionCall& call)
{
    spheretree::DistanceRequest request;
    request.enableSignedDistance = call.flag("signed");
    request.relErr = call.real("relerr");
    request.absErr = lengthOf(call, "abserr");
    if (call.given("upto")) request.upperBound = lengthOf(call, "upto");
    request.maxBlocks = blocksOf(call);
    return request;
}

Cells cellsOf(const DistanceResult& result, double unit)
{
    Cells cells = {lengthCell(result.distance, unit), lengthCell(result.lowerBound, unit),
        lengthCell(result.objectsLower, unit), lengthCell(result.objectsUpper, unit)};
    if (const auto& contact = result.contact) {
        addCells(cells, contact->pointA, unit);
        addCells(cells, contact->pointB, unit);
        cells.insert(cells.end(), {int64_t(contact->nodes.a), int64_t(contact->nodes.b)});
    } else {
        addNothing(cells, 8);
    }
    cells.insert(cells.end(), {result.isDecided, result.blocks});
    return cells;
}

std::string summaryOf(const std::vector<DistanceResult>& results, double unit)
{
    const auto nearest = std::min_element(results.begin(), results.end(),
        [](const DistanceResult& a, const DistanceResult& b) { return a.distance < b.distance; });
    if (results.size() < 2 || !nearest->contact) return {};
    openvdb_spheretree::detail::TextStream text;
    text << counted(int64_t(results.size()), "pose") << ": nearest in pose "
         << nearest - results.begin() << ", at " << nearest->distance / unit;
    return text.str();
}

void runDistance(const ActionCall& call, Session& session)
{
    const PairQuestion question(call, session);
    const auto request = distanceRequest(call);
    const auto results = question.answers<DistanceResult>(
        session, [&](const auto& a, const auto& b, const RigidTransform& pose) {
            return spheretree::distance(a, {}, b, pose, request);
        });
    AnswerSheet sheet = question.sheet("vdb_spheretree.distance.1");
    sheet.columns = {"pose", "distance", "lower", "objects_lower", "objects_upper", "ax", "ay",
        "az", "bx", "by", "bz", "a", "b", "decided", "blocks"};
    sheet.row = [&](std::size_t i) {
        Cells cells = cellsOf(results[i], question.unit);
        cells.insert(cells.begin(), int64_t(i));
        return cells;
    };
    sheet.summary = summaryOf(results, question.unit);
    giveAnswers(call, session, sheet);
}

void checkDistance(const ActionCall& call, Plan& plan) { checkPair(call, plan, "pose,distance"); }

} // namespace

ActionSpec collideAction()
{
    ActionSpec action{"collide", "", "files",
        "whether two sphere-trees touch, the second one moved, and where; spheres that hold their "
        "objects are never apart where these meet; exit code 6 if that is not what is expected"};
    OptionSpec expect = choice("expect", {"apart", "touching"},
        "fail with exit code 6 unless the spheres are so in every pose; with objects=1, unless the "
        "objects are so for certain");
    expect.fallback.clear();
    action.options = pairOptions({expect,
        length("margin", "0", 0, 1e30, "spheres nearer than this touch, in world units"),
        flag("objects", false,
            "search on, until it is known of the objects too, the voxels themselves, whether they "
            "touch, or nobody can know by spheres")});
    action.more = poseColumnDocs();
    action.givesOut = true;
    action.check = checkCollide;
    action.run = runCollide;
    return action;
}

ActionSpec distanceAction()
{
    ActionSpec action{"distance", "", "files",
        "how far two sphere-trees are apart, the second one moved, where they are nearest, and "
        "between what bounds the objects' distance is"};
    action.options = pairOptions({flag("signed", false,
                                      "of trees that meet, the depth of their deepest two spheres, "
                                      "as a negative number; not how far they must move to part"),
        length("upto", "", 0, 1e30, "look for nothing farther than this, in world units"),
        real("relerr", "0", 0, 1e6, "distances may be too large by this part of them"),
        length("abserr", "0", 0, 1e30, "or by this much, in world units")});
    action.more = poseColumnDocs();
    action.givesOut = true;
    action.check = checkDistance;
    action.run = runDistance;
    return action;
}

} // namespace command
