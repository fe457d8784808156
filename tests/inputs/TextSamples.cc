// SPDX-License-Identifier: Apache-2.0
/// @file TextSamples.cc
/// @brief Samples of volumes, meshes, spheres, tables of questions and config files, byte by byte.

#include "SampleBytes.h"
#include "SampleFiles.h"

#include <cstdint>

namespace spheretree_test {

namespace {

/// A value in the order of bytes of this machine, or in the other one.
// Volumes

/// 9 x 5 x 10 voxels: two slabs of leaves, and leaves that are not full.
template <typename Value>
std::string volume(int version)
{
    std::string values;
    for (int i = 0; i < 9 * 5 * 10; ++i) values += bytesOf(Value(i % 7 == 0 ? 0 : i));
    const std::string header = "X: 9\nY: 5\nZ: 10\nVoxel-Size: 0.5\nCenter-X: 4\nAlpha-Color: 0\n"
                               "Version: "
        + std::to_string(version) + "\n.\n";
    return header + (version == 3 ? deflated(values, Deflated::Zlib) : values);
}

std::string volRaw() { return volume<uint8_t>(2); }
std::string volZip() { return volume<uint8_t>(3); }
std::string longvolRaw() { return volume<uint64_t>(2); }
std::string longvolZip() { return volume<uint64_t>(3); }

// Meshes: a pyramid on a square, of four triangles and a polygon with four corners

constexpr float kPoints[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 1.25f}};
constexpr int kSides[4][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
constexpr int kBase[4] = {3, 2, 1, 0};

std::string pointsAsText(const std::string& start)
{
    std::string text;
    for (const auto& p : kPoints) {
        text += start + std::to_string(p[0]) + " " + std::to_string(p[1]) + " "
            + std::to_string(p[2]) + "\n";
    }
    return text;
}

/// Of the sides; then of the base, if there is a word for it.
std::string facesAsText(const std::string& side, const std::string& base, int first)
{
    std::string text;
    for (const auto& corners : kSides) {
        text += side;
        for (const int corner : corners) text += " " + std::to_string(corner + first);
        text += "\n";
    }
    text += base;
    for (const int corner : kBase) text += " " + std::to_string(corner + first);
    return text + "\n";
}

std::string obj()
{
    return "# a pyramid\nmtllib none.mtl\no pyramid\n" + pointsAsText("v ")
        + "vt 0 0\nvn 0 0 1\ng sides\nusemtl stone\ns off\n" + facesAsText("f", "f", 1)
        + "f 1/1/1 2/1/1 5//1\nf -1/1 -2/1 -3/1\nl 1 2\n";
}

std::string off()
{
    return "OFF\n# a pyramid\n5 5 0\n" + pointsAsText("") + facesAsText("3", "4", 0);
}

std::string plyHeader(const std::string& format)
{
    return "ply\nformat " + format
        + " 1.0\ncomment a pyramid\nelement vertex 5\nproperty float x\nproperty float y\n"
          "property float z\nelement face 5\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string plyText() { return plyHeader("ascii") + pointsAsText("") + facesAsText("3", "4", 0); }

std::string plyBinary(bool bigEndian)
{
    std::string bytes = plyHeader(bigEndian ? "binary_big_endian" : "binary_little_endian");
    for (const auto& p : kPoints) {
        for (const float x : p) bytes += bytesOf(x, bigEndian);
    }
    const auto add = [&](const auto& corners, char count) {
        bytes += count;
        for (const int32_t corner : corners) bytes += bytesOf(corner, bigEndian);
    };
    for (const auto& side : kSides) add(side, 3);
    add(kBase, 4);
    return bytes;
}

std::string plyLittle() { return plyBinary(false); }
std::string plyBig() { return plyBinary(true); }

std::string stlText()
{
    std::string text = "solid pyramid\n";
    for (const auto& side : kSides) {
        text += " facet normal 0 0 1\n  outer loop\n";
        for (const int corner : side) {
            const auto& p = kPoints[corner];
            text += "   vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " "
                + std::to_string(p[2]) + "\n";
        }
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid pyramid\n";
}

std::string stlBinary()
{
    std::string bytes(80, ' ');
    bytes += bytesOf(uint32_t(4));
    for (const auto& side : kSides) {
        for (int i = 0; i < 3; ++i) bytes += bytesOf(0.f);
        for (const int corner : side) {
            for (const float x : kPoints[corner]) bytes += bytesOf(x);
        }
        bytes += bytesOf(uint16_t(0));
    }
    return bytes;
}

// Spheres

std::string spheresCsv()
{
    return "# spheres of another tool\nlevel;name;x;y;z;diameter\n0;\"a\";1.5;-2;+3e-1;0.25\n"
           "0;b;.5;2e3;0;7\n1;c;0;0;0;1000\n";
}

std::string spheresJson()
{
    return R"({"unit": "m", "edges": [[0, 1], [1, 0]], "spheres": [
 {"x": 1.5, "y": -2, "z": 0.3, "radius": 0.125, "level": 0, "tags": ["a", {"b": null}]},
 {"center": [0.5, 2e3, -1], "diameter": 7, "level": 0}, {"center": [0, 0, 0], "r": 1000, "level": 1}]}
)";
}

std::string spheresRows()
{
    return R"({"columns": ["id", "x", "y", "z", "radius"], "nodes": [[0, 1.5, -2, 0.3, 4], [1, 0, 9, 9, 2]],
 "dag": [[0, 1]], "cuts": null}
)";
}

