// SPDX-License-Identifier: Apache-2.0
#include "SceneAnswers.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "MotionAnswers.h"
#include "PairQuestion.h"
#include "Verdicts.h"

#include <openvdb_spheretree/query/QueryScene.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::CollisionRequest;
using spheretree::CollisionResult;
using spheretree::Contact;
using spheretree::MovingPair;
using spheretree::QueryScene;
using spheretree::RigidMotion;
using spheretree::ScenePair;
using spheretree::Verdict;

namespace {

/// The pairs that do not come out as apart, frame by frame.
template <typename Pair>
using FrameAnswers = std::vector<std::vector<Pair>>;

/// A line of answers: in which frame, of which pair of it, and which of its contacts.
struct SceneRow {
    std::size_t frame = 0, pair = 0, contact = 0;
};

/// @param contacts  of a pair
/// @return one row for each contact, for each pair without any, and for each frame without pairs.
template <typename Pair, typename Contacts>
std::vector<SceneRow> rowsOfFrames(const FrameAnswers<Pair>& answers, const Contacts& contacts)
{
    std::vector<SceneRow> rows;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (answers[i].empty()) rows.push_back({i});
        for (std::size_t k = 0; k < answers[i].size(); ++k) {
            const std::size_t count = std::max(std::size_t(1), contacts(answers[i][k]));
            for (std::size_t c = 0; c < count; ++c) rows.push_back({i, k, c});
        }
    }
    return rows;
}

/// Of one frame. @param verdict  of a pair
template <typename Pair, typename VerdictOf>
Verdict worstOf(const std::vector<Pair>& pairs, const VerdictOf& verdict)
{
    Verdict worst = Verdict::Apart;
    for (const Pair& pair : pairs) {
        if (verdict(pair) == Verdict::Touching) return Verdict::Touching;
        if (verdict(pair) == Verdict::Undecided) worst = Verdict::Undecided;
    }
    return worst;
}

template <typename Pair, typename VerdictOf>
Verdicts worstOfFrames(const FrameAnswers<Pair>& answers, const VerdictOf& verdict)
{
    Verdicts verdicts;
    for (const auto& pairs : answers) verdicts.push_back(worstOf(pairs, verdict));
    return verdicts;
}

Verdict spheresOf(const ScenePair& pair) { return pair.result.verdict; }
Verdict spheresOf(const MovingPair& pair) { return verdictOf(pair.result); }
Verdict objectsOf(const ScenePair& pair) { return pair.result.objects; }

/// @return the pair of a line; null: none touches in its frame.
template <typename Pair>
const Pair* pairAt(const FrameAnswers<Pair>& answers, const SceneRow& row)
{
    const std::vector<Pair>& pairs = answers[row.frame];
    return pairs.empty() ? nullptr : &pairs[row.pair];
}

/// How a line begins: the frame and the pair. @param pair  null: none touches in this frame
template <typename Pair>
Cells pairCells(const SceneFrame& frame, const Pair* pair, const std::vector<std::string>& labels)
{
    Cells cells = {frame.number};
    if (pair) {
        cells.push_back(labels[std::size_t(pair->a)].c_str());
        cells.push_back(labels[std::size_t(pair->b)].c_str());
    } else {
        addNothing(cells, 2);
    }
    return cells;
}

/// @param number      which of the contacts
/// @param isNumbered  whether that has a column of its own
void addPair(Cells& cells, const ScenePair& pair, std::size_t number, bool isNumbered, double unit)
{
    const CollisionResult& result = pair.result;
    const Contact* contact = result.contact ? &*result.contact : nullptr;
    if (!pair.contacts.empty()) contact = &pair.contacts[number];
    cells.insert(cells.end(), {nameOf(result.verdict), nameOf(result.objects)});
    if (isNumbered) cells.push_back(contact ? Cell(int64_t(number)) : Cell());
    cells.push_back(contact ? lengthCell(contact->distance, unit) : Cell());
    addContact(cells, contact, unit);
    cells.push_back(result.blocks);
}

template <typename Pair>
std::string sceneSummary(const FrameAnswers<Pair>& answers, const Verdicts& verdicts,
    const char* noun, std::size_t bodies)
{
    int64_t touching = 0;
    for (const auto& frame : answers) {
        for (const Pair& pair : frame) touching += spheresOf(pair) == Verdict::Touching;
    }
    return summaryOf(verdicts, noun) + "; " + counted(int64_t(bodies), "tree") + ", "
        + counted(touching, "pair") + " touching";
}

std::vector<int64_t> numbersOf(const std::vector<SceneFrame>& frames)
{
    std::vector<int64_t> numbers;
    for (const SceneFrame& frame : frames) numbers.push_back(frame.number);
    return numbers;
}

/// The ways of all bodies from one frame to another.
std::vector<RigidMotion> motionsBetween(const SceneFrame& start, const SceneFrame& end)
{
    std::vector<RigidMotion> motions;
    for (std::size_t b = 0; b < start.poses.size(); ++b) {
        motions.push_back(RigidMotion::screw(start.poses[b], end.poses[b]));
    }
    return motions;
}

} // namespace

