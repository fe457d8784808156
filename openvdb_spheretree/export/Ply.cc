// SPDX-License-Identifier: Apache-2.0
// Points with a radius: G. Turk, "The PLY polygon file format", 1994.

#include "ExportBytes.h"
#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

namespace {

void writeHeader(ExportText& text, const ExportScene& scene, std::string_view format)
{
    text << "ply\nformat " << format << " 1.0\ncomment spheres of " << oneWord(scene.name)
         << "; parents are ids, -1 is none\nelement vertex " << scene.sphereCount()
         << "\nproperty float x\nproperty float y\nproperty float z\nproperty float radius\n"
            "property int level\nproperty int id\nproperty int parent\nend_header\n";
}

} // namespace

void writePly(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    ExportText text(out, scene.decimals);
    writeHeader(text, scene, "binary_little_endian");
    text.finish();
    ExportBytes bytes(out);
    for (const ExportLevel& level : scene.levels) {
        for (std::size_t i = 0; i < level.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) bytes.put(float(level.centers[i][axis]));
            bytes.put(float(level.radii[i]));
            bytes.put(int32_t(level.number));
            bytes.put(level.ids[i]);
            bytes.put(level.parents[i]);
        }
    }
    bytes.finish();
}

void writePlyAscii(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    ExportText text(out, scene.decimals);
    writeHeader(text, scene, "ascii");
    for (const ExportLevel& level : scene.levels) {
        for (std::size_t i = 0; i < level.size(); ++i) {
            text.floats(level.centers[i], " ") << ' ';
            text.asFloat(level.radii[i])
                << ' ' << level.number << ' ' << level.ids[i] << ' ' << level.parents[i] << '\n';
        }
    }
    text.finish();
}

} // namespace openvdb_spheretree::detail
