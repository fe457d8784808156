// SPDX-License-Identifier: Apache-2.0
// A chart as an SVG 1.1 with one style sheet, which knows light and dark screens (CSS Media Queries 5,
// prefers-color-scheme). Programs that do not know it take the light one.

#include "ChartLayout.h"
#include <openvdb_spheretree/export/ExportText.h>

#include <cmath>
#include <cstdio>

namespace openvdb_spheretree {

namespace {

using namespace detail;

constexpr int kDecimals = 2;

/// Coordinates are rounded to hundredths, which are multiples of what the text takes.
double hundredths(double number) { return std::round(number * 100) / 100; }

std::string hexOf(uint32_t color)
{
    std::array<char, 8> text;
    std::snprintf(text.data(), text.size(), "#%06x", unsigned(color));
    return text.data();
}

std::string classOf(Ink ink) { return "i" + std::to_string(int(ink)); }

std::string pointsOf(const std::vector<ChartPoint>& points)
{
    std::string text;
    for (const ChartPoint& point : points) {
        std::array<char, 64> pair;
        std::snprintf(pair.data(), pair.size(), "%.2f,%.2f", point[0], point[1]);
        text += (text.empty() ? "" : " ") + std::string(pair.data());
    }
    return text;
}

void writeStyle(ExportText& text)
{
    text << "<style>\ntext { font-family: system-ui, sans-serif }\n"
            "polyline { fill: none; stroke-linejoin: round }\n.dashed { stroke-dasharray: 7 5 }\n";
    const auto writeColors = [&](uint32_t InkColor::*paper) {
        for (int ink = 0; ink < kInks; ++ink) {
            const std::string name = classOf(Ink(ink));
            const std::string color = hexOf(inkColors()[std::size_t(ink)].*paper);
            text << "." << name << " { fill: " << color << " } polyline." << name
                 << " { stroke: " << color << "; fill: none }\n";
        }
    };
    writeColors(&InkColor::light);
    text << "@media (prefers-color-scheme: dark) {\n";
    writeColors(&InkColor::dark);
    text << "}\n</style>\n";
}

void writeText(ExportText& text, const ChartText& label)
{
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    const double x = hundredths(label.at[0]), y = hundredths(label.at[1]);
    text << "<text class=\"" << classOf(label.ink) << "\" x=\"" << x << "\" y=\"" << y
         << "\" font-size=\"" << label.size << "\" text-anchor=\""
         << kAnchors[std::size_t(label.anchor)] << '"';
    if (label.upwards) text << " transform=\"rotate(-90 " << x << ' ' << y << ")\"";
    text << '>' << xmlText(label.text) << "</text>\n";
}

} // namespace

void writeChartSvg(const std::vector<ErrorCurve>& curves, const ChartSize& size, std::ostream& out)
{
    const ChartLayout chart = layOutChart(curves, size);
    ExportText text(out, kDecimals);
    text << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << hundredths(chart.width)
         << ' ' << hundredths(chart.height) << "\" role=\"img\">\n"
         << "<title>Error against number of spheres</title>\n<desc>" << xmlText(chart.summary)
         << "</desc>\n";
    writeStyle(text);
    text << "<rect class=\"" << classOf(Ink::Paper) << "\" width=\"100%\" height=\"100%\"/>\n";
    for (const ChartLine& line : chart.lines) {
        if (line.points.size() < 2) continue;
        text << "<polyline class=\"" << classOf(line.ink) << (line.dashed ? " dashed" : "")
             << "\" stroke-width=\"" << line.width << "\" points=\"" << pointsOf(line.points)
             << "\"/>\n";
    }
    for (const ChartMark& mark : chart.marks) {
        text << "<polygon class=\"" << classOf(mark.ink) << "\" points=\"" << pointsOf(mark.corners)
             << "\"><title>" << xmlText(mark.title) << "</title></polygon>\n";
    }
    for (const ChartText& label : chart.texts) writeText(text, label);
    text << "</svg>\n";
    text.finish();
}

} // namespace openvdb_spheretree
