// SPDX-License-Identifier: Apache-2.0
/// @file MeshFile.cc
/// @brief Reader of mesh files.
///
/// 1. Polygons of the file: OBJ, OFF, PLY, STL by MeshFormats.h, which says why; others by
///    AssimpReader.h.
/// 2. toTriangles(): polygons cut up, points at the same place joined, what is unused dropped.

#include "MeshFile.h"

#include "AssimpReader.h"
#include "MeshFormats.h"
#include "Polygon.h"
#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/base/InterruptSteps.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <new>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace {

using detail::PolygonSoup;
using openvdb::IoError;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::util::NullInterrupter;

[[noreturn]] void fail(const std::string& path, const std::string& what)
{
    throw IoError(path + ": " + what);
}

void needRegularFile(const std::string& path, const std::string& name)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail(name, "no such file");
    if (std::filesystem::is_directory(status)) fail(name, "is a directory, not a mesh file");
    if (!std::filesystem::is_regular_file(status)) fail(name, "is not a regular file");
    if (std::filesystem::file_size(path, error) == 0) fail(name, "the file is empty");
}

/// @throw IoError without the name of the file, std::ios_base::failure with the system's reason
std::string contentsOf(const std::string& path, NullInterrupter* interrupter)
{
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw IoError("cannot be read: " + error.message());
    std::ifstream file(path, std::ios::binary);
    if (!file) throw IoError("cannot be opened for reading");
    file.exceptions(std::ios::badbit);         // otherwise the system's reason is lost
    constexpr std::uintmax_t kPiece = 1 << 24; // some milliseconds
    std::string bytes;
    bytes.reserve(size);
    while (bytes.size() < size) {
        detail::checkInterrupt(interrupter);
        const std::size_t begin = bytes.size();
        bytes.resize(std::min(size, begin + kPiece));
        file.read(&bytes[begin], static_cast<std::streamsize>(bytes.size() - begin));
        const std::uintmax_t end = begin + static_cast<std::uintmax_t>(file.gcount());
        if (end == bytes.size()) continue;
        throw IoError("ends after " + std::to_string(end) + " of its " + std::to_string(size)
            + " bytes: it was cut while it was read");
    }
    return bytes;
}

/// A point in steps of the coordinates' rounding.
using Place = std::array<int64_t, 3>;

struct PlaceHash {
    std::size_t operator()(const Place& place) const
    {
        std::uint64_t hash = 0;
        for (const int64_t step : place) hash = detail::hash(hash ^ std::uint64_t(step));
        return static_cast<std::size_t>(hash);
    }
};

/// @return 2^-36 of the largest coordinate along each axis: what programs that compute a corner in several ways differ
/// by is less, and what a mesh shows is more.
Vec3d roundingOf(const std::vector<Vec3d>& points)
{
    Vec3d largest(0);
    for (const Vec3d& point : points) {
        for (int axis = 0; axis < 3; ++axis) {
            largest[axis] = std::max(largest[axis], std::abs(point[axis]));
        }
    }
    return 0x1p-36 * largest;
}

/// Joins points that are the same but for rounding, drops triangles that this makes a line or a point, and keeps the points
/// that are left in use, in order of their first use.
void weld(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, TriangleMesh& mesh,
    detail::InterruptSteps& steps)
{
    const Vec3d rounding = roundingOf(points);
    const auto placeOf = [&](const Vec3d& point) {
        Place place{};
        for (int axis = 0; axis < 3; ++axis) {
            const double step = rounding[axis];
            if (step > 0) place[std::size_t(axis)] = std::llround(point[axis] / step);
        }
        return place;
    };
    std::unordered_map<Place, std::uint32_t, PlaceHash> numbers;
    numbers.reserve(points.size());
    for (const Vec3I& triangle : triangles) {
        steps.add();
        Place places[3];
        for (int i = 0; i < 3; ++i) places[i] = placeOf(points[triangle[i]]);
        if (places[0] == places[1] || places[1] == places[2] || places[2] == places[0]) continue;
        Vec3I joined;
        for (int i = 0; i < 3; ++i) {
            const auto number = std::uint32_t(mesh.points.size());
            const auto [it, isNew] = numbers.try_emplace(places[i], number);
            if (isNew) mesh.points.push_back(points[triangle[i]] + Vec3d(0)); // -0 becomes 0
            joined[i] = it->second;
        }
        mesh.triangles.push_back(joined);
    }
}

TriangleMesh toTriangles(const PolygonSoup& soup, NullInterrupter* interrupter)
{
    detail::InterruptSteps steps(interrupter);
    std::vector<Vec3I> triangles;
    std::vector<std::uint32_t> corners;
    auto at = soup.corners.begin();
    for (const std::uint32_t count : soup.counts) {
        corners.assign(at, at + count);
        at += count;
        detail::triangulate(soup.points, corners, triangles, steps);
    }
    TriangleMesh mesh;
    if (triangles.empty()) throw IoError("the file holds no triangle");
    weld(soup.points, triangles, mesh, steps);
    if (mesh.triangles.empty())
        throw IoError("the file holds no triangle but those with two corners at one place");
    return mesh;
}

} // namespace

bool readsOtherMeshFormats() { return detail::hasAssimp(); }

bool isMeshFileName(const std::string& path)
{
    const std::string extension = detail::lowerExtension(path);
    return detail::isStrictFormat(extension) || detail::assimpKnows(extension);
}

TriangleMesh readMeshFile(
    const std::string& path, const std::string& shownAs, NullInterrupter* interrupter)
{
    const std::string& name = shownAs.empty() ? path : shownAs;
    needRegularFile(path, name);
    const std::string extension = detail::lowerExtension(name);
    TriangleMesh mesh;
    try {
        mesh = toTriangles(detail::isStrictFormat(extension)
                ? detail::parseMesh(extension, contentsOf(path, interrupter), interrupter)
                : detail::readByAssimp(path, interrupter),
            interrupter);
    } catch (const std::bad_alloc&) {
        fail(name, "not enough memory for the mesh");
    } catch (const std::ios_base::failure& error) {
        fail(name, "cannot be read: " + error.code().message());
    } catch (const openvdb::Exception& error) {
        fail(name, detail::messageOf(error));
    }
    mesh.name = std::filesystem::path(name).stem().string();
    return mesh;
}

} // namespace openvdb_spheretree
