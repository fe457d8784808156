// SPDX-License-Identifier: Apache-2.0
// The spheres of a link for NVIDIA's planners: cuRobo's robot file, XRDF, and the robot description of Lula,
// which lists links where the others map them. In metres, in the frame of the link.

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

namespace {

void writeSpheres(ExportText& text, const ExportLevel& level, std::string_view indent)
{
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << indent << "- center: [";
        text.lengths(level.centers[i], ", ") << "]\n"
                                             << indent << "  radius: " << level.radii[i] << '\n';
    }
}

} // namespace

/// https://curobo.org: the map of collision_spheres stands in the file itself, because a file of its own is
/// read by some of its loaders only. Numbers must be floats for it, zeros too.
void writeCurobo(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::string link = yamlKey(scene.link);
    ExportText text(out, scene.decimals);
    text << "robot_cfg:\n  kinematics:\n    format_version: 2.0\n    urdf_path: "
         << yamlString(scene.name + ".urdf") << "\n    base_link: " << link
         << "\n    tool_frames: [" << link << "]\n    collision_link_names: [" << link
         << "]\n    collision_sphere_buffer: 0.0\n    self_collision_buffer: {" << link
         << ": 0.0}\n    self_collision_ignore: {}\n    collision_spheres:\n      " << link
         << ":\n";
    writeSpheres(text, scene.finest(), "        ");
    text.finish();
}

/// https://nvidia-isaac-ros.github.io/concepts/manipulation/xrdf.html; joints are the robot's, and are left to
/// be filled in.
void writeXrdf(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::string link = yamlKey(scene.link), geometry = yamlKey(scene.name);
    ExportText text(out, scene.decimals);
    text << "format: xrdf\nformat_version: 1.0\ngeometry:\n  " << geometry
         << ":\n    spheres:\n      " << link << ":\n";
    writeSpheres(text, scene.finest(), "        ");
    text << "collision: {geometry: " << geometry << ", buffer_distance: {" << link
         << ": 0.0}}\nself_collision: {geometry: " << geometry
         << ", ignore: {}, buffer_distance: {}}\ntool_frames: [" << link
         << "]\ncspace: {joint_names: [], acceleration_limits: [], jerk_limits: []}\n"
            "default_joint_positions: {}\n";
    text.finish();
}

void writeLula(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::string link = yamlKey(scene.link);
    ExportText text(out, scene.decimals);
    text << "api_version: 1.0\ncspace: []\nroot_link: " << link
         << "\ndefault_q: []\ncspace_to_urdf_rules: []\ncollision_spheres:\n  - " << link << ":\n";
    writeSpheres(text, scene.finest(), "    ");
    text.finish();
}

} // namespace openvdb_spheretree::detail
