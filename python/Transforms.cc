// SPDX-License-Identifier: Apache-2.0
/// @file Transforms.cc
/// @brief The distance transform, the medial axis and the pyramid of a volume, as arrays and volumes.

#include "Call.h"
#include "DenseArray.h"
#include "Errors.h"
#include "Tree.h"
#include "Volume.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/medial/DistanceTransform.h>
#include <openvdb_spheretree/medial/MedialAxis.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/TopologyCopy.h>

#include <openvdb/math/Maps.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;

namespace {

/// @param scale  world units a voxel; 0: squared distances, as integers
py::array distanceTransform(const Volume& volume, int dim, double scale, const CallSettings& call)
{
    const auto distances = resultOfCall(call, [&](Interrupter* interrupter) {
        return spheretree::distanceTransform(*volume.object, dim, {}, interrupter);
    });
    if (scale == 0) {
        py::array array = zerosFor(volume, "int32");
        fillDense<int32_t>(volume, array, distances->tree(), [](int32_t sq) { return sq; });
        return array;
    }
    py::array array = zerosFor(volume, "float32");
    fillDense<float>(volume, array, distances->tree(),
        [scale](int32_t sq) { return scale * std::sqrt(double(sq)); });
    return array;
}

std::pair<py::array, py::array> medialAxis(const Volume& volume, int dim, const CallSettings& call)
{
    const auto balls = resultOfCall(call, [&](Interrupter* interrupter) {
        return spheretree::medialBalls(*volume.object, dim, {}, interrupter);
    });
    const int axes = volume.flat ? 2 : 3;
    py::array_t<int32_t> points({py::ssize_t(balls.size()), py::ssize_t(axes)});
    py::array_t<int32_t> radii(py::ssize_t(balls.size()));
    int32_t *point = points.mutable_data(), *radius = radii.mutable_data();
    for (const auto& ball : balls) {
        for (int i = 0; i < axes; ++i) {
            *point++ = ball.center[volume.reversed ? axes - 1 - i : i];
        }
        *radius++ = ball.radiusSq;
    }
    return {points, radii};
}

/// Voxel v of a level is the block scale v + [0, scale - 1] + origin of the volume's voxels, but along a
/// flat axis, which does not coarsen.
openvdb::math::Transform::Ptr transformOfLevel(
    const Volume& volume, double scale, const openvdb::Coord& origin, int flatAxis)
{
    openvdb::Vec3d scales(scale);
    if (flatAxis >= 0) scales[flatAxis] = 1;
    openvdb::Mat4d matrix = volume.object->transform().baseMap()->getAffineMap()->getMat4();
    matrix.preTranslate(origin.asVec3d() + 0.5 * (scales - openvdb::Vec3d(1)));
    matrix.preScale(scales);
    return openvdb::math::Transform::createLinearTransform(matrix);
}

std::vector<std::shared_ptr<Volume>> pyramid(
    const Volume& volume, int factor, int dim, const CallSettings& call)
{
    const auto levels = resultOfCall(call, [&](Interrupter* interrupter) {
        return spheretree::buildOrPyramid(*volume.object, factor, dim, {}, interrupter);
    });
    const int flatAxis =
        dim == 2 ? spheretree::flatAxisOf(volume.object->evalActiveVoxelBoundingBox()) : -1;
    std::vector<std::shared_ptr<Volume>> volumes;
    double scale = 1;
    for (std::size_t k = 0; k < levels.levels.size(); ++k, scale *= factor) {
        auto level = std::make_shared<Volume>(volume);
        volumes.push_back(level);
        if (k == 0) continue;
        const auto object = openvdb::BoolGrid::create(
            spheretree::detail::copyTopology<openvdb::BoolTree>(*levels.levels[k], nullptr));
        object->setName(volume.object->getName());
        object->setTransform(transformOfLevel(volume, scale, levels.origin, flatAxis));
        level->object = object;
        level->box = object->evalActiveVoxelBoundingBox();
    }
    return volumes;
}

} // namespace

py::array zerosFor(const Volume& volume, const char* dtype)
{
    double bytes = double(py::dtype(dtype).itemsize());
    for (const py::ssize_t side : volume.shape()) bytes *= double(side);
    spheretree::detail::requireMemory(bytes, "the dense array of the volume's box",
        "sparse objects have coordinates() and medial_axis()");
    return py::module_::import("numpy").attr("zeros")(volume.shape(), dtype);
}

void bindTransforms(py::module_& module)
{
    module.def("distance_transform",
        [](const Volume& volume, int dim, double scale, const py::object& progress, int threads) {
            return distanceTransform(volume, dim, scale, {progress, threads});
        });
    module.def(
        "medial_axis", [](const Volume& volume, int dim, const py::object& progress, int threads) {
            return medialAxis(volume, dim, {progress, threads});
        });
    module.def("pyramid",
        [](const Volume& volume, int factor, int dim, const py::object& progress, int threads) {
            return pyramid(volume, factor, dim, {progress, threads});
        });
}

} // namespace binding
