// SPDX-License-Identifier: Apache-2.0
/// @file RegionHalving.h
/// @brief Halves a region of space over and over, with a list of what may matter there.
///
/// What does not matter in a region matters in no part of it, so the list gets shorter on the way
/// down. A small region never sees most of the candidates near it: they were removed long before.
/// (With a list for each leaf of all balls that reach it, the power cells of dragon-512 took 2.7 s
/// in place of 0.6 s.)
///
/// First regions are divided until there are enough for all threads, then each is taken to its end.

#pragma once

#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/Types.h>
#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree::detail {

/// @return the first of the axes along which a box is longest.
inline int longestAxis(const openvdb::CoordBBox& box)
{
    const auto length = [&](int a) { return int64_t(box.max()[a]) - box.min()[a]; };
    int axis = 0;
    for (int a = 1; a < 3; ++a) axis = length(a) > length(axis) ? a : axis;
    return axis;
}

/// Divides items in two halves across the longest side of the box around them.
/// @param originOf  of an item: a Coord
/// @return the first item of the second half.
template <typename Item, typename OriginOf>
Item* halve(Item* begin, Item* end, const openvdb::CoordBBox& box, const OriginOf& originOf)
{
    const int axis = longestAxis(box);
    Item* const middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end,
        [&](const Item& a, const Item& b) { return originOf(a)[axis] < originOf(b)[axis]; });
    return middle;
}

/// @param divide  divide(region, sum) adds what it finds in a region to a sum, and returns the
///                regions to look at in its place; none where it is done. Called by several
///                threads.
/// @return some sums, begun as copies of @a zero; their total is that of all regions.
template <typename Region, typename Sum, typename Divide>
std::vector<Sum> divideRegions(Region whole, const Sum& zero, const Divide& divide,
    openvdb::util::NullInterrupter* interrupter)
{
    constexpr std::size_t kEnough = 256; // for any number of threads to share
    std::vector<Region> regions;
    regions.push_back(std::move(whole));
    std::vector<Sum> sums;
    while (!regions.empty() && regions.size() < kEnough) {
        const std::size_t first = sums.size();
        sums.resize(first + regions.size(), zero);
        std::vector<std::vector<Region>> parts(regions.size());
        parallelFor(regions.size(), interrupter,
            [&](std::size_t i) { parts[i] = divide(regions[i], sums[first + i]); });
        regions.clear();
        for (std::vector<Region>& some : parts) {
            for (Region& part : some) regions.push_back(std::move(part));
        }
    }
    const std::size_t first = sums.size();
    sums.resize(first + regions.size(), zero);
    parallelFor(regions.size(), interrupter, [&](std::size_t i) {
        std::vector<Region> stack;
        stack.push_back(std::move(regions[i]));
        for (int64_t steps = 0; !stack.empty(); ++steps) {
            if (steps % 256 == 0) checkInterrupt(interrupter);
            const Region next = std::move(stack.back());
            stack.pop_back();
            for (Region& part : divide(next, sums[first + i])) stack.push_back(std::move(part));
        }
    });
    return sums;
}

} // namespace openvdb_spheretree::detail