void giveSceneAnswers(const ActionCall& call, Session& session, const SceneBodies& bodies,
    const CollisionRequest& request)
{
    const QueryScene scene = sceneOf(call, session, bodies);
    const std::vector<SceneFrame> frames = framesOf(call, session, bodies);
    const auto named = [&](std::size_t i) { return "frame " + std::to_string(frames[i].number); };
    // Of one frame the pairs are asked in parallel, of several the frames.
    auto* const interrupter = frames.size() == 1 ? &session.progress : nullptr;
    const auto answers =
        answersOf<std::vector<ScenePair>>(frames.size(), named, session, [&](std::size_t i) {
            QueryScene placed = scene;
            for (int b = 0; b < placed.size(); ++b)
                placed.setPose(b, frames[i].poses[std::size_t(b)]);
            return placed.touchingPairs(request, interrupter);
        });
    const auto rows = rowsOfFrames(answers, [](const ScenePair& p) { return p.contacts.size(); });
    const std::vector<std::string> labels = labelsOf(session, bodies);
    const bool isNumbered = call.given("contacts");
    AnswerSheet sheet;
    sheet.format = "vdb_spheretree.scene.1";
    sheet.count = rows.size();
    sheet.columns = {"frame", "body_a", "body_b", "spheres", "objects", "distance", "x", "y", "z",
        "nx", "ny", "nz", "a", "b", "blocks"};
    if (isNumbered) sheet.columns.insert(sheet.columns.begin() + 5, "contact");
    sheet.row = [&](std::size_t row) {
        const SceneRow& at = rows[row];
        const ScenePair* const pair = pairAt(answers, at);
        Cells cells = pairCells(frames[at.frame], pair, labels);
        if (pair) {
            addPair(cells, *pair, at.contact, isNumbered, unitOf(call));
            return cells;
        }
        cells.insert(cells.end(), {nameOf(Verdict::Apart), nameOf(Verdict::Apart)});
        addNothing(cells, isNumbered ? 11 : 10);
        return cells;
    };
    const auto spheres = [](const ScenePair& pair) { return spheresOf(pair); };
    const Verdicts verdicts = worstOfFrames(answers, spheres);
    sheet.summary = sceneSummary(answers, verdicts, "frame", bodies.size());
    giveAnswers(call, session, sheet);
    const Verdicts asked = call.flag("objects") ? worstOfFrames(answers, objectsOf) : verdicts;
    requireExpected(call, asked, "frame", numbersOf(frames));
}

void giveSceneMotionAnswers(const ActionCall& call, Session& session, const SceneBodies& bodies)
{
    const QueryScene scene = sceneOf(call, session, bodies);
    std::vector<SceneFrame> frames = framesOf(call, session, bodies);
    if (frames.size() < 2) {
        throwInput(call.text("poses")
            + ": motion=1 of a scene goes from frame to frame, and the file holds one: give two "
              "or more, numbered by a column 'frame'");
    }
    const auto request = motionRequest(call);
    const std::size_t ways = frames.size() - 1;
    const auto named = [&](std::size_t i) {
        return "from frame " + std::to_string(frames[i].number) + " to the next";
    };
    auto* const interrupter = ways == 1 ? &session.progress : nullptr;
    const auto answers =
        answersOf<std::vector<MovingPair>>(ways, named, session, [&](std::size_t i) {
            return scene.firstContacts(
                motionsBetween(frames[i], frames[i + 1]), request, interrupter);
        });
    frames.pop_back(); // a way is called by the frame where it begins
    const auto rows = rowsOfFrames(answers, [](const MovingPair&) { return std::size_t(1); });
    const std::vector<std::string> labels = labelsOf(session, bodies);
    AnswerSheet sheet;
    sheet.format = "vdb_spheretree.scene_motion.1";
    sheet.count = rows.size();
    sheet.columns = {"frame", "body_a", "body_b", "spheres", "time", "free_until", "distance", "x",
        "y", "z", "nx", "ny", "nz", "a", "b", "blocks"};
    sheet.row = [&](std::size_t row) {
        const MovingPair* const pair = pairAt(answers, rows[row]);
        Cells cells = pairCells(frames[rows[row].frame], pair, labels);
        if (pair) {
            const Cells motion = motionCells(pair->result, unitOf(call));
            cells.insert(cells.end(), motion.begin(), motion.end());
            return cells;
        }
        cells.push_back(nameOf(Verdict::Apart));
        addNothing(cells, 12);
        return cells;
    };
    const auto spheres = [](const MovingPair& pair) { return spheresOf(pair); };
    const Verdicts verdicts = worstOfFrames(answers, spheres);
    sheet.summary = sceneSummary(answers, verdicts, "motion", bodies.size());
    giveAnswers(call, session, sheet);
    requireExpected(call, verdicts, "motion", numbersOf(frames));
}

} // namespace command
