// SPDX-License-Identifier: Apache-2.0
#include "StatsReport.h"

#include <charconv>

namespace command {

using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;

namespace {

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

std::string lineOf(const SphereTree& tree, const SphereTreeLevel& level)
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
    const bool inner = tree.settings.isInner();
    if (!level.error) return line.addEmpty(inner ? 9 : 8).take();
    const auto& error = *level.error;
    line.add(error.covered).add(error.excess).add(error.missing);
    line.add(error.hammingPercent).add(error.hausdorff);
    if (level.stored) line.add(level.stored->hammingPercent).add(level.stored->reachWorld);
    else line.addEmpty(2);
    line.add(diceOf(tree, level));
    if (inner) line.add(coveredPercent(tree, level));
    return line.take();
}

} // namespace

std::string statsCsv(const SphereTree& tree)
{
    std::string text = "level,spheres,pyramid_voxels,components,tunnels,cavities,radius_min,"
                       "radius_max,covered,excess,missing,hamming_percent,hausdorff,"
                       "stored_hamming_percent,stored_reach,dice";
    text += tree.settings.isInner() ? ",covered_percent\n" : "\n";
    for (const SphereTreeLevel& level : tree.levels) text += lineOf(tree, level);
    return text;
}

} // namespace command
