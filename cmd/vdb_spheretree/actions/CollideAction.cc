// SPDX-License-Identifier: Apache-2.0
/// @file CollideAction.cc
/// @brief -collide: whether two trees touch, in one pose or in many, and where; and on the way between poses; and which of
/// many trees do.

#include "line/Actions.h"
#include "base/Terminal.h"
#include "MotionAnswers.h"
#include "PairQuestion.h"
#include "PoseOptions.h"
#include "SceneAnswers.h"
#include "Verdicts.h"

#include <openvdb_spheretree/query/Collide.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::CollisionResult;
using spheretree::Contact;
using spheretree::Verdict;

namespace {

/// What is found of a pose.
struct PoseAnswer {
    CollisionResult result;
    std::vector<Contact> contacts; ///< the deepest first; empty if apart
};

spheretree::CollisionRequest collisionRequest(const ActionCall& call)
{
    spheretree::CollisionRequest request;
    request.securityMargin = lengthOf(call, "margin");
    request.maxBlocks = blocksOf(call);
    request.enableContact = request.enableDistanceLowerBound = true;
    request.decideObjects = call.flag("objects");
    if (call.given("contacts")) request.maxContacts = int(call.integer("contacts"));
    return request;
}

std::vector<PoseAnswer> poseAnswersOf(
    const ActionCall& call, Session& session, const PairQuestion& question)
{
    const auto request = collisionRequest(call);
    return answersOf<PoseAnswer>(
        question.poses.size(), numbered("pose"), session, [&](std::size_t i) {
            PoseAnswer answer;
            answer.result = spheretree::collide(
                question.a(), {}, question.b(), question.poses[i], request, &answer.contacts);
            return answer;
        });
}

/// @param contact  null: there is none
/// @param number   of the contact, for a column of its own; below 0: no such column
Cells cellsOf(const CollisionResult& result, const Contact* contact, int64_t number, double unit)
{
    const bool isApart = result.verdict == Verdict::Apart;
    Cells cells = {nameOf(result.verdict), nameOf(result.objects)};
    if (number >= 0) cells.push_back(contact ? Cell(number) : Cell());
    cells.push_back(contact ? lengthCell(contact->distance, unit) : Cell());
    cells.push_back(isApart ? Cell(result.distanceLowerBound / unit) : Cell());
    addContact(cells, contact, unit);
    cells.push_back(result.blocks);
    return cells;
}

/// Rows of answers: one for each contact of a pose, and one for a pose without any.
std::vector<std::pair<std::size_t, std::size_t>> answerRows(const std::vector<PoseAnswer>& answers)
{
    std::vector<std::pair<std::size_t, std::size_t>> rows;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const std::size_t count = std::max(std::size_t(1), answers[i].contacts.size());
        for (std::size_t k = 0; k < count; ++k) rows.emplace_back(i, k);
    }
    return rows;
}

Verdicts verdictsOf(const std::vector<PoseAnswer>& answers, Verdict CollisionResult::*which)
{
    Verdicts verdicts;
    for (const PoseAnswer& answer : answers) verdicts.push_back(answer.result.*which);
    return verdicts;
}

std::string poseSummary(const std::vector<PoseAnswer>& answers)
{
    std::string text = summaryOf(verdictsOf(answers, &CollisionResult::verdict), "pose");
    const Verdicts objects = verdictsOf(answers, &CollisionResult::objects);
    const int64_t certain = std::count(objects.begin(), objects.end(), Verdict::Touching);
    if (certain) text += "; the objects themselves touch in " + withCommas(certain);
    return text;
}

/// Says what spheres cannot tell of the objects, where it is asked.
void noteWhatIsUnknown(
    const ActionCall& call, const std::vector<QueryBody>& bodies, Session& session)
{
    const bool isOne = bodies[0].spheres == bodies[1].spheres;
    for (const QueryBody& body : bodies) {
        if (isOne && &body != &bodies[0]) return; // asked against itself
        if (call.flag("objects") && std::isinf(body.tree.leafInset())) {
            session.note("objects=1: spheres of " + body.name
                + " are not known to hold a part of the object, so it touches in no pose for "
                  "certain; build the tree without spheres=, error= or distance=");
        }
        if (call.given("contacts") && !body.tree.holdsLeaves()) {
            session.note("contacts: some spheres of " + body.name
                + " reach beyond those above them, where no object is; exact=1 has their contacts, "
                  "too");
        }
        const bool expectsApart = call.given("expect") && call.text("expect") == "apart";
        if (expectsApart && !call.flag("objects") && !body.tree.holdsObject()) {
            session.note("expect=apart: spheres of " + body.name
                + " do not hold the object, so it may touch where they are apart");
        }
    }
}

