// SPDX-License-Identifier: Apache-2.0
#include "ErrorChart.h"

#include <openvdb_spheretree/base/CsvCell.h>
#include <openvdb_spheretree/export/ExportText.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace openvdb_spheretree {

ErrorCurve errorCurve(const SphereTree& tree)
{
    ErrorCurve curve;
    curve.name = tree.settings.name;
    for (const SphereTreeLevel& level : tree.levels) {
        if (!level.error || level.size() == 0) continue;
        curve.points.push_back(
            {level.level, level.size(), level.error->hammingPercent, level.error->hausdorff});
    }
    std::sort(curve.points.begin(), curve.points.end(), [](const auto& a, const auto& b) {
        return std::tie(a.spheres, b.level) < std::tie(b.spheres, a.level);
    });
    return curve;
}

std::vector<ErrorCurve> withOwnNames(std::vector<ErrorCurve> curves)
{
    std::map<std::string, int> count, used;
    for (const ErrorCurve& curve : curves) ++count[curve.name];
    for (ErrorCurve& curve : curves) {
        if (count[curve.name] == 1) continue;
        const std::string name = curve.name;
        curve.name = name + " (" + std::to_string(++used[name]) + ")";
    }
    return curves;
}

void writeChartCsv(const std::vector<ErrorCurve>& curves, std::ostream& out)
{
    detail::ExportText text(out, 0);
    text << "tree,level,spheres,hamming_percent,hausdorff\n";
    for (const ErrorCurve& curve : curves) {
        for (const ErrorCurve::Point& point : curve.points) {
            text << detail::csvCell(curve.name) << ',' << point.level << ',' << point.spheres
                 << ',';
            text.real(point.hammingPercent) << ',';
            text.real(point.hausdorff) << '\n';
        }
    }
    text.finish();
}

} // namespace openvdb_spheretree
