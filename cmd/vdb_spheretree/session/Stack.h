// SPDX-License-Identifier: Apache-2.0
/// @file Stack.h
/// @brief The stack of grids, sphere-trees and meshes that the actions of a line work on.
///
/// Items have an age, and the newest has age 0. Grids and trees are counted together, meshes by
/// themselves. They are chosen by age or name; where no name fits, by that of the one file with it: trees have
/// all the same name unless they are given one. An action removes its input unless keep=1. What -write has written is removed when
/// the next item arrives, so that a tree can be written, looked at and written again.

#pragma once

#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/spheres/WorldSpheres.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <functional>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace command {

/// One of `grid`, `tree` and `mesh` is set.
struct StackItem {
    openvdb::SharedPtr<openvdb::GridBase> grid = {};
    std::shared_ptr<openvdb_spheretree::SphereTree> tree = {};
    std::shared_ptr<openvdb_spheretree::TriangleMesh> mesh = {};

    /// What `tree` was made from, if these are spheres that were read: they are put into the frame of
    /// an object once there is one (GivenSpheres.h).
    std::shared_ptr<const openvdb_spheretree::WorldSpheres> given = {};

    /// That a tree was built from; null if not known.
    openvdb::SharedPtr<const openvdb::BoolGrid> object = {};
    std::string source = {}; ///< the file or action that it comes from
    bool isOfFile = false;   ///< whether that is a file
    /// The tree of no object: without levels, and `grid` is its points, of which there are none.
    std::shared_ptr<openvdb_spheretree::SphereTree> emptyTree = {};
    std::optional<int64_t> frame = {}; ///< that it was made in; nothing outside of loops
    bool unverified = false;           ///< a tree of a file without a checksum
    bool ofMesh = false;               ///< made of a mesh
    bool interpolated = false;         ///< values of a grid are means of what -resample found
    int batch = 0;                     ///< the same number for all items of one action
    int64_t serial = 0;                ///< of pushing; a copy keeps it
    std::size_t depth = 0;             ///< of the loops that it was made in
    bool written = false;              ///< to be dropped when the next item arrives

    /// @return the tree, with or without spheres; null for grids and meshes.
    const openvdb_spheretree::SphereTree* anyTree() const
    {
        return tree ? tree.get() : emptyTree.get();
    }
    std::string name() const;
    /// @return the name of the file that it comes from, without folder and extension; empty if it was made by an action.
    std::string fileStem() const;
    /// @return for instance `grid 'density' (float, fog volume, from smoke.vdb)`.
    std::string description() const;
};

/// @return what the items are called among each other: each by its name, or by its file where others have that name, too;
///         empty where neither is its own.
std::vector<std::string> distinctNames(const std::vector<const StackItem*>& items);

class Stack {
public:
    using Suits = std::function<bool(const StackItem&)>;

    /// From now on, items that are pushed belong to one action, and come from @a source.
    void beginBatch(const std::string& source);
    /// From now on, those of this action come from a file.
    void setFile(const std::string& path);
    /// From now on, items that are pushed belong to this frame.
    void setFrame(std::optional<int64_t> frame) { mFrame = frame; }
    std::optional<int64_t> frame() const { return mFrame; }
    /// What is pushed between the two belongs to a turn of a loop; turns may be within each other.
    void beginTurn() { mTurns.push_back(mPushed); }
    void endTurn() { mTurns.pop_back(); }
    /// Forgets what loops before gave up.
    void beginLoop();
    void push(StackItem item);
    void drop(const StackItem* item);
    /// Drops what has been written, and remembers that for writtenAndGone().
    void giveUp(const StackItem* item);
    /// @return whether it is of a loop that has ended since the present turn began.
    bool isOfEndedLoop(const StackItem& item) const
    {
        return isOfEndedLoop(item.serial, item.depth);
    }
    /// @return how many trees of the last such loop have been given up in it.
    int64_t writtenAndGone() const;
    void clear();
    /// @return copies of all items that are not written yet, which share their grids, trees and meshes with them.
    std::vector<StackItem> copies() const;
    /// Makes the stack what it was when it was copied.
    void restore(const std::vector<StackItem>& copies);

    /// @return the items of a list of ages and names, in its order. If the list is empty or `*`, they
    ///         are all grids and trees that are not written yet, oldest first; or all, if all are written. Behind a
    ///         loop, a name stands for the items of all its turns that have it. None is there twice.
    /// @throw CommandError (input) if there is none
    std::vector<StackItem*> several(const std::vector<std::string>& agesOrNames);

    /// @brief The grid or tree that an action is to work on.
    /// @param what      what the action needs, for messages: "a sphere-tree"
    /// @param suits     whether an item is that
    /// @param ageOrName the user's choice. If it is empty, the newest action that made an item that
    ///                  suits must have made only one such item, which is taken.
    /// @param meshes    whether it is looked for among the meshes, not among grids and trees
    /// @throw CommandError (input) if there is no such item, or more than one
    StackItem& select(const std::string& what, const Suits& suits, const std::string& ageOrName,
        bool meshes = false);
    StackItem& selectTree(const std::string& ageOrName);
    StackItem& selectMesh(const std::string& ageOrName);

    /// Oldest first.
    const std::vector<std::unique_ptr<StackItem>>& items() const { return mItems; }
    bool holdsMesh() const;
    /// Whether the newest tree is that of no object.
    bool newestTreeIsEmpty() const;

private:
    /// Of an item that is gone.
    struct GivenUp {
        int64_t serial;
        std::size_t depth;
    };
    bool isOfEndedLoop(int64_t serial, std::size_t depth) const;
    bool isOfEndedLoop(const GivenUp& gone) const { return isOfEndedLoop(gone.serial, gone.depth); }
    std::vector<StackItem*> oldestFirst(bool meshes);
    std::vector<StackItem*> newestFirst(bool meshes);
    StackItem* find(const std::string& ageOrName, bool meshes);
    /// @return the item; and if it is of a loop that has ended, those of its turns that have the name, oldest first.
    std::vector<StackItem*> ofAllTurns(StackItem* item, const std::string& ageOrName);
    /// @throw CommandError (input) if the same action has made another item of that name
    void requireOneOfName(const StackItem& chosen);
    std::string listing() const;

    std::vector<std::unique_ptr<StackItem>> mItems;
    std::string mSource;
    bool mIsFile = false;
    std::optional<int64_t> mFrame;
    int64_t mPushed = 0;
    std::vector<GivenUp> mGivenUp; ///< trees, in their loops
    std::vector<int64_t> mTurns;   ///< the first serial of each turn that goes on
    int mBatch = 0;
};

} // namespace command
