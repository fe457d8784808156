// SPDX-License-Identifier: Apache-2.0
/// @file Stack.h
/// @brief What the actions of a line pass on: grids, sphere-trees and meshes, the newest first.
///
/// Grids and trees are counted together, by age: 0 is the newest; meshes have ages of their own. An
/// action consumes its input unless keep=1. What -write has written goes as well, but not before
/// the next thing arrives, so that a tree can be written, looked at and written again.

#pragma once

#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace command {

/// One of `grid`, `tree` and `mesh` is set.
struct StackItem {
    openvdb::SharedPtr<openvdb::GridBase> grid = {};
    std::shared_ptr<openvdb_spheretree::SphereTree> tree = {};
    std::shared_ptr<openvdb_spheretree::TriangleMesh> mesh = {};

    openvdb::SharedPtr<const openvdb::BoolGrid> object =
        {};                  ///< with a tree: what it was built from, where known
    std::string source = {}; ///< the file or action that it comes from
    int batch = 0;           ///< items of one action have one number
    bool written = false;    ///< to be dropped when the next item arrives

    std::string name() const;
    /// As in `grid 'density' (float, fog volume, from smoke.vdb)`.
    std::string description() const;
};

class Stack {
public:
    using Suits = std::function<bool(const StackItem&)>;

    /// The items pushed from now on come from one action, and from @a source (a file, say).
    void beginBatch(const std::string& source);
    void setSource(const std::string& source) { mSource = source; }
    void push(StackItem item);
    void drop(const StackItem* item);
    void clear() { mItems.clear(); }

    /// @return every item of a list of ages and names, oldest first; all grids and trees if it is
    ///         empty or `*`, less those already written as long as there are others.
    /// @throw CommandError (input) if there is none
    std::vector<StackItem*> several(const std::vector<std::string>& agesOrNames);

    /// @brief The grid or tree that an action is to work on.
    /// @param what      what the action needs, for messages: "a sphere-tree"
    /// @param suits     whether an item is that
    /// @param ageOrName the user's choice; empty: the only item that suits among those of the
    ///                  newest action that made one
    /// @throw CommandError (input), with a list of the stack, if there is no such item, or more
    ///        than one
    StackItem& select(const std::string& what, const Suits& suits, const std::string& ageOrName);
    StackItem& selectTree(const std::string& ageOrName);
    StackItem& selectMesh(const std::string& ageOrName);

    /// Oldest first.
    const std::vector<std::unique_ptr<StackItem>>& items() const { return mItems; }
    bool holdsMesh() const;

private:
    std::vector<StackItem*> newestFirst(bool meshes);
    StackItem* find(const std::string& ageOrName, bool meshes);
    StackItem& selectAmong(
        const std::string& what, const Suits& suits, const std::string& ageOrName, bool meshes);
    std::string listing() const;

    std::vector<std::unique_ptr<StackItem>> mItems;
    std::string mSource;
    int mBatch = 0;
};

/// @return `float`, `points`, `bool` ...: the part of a grid's type that people know.
std::string shortType(const openvdb::GridBase& grid);

} // namespace command
