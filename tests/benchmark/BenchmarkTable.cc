// SPDX-License-Identifier: Apache-2.0
#include "BenchmarkTable.h"

#include <cstdio>
#include <ostream>
#include <string>

namespace spheretree_benchmark {

namespace {

constexpr const char* kHeader = "%-18s %9s  %-21s %7s %9s %9s %9s %9s\n";
constexpr const char* kLine = "%-18s %9s  %-21s %7d %9s %9s %9s %9s";

template <typename... Values>
std::string formatted(const char* format, Values... values)
{
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// Three digits, or all before the point; no exponent.
std::string number(double value)
{
    return formatted(value < 0.1 ? "%.3f"
            : value < 10         ? "%.2f"
            : value < 100        ? "%.1f"
                                 : "%.0f",
        value);
}

std::string remark(const Measurement& m)
{
    if (m.balls == 0) return "\n";
    return formatted("  %lld balls, %s us each\n", static_cast<long long>(m.balls),
        number(1e6 * m.seconds / double(m.balls)).c_str());
}

} // namespace

void printHeader(std::ostream& out)
{
    out << formatted(
        kHeader, "object", "Mvoxel", "stage", "threads", "ms", "Mvoxel/s", "% of copy", "B/voxel");
}

void printLine(std::ostream& out, const Measurement& m)
{
    if (!m.measured()) {
        out << m.object << ' ' << m.stage << ": " << m.failure << '\n' << std::flush;
        return;
    }
    const std::optional<double> peak = m.peakBytesPerVoxel();
    out << formatted(kLine, m.object.c_str(), formatted("%.3f", 1e-6 * double(m.voxels)).c_str(),
        m.stage.c_str(), m.threads, number(1e3 * m.seconds).c_str(),
        number(m.megavoxelsPerSecond()).c_str(), number(100 * m.ofCopy()).c_str(),
        peak ? number(*peak).c_str() : "-")
        << remark(m) << std::flush;
}

void printGrowth(std::ostream& out, const std::vector<Growth>& growths)
{
    if (growths.empty()) return;
    out << '\n'
        << formatted("%-18s %-21s %7s %8s %6s %15s\n", "family", "stage", "threads", "exponent",
               "sizes", "Mvoxel");
    for (const Growth& g : growths) {
        const std::string range = formatted(
            "%.3g to %.3g", 1e-6 * double(g.smallestVoxels), 1e-6 * double(g.largestVoxels));
        out << formatted("%-18s %-21s %7d %8.2f %6d %15s\n", g.family.c_str(), g.stage.c_str(),
            g.threads, g.exponent, g.sizes, range.c_str());
    }
}

} // namespace spheretree_benchmark
