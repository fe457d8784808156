// SPDX-License-Identifier: Apache-2.0
/// @file BlockModel.h
/// @brief Pyramid models as a function of the children: from a block of child voxels and the blocks
/// around it to on or off.
///
/// A model of one's own in a line, here "OR, and across gaps of one parent voxel":
///
///     options.customModel = blockModel([](const ChildBlock& block) {
///         return block.any() || (block.any(-1, 0, 0) && block.any(1, 0, 0));
///     });
///
/// The function sees the blocks around its own as well: an including model of one block alone could
/// only be OR. Levels stay sparse: the function is called only for parent voxels of which a child,
/// or a child of one of the 3^dim - 1 blocks around, is on; all others stay off. Tiles of the OR
/// model's level (8^3 voxels or more) have to be on, and are without a call. Cost: a call for every
/// other such voxel, in parallel. Tests: TestBlockModel.cc.

#pragma once

#include "PyramidModel.h"
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <functional>

namespace openvdb_spheretree {

/// The children of a parent voxel, and those of the blocks around it. Valid during the call only.
class ChildBlock {
public:
    /// The parent voxel, on the coarser level.
    const openvdb::Coord& parent() const { return mParent; }
    int factor() const { return mStep->factor; }
    int dim() const { return mStep->dim; }

    /// @return whether a child is on.
    /// @param i, j, k  0 to factor - 1 within the block; -factor to 2 factor - 1 with the blocks
    ///                 around it. With dim = 2, k is 0.
    bool isOn(int i, int j, int k) const { return mChildren->isValueOn(mFirst.offsetBy(i, j, k)); }

    /// @return how many of the factor^dim children are on. Cost: the nodes of the block, at most
    /// one for every 8^3 children.
    int64_t count() const;

    /// @return whether any child of a block is on.
    /// @param x, y, z  -1, 0 or 1 each: the block's place, counted in blocks from this one
    bool any(int x = 0, int y = 0, int z = 0) const;

private:
    friend class BlockEvaluator;
    using Accessor = openvdb::tree::ValueAccessor<const openvdb::MaskTree>;

    openvdb::Coord mParent, mFirst; ///< mFirst: the child of lowest coordinates
    const PyramidStep* mStep = nullptr;
    const Accessor* mChildren = nullptr; ///< of the finer level
    const Accessor* mOr = nullptr;       ///< of the OR model's level
};

/// @param isOn  says whether a parent voxel is on; called from several threads at once
/// @param interrupter  may be null; must live as long as the model
PyramidModel blockModel(std::function<bool(const ChildBlock&)> isOn,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
