// SPDX-License-Identifier: Apache-2.0
// The spheres of links for NVIDIA's planners: cuRobo's robot file, XRDF, and the robot description of Lula,
// which lists links where the others map them. In metres, each in the frame of its link.

#include "ExportText.h"
#include "ExportWriters.h"

namespace openvdb_spheretree::detail {

namespace {

void writeSpheres(ExportText& text, const ExportScene& scene, std::string_view indent)
{
    const ExportLevel& level = scene.finest();
    text.useDecimals(scene.decimals);
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << indent << "- center: [";
        text.lengths(level.centers[i], ", ") << "]\n"
                                             << indent << "  radius: " << level.radii[i] << '\n';
    }
}

/// @return what stands for each link, with commas between.
std::string listOf(const std::vector<ExportScene>& links, const char* after = "")
{
    std::string list;
    for (const ExportScene& scene : links) {
        list += (list.empty() ? "" : ", ") + yamlKey(scene.link) + after;
    }
    return list;
}

/// @return what people must know of the lines that follow: the order of trees says nothing of joints.
std::string guessOf(const std::vector<ExportScene>& links, const std::string& indent)
{
    if (links.size() == 1) return "";
    return indent + "# The first and the last of the links, to be put right by the robot's own:\n";
}

/// The map of links that cuRobo and XRDF have.
void writeMap(ExportText& text, const std::vector<ExportScene>& links)
{
    for (const ExportScene& scene : links) {
        text << "      " << yamlKey(scene.link) << ":\n";
        writeSpheres(text, scene, "        ");
    }
}

} // namespace

/// https://curobo.org: the map of collision_spheres stands in the file itself, because a file of its own is
/// read by some of its loaders only. Numbers must be floats for it, zeros too.
void writeCurobo(const std::vector<ExportScene>& links, const ExportSink& out)
{
    const std::string first = yamlKey(links.front().link);
    ExportText text(out, links.front().decimals);
    text << "robot_cfg:\n  kinematics:\n    format_version: 2.0\n"
         << guessOf(links, "    ") << "    urdf_path: " << yamlString(links.front().name + ".urdf")
         << "\n    base_link: " << first << "\n    tool_frames: [" << yamlKey(links.back().link)
         << "]\n    collision_link_names: [" << listOf(links)
         << "]\n    collision_sphere_buffer: 0.0\n    self_collision_buffer: {"
         << listOf(links, ": 0.0") << "}\n    self_collision_ignore: {}\n    collision_spheres:\n";
    writeMap(text, links);
    text.finish();
}

/// https://nvidia-isaac-ros.github.io/concepts/manipulation/xrdf.html; joints are the robot's, and are left to
/// be filled in.
void writeXrdf(const std::vector<ExportScene>& links, const ExportSink& out)
{
    const std::string geometry = yamlKey(links.front().name);
    ExportText text(out, links.front().decimals);
    text << "format: xrdf\nformat_version: 1.0\ngeometry:\n  " << geometry << ":\n    spheres:\n";
    writeMap(text, links);
    text << "collision: {geometry: " << geometry << ", buffer_distance: {" << listOf(links, ": 0.0")
         << "}}\nself_collision: {geometry: " << geometry << ", ignore: {}, buffer_distance: {}}\n"
         << guessOf(links, "") << "tool_frames: [" << yamlKey(links.back().link)
         << "]\ncspace: {joint_names: [], acceleration_limits: [], jerk_limits: []}\n"
            "default_joint_positions: {}\n";
    text.finish();
}

void writeLula(const std::vector<ExportScene>& links, const ExportSink& out)
{
    ExportText text(out, links.front().decimals);
    text << "api_version: 1.0\ncspace: []\n"
         << guessOf(links, "") << "root_link: " << yamlKey(links.front().link)
         << "\ndefault_q: []\ncspace_to_urdf_rules: []\ncollision_spheres:\n";
    for (const ExportScene& scene : links) {
        text << "  - " << yamlKey(scene.link) << ":\n";
        writeSpheres(text, scene, "    ");
    }
    text.finish();
}

} // namespace openvdb_spheretree::detail
