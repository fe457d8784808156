// SPDX-License-Identifier: Apache-2.0
// MoveIt's approximation of links by spheres (srdfdom, loadLinkSphereApproximations).

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

void writeSrdf(const std::vector<ExportScene>& links, const ExportSink& out)
{
    ExportText text(out, links.front().decimals);
    text << "<?xml version=\"1.0\"?>\n<robot name=\"" << xmlText(links.front().name) << "\">\n";
    for (const ExportScene& scene : links) {
        const ExportLevel& level = scene.finest();
        text.useDecimals(scene.decimals);
        text << "  <link_sphere_approximation link=\"" << xmlText(scene.link) << "\">\n";
        for (std::size_t i = 0; i < level.size(); ++i) {
            text << "    <sphere center=\"";
            text.lengths(level.centers[i], " ") << "\" radius=\"" << level.radii[i] << "\"/>\n";
        }
        text << "  </link_sphere_approximation>\n";
    }
    text << "</robot>\n";
    text.finish();
}

} // namespace openvdb_spheretree::detail
