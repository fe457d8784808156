// SPDX-License-Identifier: Apache-2.0
#include "WriteAdvice.h"

#include <openvdb_spheretree/export/ExportFormat.h>

#include <algorithm>

namespace command {

namespace {

struct Advice {
    const char* extensions; ///< each between two blanks
    const char* text;
};

constexpr Advice kAdvice[] = {
    {" .usd .usdc .usdz ", "of USD it writes the text, .usda, which all of its readers take"},
    {" .abc .bgeo .geo .sc .rat ", "Houdini reads .vdb (points with pscale) and .usda"},
    {" .gltf .fbx .dae .blend .3ds .x3d ",
        "triangles of spheres are .glb or .obj (format=mesh), and examples/blender opens a .csv"},
    {" .sdf .xacro .dart ", "for robots it writes .urdf, .mjcf and others"},
    {" .pcd .las .e57 .pts ", "points with radii are .ply"},
    {" .vtu .vtm .vti .pvd ", "ParaView reads .vtp"},
    {" .pdb .cif .gro ", "the chemists' is .xyz"},
    {" .npy .npz .mat .h5 .tsv .xlsx ", "numbers are .csv or .json"},
    {" .tif .tiff .bmp .exr .gif .webp ", "pictures are .png or .jpg"},
    {" .pdf .eps .ps ", "curves of errors are .svg"},
    {" .clu .clp .p3dat ", "clumps are .txt, with format=yade or format=liggghts"},
};

} // namespace

std::string formatsOf(const std::string& extension)
{
    std::string names;
    for (const auto& format : openvdb_spheretree::exportFormats()) {
        const auto& known = format.extensions;
        if (std::find(known.begin(), known.end(), extension) == known.end()) continue;
        names += (names.empty() ? "format=" : " or format=") + format.name;
    }
    return names;
}

std::string writeAdvice(const std::string& extension)
{
    for (const Advice& advice : kAdvice) {
        if (std::string(advice.extensions).find(' ' + extension + ' ') != std::string::npos) {
            return advice.text;
        }
    }
    return {};
}

} // namespace command
