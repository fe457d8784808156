// SPDX-License-Identifier: Apache-2.0
#include "LevelParts.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/Exceptions.h>

#include <limits>

namespace openvdb_spheretree::detail {

LevelParts::LevelParts(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter)
    : mLayout(layout), mCuts(layout.leafCount()), mLabels(chunks())
{
    parallelForWithScratch<PartLabels>(
        chunks(), interrupter, [&](std::size_t chunk, PartLabels& labels) {
            const uint32_t begin = uint32_t(chunk) * kPartChunk;
            const uint32_t end = std::min(begin + kPartChunk, layout.leafCount());
            for (uint32_t leaf = begin; leaf < end; ++leaf) {
                const auto counts = leafParts(layout.mask(leaf), labels);
                mCuts[leaf].objectParts = uint16_t(counts.object);
                mCuts[leaf].backgroundParts = uint16_t(counts.background);
                if (counts.object <= 1 && counts.background <= 1) continue;
                mCuts[leaf].labels = uint16_t(mLabels[chunk].size());
                mLabels[chunk].push_back(labels);
            }
        });
    numberNodes();
}

void LevelParts::numberNodes()
{
    int64_t object = 0, background = 1; // outside
    for (uint32_t leaf = 0; leaf < mLayout.leafCount(); ++leaf) {
        LeafCut& cut = mCuts[leaf];
        cut.object = uint32_t(object);
        cut.background = uint32_t(background);
        object += cut.objectParts;
        background += cut.backgroundParts + hasGapBehind(leaf);
    }
    if (std::max(object, background) > std::numeric_limits<uint32_t>::max()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the voxels of a level and the background between them are cut into "
                << std::max(object, background)
                << " parts by leaf nodes, more than 2^32: build without topology");
    }
    mObjectNodes = uint32_t(object);
    mBackgroundNodes = uint32_t(background);
}

} // namespace openvdb_spheretree::detail
