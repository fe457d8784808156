// SPDX-License-Identifier: Apache-2.0
// JSON of two makers of robots' spheres, for the programs that read theirs: foam's list of levels, and the
// centers and radii of MorphIt.

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

/// https://github.com/CoMMALab/foam: an entry a depth, the root first. Its three errors are those of the
/// program that it wraps; there are none here.
void writeFoam(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    ExportText text(out, scene.decimals);
    text << "[";
    for (const ExportLevel& level : scene.levels) {
        text << (&level == &scene.levels.front() ? "" : ",\n ")
             << "{\"mean\": 0.0, \"best\": 0.0, \"worst\": 0.0, \"spheres\": [";
        for (std::size_t i = 0; i < level.size(); ++i) {
            text << (i == 0 ? "\n" : ",\n") << "  {\"origin\": [";
            text.lengths(level.centers[i], ", ") << "], \"radius\": " << level.radii[i] << '}';
        }
        text << "]}";
    }
    text << "]\n";
    text.finish();
}

/// https://github.com/HIRO-group/MorphIt-1
void writeMorphIt(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const ExportLevel& level = scene.finest();
    ExportText text(out, scene.decimals);
    text << "{\"num_spheres\": " << level.size() << ",\n \"centers\": [";
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << (i == 0 ? "\n  [" : ",\n  [");
        text.lengths(level.centers[i], ", ") << ']';
    }
    text << "],\n \"radii\": [";
    for (std::size_t i = 0; i < level.size(); ++i)
        text << (i == 0 ? "\n  " : ",\n  ") << level.radii[i];
    text << "]}\n";
    text.finish();
}

} // namespace openvdb_spheretree::detail
