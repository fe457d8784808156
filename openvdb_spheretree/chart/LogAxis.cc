// SPDX-License-Identifier: Apache-2.0
#include "LogAxis.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace openvdb_spheretree::detail {

namespace {

constexpr int kMostTicks = 9;

int decadeOf(int place) { return (place >= 0 ? place : place - 2) / 3; }

/// The numbers of the series, from the text: 1 * 10^-2 as a product is not 0.01.
double seriesValue(int place)
{
    constexpr std::array<int, 3> kSteps = {1, 2, 5};
    const int decade = decadeOf(place);
    std::array<char, 16> text;
    std::snprintf(
        text.data(), text.size(), "%de%d", kSteps[std::size_t(place - 3 * decade)], decade);
    return std::strtod(text.data(), nullptr);
}

std::string withCommas(std::string digits)
{
    for (int at = int(digits.size()) - 3; at > 0; at -= 3) digits.insert(std::size_t(at), ",");
    return digits;
}

std::string labelOf(int place)
{
    const double value = seriesValue(place);
    const int decade = decadeOf(place);
    std::array<char, 32> text;
    if (decade < -3 || decade > 6) {
        std::snprintf(text.data(), text.size(), "%.0e", value);
        std::string label = text.data(); // 2e-05, 1e+07
        const std::size_t exponent = label.find('e') + 1;
        return label.substr(0, exponent) + std::to_string(std::atoi(label.c_str() + exponent));
    }
    std::snprintf(text.data(), text.size(), "%.*f", decade < 0 ? -decade : 0, value);
    return decade < 3 ? text.data() : withCommas(text.data());
}

} // namespace

LogAxis::LogAxis(double low, double high)
{
    mFirst = 3 * int(std::floor(std::log10(low)));
    while (seriesValue(mFirst) > low) --mFirst; // where the logarithm was rounded up
    while (seriesValue(mFirst + 1) <= low) ++mFirst;
    mLast = mFirst + 1; // an axis has a length
    while (seriesValue(mLast) < high) ++mLast;
}

double LogAxis::at(double value) const
{
    const double low = std::log(seriesValue(mFirst)), high = std::log(seriesValue(mLast));
    return (std::log(value) - low) / (high - low);
}

std::vector<LogAxis::Tick> LogAxis::ticks() const
{
    int step = 1;
    while ((mLast - mFirst) / step >= kMostTicks) step = step == 1 ? 3 : step + 3;
    // From powers of ten on, where only these have ticks.
    const int first = step == 1 ? mFirst : 3 * (decadeOf(mFirst + 2));
    std::vector<Tick> ticks;
    for (int place = first; place <= mLast; place += step) {
        ticks.push_back({seriesValue(place), labelOf(place)});
    }
    return ticks;
}

} // namespace openvdb_spheretree::detail
