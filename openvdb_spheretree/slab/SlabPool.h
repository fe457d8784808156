// SPDX-License-Identifier: Apache-2.0
/// @file SlabPool.h
/// @brief The slabs of the window, and memory for them that is used again from slab to slab.

#pragma once

#include "SlabLabels.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

template <typename Power>
class SlabPool {
public:
    SlabPool(const LeafLayout& layout, int dim, const KeptOffsets<Power>& kept)
        : mLayout(layout), mDim(dim), mKept(kept), mOpen(layout.slabCount()),
          mMemory(layout.slabCount())
    {}

    const SlabLabels<Power>& operator[](uint32_t slab) const { return mOpen[slab]; }
    bool isOpen(uint32_t slab) const { return mOpen[slab].keys != nullptr; }

    /// Labels are undefined.
    void open(uint32_t slab)
    {
        const LeafLayout::Slab leaves = mLayout.slab(slab);
        mMemory[slab] = taken(leaves.size());
        mOpen[slab] = mMemory[slab].open(leaves, mDim, mKept);
    }
    void close(uint32_t slab)
    {
        mFree.push_back(std::move(mMemory[slab]));
        mOpen[slab] = {};
    }

private:
    /// @return the smallest free memory that is large enough, or new one.
    SlabMemory<Power> taken(uint32_t leaves)
    {
        auto best = mFree.end();
        for (auto it = mFree.begin(); it != mFree.end(); ++it) {
            if (it->leaves() < leaves) continue;
            if (best == mFree.end() || it->leaves() < best->leaves()) best = it;
        }
        SlabMemory<Power> memory;
        if (best != mFree.end()) {
            std::swap(*best, mFree.back());
            memory = std::move(mFree.back());
        }
        if (!mFree.empty()) mFree.pop_back(); // the one taken, or one too small: better given back
        return memory;
    }

    const LeafLayout& mLayout;
    const int mDim;
    const KeptOffsets<Power> mKept;
    std::vector<SlabLabels<Power>> mOpen;
    std::vector<SlabMemory<Power>> mMemory, mFree; ///< of open slabs, and of none
};

} // namespace slab
} // namespace openvdb_spheretree
