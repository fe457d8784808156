// SPDX-License-Identifier: Apache-2.0
// Both axes are logarithmic, since a level has a multiple of the spheres of the next, and errors fall by ratios. Names stand
// above the axes, where no curve can run through them.

#include "ChartLayout.h"

#include "LogAxis.h"
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace openvdb_spheretree::detail {

namespace {

constexpr double kLeft = 64, kRight = 20, kTop = 40, kBottom = 52; // around the axes
constexpr double kNameHeight = 20; // of a line of the names of curves
constexpr double kZeroHeight = 26; // from the axis of errors down to the line of 0
constexpr double kMarkRadius = 4.5;
constexpr std::size_t kLongestName = 40;

std::string asciiName(const std::string& name)
{
    std::string text = onOneLine(name, kLongestName);
    for (char& c : text) {
        if (static_cast<unsigned char>(c) >= 127) c = '?';
    }
    return text;
}

Ink inkOf(std::size_t curve) { return Ink(int(Ink::FirstCurve) + int(curve % kCurveInks)); }

bool isDashed(std::size_t curve) { return curve / kCurveInks % 2 == 1; }

std::vector<ChartPoint> regularPolygon(
    const ChartPoint& at, int corners, double radius, double turn)
{
    constexpr double kPi = 3.14159265358979323846;
    std::vector<ChartPoint> points;
    for (int i = 0; i < corners; ++i) {
        const double angle = turn + 2 * kPi * i / corners;
        points.push_back({at[0] + radius * std::cos(angle), at[1] + radius * std::sin(angle)});
    }
    return points;
}

/// Circle, square, triangle, rhombus: who sees no colors has the shapes. All of about one area.
std::vector<ChartPoint> markAt(const ChartPoint& at, std::size_t curve)
{
    constexpr double kUp = -1.57079632679489661923, kCorner = 0.78539816339744830962;
    switch (curve % 4) {
    case 0: return regularPolygon(at, 24, kMarkRadius, 0);
    case 1: return regularPolygon(at, 4, 1.25 * kMarkRadius, kCorner);
    case 2: return regularPolygon(at, 3, 1.5 * kMarkRadius, kUp);
    default: return regularPolygon(at, 4, 1.3 * kMarkRadius, kUp);
    }
}

std::string inWords(const ErrorCurve::Point& point)
{
    return shortNumber(point.hammingPercent) + " % with " + std::to_string(point.spheres)
        + (point.spheres == 1 ? " sphere" : " spheres");
}

/// The first and the last point of each curve.
std::string summaryOf(const std::vector<ErrorCurve>& curves)
{
    std::string text;
    for (const ErrorCurve& curve : curves) {
        if (curve.points.empty()) continue;
        text += (text.empty() ? "" : "; ") + asciiName(curve.name) + ": "
            + inWords(curve.points.front());
        if (curve.points.size() > 1) text += ", " + inWords(curve.points.back());
    }
    return text.empty() ? "No errors are known." : text + ".";
}

class ChartMaker {
public:
    ChartMaker(const std::vector<ErrorCurve>& curves, const ChartSize& size) : mCurves(curves)
    {
        mChart.height = mChart.width * size.height / size.width;
        mChart.summary = summaryOf(curves);
        const std::size_t rows = (curves.size() + 1) / 2;
        mTop = std::min(kTop + kNameHeight * double(rows), mChart.height / 2);
        mRight = mChart.width - kRight;
        mBottom = mChart.height - kBottom;
        findAxes();
    }

    ChartLayout make()
    {
        addTitles();
        addErrorTicks();
        addSphereTicks();
        for (std::size_t i = 0; i < mCurves.size(); ++i) addCurve(i);
        return std::move(mChart);
    }

private:
    void findAxes()
    {
        double fewest = std::numeric_limits<double>::infinity(), least = fewest, most = 0,
               worst = 0;
        for (const ErrorCurve& curve : mCurves) {
            for (const ErrorCurve::Point& point : curve.points) {
                fewest = std::min(fewest, double(point.spheres));
                most = std::max(most, double(point.spheres));
                mHasZero |= point.hammingPercent <= 0;
                if (point.hammingPercent <= 0) continue;
                least = std::min(least, point.hammingPercent);
                worst = std::max(worst, point.hammingPercent);
            }
        }
        mSpheres.emplace(most > 0 ? fewest : 1, most > 0 ? most : 1000);
        mErrors.emplace(worst > 0 ? least : 1, worst > 0 ? worst : 100);
    }

    double xOf(double spheres) const { return kLeft + mSpheres->at(spheres) * (mRight - kLeft); }

    double yOf(double percent) const
    {
        if (percent <= 0) return mBottom;
        const double low = mHasZero ? mBottom - kZeroHeight : mBottom;
        return low - mErrors->at(percent) * (low - mTop);
    }

    void addTitles()
    {
        mChart.texts.push_back(
            {Ink::Text, {kLeft, 24}, "Error against number of spheres", Anchor::Start, 15, false});
        mChart.texts.push_back({Ink::Faint, {(kLeft + mRight) / 2, mChart.height - 12}, "spheres",
            Anchor::Middle, 13, false});
        mChart.texts.push_back({Ink::Faint, {16, (mTop + mBottom) / 2},
            "Hamming distance, % of the object", Anchor::Middle, 13, true});
    }

    void addErrorTicks()
    {
        std::vector<LogAxis::Tick> ticks = mErrors->ticks();
        if (mHasZero) ticks.push_back({0, "0"});
        for (const LogAxis::Tick& tick : ticks) {
            const double y = yOf(tick.value);
            mChart.lines.push_back({Ink::Grid, 1, false, {{kLeft, y}, {mRight, y}}});
            mChart.texts.push_back(
                {Ink::Faint, {kLeft - 7, y + 4}, tick.label, Anchor::End, 12, false});
        }
    }

    void addSphereTicks()
    {
        for (const LogAxis::Tick& tick : mSpheres->ticks()) {
            const double x = xOf(tick.value);
            mChart.lines.push_back({Ink::Grid, 1, false, {{x, mTop}, {x, mBottom}}});
            mChart.texts.push_back(
                {Ink::Faint, {x, mBottom + 18}, tick.label, Anchor::Middle, 12, false});
        }
    }

    void addCurve(std::size_t index)
    {
        const ErrorCurve& curve = mCurves[index];
        ChartLine line = {inkOf(index), 2, isDashed(index), {}};
        const std::string name = asciiName(curve.name);
        for (const ErrorCurve::Point& point : curve.points) {
            const ChartPoint at = {xOf(double(point.spheres)), yOf(point.hammingPercent)};
            line.points.push_back(at);
            mChart.marks.push_back({inkOf(index), markAt(at, index),
                name + ", level " + std::to_string(point.level) + ": " + inWords(point)});
        }
        mChart.lines.push_back(line);
        addName(index, name);
    }

    /// In two columns, row by row.
    void addName(std::size_t index, const std::string& name)
    {
        const double x = kLeft + double(index % 2) * (mRight - kLeft) / 2;
        const double y = kTop + kNameHeight * (double(index / 2) + 0.25);
        if (y + 4 > mTop) return; // more names than there is room for
        mChart.lines.push_back({inkOf(index), 2, isDashed(index), {{x, y}, {x + 30, y}}});
        mChart.marks.push_back({inkOf(index), markAt({x + 15, y}, index), {}});
        mChart.texts.push_back({Ink::Text, {x + 38, y + 4.5}, name, Anchor::Start, 13, false});
    }

    const std::vector<ErrorCurve>& mCurves;
    ChartLayout mChart;
    double mTop = 0, mRight = 0, mBottom = 0; ///< of the axes
    bool mHasZero = false;
    std::optional<LogAxis> mSpheres, mErrors;
};

} // namespace

const std::array<InkColor, kInks>& inkColors()
{
    static const std::array<InkColor, kInks> colors = {{{0xffffff, 0x15181c}, {0x1b1f24, 0xe8eaed},
        {0x57606a, 0xa9b1ba}, {0xdde1e6, 0x363c44}, {0x0b62b0, 0x6cb6ff}, {0xb8420a, 0xffa15c},
        {0x1a7240, 0x63d391}, {0x7a3db8, 0xcaa2f8}, {0x0c6d80, 0x5fd2e4}, {0xb3205a, 0xff92bd}}};
    return colors;
}

ChartLayout layOutChart(const std::vector<ErrorCurve>& curves, const ChartSize& size)
{
    constexpr int kMaxSide = 16384;
    for (const int side : {size.width, size.height}) {
        if (side >= 1 && side <= kMaxSide) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "a chart of " << size.width << " x " << size.height << " pixels: sides are 1 to "
                          << kMaxSide);
    }
    return ChartMaker(curves, size).make();
}

} // namespace openvdb_spheretree::detail
