// SPDX-License-Identifier: Apache-2.0
#include "XGaps.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <cstring>

namespace openvdb_spheretree::slab {

template <typename Gap>
XGaps<Gap>::XGaps(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter)
    : mLayout(layout), mGaps(detail::makeLargeArray<Gap>(std::size_t(layout.leafCount()) * 128))
{
    detail::parallelFor(layout.runCount(Axis::X), interrupter, [&](std::size_t index) {
        const LeafLayout::Run run = layout.run(Axis::X, uint32_t(index));
        const uint32_t *leaf = run.leaves, last = run.count - 1;
        std::memset(below(leaf[0]), 0, 64 * sizeof(Gap));
        for (uint32_t i = 0; i < last; ++i) {
            gapsThrough(layout.mask(leaf[i]), below(leaf[i]), below(leaf[i + 1]), /*back=*/false);
        }
        std::memset(above(leaf[last]), 0, 64 * sizeof(Gap));
        for (uint32_t i = last; i > 0; --i) {
            gapsThrough(layout.mask(leaf[i]), above(leaf[i]), above(leaf[i - 1]), /*back=*/true);
        }
    });
}

template class XGaps<uint8_t>;
template class XGaps<uint16_t>;

} // namespace openvdb_spheretree::slab
