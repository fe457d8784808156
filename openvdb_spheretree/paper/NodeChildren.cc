// SPDX-License-Identifier: Apache-2.0
#include "NodeChildren.h"

namespace openvdb_spheretree {
namespace detail {

NodeChildren::NodeChildren(const std::vector<int32_t>& parent, std::size_t parents)
    : mBegin(parents + 2, 0), mOrder(makeLargeArray<int32_t>(parent.size()))
{
    // Counts two places ahead become begins one place ahead, which filling moves to their own.
    for (const int32_t p : parent) ++mBegin[std::size_t(p) + 2];
    for (std::size_t t = 2; t < mBegin.size(); ++t) mBegin[t] += mBegin[t - 1];
    for (std::size_t i = 0; i < parent.size(); ++i) {
        mOrder[mBegin[std::size_t(parent[i]) + 1]++] = int32_t(i);
    }
    mBegin.pop_back();
}

} // namespace detail
} // namespace openvdb_spheretree
