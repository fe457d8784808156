// SPDX-License-Identifier: Apache-2.0
/// @file Query.cc
/// @brief Questions to a tree, in batches: arrays in, arrays out. Shapes and types are made sure of by _query.py.

#include "Call.h"
#include "Errors.h"
#include "ForbidNew.h"
#include "Tree.h"

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

namespace {

using Doubles = py::array_t<double, py::array::c_style>;
using Floats = py::array_t<float, py::array::c_style>;
using Ids = py::array_t<int32_t>;

/// A tree made ready, and its digital balls where they are the object.
class Query {
public:
    Query(const TreePtr& tree, const spheretree::QueryTreeSettings& settings)
        : mTree(spheretree::makeQueryTree(tree->get(), settings))
    {
        try {
            mLeaves.emplace(tree->get(), settings);
        } catch (const openvdb::ValueError& error) {
            mWhyNoLeaves = spheretree::detail::messageOf(error);
        }
    }

    const QueryTree& tree() const { return mTree; }
    /// @throw InputError where the object is not known
    const spheretree::DigitalLeaves& leaves() const
    {
        if (!mLeaves) throw InputError("this tree cannot say what its object is: " + mWhyNoLeaves);
        return *mLeaves;
    }

private:
    QueryTree mTree;
    std::optional<spheretree::DigitalLeaves> mLeaves;
    std::string mWhyNoLeaves;
};

using QueryPtr = std::shared_ptr<Query>;

std::size_t rowCount(const py::array& array) { return std::size_t(array.shape(0)); }

template <typename T>
py::array_t<T> rows(std::size_t count, int columns)
{
    return py::array_t<T>({py::ssize_t(count), py::ssize_t(columns)});
}

Vec3d vecAt(const double* numbers) { return Vec3d(numbers[0], numbers[1], numbers[2]); }

template <typename T>
void setRow(T* to, const Vec3d& vec)
{
    for (int axis = 0; axis < 3; ++axis) to[axis] = T(vec[axis]);
}

/// Rows of 16 numbers.
std::vector<RigidTransform> posesOf(const Doubles& matrices)
{
    std::vector<RigidTransform> poses;
    const double* from = matrices.data();
    for (std::size_t i = 0; i < rowCount(matrices); ++i, from += 16) {
        std::array<double, 16> matrix;
        std::copy(from, from + 16, matrix.begin());
        poses.push_back(RigidTransform::fromMatrix(matrix));
    }
    return poses;
}

/// -1 is apart, 1 touching, 0 undecided.
int8_t numberOf(Verdict verdict)
{
    if (verdict == Verdict::Undecided) return 0;
    return verdict == Verdict::Touching ? 1 : -1;
}

/// Where two spheres meet, a question a row: numbers are NaN and ids -1 where none do.
class ContactRows {
public:
    explicit ContactRows(std::size_t count)
        : distances(py::ssize_t(count)), points(rows<double>(count, 3)),
          normals(rows<double>(count, 3)), ids(rows<int32_t>(count, 2)),
          mDistance(distances.mutable_data()), mPoint(points.mutable_data()),
          mNormal(normals.mutable_data()), mId(ids.mutable_data())
    {}

    /// Without the GIL; rows may be set at the same time.
    void set(std::size_t i, const std::optional<spheretree::Contact>& contact) const
    {
        const Vec3d none(std::numeric_limits<double>::quiet_NaN());
        mDistance[i] = contact ? contact->distance : none[0];
        setRow(mPoint + 3 * i, contact ? contact->point() : none);
        setRow(mNormal + 3 * i, contact ? contact->normal : none);
        mId[2 * i] = contact ? contact->nodes.a : -1;
        mId[2 * i + 1] = contact ? contact->nodes.b : -1;
    }

    py::array_t<double> distances, points, normals;
    Ids ids;

private:
    double *mDistance, *mPoint, *mNormal;
    int32_t* mId;
};

py::tuple collide(const Query& a, const Query& b, const Doubles& matrices, double margin,
    bool objects, const CallSettings& call)
{
    const auto poses = posesOf(matrices);
    spheretree::CollisionRequest request;
    request.securityMargin = margin;
    request.enableContact = true;
    request.decideObjects = objects;
    py::array_t<int8_t> spheres(py::ssize_t(poses.size())), certain(py::ssize_t(poses.size()));
    const ContactRows contacts(poses.size());
    int8_t *const sphere = spheres.mutable_data(), *const object = certain.mutable_data();
    runCall(call, [&](Interrupter* interrupter) {
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

/// The screws from pose to pose, a row each.
std::vector<RigidMotion> motionsOf(const Doubles& starts, const Doubles& ends)
{
    const auto from = posesOf(starts), to = posesOf(ends);
    std::vector<RigidMotion> motions;
    for (std::size_t i = 0; i < from.size(); ++i) {
        motions.push_back(RigidMotion::screw(from[i], to[i]));
    }
    return motions;
}

/// @param ways  poses where a starts and ends, and b: as many of each
py::tuple continuousCollide(const Query& a, const Query& b, const std::array<Doubles, 4>& ways,
    double tolerance, const CallSettings& call)
{
    const auto motionsA = motionsOf(ways[0], ways[1]), motionsB = motionsOf(ways[2], ways[3]);
    spheretree::ContinuousCollisionRequest request;
    request.tolerance = tolerance;
    py::array_t<double> times(py::ssize_t(motionsA.size()));
    const ContactRows contacts(motionsA.size());
    double* const time = times.mutable_data();
    runCall(call, [&](Interrupter* interrupter) {
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
    const auto poses = posesOf(matrices);
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
    runCall(call, [&](Interrupter* interrupter) {
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
    runCall(call, [&, count = rowCount(points)](Interrupter* interrupter) {
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
    runCall(call, [&](Interrupter* interrupter) {
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
    runCall(call, [&](Interrupter* interrupter) {
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
    runCall(call, [&](Interrupter* interrupter) {
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
    runCall(call, [&](Interrupter* interrupter) {
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
        .def("continuous_collide",
            [](const Query& a, const Query& b, const Doubles& startA, const Doubles& endA,
                const Doubles& startB, const Doubles& endB, double tolerance,
                const py::object& progress, int threads) {
                return continuousCollide(
                    a, b, {startA, endA, startB, endB}, tolerance, CallSettings{progress, threads});
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
