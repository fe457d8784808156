// SPDX-License-Identifier: Apache-2.0
/// @file Query.cc
/// @brief Questions to a tree, in batches: arrays in, arrays out.

#include "Query.h"

#include "Call.h"
#include "Errors.h"
#include "ForbidNew.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>
#include <openvdb_spheretree/query/DigitalLeaves.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/RayQuery.h>
#include <openvdb_spheretree/query/RigidMotion.h>
#include <openvdb_spheretree/query/SphereDistances.h>

#include <openvdb/Exceptions.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;
using openvdb::Vec3d;
using spheretree::QueryTree;
using spheretree::RigidMotion;
using spheretree::RigidTransform;
using spheretree::Verdict;

Query::Query(const TreePtr& tree, const spheretree::QueryTreeSettings& settings)
    : mTree(spheretree::makeQueryTree(tree->get(), settings))
{
    try {
        mLeaves.emplace(tree->get(), settings);
    } catch (const openvdb::ValueError& error) {
        mWhyNoLeaves = spheretree::detail::messageOf(error);
    }
}

const spheretree::DigitalLeaves& Query::leaves() const
{
    if (!mLeaves) throw InputError("this tree cannot say what its object is: " + mWhyNoLeaves);
    return *mLeaves;
}

std::string PoseRows::rowName(std::size_t row) const
{
    if (bodies > 0 && size() > bodies) {
        return " of frame " + std::to_string(row / bodies) + ", body "
            + std::to_string(row % bodies);
    }
    if (bodies > 0) return " of body " + std::to_string(row);
    return size() > 1 ? " " + std::to_string(row) : "";
}

RigidTransform PoseRows::at(std::size_t row) const
{
    std::array<double, 16> matrix;
    std::copy_n(matrices.data() + 16 * row, 16, matrix.begin());
    try {
        return RigidTransform::fromMatrix(matrix);
    } catch (const openvdb::ValueError& error) {
        throw InputError(name + rowName(row) + ": " + spheretree::detail::messageOf(error));
    }
}

std::vector<RigidTransform> posesOf(const PoseRows& rows)
{
    std::vector<RigidTransform> poses;
    for (std::size_t i = 0; i < rows.size(); ++i) poses.push_back(rows.at(i));
    return poses;
}

std::vector<RigidMotion> motionsOf(const PoseRows& starts, const PoseRows& ends)
{
    std::vector<RigidMotion> motions;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const RigidTransform start = starts.at(i); // whose error comes first
        motions.push_back(RigidMotion::screw(start, ends.at(i)));
    }
    return motions;
}

int8_t numberOf(Verdict verdict)
{
    if (verdict == Verdict::Undecided) return 0;
    return verdict == Verdict::Touching ? 1 : -1;
}

void runQuestions(
    const CallSettings& call, std::size_t count, const std::function<void(Interrupter*)>& work)
{
    constexpr std::size_t kFew = 16;
    if (count <= kFew) runBriefly(call, work);
    else runCall(call, work);
}

ContactRows::ContactRows(std::size_t count)
    : distances(py::ssize_t(count)), points(rows<double>(count, 3)),
      normals(rows<double>(count, 3)), ids(rows<int32_t>(count, 2)),
      mDistance(distances.mutable_data()), mPoint(points.mutable_data()),
      mNormal(normals.mutable_data()), mId(ids.mutable_data())
{}

void ContactRows::set(std::size_t i, const std::optional<spheretree::Contact>& contact) const
{
    const Vec3d none(std::numeric_limits<double>::quiet_NaN());
    mDistance[i] = contact ? contact->distance : none[0];
    setRow(mPoint + 3 * i, contact ? contact->point() : none);
    setRow(mNormal + 3 * i, contact ? contact->normal : none);
    mId[2 * i] = contact ? contact->nodes.a : -1;
    mId[2 * i + 1] = contact ? contact->nodes.b : -1;
}

