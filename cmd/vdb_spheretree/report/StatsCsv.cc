// SPDX-License-Identifier: Apache-2.0
#include "StatsReport.h"

#include <charconv>

namespace command {

using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;

namespace {

constexpr const char* kMassColumns = ",volume,center_x,center_y,center_z,inertia_xx,inertia_yy,"
                                     "inertia_zz,inertia_xy,inertia_xz,inertia_yz";

/// Cells of a line, from first to last. What is not known is an empty one.
class Line {
public:
    template <typename Number>
    Line& add(Number number)
    {
        char text[64];
        return addText(std::string(text, std::to_chars(text, text + sizeof(text), number).ptr));
    }
    Line& addEmpty(int count)
    {
        for (int i = 0; i < count; ++i) addText("");
        return *this;
    }
    std::string take() const { return mText + "\n"; }

private:
    Line& addText(const std::string& cell)
    {
        mText += (mIsFirst ? "" : ",") + cell;
        mIsFirst = false;
        return *this;
    }

    std::string mText;
    bool mIsFirst = true;
};

void addErrors(Line& line, const SphereTree& tree, const SphereTreeLevel& level)
{
    const bool inner = tree.settings.isInner();
    if (!level.error) {
        line.addEmpty(inner ? 9 : 8);
        return;
    }
    const auto& error = *level.error;
    line.add(error.covered).add(error.excess).add(error.missing);
    line.add(error.hammingPercent).add(error.hausdorff);
    if (level.stored) line.add(level.stored->hammingPercent).add(level.stored->reachWorld);
    else line.addEmpty(2);
    line.add(diceOf(tree, level));
    if (inner) line.add(coveredPercent(tree, level));
}

/// In the order of kMassColumns.
void addMass(Line& line, const LevelMass& level)
{
    if (!level.mass) {
        line.addEmpty(10);
        return;
    }
    const openvdb::Vec3d& center = level.mass->center;
    const openvdb::Mat3d& inertia = level.mass->inertia;
    line.add(level.mass->volume).add(center[0]).add(center[1]).add(center[2]);
    line.add(inertia(0, 0)).add(inertia(1, 1)).add(inertia(2, 2));
    line.add(inertia(0, 1)).add(inertia(0, 2)).add(inertia(1, 2));
}

std::string lineOf(const SphereTree& tree, const SphereTreeLevel& level, const LevelMass* mass)
{
    const LevelRadii radii = radiiOf(tree, level);
    Line line;
    line.add(level.level).add(level.size()).add(level.pyramidVoxels);
    if (const auto& topology = level.topology) {
        line.add(topology->components).add(topology->tunnels).add(topology->cavities);
    } else {
        line.addEmpty(3);
    }
    line.add(radii.smallest).add(radii.largest);
    addErrors(line, tree, level);
    if (mass) addMass(line, *mass);
    return line.take();
}

} // namespace

std::string statsCsv(const SphereTree& tree, const StatsMass& mass)
{
    std::string text = "level,spheres,pyramid_voxels,components,tunnels,cavities,radius_min,"
                       "radius_max,covered,excess,missing,hamming_percent,hausdorff,"
                       "stored_hamming_percent,stored_reach,dice";
    if (tree.settings.isInner()) text += ",covered_percent";
    if (!mass.levels.empty()) text += kMassColumns;
    text += "\n";
    for (std::size_t i = 0; i < tree.levels.size(); ++i) {
        text += lineOf(tree, tree.levels[i], mass.levels.empty() ? nullptr : &mass.levels[i]);
    }
    return text;
}

} // namespace command
