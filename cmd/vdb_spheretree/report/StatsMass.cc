// SPDX-License-Identifier: Apache-2.0
#include "StatsMass.h"

#include "TextTable.h"

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/openvdb.h>

#include <cstdio>

namespace command {

namespace {

using openvdb_spheretree::massProperties;
using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;

std::string significant(double number)
{
    char text[64];
    std::snprintf(text, sizeof(text), "%.6g", number);
    return text;
}

std::string tuple(const openvdb::Vec3d& vec)
{
    return "(" + significant(vec[0]) + ", " + significant(vec[1]) + ", " + significant(vec[2])
        + ")";
}

LevelMass massOfLevel(const SphereTree& tree, const SphereTreeLevel& level, Session& session)
{
    LevelMass result;
    try {
        result.mass = massProperties(tree, level, &session.progress);
        if (!result.mass) result.unknown = "no voxel center lies in the spheres of the level";
    } catch (const openvdb::ValueError& error) {
        result.unknown = openvdb_spheretree::detail::messageOf(error);
    }
    return result;
}

} // namespace

StatsMass massOf(const StackItem& item, bool levels, Session& session)
{
    const Stopwatch watch;
    StatsMass result;
    if (item.object) result.object = massProperties(*item.object, &session.progress);
    if (levels) {
        for (const SphereTreeLevel& level : item.tree->levels) {
            result.levels.push_back(massOfLevel(*item.tree, level, session));
        }
    }
    session.seconds.error += watch.seconds();
    return result;
}

void printMass(std::ostream& out, const StatsMass& mass)
{
    if (!mass.object) return;
    out << "mass of the object, of density 1: " << significant(mass.object->volume) << " at "
        << tuple(mass.object->center) << ", principal moments "
        << tuple(mass.object->principalMoments) << "; world units\n";
}

void printLevelMass(
    std::ostream& out, const SphereTree& tree, const StatsMass& mass, std::size_t limit)
{
    if (mass.levels.empty()) return;
    out << "mass of the union of the stored spheres, of density 1; world units\n";
    std::vector<Row> rows = {{"level", "volume", "of object %", "center x", "y", "z", "moment 1",
        "moment 2", "moment 3"}};
    for (std::size_t i = 0; i < mass.levels.size(); ++i) {
        rows.push_back({std::to_string(tree.levels[i].level)});
        Row& row = rows.back();
        if (const auto& found = mass.levels[i].mass) {
            row.push_back(significant(found->volume));
            row.push_back(mass.object ? fixed(100 * found->volume / mass.object->volume, 2) : "-");
            for (int a = 0; a < 3; ++a) row.push_back(significant(found->center[a]));
            for (int a = 0; a < 3; ++a) row.push_back(significant(found->principalMoments[a]));
        }
        row.resize(rows.front().size(), "-");
    }
    printRows(out, rows, /*second=*/6, limit);
    for (const LevelMass& level : mass.levels) {
        if (level.unknown.empty()) continue;
        out << "'-' for mass: " << oneLine(level.unknown) << "\n";
        break; // a coarser level has the same reason
    }
}

} // namespace command