// Questions

std::string posesNamed()
{
    return "# a "
           "trajectory\ntime;x;y;z;qx;qy;qz;qw\n0.5;1;-2;3e-1;0;0;0;1\n1.5;.5;2e3;0;0;0.6;0;0.8\n";
}

std::string posesOfBodies()
{
    return "frame,body,x,y,z,rx,ry,rz\n-1,0,1,2,3,0,0,1.5\n4,\"a "
           "b\",1,2,3,0,0,0\n4,hand,0,0,1,0,0,0\n";
}

std::string posesAsMatrices() { return "0 -1 0 20 1 0 0 1 0 0 1 2\n1 0 0 0 0 1 0 0 0 0 1 0\n"; }

std::string points() { return "z,\"y\",x\n1,2,3\n+4,-5,6e-3\n"; }

std::string rays()
{
    return "x y z dx dy dz tnear tfar\n1 2 3 0 0 -2 0.5 9\n-1 0 0 1e3 0 0 0 1e300\n";
}

// Lines

std::string config()
{
    return "vdb_spheretree 0.2\n# a line of actions\nquiet\n\n-read 'a file.vdb' \"b.vol\"  # two\n"
           "spheretree tree=extended factor=3 dist=chamfer:3,4 name=\"x y\" dag=1\n"
           "stats json=-\nwrite out.vdb codec=zip\n";
}

std::string expression()
{
    return "tree_{$i:4:pad0}_{1:@a:$a:2:+:3.5:*:sqrt:to_int}_{a b: :tokenize:swap:squash:upper}_"
           "{$i:7:==:if(0:if(x?y)?z)}_{2:switch(1:p?2:q)}_{/d/f_012.vdb:base}_{1:G:set:G:get}";
}

} // namespace

const std::vector<SampleMaker>& textSamples()
{
    static const std::vector<SampleMaker> samples = {
        {"vol_raw", ".vol", volRaw},
        {"vol_zip", ".vol", volZip},
        {"longvol_raw", ".longvol", longvolRaw},
        {"longvol_zip", ".longvol", longvolZip},
        {"obj", ".obj", obj, false},
        {"off", ".off", off, false},
        {"ply_text", ".ply", plyText, false},
        {"ply_little", ".ply", plyLittle},
        {"ply_big", ".ply", plyBig},
        {"stl_text", ".stl", stlText, false},
        {"stl_binary", ".stl", stlBinary},
        {"spheres_csv", ".csv", spheresCsv, false},
        {"spheres_json", ".json", spheresJson, false},
        {"spheres_rows", ".json", spheresRows, false},
        {"poses_named", ".poses", posesNamed, false},
        {"poses_of_bodies", ".bodies", posesOfBodies, false},
        {"poses_matrices", ".poses", posesAsMatrices, false},
        {"points", ".points", points, false},
        {"rays", ".rays", rays, false},
        {"config", ".cfg", config, false},
        {"expression", ".expression", expression, false},
    };
    return samples;
}

} // namespace spheretree_test
