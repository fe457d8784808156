// SPDX-License-Identifier: Apache-2.0
// The .sph of Bradshaw's sphere-tree toolkit (https://isg.cs.tcd.ie/spheretree/): a complete tree, where every
// sphere has as many places for children as the one with most children, in arrays without links. The children
// of place n are in places n d + 1 to n d + d. An empty place has a negative radius.

#include "ExportText.h"
#include "ExportWriters.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::detail {

namespace {

constexpr int64_t kMostPlaces = 10'000'000; ///< 220 MB of text
constexpr int32_t kEmpty = -1;              ///< in place of a sphere's index on its level

/// @return for each sphere of a level the indices of its children on the level below.
std::vector<std::vector<int32_t>> childrenOf(const ExportLevel& above, const ExportLevel& below)
{
    std::vector<std::vector<int32_t>> children(above.size());
    for (std::size_t i = 0; i < below.size(); ++i) {
        children[std::size_t(below.parents[i] - above.ids.front())].push_back(int32_t(i));
    }
    return children;
}

/// @return how many places there are, or some number above kMostPlaces.
int64_t placesOf(std::size_t levels, std::size_t degree)
{
    int64_t places = 0, onLevel = 1;
    for (std::size_t k = 0; k < levels && places <= kMostPlaces; ++k) {
        places += onLevel;
        onLevel = std::min(onLevel * int64_t(degree), kMostPlaces + 1);
    }
    return places;
}

void requireRoot(const ExportScene& scene)
{
    const std::size_t roots = scene.levels.front().size();
    if (roots == 1) return;
    OPENVDB_THROW(openvdb::ValueError,
        "a .sph begins with one sphere, and the coarsest level has "
            << roots << ": build a tree down to one, with spheres=512,64,8,1 for instance");
}

void requireFewPlaces(std::size_t levels, std::size_t degree)
{
    if (placesOf(levels, degree) <= kMostPlaces) return;
    OPENVDB_THROW(openvdb::ValueError,
        "a .sph is a complete tree: with "
            << levels << " levels, and " << degree << " children of one sphere, it has more than "
            << kMostPlaces
            << " places; build a tree of fewer levels, or of levels that differ less");
}

void writePlace(ExportText& text, const ExportLevel& level, int32_t sphere)
{
    if (sphere == kEmpty) {
        text << "0.0 0.0 0.0 -1.0 0.0\n";
        return;
    }
    const auto i = std::size_t(sphere);
    text.lengths(level.centers[i], " ") << ' ' << level.radii[i] << " 1.0\n";
}

} // namespace

void writeSph(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::size_t levels = scene.levels.size();
    requireRoot(scene);
    std::vector<std::vector<std::vector<int32_t>>> children; // of each level but the finest
    std::size_t degree = 1;
    for (std::size_t k = 0; k + 1 < levels; ++k) {
        children.push_back(childrenOf(scene.levels[k], scene.levels[k + 1]));
        for (const auto& row : children.back()) degree = std::max(degree, row.size());
    }
    requireFewPlaces(levels, degree);

    ExportText text(out, scene.decimals);
    text << levels << ' ' << degree << '\n';
    std::vector<int32_t> places = {0};
    for (std::size_t k = 0; k < levels; ++k) {
        for (const int32_t sphere : places) writePlace(text, scene.levels[k], sphere);
        if (k + 1 == levels) break;
        std::vector<int32_t> below;
        for (const int32_t sphere : places) {
            const std::size_t end = below.size() + degree;
            if (sphere != kEmpty) {
                const auto& row = children[k][std::size_t(sphere)];
                below.insert(below.end(), row.begin(), row.end());
            }
            below.resize(end, kEmpty);
        }
        places = std::move(below);
    }
    text.finish();
}

} // namespace openvdb_spheretree::detail
