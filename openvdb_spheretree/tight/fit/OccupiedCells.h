// SPDX-License-Identifier: Apache-2.0
/// @file OccupiedCells.h
/// @brief Lists the occupied cells of a sparse grid in a box, in time that grows with those found:
/// neither with the size of the box nor with the cells elsewhere.
///
/// Cells are grouped by 4^3, groups again by 4^3, and so on: a walk starts where the box is few
/// groups wide, and goes down into those that are occupied. Adding and removing take constant time,
/// one look-up as a rule.

#pragma once

#include <openvdb/Types.h>

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace openvdb_spheretree::tight {

struct CoordHash {
    std::size_t operator()(const openvdb::Coord& at) const;
};

class OccupiedCells {
public:
    /// @param cell  that is not there yet
    void add(const openvdb::Coord& cell);
    /// @param cell  that is there
    void remove(const openvdb::Coord& cell);

    /// Calls body(cell) for each cell in the box, in no order.
    template <typename Body>
    void forEachIn(const openvdb::CoordBBox& box, const Body& body) const
    {
        if (box.empty()) return;
        std::size_t level = 0;
        while (level + 1 < kLevels && countOf(groupsIn(box, level)) > kFewGroups) ++level;
        const openvdb::CoordBBox groups = groupsIn(box, level);
        if (countOf(groups) > double(mGroups[level].size())) {
            for (const auto& [group, parts] : mGroups[level]) {
                if (groups.isInside(group)) walk(level, parts, box, body);
            }
            return;
        }
        for (const openvdb::Coord& at : groups) {
            const auto group = mGroups[level].find(at);
            if (group != mGroups[level].end()) walk(level, group->second, box, body);
        }
    }

private:
    using Parts = std::vector<openvdb::Coord>;

    static constexpr std::size_t kShift = 2;  ///< a group is 4 parts wide
    static constexpr std::size_t kLevels = 8; ///< the last has groups of 65,536 cells along a side
    static constexpr double kFewGroups = 27;

    /// As a double: 64 bits do not hold the cells of the widest box.
    static double countOf(const openvdb::CoordBBox& box)
    {
        const openvdb::Coord size = box.dim();
        return double(size[0]) * size[1] * size[2];
    }
    static openvdb::CoordBBox groupsIn(const openvdb::CoordBBox& box, std::size_t level)
    {
        return box >> (kShift * (level + 1));
    }

    template <typename Body>
    void walk(std::size_t level, const Parts& parts, const openvdb::CoordBBox& box,
        const Body& body) const
    {
        const openvdb::CoordBBox within = box >> (kShift * level);
        for (const openvdb::Coord& part : parts) {
            if (!within.isInside(part)) continue;
            if (level == 0) body(part);
            else walk(level - 1, mGroups[level - 1].find(part)->second, box, body);
        }
    }

    /// Of each level: by their places the groups that are not empty, with the parts of theirs that
    /// are not.
    std::array<std::unordered_map<openvdb::Coord, Parts, CoordHash>, kLevels> mGroups;
};

} // namespace openvdb_spheretree::tight
