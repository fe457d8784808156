// SPDX-License-Identifier: Apache-2.0
// Tables of points with radii and parents: extended XYZ of chemistry, and SWC of neurons.

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

/// https://wiki.fysik.dtu.dk/ase/ase/io/formatoptions.html#extxyz: all spheres are hydrogen (X has no colour).
void writeXyz(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    ExportText text(out, scene.decimals);
    text << scene.sphereCount()
         << "\nProperties=species:S:1:pos:R:3:radius:R:1:level:I:1:id:I:1:parent:I:1 pbc=\"F F "
            "F\"\n";
    for (const ExportLevel& level : scene.levels) {
        for (std::size_t i = 0; i < level.size(); ++i) {
            text << "H ";
            text.lengths(level.centers[i], " ")
                << ' ' << level.radii[i] << ' ' << level.number << ' ' << level.ids[i] << ' '
                << level.parents[i] << '\n';
        }
    }
    text.finish();
}

/// http://www.neuronland.org/NLMorphologyConverter/MorphologyFormats/SWC/Spec.html: parents stand before their
/// children, and -1 is no parent. Numbers begin with 1.
void writeSwc(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    ExportText text(out, scene.decimals);
    text << "# " << oneWord(scene.name) << ": number type x y z radius parent\n";
    for (const ExportLevel& level : scene.levels) {
        for (std::size_t i = 0; i < level.size(); ++i) {
            const int32_t parent = level.parents[i];
            text << level.ids[i] + 1 << " 0 ";
            text.lengths(level.centers[i], " ")
                << ' ' << level.radii[i] << ' ' << (parent < 0 ? -1 : parent + 1) << '\n';
        }
    }
    text.finish();
}

} // namespace openvdb_spheretree::detail
