// SPDX-License-Identifier: Apache-2.0
#include "Volume.h"

#include "Call.h"
#include "DenseArray.h"
#include "Errors.h"
#include "ForbidNew.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/input/Resample.h>
#include <openvdb_spheretree/input/array/ArrayFile.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/TopologyCopy.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;
using openvdb_spheretree::Coverage;
using openvdb_spheretree::NumberType;
using openvdb_spheretree::ValueBound;

namespace {

// ---- Arguments

NumberType typeOf(const py::array& array)
{
    const std::string kind = py::str(array.dtype().attr("kind"));
    const auto size = array.itemsize();
    if (kind == "b") return NumberType::Bool;
    if (kind == "i" && size <= 8) {
        return size == 1 ? NumberType::Int8
            : size == 2  ? NumberType::Int16
            : size == 4  ? NumberType::Int32
                         : NumberType::Int64;
    }
    if (kind == "u" && size <= 8) {
        return size == 1 ? NumberType::UInt8
            : size == 2  ? NumberType::UInt16
            : size == 4  ? NumberType::UInt32
                         : NumberType::UInt64;
    }
    if (kind == "f" && (size == 4 || size == 8)) {
        return size == 4 ? NumberType::Float32 : NumberType::Float64;
    }
    throw InputError("volume is of dtype " + std::string(py::str(array.dtype()))
        + ": it must be bool, an integer of 8 to 64 bits, float32 or float64; volume.astype() "
          "converts it");
}

/// Along x, y and z, whichever order the array has. Of a flat array z is one voxel.
VoxelArray viewOf(const py::array& array, bool reversed)
{
    if (array.ndim() != 2 && array.ndim() != 3) {
        throw InputError("volume has " + std::to_string(array.ndim())
            + (array.ndim() == 1 ? " axis" : " axes") + ": it must have three, or two for dim=2");
    }
    VoxelArray view;
    view.type = typeOf(array);
    if (!py::cast<bool>(array.dtype().attr("isnative"))) {
        throw InputError("volume has the byte order of other machines: "
                         "volume.astype(volume.dtype.newbyteorder(\"=\")) converts it");
    }
    view.data = static_cast<const char*>(array.data());
    view.shape.fill(1);
    for (py::ssize_t i = 0; i < array.ndim(); ++i) {
        const auto axis = std::size_t(reversed ? array.ndim() - 1 - i : i);
        view.shape[axis] = array.shape(i);
        view.stride[axis] = array.strides(i);
        constexpr int64_t kLongest = int64_t(1) << 28;
        if (view.shape[axis] <= kLongest) continue;
        throw InputError("volume has an axis of " + std::to_string(view.shape[axis])
            + " voxels: at most 2^28 are allowed");
    }
    return view;
}

/// Integers keep all of their digits.
ValueBound boundOf(const py::handle& value)
{
    if (py::isinstance<py::int_>(value)) return ValueBound::of(py::cast<int64_t>(value));
    return py::cast<double>(value);
}

Coverage coverageOf(const std::string& name)
{
    if (name == "centers") return Coverage::Centers;
    if (name == "cubes") return Coverage::Cubes;
    if (name == "whole") return Coverage::Whole;
    throw InputError("coverage=" + spheretree::detail::inQuotes(name)
        + " is unknown: it takes centers, cubes or whole");
}

/// @param keywords  those that were given; the package has checked their types
ObjectRequest requestOf(const py::dict& keywords)
{
    ObjectRequest request;
    auto& settings = request.settings;
    for (const auto& [key, value] : keywords) {
        const std::string name = py::str(key);
        if (name == "strict")
            settings.coverage = Coverage::Whole; // where there is a solid between voxels
        else request.given.push_back(name);
        if (name == "threshold" || name == "above") settings.above = boundOf(value);
        else if (name == "below") settings.below = boundOf(value);
        else if (name == "label") settings.labels = py::cast<std::vector<int64_t>>(value);
        else if (name == "iso") settings.iso = py::cast<double>(value);
        else if (name == "coverage") settings.coverage = coverageOf(py::cast<std::string>(value));
        else if (name == "largest") request.largest = py::cast<bool>(value);
        else if (name == "fill") request.fill = py::cast<bool>(value);
    }
    if (settings.above && settings.below && !(*settings.above < *settings.below)) {
        throw InputError("no value is above " + spheretree::detail::toText(*settings.above)
            + " and below " + spheretree::detail::toText(*settings.below));
    }
    return request;
}

/// Where the voxels of an array are.
struct Placement {
    std::array<double, 3> spacing, origin; ///< along x, y, z
    std::optional<std::array<double, 16>>
        matrix; ///< in place of both: rows, for columns (x, y, z, 1)
};

/// @throw openvdb::Exception by names that no argument has
openvdb::math::Transform::Ptr gridTransformOf(const Placement& place)
{
    using spheretree::detail::transformOf;
    if (place.matrix) return transformOf(openvdb::Mat4d(place.matrix->data()).transpose());
    auto transform = transformOf(openvdb::Vec3d(place.spacing.data()));
    const openvdb::Vec3d origin(place.origin.data());
    if (origin != openvdb::Vec3d(0)) transform->postTranslate(origin);
    return transform;
}

/// @param said  the arguments that say it
openvdb::math::Transform::Ptr transformOf(const Placement& place, const char* said)
{
    try {
        auto transform = gridTransformOf(place);
        if (std::isfinite(spheretree::largestStretch(*transform))) return transform;
    } catch (const openvdb::Exception&) { // told below
    }
    throw InputError(std::string(said)
        + ": OpenVDB has no transform for these voxels: they have no volume, or one below 3e-15, "
          "or are too large, or too far from the origin; choose another unit of length");
}

/// The sides of a file's voxels. @throw InputError where OpenVDB has no such voxels
openvdb::Vec3d spacingOf(const py::handle& sides)
{
    const Placement place{py::cast<std::array<double, 3>>(sides), {}, {}};
    transformOf(place, "anisotropy");
    return openvdb::Vec3d(place.spacing.data());
}

FileRequest fileRequestOf(const py::dict& keywords)
{
    FileRequest file;
    for (const auto& [key, value] : keywords) {
        const std::string name = py::str(key);
        if (name == "grid") file.grid = py::cast<std::string>(value);
        else if (name == "voxel") file.voxel = py::cast<double>(value);
        else if (name == "units") file.units = py::cast<std::string>(value);
        else if (name == "resolution") file.resolution = py::cast<int>(value);
        else if (name == "gap") file.gap = py::cast<double>(value);
        else if (name == "zyx") file.array.zyx = py::cast<bool>(value);
        else if (name == "background") file.array.background = py::cast<double>(value);
        else if (name == "spacing") file.array.spacing = spacingOf(value);
    }
    return file;
}

// ---- Arrays

std::string wantedBy(const spheretree::ObjectSettings& settings, NumberType type)
{
    using openvdb_spheretree::detail::toText;
    if (type == NumberType::Bool) return "it is False everywhere";
    if (!settings.labels.empty()) return "no value is a label that is asked for";
    if (settings.above && settings.below) {
        return "no value is above " + toText(*settings.above) + " and below "
            + toText(*settings.below);
    }
    if (settings.below) return "no value is below " + toText(*settings.below);
    return "no value is above " + toText(settings.above.value_or(settings.threshold));
}

void requireNumbers(const ObjectRequest& request, NumberType type)
{
    for (const std::string& name : request.given) {
        if (name == "iso") {
            throw InputError("iso is for level sets, and an array is none: use below or threshold");
        }
        const bool isOfParts = name == "largest" || name == "fill";
        if (type != NumberType::Bool || isOfParts) continue;
        throw InputError(name + " is for volumes of numbers, and this one is of dtype bool");
    }
}

/// Voxels by their centers, which are cubes: nothing of the array is kept.
openvdb::BoolGrid::Ptr objectOfMask(
    const VoxelArray& array, const ObjectRequest& request, Interrupter* interrupter)
{
    const auto mask = maskOf(array, request.settings, interrupter);
    return openvdb::BoolGrid::create(
        spheretree::detail::copyTopology<openvdb::BoolTree>(*mask, interrupter));
}

/// What one array becomes, with all that is needed for it.
struct ArrayRequest {
    VoxelArray view;
    openvdb::math::Transform::Ptr transform;
    bool cubes; ///< whether its voxels are cubes
    double background;
    std::string name;
    ObjectRequest object;
};

openvdb::BoolGrid::Ptr objectOfArray(const ArrayRequest& request, Interrupter* interrupter)
{
    ObjectRequest object = request.object;
    const bool byCenters = object.settings.coverage == Coverage::Centers
        || request.view.type == NumberType::Bool || !object.settings.labels.empty();
    openvdb::GridBase::Ptr grid;
    if (request.cubes && byCenters) {
        grid = objectOfMask(request.view, object, interrupter);
        if (grid->empty()) {
            throw InputError(
                "volume holds no object: " + wantedBy(object.settings, request.view.type));
        }
        object.settings = {};
        object.given.clear();
    } else {
        grid = gridOf(request.view, request.background, interrupter);
    }
    grid->setName(request.name);
    grid->setTransform(request.transform);
    return objectOfGrid(grid, object, interrupter);
}

Volume volumeOfArray(const py::array& array, const py::dict& place, const py::dict& keywords,
    const CallSettings& call)
{
    ArrayRequest request;
    const bool reversed = py::cast<bool>(place["reversed"]);
    request.view = viewOf(array, reversed);
    request.object = requestOf(keywords);
    requireNumbers(request.object, request.view.type);
    request.name = py::cast<std::string>(place["name"]);
    request.background = py::cast<double>(place["background"]);
    request.cubes = py::cast<bool>(place["cubes"]);
    Placement placement{py::cast<std::array<double, 3>>(place["spacing"]),
        py::cast<std::array<double, 3>>(place["origin"]), {}};
    if (!place["matrix"].is_none()) {
        placement.matrix = py::cast<std::array<double, 16>>(place["matrix"]);
    }
    request.transform =
        transformOf(placement, placement.matrix ? "matrix" : "anisotropy and origin");
    Volume volume;
    volume.object = resultOfCall(call, [&](Interrupter* in) { return objectOfArray(request, in); });
    volume.reversed = reversed;
    volume.flat = array.ndim() == 2;
    volume.box = request.cubes ? openvdb::CoordBBox(openvdb::Coord(0),
                     openvdb::Coord(int(request.view.shape[0] - 1), int(request.view.shape[1] - 1),
                         int(request.view.shape[2] - 1)))
                               : volume.object->evalActiveVoxelBoundingBox();
    return volume;
}

// ---- What Python asks of a volume

std::vector<int> startOf(const Volume& volume)
{
    const openvdb::Coord& min = volume.box.min();
    std::vector<int> start = {min[0], min[1], min[2]};
    if (volume.flat) start.pop_back();
    if (volume.reversed) std::reverse(start.begin(), start.end());
    return start;
}

py::array matrixOf(const Volume& volume)
{
    const openvdb::Mat4d matrix =
        volume.object->transform().baseMap()->getAffineMap()->getMat4().transpose();
    return py::array_t<double>({4, 4}, matrix.asPointer());
}

py::array toArray(const Volume& volume)
{
    py::array array = zerosFor(volume, "bool");
    fillDense<bool>(volume, array, volume.object->tree(), [](bool) { return true; });
    return array;
}

py::array coordinatesOf(const Volume& volume)
{
    const int axes = volume.flat ? 2 : 3;
    const auto count = py::ssize_t(volume.object->activeVoxelCount());
    py::array_t<int32_t> array({count, py::ssize_t(axes)});
    int32_t* to = array.mutable_data();
    {
        const py::gil_scoped_release others;
        for (auto value = volume.object->cbeginValueOn(); value; ++value) {
            openvdb::CoordBBox box;
            value.getBoundingBox(box);
            spheretree::detail::forEachVoxelOf(box, [&](const openvdb::Coord& ijk) {
                for (int i = 0; i < axes; ++i) *to++ = ijk[volume.reversed ? axes - 1 - i : i];
            });
        }
    }
    return array;
}

} // namespace

