// SPDX-License-Identifier: Apache-2.0
/// @file Scene.cc
/// @brief Many bodies, and which of them touch. Shapes and types are made sure of by _scene.py.

#include "Query.h"

#include "Call.h"
#include "ForbidNew.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>
#include <openvdb_spheretree/query/QueryScene.h>

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;
using spheretree::QueryScene;

namespace {

using ScenePtr = std::shared_ptr<QueryScene>;

/// What is known of two bodies at the same time, a pair a row.
struct PairRows {
    explicit PairRows(std::size_t count)
        : frames(py::ssize_t(count)), bodies(rows<int32_t>(count, 2)), contacts(count),
          mFrame(frames.mutable_data()), mBody(bodies.mutable_data())
    {}

    void add(std::size_t frame, int a, int b, const std::optional<spheretree::Contact>& contact)
    {
        mFrame[mRow] = int64_t(frame);
        mBody[2 * mRow] = a;
        mBody[2 * mRow + 1] = b;
        contacts.set(mRow++, contact);
    }

    py::array_t<int64_t> frames;
    Ids bodies;
    ContactRows contacts;

private:
    int64_t* mFrame;
    int32_t* mBody;
    std::size_t mRow = 0;
};

py::array poseOf(const QueryScene& scene, int body)
{
    const spheretree::RigidTransform& pose = scene.pose(body);
    auto matrix = rows<double>(4, 4);
    double* const to = matrix.mutable_data();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            to[4 * row + column] = pose.rotation()(row, column);
        to[4 * row + 3] = pose.translation()[row];
        to[12 + row] = 0;
    }
    to[15] = 1;
    return matrix;
}

/// Where all bodies of a scene are, frame by frame.
class FramePoses {
public:
    /// @param name      of the argument
    /// @param matrices  None: one frame, as the scene is; else poses, of which those of bodies that were removed may be
    ///                  anything
    FramePoses(const QueryScene& scene, const char* name, const py::object& matrices)
        : mBodies(std::size_t(scene.size()))
    {
        if (matrices.is_none()) {
            for (int body = 0; body < scene.size(); ++body)
                mPoses.push_back(scene.has(body) ? scene.pose(body) : spheretree::RigidTransform());
            return;
        }
        const auto numbers = matrices.cast<Doubles>();
        const PoseRows rows{name, numbers, mBodies};
        for (std::size_t row = 0; row < rows.size(); ++row) {
            const bool isThere = scene.has(int(row % mBodies));
            mPoses.push_back(isThere ? rows.at(row) : spheretree::RigidTransform());
        }
    }

    std::size_t frames() const { return mBodies == 0 ? 0 : mPoses.size() / mBodies; }
    /// Where there is one frame, it is that of all.
    const spheretree::RigidTransform& at(std::size_t frame, int body) const
    {
        return mPoses[(frames() == 1 ? 0 : frame) * mBodies + std::size_t(body)];
    }

private:
    std::size_t mBodies;
    std::vector<spheretree::RigidTransform> mPoses;
};

/// @return the scene with all bodies where they are in a frame.
QueryScene placed(QueryScene scene, const FramePoses& poses, std::size_t frame)
{
    for (int body = 0; body < scene.size(); ++body) {
        if (scene.has(body)) scene.setPose(body, poses.at(frame, body));
    }
    return scene;
}

/// @param each  what is asked for of two bodies
/// @return how much there is to do, by the number of bodies.
std::size_t questionCount(const QueryScene& scene, std::size_t frames, int each = 1)
{
    return frames * std::size_t(scene.size()) * std::size_t(std::max(each, 1));
}

/// @return the deepest ones, or the one that was found.
std::vector<spheretree::Contact> contactsOf(const spheretree::ScenePair& pair, bool areSeveral)
{
    if (areSeveral) return pair.contacts;
    return {*pair.result.contact};
}

