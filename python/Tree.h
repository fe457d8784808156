// SPDX-License-Identifier: Apache-2.0
/// @file Tree.h
/// @brief A sphere-tree as Python has it: its arrays are shown where they lie.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/Types.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

namespace binding {

/// Never changes once it is made, so that arrays may look into it.
class Tree {
public:
    explicit Tree(openvdb_spheretree::SphereTree tree);

    const openvdb_spheretree::SphereTree& get() const { return mTree; }
    /// World units; the only array that a SphereTree does not have.
    const std::vector<openvdb::Vec3d>& centersWorld() const { return mCenters; }

private:
    const openvdb_spheretree::SphereTree mTree;
    std::vector<openvdb::Vec3d> mCenters;
};

using TreePtr = std::shared_ptr<Tree>;

void bindTree(pybind11::module_& module);
void bindTreeFiles(pybind11::module_& module);
void bindTreeExport(pybind11::module_& module);
void bindTreePage(pybind11::module_& module);
void bindBuild(pybind11::module_& module);
void bindTransforms(pybind11::module_& module);
void bindPoints(pybind11::module_& module);
void bindQuery(pybind11::module_& module);
void bindScene(pybind11::module_& module);

} // namespace binding
