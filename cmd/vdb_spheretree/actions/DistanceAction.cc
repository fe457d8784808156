// SPDX-License-Identifier: Apache-2.0
/// @file DistanceAction.cc
/// @brief -distance: how far two trees are apart, in one pose or in many.

#include "base/Terminal.h"
#include "line/Actions.h"
#include "PairQuestion.h"
#include "PoseOptions.h"

#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/query/BodyDistance.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::DistanceResult;

namespace {

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
    const auto results = answersOf<DistanceResult>(
        question.poses.size(), numbered("pose"), session, [&](std::size_t i) {
            return spheretree::distance(question.a(), {}, question.b(), question.poses[i], request);
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
