// SPDX-License-Identifier: Apache-2.0
/// @file ChartLayout.h
/// @brief What a chart is made of, and where: lines, marks and texts, for whoever draws them.

#pragma once

#include "ErrorChart.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// Points have x to the right and y down, in units of which a chart is 720 wide.
using ChartPoint = std::array<double, 2>;

/// What a part is drawn with. Curves take turns with the colors from `FirstCurve` on.
enum class Ink { Paper, Text, Faint, Grid, FirstCurve };
constexpr int kCurveInks = 6;
constexpr int kInks = int(Ink::FirstCurve) + kCurveInks;

/// Red, green and blue in sRGB, for paper that is white, and for paper that is nearly black.
struct InkColor {
    uint32_t light, dark;
};
/// By ink. The colors of curves differ in lightness too, and all have a contrast of 4.5 and more.
const std::array<InkColor, kInks>& inkColors();

struct ChartLine {
    Ink ink = Ink::Grid;
    double width = 1;
    bool dashed = false;
    std::vector<ChartPoint> points;
};

/// A filled polygon.
struct ChartMark {
    Ink ink = Ink::FirstCurve;
    std::vector<ChartPoint> corners;
    std::string title; ///< its numbers, in words; may be empty
};

enum class Anchor { Start, Middle, End };

struct ChartText {
    Ink ink = Ink::Text;
    ChartPoint at = {}; ///< on the base line
    std::string text;   ///< ASCII
    Anchor anchor = Anchor::Start;
    double size = 13;
    bool upwards = false; ///< turned to the left by a right angle
};

/// In the order in which its parts are drawn: lines, marks, texts.
struct ChartLayout {
    double width = 720, height = 540;
    std::string summary; ///< the curves in words
    std::vector<ChartLine> lines;
    std::vector<ChartMark> marks;
    std::vector<ChartText> texts;
};

/// @throw openvdb::ValueError if the size is out of range
ChartLayout layOutChart(const std::vector<ErrorCurve>& curves, const ChartSize& size);

} // namespace openvdb_spheretree::detail
