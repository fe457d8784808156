// SPDX-License-Identifier: Apache-2.0
/// @file Volume.h
/// @brief The object that trees are built over, as Python has it: made of an array or of a file.

#pragma once

#include "ArrayVoxels.h"

#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/mesh/TriangleMesh.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/openvdb.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

namespace binding {

struct Volume {
    openvdb::BoolGrid::ConstPtr object;
    openvdb::CoordBBox box;                 ///< index space: what arrays of it show, inclusive
    bool reversed = false;                  ///< arrays have their axes in the order z, y, x
    bool flat = false;                      ///< arrays have two axes
    std::vector<std::string> warnings = {}; ///< what is seldom meant

    /// @return the lengths of the axes of arrays, in their order.
    std::vector<pybind11::ssize_t> shape() const;
};

/// Which voxels of a volume are its object: the keywords of -mask, checked.
struct ObjectRequest {
    openvdb_spheretree::ObjectSettings settings;
    std::vector<std::string> given; ///< names of those settings that somebody asked for
    bool largest = false, fill = false;
};

/// What a file is read with.
struct FileRequest {
    std::string grid;  ///< of a .vdb; empty: the only one
    std::string units; ///< of a mesh: its points become metres; empty: they stay as they are
    std::optional<double> voxel; ///< of a mesh: world units
    int resolution = 256;        ///< of a mesh, in place of that: voxels along its longest side
    std::optional<double> gap;   ///< of a mesh: width of holes to close, world units
};

/// @brief The object of a grid: cubic voxels are made where there are others, then the request is met.
/// @param notNumbers  as of objectOf()
/// @throw InputError for a setting that says nothing about such a grid; what the library throws
openvdb::BoolGrid::Ptr objectOfGrid(const openvdb::GridBase::ConstPtr& grid,
    const ObjectRequest& request, openvdb::util::NullInterrupter* interrupter,
    int64_t* notNumbers = nullptr);

/// @param units  that the file is in: its points become metres; empty: they stay as they are
/// @throw what readMeshFile() throws; InputError for a unit that is none
openvdb_spheretree::TriangleMesh meshOfFile(const std::string& path, const std::string& units);

/// @throw command::CommandError naming the file; InputError for arguments that do not suit it
Volume volumeOfFile(const std::string& path, const FileRequest& file, const ObjectRequest& request,
    openvdb::util::NullInterrupter* interrupter);

/// @return an array of the shape of the volume, all 0.
pybind11::array zerosFor(const Volume& volume, const char* dtype);

void bindVolume(pybind11::module_& module);

} // namespace binding