namespace {

using Floats = py::array_t<float, py::array::c_style>;

Vec3d vecAt(const double* numbers) { return Vec3d(numbers[0], numbers[1], numbers[2]); }

py::tuple collide(const Query& a, const Query& b, const Doubles& matrices, double margin,
    bool objects, const CallSettings& call)
{
    const auto poses = posesOf({"pose", matrices});
    spheretree::CollisionRequest request;
    request.securityMargin = margin;
    request.enableContact = true;
    request.decideObjects = objects;
    py::array_t<int8_t> spheres(py::ssize_t(poses.size())), certain(py::ssize_t(poses.size()));
    const ContactRows contacts(poses.size());
    int8_t *const sphere = spheres.mutable_data(), *const object = certain.mutable_data();
    runQuestions(call, poses.size(), [&](Interrupter* interrupter) {
        spheretree::detail::parallelFor(poses.size(), interrupter, [&](std::size_t i) {
            const auto result = spheretree::collide(a.tree(), {}, b.tree(), poses[i], request);
            sphere[i] = numberOf(result.verdict);
            object[i] = numberOf(result.objects);
            contacts.set(i, result.contact);
        });
    });
    return py::make_tuple(
        spheres, certain, contacts.distances, contacts.points, contacts.normals, contacts.ids);
}

/// @return up to @a maxContacts of each pose, the deepest first, and which pose each is of.
py::tuple contacts(const Query& a, const Query& b, const Doubles& matrices, int maxContacts,
    double margin, const CallSettings& call)
{
    const auto poses = posesOf({"pose", matrices});
    spheretree::CollisionRequest request;
    request.securityMargin = margin;
    request.maxContacts = contactsToAsk(maxContacts);
    std::vector<std::vector<spheretree::Contact>> found(poses.size());
    runQuestions(call, poses.size() * std::size_t(maxContacts), [&](Interrupter* interrupter) {
        spheretree::detail::parallelFor(poses.size(), interrupter, [&](std::size_t i) {
            spheretree::collide(a.tree(), {}, b.tree(), poses[i], request, &found[i]);
            keepDeepest(found[i], maxContacts);
        });
    });
    std::size_t count = 0;
    for (const auto& ofPose : found) count += ofPose.size();
    py::array_t<int64_t> numbers{py::ssize_t(count)};
    const ContactRows answers(count);
    std::size_t row = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (const spheretree::Contact& contact : found[i]) {
            numbers.mutable_data()[row] = int64_t(i);
            answers.set(row++, contact);
        }
    }
    return py::make_tuple(numbers, answers.distances, answers.points, answers.normals, answers.ids);
}

/// @param ways  poses where a starts and ends, and b: as many of each
py::tuple continuousCollide(const Query& a, const Query& b, const std::array<Doubles, 4>& ways,
    double margin, double tolerance, const CallSettings& call)
{
    const auto motionsA = motionsOf({"own_start", ways[0]}, {"own_end", ways[1]}),
               motionsB = motionsOf({"start", ways[2]}, {"end", ways[3]});
    spheretree::ContinuousCollisionRequest request;
    request.securityMargin = margin;
    request.tolerance = tolerance;
    py::array_t<double> times(py::ssize_t(motionsA.size()));
    const ContactRows contacts(motionsA.size());
    double* const time = times.mutable_data();
    runQuestions(call, motionsA.size(), [&](Interrupter* interrupter) {
        spheretree::detail::parallelFor(motionsA.size(), interrupter, [&](std::size_t i) {
            const auto result = spheretree::continuousCollide(
                a.tree(), motionsA[i], b.tree(), motionsB[i], request);
            time[i] =
                result.isCollide ? result.timeOfContact : std::numeric_limits<double>::quiet_NaN();
            contacts.set(i, result.contact);
        });
    });
    return py::make_tuple(
        times, contacts.distances, contacts.points, contacts.normals, contacts.ids);
}

