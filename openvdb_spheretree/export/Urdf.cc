// SPDX-License-Identifier: Apache-2.0
// A link of a robot with a sphere for each collision element: http://wiki.ros.org/urdf/XML/link

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

namespace {

void writeInertial(ExportText& text, const ExportScene& scene)
{
    text << "    <inertial>\n      <origin xyz=\"";
    text.reals(scene.mass.center.asPointer(), 3) << "\" rpy=\"0 0 0\"/>\n      <mass value=\"";
    text.real(scene.mass.volume * scene.density) << "\"/>\n      <inertia";
    const auto moment = [&](const char* name, int row, int column) {
        text << ' ' << name << "=\"";
        text.real(scene.mass.inertia(row, column)) << '"';
    };
    moment("ixx", 0, 0);
    moment("ixy", 0, 1);
    moment("ixz", 0, 2);
    moment("iyy", 1, 1);
    moment("iyz", 1, 2);
    moment("izz", 2, 2);
    text << "/>\n    </inertial>\n";
}

} // namespace

void writeUrdf(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const ExportLevel& level = scene.finest();
    const std::string link = xmlText(scene.link);
    ExportText text(out, scene.decimals);
    text << "<?xml version=\"1.0\"?>\n<robot name=\"" << xmlText(scene.name)
         << "\">\n  <link name=\"" << link << "\">\n";
    writeInertial(text, scene);
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << "    <collision name=\"" << link << "_sphere_" << i << "\"><origin xyz=\"";
        text.lengths(level.centers[i], " ") << "\" rpy=\"0 0 0\"/><geometry><sphere radius=\""
                                            << level.radii[i] << "\"/></geometry></collision>\n";
    }
    text << "  </link>\n</robot>\n";
    text.finish();
}

} // namespace openvdb_spheretree::detail
