// SPDX-License-Identifier: Apache-2.0
#include "XGaps.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/kernel/BackgroundGaps.h>

#include <cstring>

namespace openvdb_spheretree {
namespace slab {

template <typename Gap>
XGaps<Gap>::XGaps(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter)
    : mLayout(layout), mGaps(detail::makeLargeArray<Gap>(std::size_t(layout.leafCount()) * 128))
{
    detail::parallelFor(layout.runCount(Axis::X), interrupter,
        [&](std::size_t i) { sweep(layout.run(Axis::X, uint32_t(i))); });
}

template <typename Gap>
void XGaps<Gap>::sweep(LeafLayout::Run run)
{
    const uint32_t first = run.leaves[0], last = run.leaves[run.count - 1];
    std::memset(below(first), 0, 64 * sizeof(Gap));
    for (uint32_t i = 0; i + 1 < run.count; ++i) {
        gapsThrough(mLayout.mask(run.leaves[i]), below(run.leaves[i]), below(run.leaves[i + 1]));
    }
    std::memset(above(last), 0, 64 * sizeof(Gap));
    for (uint32_t i = run.count - 1; i > 0; --i) {
        gapsBackThrough(
            mLayout.mask(run.leaves[i]), above(run.leaves[i]), above(run.leaves[i - 1]));
    }
}

template <typename Gap>
template <typename Square>
void XGaps<Gap>::squares(uint32_t leaf, Square* rows) const
{
    squaresOfGaps(mLayout.mask(leaf), below(leaf), above(leaf), rows);
}

template class XGaps<uint8_t>;
template class XGaps<uint16_t>;
template void XGaps<uint8_t>::squares(uint32_t, uint16_t*) const;
template void XGaps<uint16_t>::squares(uint32_t, uint32_t*) const;

} // namespace slab
} // namespace openvdb_spheretree
