// SPDX-License-Identifier: Apache-2.0
#include "SceneAnswers.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "PairQuestion.h"
#include "Verdicts.h"

#include <openvdb_spheretree/query/QueryScene.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::BodyPose;
using spheretree::QueryScene;
using spheretree::RigidTransform;
using spheretree::ScenePair;
using spheretree::Verdict;
using Bodies = std::vector<QueryBody>;
using Pair = std::pair<std::string, std::string>;

namespace {

/// All bodies at one time.
struct SceneFrame {
    int64_t number = 0;
    std::vector<RigidTransform> poses; ///< by body
};

/// Names, or ages on the stack, of a pair of ignore=.
Pair pairOf(const std::string& typed)
{
    const std::size_t colon = typed.find(':');
    const bool isPair = colon != typed.npos && colon > 0 && colon + 1 < typed.size()
        && typed.find(':', colon + 1) == typed.npos;
    if (!isPair) {
        throwUsage("ignore=" + typed
            + ": a pair is two trees with a colon between, by their age on the stack or name, such "
              "as 1:0");
    }
    return {typed.substr(0, colon), typed.substr(colon + 1)};
}

/// @return the number of the body that is named so.
/// @throw CommandError (input)
int bodyOf(Session& session, const Bodies& bodies, const std::string& ageOrName)
{
    const StackItem& item = session.stack.selectTree(ageOrName);
    const auto isIt = [&](const QueryBody& body) { return body.spheres == item.tree.get(); };
    const auto found = std::find_if(bodies.begin(), bodies.end(), isIt);
    if (found == bodies.end()) {
        throwInput(item.description() + " is not in the scene: vdb= chooses others");
    }
    return int(found - bodies.begin());
}

QueryScene sceneOf(const ActionCall& call, Session& session, const Bodies& bodies)
{
    QueryScene scene;
    for (const QueryBody& body : bodies) scene.add(body.tree);
    for (const std::string& typed : call.list("ignore")) {
        const Pair names = pairOf(typed);
        const int a = bodyOf(session, bodies, names.first);
        const int b = bodyOf(session, bodies, names.second);
        if (a == b) throwInput("ignore=" + typed + ": that is one tree, not two");
        scene.ignore(a, b);
    }
    return scene;
}

/// @throw CommandError (input) if there is no such body, or it has a place in this frame already
void place(
    const BodyPose& row, int body, double unit, std::vector<int64_t>& lines, SceneFrame& frame)
{
    int64_t& line = lines[std::size_t(body)];
    if (line) {
        throwInput("the tree '" + oneLine(row.body, 60) + "' is placed twice in frame "
            + std::to_string(row.frame) + ", by line " + std::to_string(line)
            + " before: a column 'frame' numbers what is at one time");
    }
    line = int64_t(row.line);
    frame.poses[std::size_t(body)] =
        RigidTransform(row.pose.rotation(), row.pose.translation() * unit);
}

/// A body stays where it was until a line places it anew.
std::vector<SceneFrame> framesOf(const ActionCall& call, Session& session, const Bodies& bodies)
{
    SceneFrame frame{0, std::vector<RigidTransform>(bodies.size())};
    if (!call.given("poses")) return {frame};
    const double unit = unitOf(call);
    std::vector<SceneFrame> frames;
    std::vector<int64_t> lines; // that placed a body in this frame; 0: none
    for (const BodyPose& row : rowsOf(call, "poses", session, spheretree::readBodyPoseTable)) {
        if (frames.empty() || frames.back().number != row.frame) {
            frames.push_back(frames.empty() ? frame : frames.back());
            frames.back().number = row.frame;
            lines.assign(bodies.size(), 0);
        }
        try {
            place(row, bodyOf(session, bodies, row.body), unit, lines, frames.back());
        } catch (...) {
            rethrowNamed(call.text("poses") + ": line " + std::to_string(row.line), kInput);
        }
    }
    return frames;
}

/// Of one frame. @param which  of the spheres or the objects
Verdict verdictOf(const std::vector<ScenePair>& pairs, Verdict spheretree::CollisionResult::*which)
{
    Verdict verdict = Verdict::Apart;
    for (const ScenePair& pair : pairs) {
        if (pair.result.*which == Verdict::Touching) return Verdict::Touching;
        if (pair.result.*which == Verdict::Undecided) verdict = Verdict::Undecided;
    }
    return verdict;
}

/// What bodies are called: by their names, and by their ages where two have the same.
std::vector<std::string> labelsOf(const Session& session, const Bodies& bodies)
{
    std::vector<std::string> labels;
    for (const QueryBody& body : bodies) {
        const auto isOf = [&](const QueryBody& other) { return other.name == body.name; };
        if (!body.name.empty() && std::count_if(bodies.begin(), bodies.end(), isOf) == 1) {
            labels.push_back(body.name);
            continue;
        }
        int age = 0;
        const auto& items = session.stack.items();
        for (auto item = items.rbegin(); (*item)->tree.get() != body.spheres; ++item) {
            age += (*item)->mesh ? 0 : 1;
        }
        labels.push_back(std::to_string(age));
    }
    return labels;
}

/// @param pair  null: none touches in this frame
Cells cellsOf(const SceneFrame& frame, const ScenePair* pair,
    const std::vector<std::string>& labels, double unit)
{
    Cells cells = {frame.number};
    if (!pair) {
        addNothing(cells, 2);
        cells.insert(cells.end(), {nameOf(Verdict::Apart), nameOf(Verdict::Apart)});
        addNothing(cells, 10);
        return cells;
    }
    const auto& result = pair->result;
    const auto& contact = result.contact;
    cells.insert(cells.end(),
        {labels[std::size_t(pair->a)].c_str(), labels[std::size_t(pair->b)].c_str(),
            nameOf(result.verdict), nameOf(result.objects)});
    cells.push_back(contact ? lengthCell(contact->distance, unit) : Cell());
    addContact(cells, contact ? &*contact : nullptr, unit);
    cells.push_back(result.blocks);
    return cells;
}

std::string sceneSummary(const std::vector<std::vector<ScenePair>>& answers,
    const Verdicts& verdicts, std::size_t bodies)
{
    int64_t pairs = 0;
    for (const auto& frame : answers) {
        for (const ScenePair& pair : frame) pairs += pair.result.isCollision();
    }
    return summaryOf(verdicts, "frame") + "; " + counted(int64_t(bodies), "tree") + ", "
        + counted(pairs, "pair") + " touching";
}

} // namespace

