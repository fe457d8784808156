// SPDX-License-Identifier: Apache-2.0
// Curves of trees, where a chart has their points, and that its files say the same.

#include <openvdb_spheretree/chart/ChartLayout.h>
#include <openvdb_spheretree/chart/ErrorChart.h>

#include "support/Messages.h"

#include <openvdb/Exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace {

using namespace openvdb_spheretree;
using detail::ChartLayout;
using detail::ChartMark;
using detail::ChartPoint;
using spheretree_test::mentions;

std::vector<ErrorCurve> twoCurves()
{
    return {{"fine", {{2, 1, 400, 20}, {1, 10, 40, 4}, {0, 100, 4, 2}}},
        {"exact", {{1, 1, 300, 9}, {0, 1000, 0, 0}}}};
}

ChartPoint middleOf(const ChartMark& mark)
{
    ChartPoint sum = {0, 0};
    for (const ChartPoint& corner : mark.corners) {
        for (int axis = 0; axis < 2; ++axis)
            sum[axis] += corner[axis] / double(mark.corners.size());
    }
    return sum;
}

/// Marks of points; those of names have no titles.
std::vector<ChartPoint> pointsOf(const ChartLayout& chart)
{
    std::vector<ChartPoint> points;
    for (const ChartMark& mark : chart.marks) {
        if (!mark.title.empty()) points.push_back(middleOf(mark));
    }
    return points;
}

std::string svgOf(const std::vector<ErrorCurve>& curves, const ChartSize& size = {})
{
    std::ostringstream out;
    writeChartSvg(curves, size, out);
    return out.str();
}

TEST(ErrorChart, ACurveHasTheLevelsWhoseErrorsAreKnownByNumberOfSpheres)
{
    SphereTree tree;
    tree.settings.name = "part";
    tree.levels.resize(4);
    const int32_t ends[] = {60, 70, 71, 72};
    for (int i = 0; i < 4; ++i) {
        tree.levels[i].level = i;
        tree.levels[i].begin = i == 0 ? 0 : ends[i - 1];
        tree.levels[i].end = ends[i];
        if (i == 1) continue;
        tree.levels[i].error = LevelError{};
        tree.levels[i].error->hammingPercent = 10.0 * i;
        tree.levels[i].error->hausdorff = i;
    }
    const ErrorCurve curve = errorCurve(tree);
    EXPECT_EQ(curve.name, "part");
    ASSERT_EQ(curve.points.size(), 3u);
    EXPECT_EQ(curve.points[0].level, 3);
    EXPECT_EQ(curve.points[1].level, 2);
    EXPECT_EQ(curve.points[2].level, 0);
    EXPECT_EQ(curve.points[2].spheres, 60);
    EXPECT_EQ(curve.points[1].hammingPercent, 20);
    EXPECT_EQ(curve.points[1].hausdorff, 2);
}

TEST(ErrorChart, CurvesOfOneNameGetNumbers)
{
    const auto curves = withOwnNames({{"a", {}}, {"b", {}}, {"a", {}}});
    EXPECT_EQ(curves[0].name, "a (1)");
    EXPECT_EQ(curves[1].name, "b");
    EXPECT_EQ(curves[2].name, "a (2)");
}

TEST(ErrorChart, EqualRatiosAreEqualDistancesOnBothAxes)
{
    const auto points = pointsOf(detail::layOutChart({twoCurves()[0]}, {}));
    ASSERT_EQ(points.size(), 3u);
    EXPECT_NEAR(points[1][0] - points[0][0], points[2][0] - points[1][0], 1e-9);
    EXPECT_NEAR(points[1][1] - points[0][1], points[2][1] - points[1][1], 1e-9);
    EXPECT_GT(points[1][0], points[0][0] + 100);
    EXPECT_GT(points[1][1], points[0][1] + 50) << "a smaller error is farther down";
}

TEST(ErrorChart, AnErrorOfZeroHasALineOfItsOwnBelow)
{
    const ChartLayout chart = detail::layOutChart(twoCurves(), {});
    const auto points = pointsOf(chart);
    ASSERT_EQ(points.size(), 5u);
    for (int i = 0; i < 4; ++i) EXPECT_LT(points[i][1], points[4][1] - 20);
    EXPECT_EQ(points[4][1], chart.height - 52);
}

TEST(ErrorChart, EverythingIsOnTheChart)
{
    for (const int height : {300, 960, 2000}) {
        const ChartLayout chart = detail::layOutChart(twoCurves(), {1280, height});
        EXPECT_NEAR(chart.height, 720.0 * height / 1280, 1e-9);
        for (const ChartPoint& point : pointsOf(chart)) {
            EXPECT_TRUE(point[0] >= 0 && point[0] <= chart.width);
            EXPECT_TRUE(point[1] >= 0 && point[1] <= chart.height);
        }
    }
}