void requireObjectOf(
    const spheretree::SphereTree& tree, const Volume& volume, const std::string& what)
{
    if (spheretree::isObjectOf(*volume.object, tree)) return;
    throw InputError(what
        + ": the volume has other voxels than those that the tree was built of: make it once, by "
          "volume() with all keywords, and give that to build() and here");
}

std::vector<py::ssize_t> Volume::shape() const
{
    const auto sides = spheretree::detail::sidesOf(box);
    std::vector<py::ssize_t> shape(sides.begin(), sides.end());
    if (flat) shape.pop_back();
    if (reversed) std::reverse(shape.begin(), shape.end());
    return shape;
}

void bindVolume(py::module_& module)
{
    py::class_<Volume, std::shared_ptr<Volume>> handle(module, "Volume");
    forbidNew(handle);
    handle
        .def_property_readonly("voxels",
            [](const Volume& volume) { return int64_t(volume.object->activeVoxelCount()); })
        .def_property_readonly("shape", [](const Volume& volume) { return volume.shape(); })
        .def_property_readonly("start", startOf)
        .def_property_readonly("matrix", matrixOf)
        .def_property_readonly(
            "name", [](const Volume& volume) { return textOf(volume.object->getName()); })
        .def_property_readonly("voxel_size",
            [](const Volume& volume) {
                return openvdb_spheretree::voxelSizeOf(volume.object->transform());
            })
        .def_readonly("flat", &Volume::flat)
        .def_property_readonly("warnings",
            [](const Volume& volume) {
                py::list texts;
                for (const std::string& text : volume.warnings) texts.append(textOf(text));
                return texts;
            })
        .def("to_array", toArray)
        .def("coordinates", coordinatesOf);
    module.def("volume_of_array",
        [](const py::array& array, const py::dict& place, const py::dict& keywords,
            const py::object& progress, int threads) {
            return volumeOfArray(array, place, keywords, {progress, threads});
        });
    module.def("kind_of_file", kindOfFile);
    module.def("is_stack_name", spheretree::isStackName);
    module.def("value_range_of_file",
        [](const std::string& path, const py::object& progress, int threads) {
            return resultOfCall(CallSettings{progress, threads},
                [&](Interrupter* in) { return valueRangeOfFile(path, in); });
        });
    module.def("volume_of_file",
        [](const std::string& path, const py::dict& file, const py::dict& keywords,
            const py::object& progress, int threads) {
            const FileRequest from = fileRequestOf(file);
            const ObjectRequest request = requestOf(keywords);
            return resultOfCall(CallSettings{progress, threads},
                [&](Interrupter* in) { return volumeOfFile(path, from, request, in); });
        });
}

} // namespace binding
