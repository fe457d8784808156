// SPDX-License-Identifier: Apache-2.0
#include "WriteChart.h"

#include "CountErrors.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/chart/ErrorChart.h>

#include <algorithm>

namespace command {

namespace spheretree = openvdb_spheretree;

namespace {

std::string extensionOf(const std::string& path)
{
    return spheretree::detail::lowerExtension(path);
}

std::vector<spheretree::ErrorCurve> curvesOf(const std::vector<StackItem*>& items)
{
    std::vector<spheretree::ErrorCurve> curves;
    for (const StackItem* item : items) {
        if (item->tree) curves.push_back(spheretree::errorCurve(*item->tree));
    }
    return spheretree::withOwnNames(curves);
}

[[noreturn]] void throwUnknown(const StackItem& item, const std::string& path)
{
    const auto& levels = item.tree->levels;
    const std::string& why = levels.front().errorUnknown;
    throwInput(path + ": the errors of " + item.description() + " are not known"
        + (why.empty() ? ", and its object is not on the stack: -read it before" : ": " + why));
}

/// Levels of which no error is known are noted; a tree without any is an error.
void requireKnown(const StackItem& item, const std::string& path, Session& session)
{
    const auto& levels = item.tree->levels;
    const auto unknown =
        std::count_if(levels.begin(), levels.end(), [](const auto& level) { return !level.error; });
    if (unknown == std::ptrdiff_t(levels.size())) throwUnknown(item, path);
    if (unknown == 0) return;
    session.note(path + " lacks " + std::to_string(unknown) + " of " + std::to_string(levels.size())
        + " levels of " + item.description() + ", whose errors are not known (-stats says why)");
}

} // namespace

std::vector<std::pair<std::string, std::string>> chartDocs()
{
    return {{".svg", "errors against numbers of spheres: a curve for each tree, with its name"},
        {".png .csv", "format=curve: the same as a picture or a table"}};
}

bool isChart(const ActionCall& call, const std::string& path)
{
    const std::string extension = extensionOf(path);
    if (extension == ".svg") return true;
    return call.given("format") && call.text("format") == kChartFormat
        && (extension == ".png" || extension == ".csv");
}

void checkCharts(const ActionCall& call)
{
    for (const std::string& path : call.list("files")) {
        if (!isChart(call, path) || extensionOf(path) != ".png" || spheretree::drawsCharts()) {
            continue;
        }
        throwUsage(path + ": this build has no cairo, so it writes curves as .svg and .csv only");
    }
}

void countErrorsOfCharts(
    const ActionCall& call, const std::vector<StackItem*>& items, Session& session)
{
    const std::vector<std::string> files = call.list("files");
    const auto chart = std::find_if(
        files.begin(), files.end(), [&](const std::string& path) { return isChart(call, path); });
    if (chart == files.end()) return;
    bool anyTree = false;
    for (StackItem* item : items) {
        anyTree |= item->anyTree() != nullptr;
        if (!item->tree) continue;
        countErrors(*item, session);
        requireKnown(*item, *chart, session);
    }
    if (anyTree) return;
    throwInput(*chart + " shows errors of sphere-trees, and there is none: put -spheretree before");
}

void writeChart(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, std::ostream& out)
{
    const std::vector<spheretree::ErrorCurve> curves = curvesOf(items);
    const spheretree::ChartSize size = {int(call.integer("width")), int(call.integer("height"))};
    const std::string extension = extensionOf(path);
    if (extension == ".csv") return spheretree::writeChartCsv(curves, out);
    if (extension == ".svg") return spheretree::writeChartSvg(curves, size, out);
    spheretree::writePng(spheretree::drawChart(curves, size), out);
}

} // namespace command
