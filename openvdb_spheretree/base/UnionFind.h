// SPDX-License-Identifier: Apache-2.0
/// @file UnionFind.h
/// @brief Disjoint sets that many threads may join at once, without locks.
///
/// The parent of a node is never a larger one, so there are no cycles. Only roots are linked, by
/// compare-and-swap; a node that has a parent never becomes a root again. Path halving may replace
/// a newer parent by an older one, which is an ancestor too. The resulting sets do not depend on
/// the order of joins. 4 bytes a node.

#pragma once

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree::detail {

class UnionFind {
public:
    explicit UnionFind(uint32_t nodes) : mParent(nodes)
    {
        for (uint32_t i = 0; i < nodes; ++i) mParent[i].store(i, std::memory_order_relaxed);
    }

    uint32_t find(uint32_t node)
    {
        for (;;) {
            const uint32_t parent = mParent[node].load(std::memory_order_relaxed);
            const uint32_t above = mParent[parent].load(std::memory_order_relaxed);
            if (above == parent) return parent;
            mParent[node].store(above, std::memory_order_relaxed);
            node = above;
        }
    }

    void unite(uint32_t a, uint32_t b)
    {
        for (;;) {
            a = find(a);
            b = find(b);
            if (a == b) return;
            if (a < b) std::swap(a, b);
            uint32_t root = a; // unless another thread was faster
            if (mParent[a].compare_exchange_strong(root, b, std::memory_order_relaxed)) return;
        }
    }

    /// @return the number of sets, once all threads are done.
    int64_t sets() const
    {
        int64_t count = 0;
        for (uint32_t i = 0; i < mParent.size(); ++i) {
            count += mParent[i].load(std::memory_order_relaxed) == i;
        }
        return count;
    }

private:
    std::vector<std::atomic<uint32_t>> mParent;
};

} // namespace openvdb_spheretree::detail
