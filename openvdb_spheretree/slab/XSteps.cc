// SPDX-License-Identifier: Apache-2.0
#include "XSteps.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/kernel/BackgroundSteps.h>

#include <cstring>

namespace openvdb_spheretree {
namespace slab {

template <typename Step>
XSteps<Step>::XSteps(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter)
    : mLayout(layout), mSteps(detail::makeLargeArray<Step>(std::size_t(layout.leafCount()) * 128))
{
    detail::parallelFor(layout.runCount(Axis::X), interrupter,
        [&](std::size_t i) { sweep(layout.run(Axis::X, uint32_t(i))); });
}

template <typename Step>
void XSteps<Step>::sweep(LeafLayout::Run run)
{
    const uint32_t first = run.leaves[0], last = run.leaves[run.count - 1];
    std::memset(below(first), 0, 64 * sizeof(Step));
    for (uint32_t i = 0; i + 1 < run.count; ++i) {
        stepsThrough(mLayout.mask(run.leaves[i]), below(run.leaves[i]), below(run.leaves[i + 1]));
    }
    std::memset(above(last), 0, 64 * sizeof(Step));
    for (uint32_t i = run.count - 1; i > 0; --i) {
        stepsBackThrough(
            mLayout.mask(run.leaves[i]), above(run.leaves[i]), above(run.leaves[i - 1]));
    }
}

template <typename Step>
template <typename Square>
void XSteps<Step>::squares(uint32_t leaf, Square* rows) const
{
    squaresOfSteps(mLayout.mask(leaf), below(leaf), above(leaf), rows);
}

template class XSteps<uint8_t>;
template class XSteps<uint16_t>;
template void XSteps<uint8_t>::squares(uint32_t, uint16_t*) const;
template void XSteps<uint16_t>::squares(uint32_t, uint32_t*) const;

} // namespace slab
} // namespace openvdb_spheretree
