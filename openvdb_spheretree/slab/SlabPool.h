// SPDX-License-Identifier: Apache-2.0
/// @file slab/SlabPool.h
/// @brief Memory for the slabs of the window, used again from slab to slab.

#pragma once

#include "../LeafLayout.h"
#include "../detail/LargeArray.h"
#include "SlabLabels.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

template <typename Power>
class SlabPool {
public:
    using Offset = typename Power::Offset;
    using Steps = std::array<Offset*, 3>; ///< along x, y, z, 512 a leaf

    /// @param kept  where the steps of all leaves go to stay; nulls: they go with their slab
    SlabPool(const LeafLayout& layout, int dim, const Steps& kept)
        : mLayout(layout), mDim(dim), mKept(kept), mOpen(layout.slabCount()),
          mMemory(layout.slabCount())
    {}

    const SlabLabels<Power>& operator[](uint32_t slab) const { return mOpen[slab]; }
    bool isOpen(uint32_t slab) const { return mOpen[slab].keys != nullptr; }

    /// Labels are undefined, marks off.
    void open(uint32_t slab)
    {
        const LeafLayout::Slab leaves = mLayout.slab(slab);
        Memory& memory = mMemory[slab];
        memory = taken(leaves.size());
        SlabLabels<Power>& labels = mOpen[slab];
        labels.firstLeaf = leaves.begin;
        labels.keys = memory.keys.get();
        labels.dx = steps(0, leaves, memory);
        labels.dy = steps(1, leaves, memory);
        labels.dz = mDim == 3 ? steps(2, leaves, memory) : nullptr;
        labels.marks = memory.marks.get();
        std::fill(labels.marks, labels.marks + leaves.size(), LeafMask{});
    }
    void close(uint32_t slab)
    {
        mFree.push_back(std::move(mMemory[slab]));
        mOpen[slab] = {};
    }

private:
    struct Memory {
        uint32_t leaves = 0; ///< that there is room for
        detail::LargeArray<typename Power::Key> keys;
        detail::LargeArray<Offset> offsets;
        detail::LargeArray<LeafMask> marks;
    };

    Offset* steps(int axis, const LeafLayout::Slab& leaves, const Memory& memory) const
    {
        if (mKept[0]) return mKept[axis] + std::size_t(leaves.begin) * kLeafVoxels;
        return memory.offsets.get() + std::size_t(axis) * leaves.size() * kLeafVoxels;
    }

    /// @return the smallest free memory that is large enough, or new one.
    Memory taken(uint32_t leaves)
    {
        auto best = mFree.end();
        for (auto it = mFree.begin(); it != mFree.end(); ++it) {
            if (it->leaves < leaves || (best != mFree.end() && it->leaves >= best->leaves))
                continue;
            best = it;
        }
        if (best != mFree.end()) {
            std::swap(*best, mFree.back());
            Memory memory = std::move(mFree.back());
            mFree.pop_back();
            return memory;
        }
        if (!mFree.empty()) mFree.pop_back(); // too small: its place is worth more
        Memory memory;
        const std::size_t size = std::size_t(leaves) * kLeafVoxels;
        memory.leaves = leaves;
        memory.keys = detail::makeLargeArray<typename Power::Key>(size);
        if (!mKept[0]) memory.offsets = detail::makeLargeArray<Offset>(size * std::size_t(mDim));
        memory.marks = detail::makeLargeArray<LeafMask>(leaves);
        return memory;
    }

    const LeafLayout& mLayout;
    const int mDim;
    const Steps mKept;
    std::vector<SlabLabels<Power>> mOpen;
    std::vector<Memory> mMemory, mFree; ///< of open slabs, and of nobody
};

} // namespace slab
} // namespace openvdb_spheretree
