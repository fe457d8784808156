// SPDX-License-Identifier: Apache-2.0
// The legacy text format of VTK: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include "ExportText.h"
#include "ExportWriters.h"

#include <openvdb_spheretree/base/Text.h>

namespace openvdb_spheretree::detail {

void writeVtk(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::size_t count = scene.sphereCount();
    ExportText text(out, scene.decimals);
    const auto forEach = [&](const auto& write) {
        for (const ExportLevel& level : scene.levels) {
            for (std::size_t i = 0; i < level.size(); ++i) write(level, i);
        }
    };
    constexpr std::size_t kLongestTitle = 200; // 256 letters with the end of the line
    text << "# vtk DataFile Version 3.0\nspheres of " << startOf(oneWord(scene.name), kLongestTitle)
         << "\nASCII\nDATASET POLYDATA\nPOINTS " << count << " double\n";
    forEach([&](const ExportLevel& level, std::size_t i) {
        text.lengths(level.centers[i], " ") << '\n';
    });
    text << "VERTICES " << count << ' ' << 2 * count << '\n';
    for (std::size_t i = 0; i < count; ++i) text << "1 " << i << '\n';
    text << "POINT_DATA " << count << "\nSCALARS radius double 1\nLOOKUP_TABLE default\n";
    forEach([&](const ExportLevel& level, std::size_t i) { text << level.radii[i] << '\n'; });
    // A reader takes the first scalars alone, and all of a field.
    text << "FIELD FieldData 3\nlevel 1 " << count << " int\n";
    forEach([&](const ExportLevel& level, std::size_t) { text << level.number << '\n'; });
    text << "id 1 " << count << " int\n";
    forEach([&](const ExportLevel& level, std::size_t i) { text << level.ids[i] << '\n'; });
    text << "parent 1 " << count << " int\n";
    forEach([&](const ExportLevel& level, std::size_t i) { text << level.parents[i] << '\n'; });
    text.finish();
}

} // namespace openvdb_spheretree::detail
