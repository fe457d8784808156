// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/CoverCounts.h>

#include "support/FineBalls.h"

#include <array>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// Plain counters of a leaf.
using Counters = std::array<int, 512>;

LeafMask randomMask(Random& random)
{
    LeafMask mask{};
    if (random.chance(0.2)) mask.fill(~uint64_t(0));
    for (int i = 0; i < 512; ++i) mask[i >> 6] |= uint64_t(random.chance(0.6)) << (i & 63);
    return mask;
}

void count(Counters& counters, const LeafMask& mask, int by)
{
    for (int i = 0; i < 512; ++i) counters[i] += by * int(mask[i >> 6] >> (i & 63) & 1);
}

void expectSame(const CoverCounts& counts, std::size_t leaf, const Counters& counters)
{
    for (int i = 0; i < 512; ++i) {
        const auto bit = [i](const LeafMask& mask) { return mask[i >> 6] >> (i & 63) & 1; };
        ASSERT_EQ(bit(counts.heldBy(leaf, 1)), counters[i] == 1) << i << ": " << counters[i];
        ASSERT_EQ(bit(counts.heldBy(leaf, 2)), counters[i] == 2) << i << ": " << counters[i];
    }
}

TEST(CoverCounts, AreThoseOfPlainCounters)
{
    Random random(1);
    for (const int most : {1, 2, 3, 4, 21}) {
        CoverCounts counts(3, uint32_t(most));
        std::array<Counters, 3> counters{};
        std::array<std::vector<LeafMask>, 3> added;
        for (int turn = 0; turn < 90; ++turn) {
            const auto leaf = std::size_t(random.between(0, 2));
            auto& masks = added[leaf];
            if (int(masks.size()) == most || (!masks.empty() && random.chance(0.4))) {
                std::swap(
                    masks[std::size_t(random.between(0, int(masks.size()) - 1))], masks.back());
                counts.remove(leaf, masks.back());
                count(counters[leaf], masks.back(), -1);
                masks.pop_back();
            } else {
                masks.push_back(randomMask(random));
                counts.add(leaf, masks.back());
                count(counters[leaf], masks.back(), 1);
            }
            ASSERT_NO_FATAL_FAILURE(expectSame(counts, leaf, counters[leaf])) << most;
        }
    }
}

} // namespace
