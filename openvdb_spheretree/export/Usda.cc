// SPDX-License-Identifier: Apache-2.0
// A stage of USD: a Points prim a level, and a variant set that shows one level at a time. Trees that are
// samples over time become time samples. https://openusd.org/release/api/class_usd_geom_points.html

#include "ExportText.h"
#include "ExportWriters.h"
#include <openvdb_spheretree/base/Rounding.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace openvdb_spheretree::detail {

namespace {

using Samples = std::vector<ExportScene>;
using WriteValue = std::function<void(ExportText&, const ExportLevel&)>;

constexpr const char* kIndent = "        ";

/// Levels are numbered, so those of one number are one prim. A tree with fewer levels than others shows the nearest that
/// it has there: else what it covers would be gone for a frame.
/// @return one without spheres of a sample that has none
const ExportLevel& levelIn(const ExportScene& scene, int number)
{
    static const ExportLevel kNothing;
    const ExportLevel* nearest = nullptr;
    for (const ExportLevel& level : scene.levels) {
        const int off = std::abs(level.number - number);
        if (!nearest || off < std::abs(nearest->number - number)) nearest = &level;
    }
    return nearest ? *nearest : kNothing;
}

/// @return the numbers of the levels of all samples, the finest first; 0 if none has any.
std::vector<int> levelNumbers(const Samples& samples)
{
    std::vector<int> numbers;
    for (const ExportScene& scene : samples) {
        for (const ExportLevel& level : scene.levels) numbers.push_back(level.number);
    }
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    if (numbers.empty()) numbers.push_back(0);
    return numbers;
}

template <typename WriteItem>
void writeArray(ExportText& text, std::size_t count, const WriteItem& writeItem)
{
    text << '[';
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) text << ", ";
        writeItem(i);
    }
    text << ']';
}

void writeExtent(ExportText& text, const ExportLevel& level)
{
    if (level.size() == 0) {
        constexpr const char* kMost = "340282346638528859811704183484516925440"; // of a float
        text << "[(" << kMost << ", " << kMost << ", " << kMost << "), (-" << kMost << ", -"
             << kMost << ", -" << kMost
             << ")]"; // the box of nothing, as UsdGeomPoints::ComputeExtent() has it
        return;
    }
    const openvdb::BBoxd box = ExportScene::boxOf(level);
    openvdb::Vec3d low, high; // rounded outward
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = double(toFloatDown(box.min()[axis]));
        high[axis] = double(toFloatUp(box.max()[axis]));
    }
    text << "[(";
    text.floats(low, ", ") << "), (";
    text.floats(high, ", ") << ")]";
}

/// One value, or one a sample; a sample without spheres has an empty one.
void writeAttribute(ExportText& text, const Samples& samples, int number, const std::string& name,
    const char* metadata, const WriteValue& writeValue)
{
    text << kIndent << name;
    if (samples.size() == 1) {
        text << " = ";
        writeValue(text, levelIn(samples.front(), number));
        text << metadata << '\n';
        return;
    }
    // Metadata belongs to the attribute itself, which has no value of its own then.
    if (*metadata) text << metadata << '\n' << kIndent << name;
    text << ".timeSamples = {\n";
    for (const ExportScene& scene : samples) {
        text << kIndent << "    ";
        text.real(scene.sample) << ": ";
        writeValue(text, levelIn(scene, number));
        text << ",\n";
    }
    text << kIndent << "}\n";
}

void writePoints(ExportText& text, const Samples& samples, int number)
{
    constexpr const char* kVertex = " (\n            interpolation = \"vertex\"\n        )";
    text << "    def Points \"level_" << number << "\"\n    {\n";
    writeAttribute(text, samples, number, "float3[] extent", "", writeExtent);
    writeAttribute(
        text, samples, number, "int64[] ids", "", [](ExportText& to, const ExportLevel& level) {
            writeArray(to, level.size(), [&](std::size_t i) { to << level.ids[i]; });
        });
    writeAttribute(text, samples, number, "point3f[] points", "",
        [](ExportText& to, const ExportLevel& level) {
            writeArray(to, level.size(), [&](std::size_t i) {
                to << '(';
                to.floats(level.centers[i], ", ") << ')';
            });
        });
    writeAttribute(text, samples, number, "float[] widths", kVertex,
        [](ExportText& to, const ExportLevel& level) {
            writeArray(to, level.size(), [&](std::size_t i) { to.asFloat(2 * level.radii[i]); });
        });
    writeAttribute(text, samples, number, "int[] primvars:parent", kVertex,
        [](ExportText& to, const ExportLevel& level) {
            writeArray(to, level.size(), [&](std::size_t i) { to << level.parents[i]; });
        });
    text << "    }\n";
}

void writeVariants(ExportText& text, const std::vector<int>& numbers)
{
    text << "    variantSet \"level\" = {\n";
    for (const int shown : numbers) {
        text << "        \"level_" << shown << "\" {\n";
        for (const int number : numbers) {
            text << "            over \"level_" << number
                 << "\"\n            {\n                token visibility = \""
                 << (number == shown ? "inherited" : "invisible") << "\"\n            }\n";
        }
        text << "        }\n";
    }
    text << "    }\n";
}

void writeStage(ExportText& text, const Samples& samples, const std::string& prim)
{
    const ExportScene& scene = samples.front();
    text << "#usda 1.0\n(\n    defaultPrim = \"" << prim << "\"\n    metersPerUnit = ";
    text.real(scene.metersPerUnit)
        << "\n    upAxis = \"" << (scene.up == UpAxis::Y ? "Y" : "Z") << "\"\n";
    if (samples.size() > 1) {
        text << "    startTimeCode = ";
        text.real(scene.sample) << "\n    endTimeCode = ";
        text.real(samples.back().sample) << "\n    timeCodesPerSecond = ";
        text.real(scene.framesPerSecond) << "\n    framesPerSecond = ";
        text.real(scene.framesPerSecond) << '\n';
    }
    text << ")\n\n";
}

} // namespace

void writeUsda(const Samples& samples, const ExportSink& out)
{
    const std::string prim = identifier(samples.front().name);
    const std::vector<int> numbers = levelNumbers(samples);
    ExportText text(out, samples.front().decimals);
    writeStage(text, samples, prim);
    text << "def Xform \"" << prim << "\" (\n";
    if (numbers.size() > 1) {
        text << "    variants = {\n        string level = \"level_" << numbers.front()
             << "\"\n    }\n    prepend variantSets = \"level\"\n";
    }
    text << "    kind = \"component\"\n)\n{\n";
    for (const int number : numbers) writePoints(text, samples, number);
    if (numbers.size() > 1) writeVariants(text, numbers);
    text << "}\n";
    text.finish();
}

} // namespace openvdb_spheretree::detail
