// SPDX-License-Identifier: Apache-2.0
/// @file ErrorChart.h
/// @brief The errors of sphere-trees against their numbers of spheres: as an SVG, a picture or a table.
///
///     std::vector<ErrorCurve> curves = {errorCurve(fine), errorCurve(coarse)};
///     writeChartSvg(curves, {}, out);

#pragma once

#include <openvdb_spheretree/picture/Picture.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// The levels of one tree whose errors are known.
struct ErrorCurve {
    struct Point {
        int level = 0;
        int64_t spheres = 0;       ///< at least 1
        double hammingPercent = 0; ///< 100 (excess + missing) / object voxels, 0 or more
        double hausdorff = 0;      ///< voxels
    };
    std::string name;          ///< of the tree
    std::vector<Point> points; ///< the level with the fewest spheres first
};

/// @return the errors that @a tree has: computeLevelErrors() counts them. Levels without are left out.
ErrorCurve errorCurve(const SphereTree& tree);

/// Curves of one name cannot be told apart.
/// @return the curves with numbers behind names that are there several times: "tree (1)", "tree (2)".
std::vector<ErrorCurve> withOwnNames(std::vector<ErrorCurve> curves);

/// Of a chart in pixels, 1 to 16384 each. The SVG has the same shape, and any size.
struct ChartSize {
    int width = 1280, height = 960;
};

/// @brief Write a chart: both axes by ratios, a line a curve with a mark a level. An error of 0 has a line of its own
/// below. Light or dark as the reader's screen is; every mark says its numbers, and a summary is there for
/// screen readers. Names have the letters of ASCII, and `?` for others.
/// @throw openvdb::ValueError if the size is out of range; openvdb::IoError if the stream fails
/// @note The same curves give the same bytes.
void writeChartSvg(const std::vector<ErrorCurve>& curves, const ChartSize& size, std::ostream& out);

/// @return whether this build draws charts as pictures, because it has cairo.
bool drawsCharts();

/// @brief The same chart in pixels, on white.
/// @throw openvdb::ValueError as above; openvdb::IoError if this build has no cairo, or that fails
Picture drawChart(const std::vector<ErrorCurve>& curves, const ChartSize& size);

/// @brief Write a line a point: `tree,level,spheres,hamming_percent,hausdorff`.
/// @throw openvdb::IoError if the stream fails
void writeChartCsv(const std::vector<ErrorCurve>& curves, std::ostream& out);

} // namespace openvdb_spheretree