py::tuple distance(const Query& a, const Query& b, const Doubles& matrices, bool isSigned,
    double upTo, const CallSettings& call)
{
    const auto poses = posesOf({"pose", matrices});
    spheretree::DistanceRequest request;
    request.enableSignedDistance = isSigned;
    request.upperBound = upTo;
    const auto count = py::ssize_t(poses.size());
    py::array_t<double> distances(count), lowers(count), uppers(count);
    auto pointsA = rows<double>(poses.size(), 3), pointsB = rows<double>(poses.size(), 3);
    auto ids = rows<int32_t>(poses.size(), 2);
    double *const found = distances.mutable_data(), *const lower = lowers.mutable_data(),
                  *const upper = uppers.mutable_data(), *const pointA = pointsA.mutable_data(),
                  *const pointB = pointsB.mutable_data();
    int32_t* const id = ids.mutable_data();
    runQuestions(call, poses.size(), [&](Interrupter* interrupter) {
        spheretree::detail::parallelFor(poses.size(), interrupter, [&](std::size_t i) {
            const auto result = spheretree::distance(a.tree(), {}, b.tree(), poses[i], request);
            const bool isThere = result.contact.has_value();
            const Vec3d none(std::numeric_limits<double>::quiet_NaN());
            found[i] = result.distance;
            lower[i] = result.objectsLower;
            upper[i] = result.objectsUpper;
            setRow(pointA + 3 * i, isThere ? result.contact->pointA : none);
            setRow(pointB + 3 * i, isThere ? result.contact->pointB : none);
            id[2 * i] = isThere ? result.contact->nodes.a : -1;
            id[2 * i + 1] = isThere ? result.contact->nodes.b : -1;
        });
    });
    return py::make_tuple(distances, lowers, uppers, pointsA, pointsB, ids);
}

py::array contains(const Query& query, const Doubles& points, const CallSettings& call)
{
    const auto& leaves = query.leaves();
    py::array_t<bool> inside(py::ssize_t(rowCount(points)));
    bool* const isInside = inside.mutable_data();
    const double* const point = points.data();
    runQuestions(call, rowCount(points), [&, count = rowCount(points)](Interrupter* interrupter) {
        spheretree::detail::parallelFor(count, interrupter, [&](std::size_t i) {
            isInside[i] = spheretree::contains(query.tree(), leaves, vecAt(point + 3 * i));
        });
    });
    return inside;
}

py::tuple nearest(
    const Query& query, const Doubles& points, double cutoff, const CallSettings& call)
{
    const std::size_t count = rowCount(points);
    py::array_t<double> distances{py::ssize_t(count)};
    auto gradients = rows<double>(count, 3);
    Ids ids{py::ssize_t(count)};
    double *const distance = distances.mutable_data(), *const gradient = gradients.mutable_data();
    int32_t* const id = ids.mutable_data();
    const double* const point = points.data();
    runQuestions(call, count, [&](Interrupter* interrupter) {
        spheretree::detail::parallelFor(count, interrupter, [&](std::size_t i) {
            const auto found = spheretree::nearest(query.tree(), vecAt(point + 3 * i), cutoff);
            distance[i] = found.distance;
            setRow(gradient + 3 * i, found.gradient);
            id[i] = found ? query.tree().nodeId(found.leaf) : -1;
        });
    });
    return py::make_tuple(distances, gradients, ids);
}

/// Rows of origins and directions, as many of both.
std::vector<spheretree::QueryRay> raysOf(
    const Doubles& origins, const Doubles& directions, double tFar, bool leavesStart)
{
    std::vector<spheretree::QueryRay> rays(rowCount(origins));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].origin = vecAt(origins.data() + 3 * i);
        rays[i].direction = vecAt(directions.data() + 3 * i);
        rays[i].tFar = tFar;
        rays[i].leavesStart = leavesStart;
    }
    return rays;
}

py::tuple intersect(const Query& query, const Doubles& origins, const Doubles& directions,
    double tFar, bool leavesStart, const CallSettings& call)
{
    const auto rays = raysOf(origins, directions, tFar, leavesStart);
    std::vector<spheretree::RayHit> hits(rays.size());
    runQuestions(call, rays.size(), [&](Interrupter* interrupter) {
        spheretree::intersect(query.tree(), rays.data(), rays.size(), hits.data(), interrupter);
    });
    py::array_t<double> times{py::ssize_t(rays.size())};
    Ids ids{py::ssize_t(rays.size())};
    for (std::size_t i = 0; i < hits.size(); ++i) {
        times.mutable_data()[i] = hits[i].t;
        ids.mutable_data()[i] = hits[i] ? query.tree().nodeId(hits[i].leaf) : -1;
    }
    return py::make_tuple(times, ids);
}