std::vector<OptionSpec> sceneOptions()
{
    return {flag("scene", false,
                "find all pairs that touch of more than two trees, which are where they are, or "
                "where poses= puts them, frame by frame; a line for each pair"),
        list("ignore", "",
            "with scene=1: pairs that are not asked about, as neighbouring links of a robot, such "
            "as 1:0,base:arm; by their age on the stack or name")};
}

std::vector<std::pair<std::string, std::string>> sceneColumnDocs()
{
    return {{"of scenes",
        "poses with a header, and body: the tree, by its age on the stack or name; with frame, a "
        "whole number, lines of a frame are one time, and trees without a line stay where they "
        "were"}};
}

void checkScene(const ActionCall& call, Plan& plan)
{
    if (!call.flag("scene")) {
        if (call.given("ignore")) throwUsage("ignore is of a scene: add scene=1");
        return;
    }
    for (const char* other : {"motion", "contacts"}) {
        if (call.given(other)) {
            throwUsage(std::string("scene and ") + other + " exclude each other");
        }
    }
    for (const char* other : {"translate", "rotate", "axis", "angle", "matrix", "scale"}) {
        if (call.given(other)) {
            throwUsage(std::string("scene and ") + other
                + " exclude each other: poses= places the trees of a scene");
        }
    }
    for (const std::string& typed : call.list("ignore")) pairOf(typed);
    checkQuestion(call, plan, kAnyTrees, "poses", "frame,body_a");
    checkTable(call, plan, "poses", {});
}

void giveSceneAnswers(const ActionCall& call, Session& session, const Bodies& bodies,
    const spheretree::CollisionRequest& request)
{
    const QueryScene scene = sceneOf(call, session, bodies);
    const std::vector<SceneFrame> frames = framesOf(call, session, bodies);
    // Of one frame the pairs are asked in parallel, of several the frames.
    auto* const interrupter = frames.size() == 1 ? &session.progress : nullptr;
    const auto answers =
        answersOf<std::vector<ScenePair>>(frames.size(), session, [&](std::size_t i) {
            QueryScene placed = scene;
            for (int b = 0; b < placed.size(); ++b)
                placed.setPose(b, frames[i].poses[std::size_t(b)]);
            return placed.touchingPairs(request, interrupter);
        });
    std::vector<std::pair<std::size_t, std::size_t>> rows;
    Verdicts verdicts, asked;
    const bool asksObjects = call.flag("objects");
    std::vector<int64_t> numbers;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const std::size_t count = std::max(std::size_t(1), answers[i].size());
        for (std::size_t k = 0; k < count; ++k) rows.emplace_back(i, k);
        verdicts.push_back(verdictOf(answers[i], &spheretree::CollisionResult::verdict));
        asked.push_back(asksObjects ? verdictOf(answers[i], &spheretree::CollisionResult::objects)
                                    : verdicts.back());
        numbers.push_back(frames[i].number);
    }
    const std::vector<std::string> labels = labelsOf(session, bodies);
    AnswerSheet sheet;
    sheet.format = "vdb_spheretree.scene.1";
    sheet.count = rows.size();
    sheet.columns = {"frame", "body_a", "body_b", "spheres", "objects", "distance", "x", "y", "z",
        "nx", "ny", "nz", "a", "b", "blocks"};
    sheet.row = [&](std::size_t row) {
        const auto [i, k] = rows[row];
        return cellsOf(
            frames[i], answers[i].empty() ? nullptr : &answers[i][k], labels, unitOf(call));
    };
    sheet.summary = sceneSummary(answers, verdicts, bodies.size());
    giveAnswers(call, session, sheet);
    requireExpected(call, asked, "frame", numbers);
}

} // namespace command