TEST(ErrorChart, WithoutPointsThereAreAxes)
{
    const std::vector<std::vector<ErrorCurve>> nothings = {{}, {{"none", {}}}};
    for (const auto& curves : nothings) {
        const ChartLayout chart = detail::layOutChart(curves, {});
        EXPECT_TRUE(pointsOf(chart).empty());
        EXPECT_GT(chart.texts.size(), 5u);
        EXPECT_TRUE(mentions(svgOf(curves), "No errors are known."));
    }
}

TEST(ErrorChart, TheSvgSaysItsNumbersAndEscapesNames)
{
    auto curves = twoCurves();
    curves[0].name = "a<b> & \"c\" \xc3\xa9";
    const std::string svg = svgOf(curves);
    EXPECT_TRUE(mentions(
        svg, "<title>a&lt;b&gt; &amp; &quot;c&quot; ??, level 1: 40 % with 10 spheres</title>"));
    EXPECT_TRUE(mentions(svg, "exact: 300 % with 1 sphere, 0 % with 1000 spheres.</desc>"));
    EXPECT_TRUE(mentions(svg, "prefers-color-scheme: dark"));
    EXPECT_TRUE(mentions(svg, "viewBox=\"0 0 720.0 540.0\""));
    EXPECT_EQ(svg, svgOf(curves)) << "the same bytes";
}

TEST(ErrorChart, TheTableQuotesNames)
{
    auto curves = twoCurves();
    curves[1].name = "ex\"a,ct";
    std::ostringstream out;
    writeChartCsv(curves, out);
    EXPECT_EQ(out.str(),
        "tree,level,spheres,hamming_percent,hausdorff\n"
        "fine,2,1,400,20\nfine,1,10,40,4\nfine,0,100,4,2\n"
        "\"ex\"\"a,ct\",1,1,300,9\n\"ex\"\"a,ct\",0,1000,0,0\n");
}

/// Relative luminance and contrast as WCAG 2.1 defines them.
double contrast(uint32_t a, uint32_t b)
{
    const auto luminance = [](uint32_t color) {
        double sum = 0;
        const double weights[] = {0.0722, 0.7152, 0.2126};
        for (int i = 0; i < 3; ++i) {
            const double c = (color >> (8 * i) & 255) / 255.0;
            sum += weights[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
        }
        return sum + 0.05;
    };
    const double x = luminance(a), y = luminance(b);
    return std::max(x, y) / std::min(x, y);
}

TEST(ErrorChart, ColorsCanBeReadOnLightAndDarkPaper)
{
    const auto& colors = detail::inkColors();
    const auto paper = colors[int(detail::Ink::Paper)];
    for (int ink = 0; ink < detail::kInks; ++ink) {
        if (ink == int(detail::Ink::Paper) || ink == int(detail::Ink::Grid)) continue;
        EXPECT_GE(contrast(colors[ink].light, paper.light), 4.5) << ink;
        EXPECT_GE(contrast(colors[ink].dark, paper.dark), 4.5) << ink;
    }
}

TEST(ErrorChart, ThePictureHasTheMarksInTheirColors)
{
    if (!drawsCharts()) GTEST_SKIP() << "this build has no cairo";
    const ChartSize size = {400, 300};
    const Picture picture = drawChart(twoCurves(), size);
    ASSERT_EQ(picture.width, size.width);
    ASSERT_EQ(picture.height, size.height);
    const ChartLayout chart = detail::layOutChart(twoCurves(), size);
    const auto colorAt = [&](const ChartPoint& at) {
        const int x = int(at[0] * size.width / chart.width);
        const int y = int(at[1] * size.width / chart.width);
        const uint8_t* const p = &picture.rgb[3 * (std::size_t(y) * size.width + x)];
        return uint32_t(p[0] << 16 | p[1] << 8 | p[2]);
    };
    EXPECT_EQ(colorAt({1, 1}), 0xffffffu);
    for (const ChartMark& mark : chart.marks) {
        EXPECT_EQ(colorAt(middleOf(mark)), detail::inkColors()[int(mark.ink)].light) << mark.title;
    }
    EXPECT_EQ(picture.rgb, drawChart(twoCurves(), size).rgb);
}

TEST(ErrorChart, SizesOutOfRangeAreRefused)
{
    for (const ChartSize size : {ChartSize{0, 10}, {10, 0}, {16385, 10}, {10, -1}}) {
        EXPECT_THROW(svgOf(twoCurves(), size), openvdb::ValueError);
    }
}

} // namespace