py::array occluded(const Query& query, const Doubles& origins, const Doubles& directions,
    double tFar, bool leavesStart, const CallSettings& call)
{
    const auto rays = raysOf(origins, directions, tFar, leavesStart);
    py::array_t<bool> blocked{py::ssize_t(rays.size())};
    static_assert(sizeof(bool) == 1, "a bool of numpy is a byte");
    auto* const isBlocked = reinterpret_cast<uint8_t*>(blocked.mutable_data());
    runQuestions(call, rays.size(), [&](Interrupter* interrupter) {
        spheretree::occluded(query.tree(), rays.data(), rays.size(), isBlocked, interrupter);
    });
    return blocked;
}

py::tuple sphereDistances(
    const Query& query, const Floats& spheres, float activation, const CallSettings& call)
{
    const std::size_t count = rowCount(spheres);
    py::array_t<float> distances{py::ssize_t(count)};
    auto gradients = rows<float>(count, 3);
    Ids ids{py::ssize_t(count)};
    const spheretree::SphereDistanceArrays results{
        distances.mutable_data(), gradients.mutable_data(), ids.mutable_data()};
    const float* const from = spheres.data();
    runQuestions(call, count, [&](Interrupter* interrupter) {
        spheretree::sphereDistances(query.tree(), from, count, activation, results, interrupter);
        for (std::size_t i = 0; i < count; ++i) {
            if (results.leaf[i] >= 0) results.leaf[i] = query.tree().nodeId(results.leaf[i]);
        }
    });
    return py::make_tuple(distances, gradients, ids);
}

} // namespace

void bindQuery(py::module_& module)
{
    py::class_<Query, QueryPtr> query(module, "Query");
    forbidNew(query);
    module.def("make_query", [](const TreePtr& tree, bool exact, int level, double scale) {
        spheretree::QueryTreeSettings settings;
        if (exact) settings.exactness = spheretree::Exactness::LeafUnion;
        settings.level = level;
        settings.scale = scale;
        return std::make_shared<Query>(tree, settings);
    });
    query.def_property_readonly("leaf_count", [](const Query& q) { return q.tree().leafCount(); })
        .def("collide",
            [](const Query& a, const Query& b, const Doubles& poses, double margin, bool objects,
                const py::object& progress, int threads) {
                return collide(a, b, poses, margin, objects, CallSettings{progress, threads});
            })
        .def("contacts",
            [](const Query& a, const Query& b, const Doubles& poses, int maxContacts, double margin,
                const py::object& progress, int threads) {
                return contacts(a, b, poses, maxContacts, margin, CallSettings{progress, threads});
            })
        .def("continuous_collide",
            [](const Query& a, const Query& b, const Doubles& startA, const Doubles& endA,
                const Doubles& startB, const Doubles& endB, double margin, double tolerance,
                const py::object& progress, int threads) {
                return continuousCollide(a, b, {startA, endA, startB, endB}, margin, tolerance,
                    CallSettings{progress, threads});
            })
        .def("distance",
            [](const Query& a, const Query& b, const Doubles& poses, bool isSigned, double upTo,
                const py::object& progress, int threads) {
                return distance(a, b, poses, isSigned, upTo, CallSettings{progress, threads});
            })
        .def("contains",
            [](const Query& q, const Doubles& points, const py::object& progress, int threads) {
                return contains(q, points, CallSettings{progress, threads});
            })
        .def("nearest",
            [](const Query& q, const Doubles& points, double cutoff, const py::object& progress,
                int threads) {
                return nearest(q, points, cutoff, CallSettings{progress, threads});
            })
        .def("intersect",
            [](const Query& q, const Doubles& origins, const Doubles& directions, double tFar,
                bool leavesStart, const py::object& progress, int threads) {
                return intersect(
                    q, origins, directions, tFar, leavesStart, CallSettings{progress, threads});
            })
        .def("occluded",
            [](const Query& q, const Doubles& origins, const Doubles& directions, double tFar,
                bool leavesStart, const py::object& progress, int threads) {
                return occluded(
                    q, origins, directions, tFar, leavesStart, CallSettings{progress, threads});
            })
        .def("sphere_distances",
            [](const Query& q, const Floats& spheres, float activation, const py::object& progress,
                int threads) {
                return sphereDistances(q, spheres, activation, CallSettings{progress, threads});
            });
}

} // namespace binding
