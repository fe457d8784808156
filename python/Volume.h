// SPDX-License-Identifier: Apache-2.0
/// @file Volume.h
/// @brief The object that trees are built over, as Python has it: made of an array or of a file.

#pragma once

#include "ArrayVoxels.h"

#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/volume/VolumeFile.h>
#include <openvdb_spheretree/mesh/TriangleMesh.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/openvdb.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <utility>
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
    openvdb_spheretree::VolumeSettings array = {}; ///< of an array file or of pictures
};

/// @brief The object of a grid: cubic voxels are made where there are others, then the request is met.
/// @param notNumbers  as of objectOf()
/// @throw InputError for a setting that says nothing about such a grid; what the library throws
openvdb::BoolGrid::Ptr objectOfGrid(const openvdb::GridBase::ConstPtr& grid,
    const ObjectRequest& request, openvdb::util::NullInterrupter* interrupter,
    int64_t* notNumbers = nullptr);

/// @param units  that the file is in: its points become metres; empty: they stay as they are
/// @throw what readMeshFile() throws; InputError for a unit that is none
openvdb_spheretree::TriangleMesh meshOfFile(
    const std::string& path, const std::string& units, openvdb::util::NullInterrupter* interrupter);

/// @return what a path is read as, by its extension: `vdb`, `vol`, `npy`, `array` (of other tools, and pictures),
///         `mesh`; or nothing.
std::string kindOfFile(const std::string& path);

/// @return the least and the largest value of an array file that are not 0, or 0 and 0; nothing for bools.
/// @throw what readVolumeFile() throws; InputError for a .raw
std::optional<std::pair<double, double>> valueRangeOfFile(
    const std::string& path, openvdb::util::NullInterrupter* interrupter);

/// @throw command::CommandError or openvdb::IoError naming the file; InputError for arguments that do not suit it
Volume volumeOfFile(const std::string& path, const FileRequest& file, const ObjectRequest& request,
    openvdb::util::NullInterrupter* interrupter);

/// @param what  the message begins with it
/// @throw InputError if @a volume is not what the tree was built over, as far as isObjectOf() tells
void requireObjectOf(
    const openvdb_spheretree::SphereTree& tree, const Volume& volume, const std::string& what);

/// @return an array of the shape of the volume, all 0.
pybind11::array zerosFor(const Volume& volume, const char* dtype);

void bindVolume(pybind11::module_& module);

} // namespace binding
