// SPDX-License-Identifier: Apache-2.0
// MoveIt's approximation of a link by spheres (srdfdom, loadLinkSphereApproximations).

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

void writeSrdf(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const ExportLevel& level = scene.finest();
    ExportText text(out, scene.decimals);
    text << "<?xml version=\"1.0\"?>\n<robot name=\"" << xmlText(scene.name)
         << "\">\n  <link_sphere_approximation link=\"" << xmlText(scene.link) << "\">\n";
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << "    <sphere center=\"";
        text.lengths(level.centers[i], " ") << "\" radius=\"" << level.radii[i] << "\"/>\n";
    }
    text << "  </link_sphere_approximation>\n</robot>\n";
    text.finish();
}

} // namespace openvdb_spheretree::detail
