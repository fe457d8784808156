// SPDX-License-Identifier: Apache-2.0
#include "SceneFrames.h"

#include "base/Errors.h"

#include <algorithm>
#include <cstddef>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::BodyPose;
using spheretree::QueryScene;
using spheretree::RigidTransform;
using Pair = std::pair<std::string, std::string>;

namespace {

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
int bodyOf(Session& session, const SceneBodies& bodies, const std::string& ageOrName)
{
    const StackItem& item = session.stack.selectTree(ageOrName);
    const auto isIt = [&](const QueryBody& body) { return body.spheres == item.tree.get(); };
    const auto found = std::find_if(bodies.begin(), bodies.end(), isIt);
    if (found == bodies.end()) {
        throwInput(item.description() + " is not in the scene: vdb= chooses others");
    }
    return int(found - bodies.begin());
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
    for (const char* other : {"translate", "rotate", "axis", "angle", "matrix", "scale"}) {
        if (call.given(other)) {
            throwUsage(std::string("scene and ") + other
                + " exclude each other: poses= places the trees of a scene");
        }
    }
    for (const std::string& typed : call.list("ignore")) pairOf(typed);
    if (call.flag("motion") && !call.given("poses")) {
        throwUsage(
            "motion=1 of a scene needs poses=: a table with the frames that bodies go between");
    }
    checkQuestion(call, plan, kAnyTrees, "poses", "frame,body_a");
    checkTable(call, plan, "poses", {});
}

QueryScene sceneOf(const ActionCall& call, Session& session, const SceneBodies& bodies)
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

std::vector<SceneFrame> framesOf(
    const ActionCall& call, Session& session, const SceneBodies& bodies)
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

std::vector<std::string> labelsOf(const Session& session, const SceneBodies& bodies)
{
    std::vector<const StackItem*> items;
    std::vector<std::string> ages;
    for (const QueryBody& body : bodies) {
        int age = 0;
        auto item = session.stack.items().rbegin();
        for (; (*item)->tree.get() != body.spheres; ++item) age += (*item)->mesh ? 0 : 1;
        items.push_back(item->get());
        ages.push_back(std::to_string(age));
    }
    std::vector<std::string> labels = distinctNames(items);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i].empty()) labels[i] = ages[i];
    }
    return labels;
}

} // namespace command
