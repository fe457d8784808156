// SPDX-License-Identifier: Apache-2.0
#include "MotionAnswers.h"

#include "base/Errors.h"
#include "Verdicts.h"

#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>
#include <openvdb_spheretree/query/RigidMotion.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::ContinuousCollisionResult;
using spheretree::RigidMotion;
using spheretree::RigidTransform;
using spheretree::Verdict;

namespace {

std::vector<RigidMotion> motionsOf(const ActionCall& call, const PairQuestion& question)
{
    std::vector<RigidTransform> poses = question.poses;
    if (!call.given("poses")) poses.insert(poses.begin(), RigidTransform());
    if (poses.size() < 2) {
        throwInput(call.text("poses")
            + ": motion=1 goes from pose to pose, and the file holds one: give two or more");
    }
    std::vector<RigidMotion> motions;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        motions.push_back(RigidMotion::screw(poses[i - 1], poses[i]));
    }
    return motions;
}

std::string motionSummary(
    const std::vector<ContinuousCollisionResult>& results, const Verdicts& verdicts)
{
    spheretree::detail::TextStream text;
    text << summaryOf(verdicts, "motion");
    const auto first = std::find(verdicts.begin(), verdicts.end(), Verdict::Touching);
    if (first == verdicts.end()) return text.str();
    const auto which = first - verdicts.begin();
    text << "; the first contact is in motion " << which << " at time "
         << results[std::size_t(which)].timeOfContact;
    return text.str();
}

} // namespace

void checkMotion(const ActionCall& call)
{
    if (!call.flag("motion")) {
        if (call.given("tolerance")) throwUsage("tolerance is of a time of contact: add motion=1");
        return;
    }
    for (const char* other : {"objects", "contacts"}) {
        if (call.given(other)) {
            throwUsage(std::string("motion and ") + other + " exclude each other");
        }
    }
}

Verdict verdictOf(const ContinuousCollisionResult& result)
{
    if (result.isCollide) return Verdict::Touching;
    return result.isDecided ? Verdict::Apart : Verdict::Undecided;
}

Cells motionCells(const ContinuousCollisionResult& result, double unit)
{
    Cells cells = {nameOf(verdictOf(result)),
        result.isCollide ? Cell(result.timeOfContact) : Cell(), result.freeUntil};
    const auto& contact = result.contact;
    cells.push_back(contact ? lengthCell(contact->distance, unit) : Cell());
    addContact(cells, contact ? &*contact : nullptr, unit);
    cells.push_back(result.blocks);
    return cells;
}

spheretree::ContinuousCollisionRequest motionRequest(const ActionCall& call)
{
    spheretree::ContinuousCollisionRequest request;
    request.securityMargin = lengthOf(call, "margin");
    request.tolerance = lengthOf(call, "tolerance");
    request.maxBlocks = blocksOf(call);
    return request;
}

void giveMotionAnswers(const ActionCall& call, Session& session, const PairQuestion& question)
{
    const std::vector<RigidMotion> motions = motionsOf(call, question);
    const auto request = motionRequest(call);
    const auto results = answersOf<ContinuousCollisionResult>(
        motions.size(), numbered("motion"), session, [&](std::size_t i) {
            return spheretree::continuousCollide(
                question.a(), {}, question.b(), motions[i], request);
        });
    Verdicts verdicts;
    for (const auto& result : results) verdicts.push_back(verdictOf(result));
    AnswerSheet sheet = question.sheet("vdb_spheretree.motion.1");
    sheet.count = results.size();
    sheet.columns = {"motion", "spheres", "time", "free_until", "distance", "x", "y", "z", "nx",
        "ny", "nz", "a", "b", "blocks"};
    sheet.row = [&](std::size_t i) {
        Cells cells = motionCells(results[i], question.unit);
        cells.insert(cells.begin(), int64_t(i));
        return cells;
    };
    sheet.summary = motionSummary(results, verdicts);
    giveAnswers(call, session, sheet);
    requireExpected(call, verdicts, "motion");
}

} // namespace command
