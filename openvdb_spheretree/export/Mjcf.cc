// SPDX-License-Identifier: Apache-2.0
// A free body of MuJoCo's: https://mujoco.readthedocs.io/en/stable/XMLreference.html

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

namespace {

/// Without it MuJoCo would count what spheres share more than once.
void writeInertial(ExportText& text, const MassProperties& mass, double density)
{
    text << "      <inertial pos=\"";
    text.real(mass.center[0]) << ' ';
    text.real(mass.center[1]) << ' ';
    text.real(mass.center[2]) << "\" mass=\"";
    text.real(mass.volume * density) << "\" fullinertia=\"";
    constexpr int kEntries[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (const auto& entry : kEntries) {
        if (&entry != &kEntries[0]) text << ' ';
        text.real(mass.inertia(entry[0], entry[1]));
    }
    text << "\"/>\n";
}

} // namespace

void writeMjcf(const std::vector<ExportScene>& samples, std::ostream& out)
{
    const ExportScene& scene = samples.front();
    const ExportLevel& level = scene.finest();
    const std::string link = xmlText(scene.link);
    ExportText text(out, scene.decimals);
    text << "<mujoco model=\"" << xmlText(scene.name) << "\">\n  <worldbody>\n    <body name=\""
         << link << "\">\n      <freejoint/>\n";
    writeInertial(text, scene.mass, scene.density);
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << "      <geom name=\"" << link << "_sphere_" << i << "\" type=\"sphere\" size=\""
             << level.radii[i] << "\" pos=\"";
        text.lengths(level.centers[i], " ") << "\"/>\n";
    }
    text << "    </body>\n  </worldbody>\n</mujoco>\n";
    text.finish();
}

} // namespace openvdb_spheretree::detail