void givePoseAnswers(const ActionCall& call, Session& session, const PairQuestion& question)
{
    const auto answers = poseAnswersOf(call, session, question);
    const auto rows = answerRows(answers);
    AnswerSheet sheet = question.sheet("vdb_spheretree.collide.1");
    sheet.count = rows.size();
    sheet.columns = {"pose", "spheres", "objects", "distance", "lower", "x", "y", "z", "nx", "ny",
        "nz", "a", "b", "blocks"};
    const bool isNumbered = call.given("contacts");
    if (isNumbered) sheet.columns.insert(sheet.columns.begin() + 3, "contact");
    sheet.row = [&](std::size_t row) {
        const auto [pose, k] = rows[row];
        const auto& [result, contacts] = answers[pose];
        Cells cells = cellsOf(result, contacts.empty() ? nullptr : &contacts[k],
            isNumbered ? int64_t(k) : -1, question.unit);
        cells.insert(cells.begin(), int64_t(pose));
        return cells;
    };
    sheet.summary = poseSummary(answers);
    giveAnswers(call, session, sheet);
    const auto which = call.flag("objects") ? &CollisionResult::objects : &CollisionResult::verdict;
    requireExpected(call, verdictsOf(answers, which), "pose");
}

void runCollide(const ActionCall& call, Session& session)
{
    if (call.flag("scene")) {
        const std::vector<QueryBody> bodies = bodiesOf(call, session, kAnyTrees);
        noteWhatIsUnknown(call, bodies, session);
        if (call.flag("motion")) return giveSceneMotionAnswers(call, session, bodies);
        return giveSceneAnswers(call, session, bodies, collisionRequest(call));
    }
    const PairQuestion question(call, session);
    noteWhatIsUnknown(call, question.bodies, session);
    if (call.flag("motion")) giveMotionAnswers(call, session, question);
    else givePoseAnswers(call, session, question);
}

void checkCollide(const ActionCall& call, Plan& plan)
{
    checkMotion(call);
    checkScene(call, plan);
    if (call.flag("scene")) return;
    checkPair(call, plan, call.flag("motion") ? "motion,spheres" : "pose,spheres");
}

} // namespace

ActionSpec collideAction()
{
    ActionSpec action{"collide", "", "files",
        "whether two sphere-trees touch, the second one moved, and where, or which of many do; "
        "spheres that hold their objects are never apart where these meet; exit code 6 if that is "
        "not what is expected"};
    OptionSpec expect = choice("expect", {"apart", "touching"},
        "fail with exit code 6 unless the spheres are so in every pose; with objects=1, unless the "
        "objects are so for certain");
    expect.fallback.clear();
    std::vector<OptionSpec> own = {expect,
        length("margin", "0", 0, 1e30, "spheres nearer than this touch, in world units"),
        flag("objects", false,
            "search on, until it is known of the objects too, the voxels themselves, whether they "
            "touch, or nobody can know by spheres"),
        integer("contacts", "", 2, 1000000,
            "of a pose, or of two trees of a scene, that touch, give up to so many pairs of "
            "spheres that do, the deepest first, a line each"),
        flag("motion", false,
            "find when the second tree first touches the first one on its way from each pose of "
            "poses= to the next, or from where it is to the one pose: along a line, or where it "
            "turns a screw, by half a turn at most; time runs from 0 to 1, and nothing is sampled; "
            "of a scene, all trees go at the same time, from each frame to the next"),
        length("tolerance", "0", 0, 1e30,
            "with motion=1: how far apart spheres may be at the time of contact; 0: a "
            "ten-thousandth of the smaller tree's radius")};
    for (const OptionSpec& option : sceneOptions()) own.push_back(option);
    action.options = pairOptions(own);
    action.more = poseColumnDocs();
    for (const auto& column : sceneColumnDocs()) action.more.push_back(column);
    action.givesOut = true;
    action.check = checkCollide;
    action.run = runCollide;
    return action;
}

} // namespace command
