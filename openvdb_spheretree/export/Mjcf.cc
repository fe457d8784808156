// SPDX-License-Identifier: Apache-2.0
// A free body of MuJoCo's: https://mujoco.readthedocs.io/en/stable/XMLreference.html

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

namespace {

/// Without it MuJoCo would count what spheres share more than once.
void writeInertial(ExportText& text, const ExportScene& scene)
{
    text << "      <inertial pos=\"";
    text.reals(scene.mass.center.asPointer(), 3) << "\" mass=\"";
    text.real(scene.mass.volume * scene.density) << "\" fullinertia=\"";
    text.reals(scene.inertia().data(), 6) << "\"/>\n";
}

} // namespace

void writeMjcf(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const ExportLevel& level = scene.finest();
    const std::string link = xmlText(scene.link);
    ExportText text(out, scene.decimals);
    text << "<mujoco model=\"" << xmlText(scene.name) << "\">\n  <worldbody>\n    <body name=\""
         << link << "\">\n      <freejoint/>\n";
    writeInertial(text, scene);
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << "      <geom name=\"" << link << "_sphere_" << i << "\" type=\"sphere\" size=\""
             << level.radii[i] << "\" pos=\"";
        text.lengths(level.centers[i], " ") << "\"/>\n";
    }
    text << "    </body>\n  </worldbody>\n</mujoco>\n";
    text.finish();
}

} // namespace openvdb_spheretree::detail