/// @param scene        a copy: another thread may change the one that is asked
/// @param maxContacts  0: any one of each pair
py::tuple touchingPairs(const QueryScene scene, const FramePoses& poses, double margin,
    bool objects, int maxContacts, const CallSettings& call)
{
    spheretree::CollisionRequest request;
    request.securityMargin = margin;
    request.decideObjects = objects;
    request.enableContact = true;
    if (maxContacts > 0) request.maxContacts = contactsToAsk(maxContacts);
    std::vector<std::vector<spheretree::ScenePair>> found(poses.frames());
    runQuestions(
        call, questionCount(scene, found.size(), maxContacts), [&](Interrupter* interrupter) {
            spheretree::detail::parallelFor(found.size(), interrupter, [&](std::size_t frame) {
                found[frame] = placed(scene, poses, frame).touchingPairs(request, interrupter);
                for (auto& pair : found[frame]) keepDeepest(pair.contacts, maxContacts);
            });
        });
    std::size_t count = 0;
    for (const auto& pairs : found) {
        for (const auto& pair : pairs) count += maxContacts > 0 ? pair.contacts.size() : 1;
    }
    PairRows answers(count);
    py::array_t<int8_t> certain{py::ssize_t(count)};
    int8_t* object = certain.mutable_data();
    for (std::size_t frame = 0; frame < found.size(); ++frame) {
        for (const spheretree::ScenePair& pair : found[frame]) {
            for (const spheretree::Contact& contact : contactsOf(pair, maxContacts > 0)) {
                answers.add(frame, pair.a, pair.b, contact);
                *object++ = numberOf(pair.result.objects);
            }
        }
    }
    const ContactRows& contacts = answers.contacts;
    return py::make_tuple(answers.frames, answers.bodies, certain, contacts.distances,
        contacts.points, contacts.normals, contacts.ids);
}

/// @return the ways of all bodies in a frame.
std::vector<spheretree::RigidMotion> waysOf(
    const QueryScene& scene, const FramePoses& starts, const FramePoses& ends, std::size_t frame)
{
    std::vector<spheretree::RigidMotion> ways;
    for (int body = 0; body < scene.size(); ++body) {
        ways.push_back(
            spheretree::RigidMotion::screw(starts.at(frame, body), ends.at(frame, body)));
    }
    return ways;
}

/// @param scene  a copy, as above
py::tuple firstContacts(const QueryScene scene, const FramePoses& starts, const FramePoses& ends,
    double margin, double tolerance, const CallSettings& call)
{
    spheretree::ContinuousCollisionRequest request;
    request.securityMargin = margin;
    request.tolerance = tolerance;
    std::vector<std::vector<spheretree::MovingPair>> found(ends.frames());
    runQuestions(call, questionCount(scene, found.size()), [&](Interrupter* interrupter) {
        spheretree::detail::parallelFor(found.size(), interrupter, [&](std::size_t frame) {
            const auto ways = waysOf(scene, starts, ends, frame);
            found[frame] = scene.firstContacts(ways, request, interrupter);
        });
    });
    std::size_t count = 0;
    for (const auto& pairs : found) count += pairs.size();
    PairRows answers(count);
    py::array_t<double> times{py::ssize_t(count)};
    double* time = times.mutable_data();
    for (std::size_t frame = 0; frame < found.size(); ++frame) {
        for (const spheretree::MovingPair& pair : found[frame]) {
            answers.add(frame, pair.a, pair.b, pair.result.contact);
            *time++ = pair.result.timeOfContact;
        }
    }
    const ContactRows& contacts = answers.contacts;
    return py::make_tuple(answers.frames, answers.bodies, times, contacts.distances,
        contacts.points, contacts.normals, contacts.ids);
}

} // namespace

void bindScene(py::module_& module)
{
    py::class_<QueryScene, ScenePtr> scene(module, "Scene");
    forbidNew(scene);
    module.def("make_scene", [] { return std::make_shared<QueryScene>(); });
    scene.def_property_readonly("size", &QueryScene::size)
        .def("add",
            [](QueryScene& s, const Query& body, const Doubles& pose) {
                return s.add(body.tree(), PoseRows{"pose", pose}.at(0));
            })
        .def("remove", &QueryScene::remove)
        .def("pose", poseOf)
        .def("set_pose",
            [](QueryScene& s, int body, const Doubles& pose) {
                s.setPose(body, PoseRows{"pose", pose}.at(0));
            })
        .def("ignore", &QueryScene::ignore)
        .def("is_ignored", &QueryScene::isIgnored)
        .def("touching_pairs",
            [](const QueryScene& s, const py::object& poses, double margin, bool objects,
                int maxContacts, const py::object& progress, int threads) {
                return touchingPairs(s, FramePoses(s, "poses", poses), margin, objects, maxContacts,
                    CallSettings{progress, threads});
            })
        .def("first_contacts",
            [](const QueryScene& s, const py::object& starts, const py::object& ends, double margin,
                double tolerance, const py::object& progress, int threads) {
                return firstContacts(s, FramePoses(s, "start", starts), FramePoses(s, "end", ends),
                    margin, tolerance, CallSettings{progress, threads});
            });
}

} // namespace binding
