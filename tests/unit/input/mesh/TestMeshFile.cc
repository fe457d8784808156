// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshFile.cc
/// @brief Mesh files: the same cube out of every format, and every broken file refused.

#include <openvdb_spheretree/input/mesh/MeshFile.h>

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/mesh/MeshFormats.h>

#include "support/MeshFiles.h"
#include "support/Messages.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Coord;

constexpr int kQuads[6][4] = {
    {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

int cornerOf(int point, int axis) { return (point >> axis) & 1; }

// A cube from 0 to 1, facing outwards, in each format; nothing follows the last needed byte.

std::string objCube()
{
    std::ostringstream out;
    for (int p = 0; p < 8; ++p) {
        out << "v " << cornerOf(p, 0) << ' ' << cornerOf(p, 1) << ' ' << cornerOf(p, 2) << '\n';
    }
    for (const auto& q : kQuads) {
        out << "f " << q[0] + 1 << ' ' << q[1] + 1 << ' ' << q[2] + 1 << ' ' << q[3] + 1 << '\n';
    }
    return out.str().substr(0, out.str().size() - 1);
}

std::string plainRows() // of points and faces, as in OFF and ASCII PLY
{
    std::ostringstream out;
    for (int p = 0; p < 8; ++p) {
        out << cornerOf(p, 0) << ' ' << cornerOf(p, 1) << ' ' << cornerOf(p, 2) << '\n';
    }
    for (const auto& q : kQuads) {
        out << "4 " << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
    }
    return out.str().substr(0, out.str().size() - 1);
}

std::string offCube() { return "OFF\n8 6 0\n" + plainRows(); }

std::string plyHeader(const std::string& format, const std::string& vertices = "8")
{
    return "ply\nformat " + format + " 1.0\ncomment a cube\nelement vertex " + vertices
        + "\nproperty float x\nproperty float y\nproperty float z\nelement face 6\n"
          "property list uchar int vertex_indices\nend_header\n";
}

std::string plyCube() { return plyHeader("ascii") + plainRows(); }

std::string binaryPlyCube(bool bigEndian)
{
    std::string bytes = plyHeader(bigEndian ? "binary_big_endian" : "binary_little_endian");
    for (int p = 0; p < 8; ++p) {
        for (int axis = 0; axis < 3; ++axis) bytes += bytesOf(float(cornerOf(p, axis)), bigEndian);
    }
    for (const auto& q : kQuads) {
        bytes.push_back(4);
        for (const int corner : q) bytes += bytesOf(corner, bigEndian);
    }
    return bytes;
}

/// Calls use(facet's three points) for the cube's twelve triangles.
template <typename Use>
void forEachFacet(const Use& use)
{
    for (const auto& q : kQuads) {
        use(q[0], q[1], q[2]);
        use(q[0], q[2], q[3]);
    }
}

std::string stlCube()
{
    std::ostringstream out;
    out << "solid cube\n";
    forEachFacet([&](int a, int b, int c) {
        out << "facet normal 0 0 0\n outer loop\n";
        for (const int p : {a, b, c}) {
            out << "  vertex " << cornerOf(p, 0) << ' ' << cornerOf(p, 1) << ' ' << cornerOf(p, 2)
                << '\n';
        }
        out << " endloop\nendfacet\n";
    });
    out << "endsolid";
    return out.str();
}

std::string binaryStlCube(const std::string& title = "cube")
{
    std::string bytes = title + std::string(80 - title.size(), ' ') + bytesOf(12);
    forEachFacet([&](int a, int b, int c) {
        bytes.append(12, '\0');
        for (const int p : {a, b, c}) {
            for (int axis = 0; axis < 3; ++axis) bytes += bytesOf(float(cornerOf(p, axis)));
        }
        bytes.append(2, '\0');
    });
    return bytes;
}

struct Sample {
    std::string name, bytes;
};

std::vector<Sample> cubes()
{
    return {{"cube.obj", objCube()}, {"cube.off", offCube()}, {"cube.ply", plyCube()},
        {"little.ply", binaryPlyCube(false)}, {"big.PLY", binaryPlyCube(true)},
        {"cube.stl", stlCube()}, {"binary.stl", binaryStlCube()},
        {"trap.stl", binaryStlCube("solid, says this binary file")}};
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.rfind(from);
    EXPECT_NE(std::string::npos, at) << from;
    return text.replace(at, from.size(), to);
}

TEST(MeshFile, ReadsTheSameCubeFromEveryFormat)
{
    for (const auto& [name, bytes] : cubes()) {
        const TempFile file(name, bytes);
        const TriangleMesh mesh = readMeshFile(file.path);
        EXPECT_EQ(8u, mesh.points.size()) << name;
        EXPECT_EQ(12u, mesh.triangles.size()) << name;
        EXPECT_DOUBLE_EQ(1, volumeOf(mesh)) << name;
        EXPECT_DOUBLE_EQ(6, areaOf(mesh)) << name;
        EXPECT_EQ(std::filesystem::path(file.path).stem().string(), mesh.name);
    }
}

TEST(MeshFile, RejectsEveryTruncation)
{
    for (const auto& [name, bytes] : cubes()) {
        if (name == "cube.obj") continue; // does not say how much it holds; see below
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            ASSERT_NE("", errorOf(name, bytes.substr(0, length))) << name << " cut to " << length;
        }
    }
}

TEST(MeshFile, SaysOfABinaryPlyThatItIsTruncatedWhereverItEnds)
{
    for (const bool bigEndian : {false, true}) {
        const std::string bytes = binaryPlyCube(bigEndian);
        const std::size_t begin = bytes.find("end_header\n") + 11;
        for (std::size_t length = begin; length < bytes.size(); ++length) {
            const std::string why = errorOf("cut.ply", bytes.substr(0, length));
            ASSERT_NE(std::string::npos, why.find("it is truncated")) << length << ": " << why;
        }
    }
}

TEST(MeshFile, RejectsATruncatedObjOrReadsTheSmallerMeshThatItIs)
{
    const std::string bytes = objCube();
    int rejected = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const TempFile file("cut.obj", bytes.substr(0, length));
        try {
            EXPECT_LT(readMeshFile(file.path).triangles.size(), 12u) << length;
        } catch (const openvdb::IoError&) {
            ++rejected;
        }
    }
    EXPECT_GT(rejected, 80); // all within the points, and within a face's first two corners
}

TEST(MeshFile, RejectsWhatFollowsTheEnd)
{
    EXPECT_NE("", errorOf("tail.off", offCube() + "\n3 0 1 2\n"));
    EXPECT_NE("", errorOf("tail.ply", plyCube() + "\n1\n"));
    EXPECT_NE("", errorOf("tail.ply", binaryPlyCube(false) + "x"));
    EXPECT_NE("", errorOf("tail.stl", stlCube() + "\nfacet"));
    EXPECT_NE("", errorOf("tail.stl", binaryStlCube() + "x"));
    EXPECT_EQ("", errorOf("blank.off", offCube() + " # the end\n\n"));
    EXPECT_EQ("", errorOf("blank.ply", plyCube() + "\n \n"));
    EXPECT_EQ("", errorOf("blank.stl", stlCube() + " cube\n"));
}

TEST(MeshFile, RejectsFacesThatNamePointsThatAreNotThere)
{
    for (const char* face : {"f 1 2 9", "f 0 1 2", "f 1 2 -9", "f 1 2 x", "f 1 2 3.5", "f 1/ 2/x 3",
             "f 1 2", "f", "f 1 2 99999999999999999999"}) {
        EXPECT_NE("", errorOf("index.obj", objCube() + "\n" + face + "\n")) << face;
    }
    for (const char* last : {"1 3 7 8", "1 3 7 -1", "1 3 7 x", "1 3 7 1e0", "1 3 7"}) {
        EXPECT_NE("", errorOf("index.off", replaced(offCube(), "1 3 7 5", last))) << last;
        EXPECT_NE("", errorOf("index.ply", replaced(plyCube(), "1 3 7 5", last))) << last;
    }
    for (const int last : {8, -1, 1 << 30}) {
        std::string bytes = binaryPlyCube(false);
        EXPECT_NE("", errorOf("index.ply", bytes.replace(bytes.size() - 4, 4, bytesOf(last))));
    }
}

TEST(MeshFile, RejectsCoordinatesThatAreNotFinite)
{
    for (const char* bad : {"nan", "inf", "-inf", "1e39", "1e999", "NaN(1)", "0x10", "", "one"}) {
        const std::string point = std::string("0 0 ") + bad;
        EXPECT_NE("", errorOf("bad.obj", "v " + point + "\n" + objCube())) << bad;
        EXPECT_NE("", errorOf("bad.off", replaced(offCube(), "\n0 0 0\n", "\n" + point + "\n")));
        EXPECT_NE("", errorOf("bad.ply", replaced(plyCube(), "\n0 0 0\n", "\n" + point + "\n")));
        EXPECT_NE("", errorOf("bad.stl", replaced(stlCube(), "vertex 0 0 0", "vertex " + point)));
    }
    for (const float bad :
        {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        std::string bytes = binaryStlCube();
        EXPECT_NE("", errorOf("bad.stl", bytes.replace(84 + 12, 4, bytesOf(bad))));
        bytes = binaryPlyCube(false);
        EXPECT_NE("",
            errorOf("bad.ply",
                bytes.replace(plyHeader("binary_little_endian").size(), 4, bytesOf(bad))));
    }
}

TEST(MeshFile, SaysInWhichLineOfATextTheErrorIs)
{
    EXPECT_NE(std::string::npos, errorOf("line.obj", "v 0 0 0\n\nv 0 x 0\n").find("line 3"));
    EXPECT_NE(std::string::npos, errorOf("line.off", "OFF\n1 0 0\nx 0 0\n").find("line 3"));
}

TEST(MeshFile, AllocatesNothingForCountsThatLie)
{
    EXPECT_NE("", errorOf("lie.ply", plyHeader("ascii", "4000000000") + plainRows()));
    EXPECT_NE("", errorOf("lie.ply", plyHeader("ascii", "-8") + plainRows()));
    EXPECT_NE("", errorOf("lie.ply", plyHeader("ascii", "99999999999999999999") + plainRows()));
    EXPECT_NE("", errorOf("lie.off", replaced(offCube(), "8 6 0", "4000000000 6 0")));
    EXPECT_NE("", errorOf("lie.off", replaced(offCube(), "8 6 0", "8 -6 0")));
    EXPECT_NE("", errorOf("lie.off", replaced(offCube(), "4 1 3 7 5", "4000000000 1 3 7 5")));
    std::string bytes = binaryStlCube();
    EXPECT_NE("", errorOf("lie.stl", bytes.replace(80, 4, bytesOf(-1))));
}

TEST(MeshFile, RejectsHeadersItDoesNotUnderstand)
{
    EXPECT_NE("", errorOf("a.off", replaced(offCube(), "OFF", "4OFF")));
    EXPECT_NE("", errorOf("a.off", plainRows()));
    EXPECT_NE("", errorOf("a.ply", replaced(plyCube(), "ascii 1.0", "ascii 2.0")));
    EXPECT_NE("", errorOf("a.ply", replaced(plyCube(), "format ascii 1.0\n", "")));
    EXPECT_NE("", errorOf("a.ply", replaced(plyCube(), "float z", "quad z")));
    EXPECT_NE("", errorOf("a.ply", replaced(plyCube(), "float z", "float depth")));
    EXPECT_NE("", errorOf("a.ply", replaced(plyCube(), "list uchar int", "int")));
    EXPECT_NE("", errorOf("a.ply", replaced(plyCube(), "comment", "comet")));
    EXPECT_NE("", errorOf("a.ply", "plywood\n"));
    // Nobody could say which of the two is meant.
    EXPECT_TRUE(mentions(
        errorOf("a.ply", replaced(plyCube(), "element face", "property float x\nelement face")),
        "the property 'x' of element 'vertex' is there twice"));
    EXPECT_TRUE(mentions(
        errorOf("a.ply", replaced(plyCube(), "end_header", "element vertex 0\nend_header")),
        "the element 'vertex' is there twice"));
    EXPECT_TRUE(mentions(errorOf("a.ply",
                             replaced(plyCube(), "property list",
                                 "property list uchar int vertex_index\nproperty list")),
        "there twice"));
    EXPECT_NE("", errorOf("a.ply", replaced(plyCube(), "comment", "format ascii 1.0\ncomment")));
    const std::string unused = "element edge 0\nproperty int a\nproperty int a\nelement edge 0\n";
    EXPECT_EQ("", errorOf("a.ply", replaced(plyCube(), "element face", unused + "element face")));
    EXPECT_NE("", errorOf("a.stl", std::string(300, 'x')));
    EXPECT_NE("", errorOf("a.obj", std::string("\x89PNG\r\n\x1a\n") + std::string(100, '\0')));
}

TEST(MeshFile, RejectsAFileWithoutTriangles)
{
    EXPECT_NE(std::string::npos, errorOf("none.obj", "v 0 0 0\n").find("no triangle"));
    EXPECT_NE(std::string::npos, errorOf("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n").find("no tri"));
    EXPECT_NE(std::string::npos, errorOf("flat.obj", "v 0 0 0\nv 1 0 0\nf 1 2 1\n").find("no tri"));
    EXPECT_NE("", errorOf("none.stl", "solid nothing\nendsolid nothing\n"));
}

TEST(MeshFile, RejectsAMissingFileAnEmptyOneAndADirectory)
{
    EXPECT_NE("", errorOf(testing::TempDir() + "no_such_mesh.obj"));
    EXPECT_NE("", errorOf(testing::TempDir()));
    EXPECT_NE("", errorOf("empty.obj", ""));
    EXPECT_NE("", errorOf("unknown.mesh_of_no_kind", "v 0 0 0\n"));
}

TEST(MeshFile, ReadsWhatObjWritersWrite)
{
    const TriangleMesh mesh = read("all.obj",
        "# comment\r\nmtllib a.mtl\r\no thing\r\ng a b\r\ns off\r\n"
        "v 0 0 0 1.0\r\nv +1 0 0 0.5 0.5 0.5\r\nv 1e0 1 0 # here\r\n\tv 0 1 1e-400\r\n"
        "vt 0 0\r\nvn 0 0 1\r\nusemtl m\r\nf 1/1/1 2/1/1 3/1/1\r\n"
        "f -4//1 \\\r\n -2//1 -1//1\r\np 1\r\nl 1 2\r\nf 5 6 7\r\nv 0 0 2\r\nv 1 0 2\r\n"
        "v 0 1 2\r\n");
    EXPECT_EQ(7u, mesh.points.size());
    EXPECT_EQ(3u, mesh.triangles.size());
    EXPECT_DOUBLE_EQ(1.5, areaOf(mesh));
}

TEST(MeshFile, ReadsWhatOffAndPlyWritersWrite)
{
    const TriangleMesh off = read("c.off",
        "COFF # coloured\n\n# counts\n4 3 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n1 1 0 0 0 0 0\n"
        "0 1 0 0 0 0 0\n3 0 1 2 255 0 0\n\n3 0 2 3\n2 0 1\n");
    EXPECT_EQ(2u, off.triangles.size());
    EXPECT_EQ(1u, read("one.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2").triangles.size());
    const TriangleMesh ply = read("more.ply",
        "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement face 1\r\nproperty uchar flag\r\n"
        "property list uint8 uint32 vertex_index\r\nproperty list uchar float uv\r\n"
        "element vertex 3\r\nproperty uchar red\r\nproperty double z\r\nproperty float32 y\r\n"
        "property float x\r\nelement edge 1\r\nproperty int vertex1\r\nproperty int vertex2\r\n"
        "end_header\r\n7 3 0 1 2 2 0.5 0.5\r\n1 5 0 0\r\n2 5 0 1\r\n3 5 1 0\r\n0 1\r\n");
    ASSERT_EQ(3u, ply.points.size());
    EXPECT_EQ(Vec3d(1, 0, 5), ply.points[1]);
}

/// The lowest @a size bytes of a whole number.
std::string bytesOfInteger(int value, int size, bool bigEndian)
{
    std::string bytes;
    for (int i = 0; i < size; ++i) {
        bytes.push_back(char(value >> (8 * (bigEndian ? size - 1 - i : i))));
    }
    return bytes;
}

TEST(MeshFile, ReadsNegativeWholeNumbersOfABinaryPly)
{
    for (const bool bigEndian : {false, true}) {
        std::string bytes = std::string("ply\nformat binary_") + (bigEndian ? "big" : "little")
            + "_endian 1.0\nelement vertex 3\n"
              "property char x\nproperty short y\nproperty int z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        const Coord points[] = {Coord(-1, 2, 3), Coord(-128, -129, 4), Coord(127, 32767, -70000)};
        for (const Coord& point : points) {
            for (int axis = 0; axis < 3; ++axis) {
                bytes += bytesOfInteger(point[axis], 1 << axis, bigEndian);
            }
        }
        bytes += '\3' + bytesOf(0) + bytesOf(1, bigEndian) + bytesOf(2, bigEndian);
        const TriangleMesh mesh = read("signs.ply", bytes);
        ASSERT_EQ(3u, mesh.points.size());
        for (int i = 0; i < 3; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(double(points[i][axis]), mesh.points[i][axis]) << i << ' ' << axis;
            }
        }
    }
}

TEST(MeshFile, CutsConcavePolygonsIntoTrianglesThatStayInside)
{
    const TriangleMesh ell =
        read("ell.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 3 4 5 6 1 2\n");
    EXPECT_EQ(4u, ell.triangles.size());
    EXPECT_DOUBLE_EQ(3, areaOf(ell));          // overlapping triangles would have more
    const TriangleMesh comb = read("comb.obj", // in a plane that leans, the other way round
        "v 0 0 0\nv 0 3 3\nv 1 3 3\nv 1 1 1\nv 2 1 1\nv 2 3 3\nv 3 3 3\nv 3 1 1\nv 4 1 1\nv 4 3 3\n"
        "v 5 3 3\nv 5 0 0\nf 1 2 3 4 5 6 7 8 9 10 11 12\n");
    EXPECT_NEAR(std::sqrt(2.0) * (5 + 3 * 2), areaOf(comb), 1e-6);
}

TEST(MeshFile, CutsUpAPolygonThatCrossesItself)
{
    const TriangleMesh mesh = read(
        "star.obj", "v 0 3 0\nv 2 -2 0\nv -3 1 0\nv 3 1 0\nv -2 -2 0\nv 0 0 0\nf 1 2 3 4 5 6\n");
    EXPECT_EQ(4u, mesh.triangles.size());
}

/// In the meters of a map, floats are half a meter apart.
TEST(MeshFile, ReadsCoordinatesAsTheyAreFarFromTheOrigin)
{
    const std::string at = "5400000.3", beyond = "5400001.6";
    const std::string corners = at + " 0 0\n" + beyond + " 0 0\n" + at + " 0 1.3\n";
    const std::string faces = "3 0 1 2\n";
    std::string obj, stl = "solid s\nfacet normal 0 0 0\nouter loop\n";
    std::istringstream lines(corners);
    for (std::string line; std::getline(lines, line);) {
        obj += "v " + line + "\n";
        stl += "vertex " + line + "\n";
    }
    const std::map<std::string, std::string> files = {{"far.obj", obj + "f 1 2 3\n"},
        {"far.off", "OFF\n3 1 0\n" + corners + faces},
        {"far.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
            "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
            "end_header\n"
                + corners + faces},
        {"far.stl", stl + "endloop\nendfacet\nendsolid s\n"}};
    for (const auto& [name, bytes] : files) {
        const TriangleMesh mesh = read(name, bytes);
        ASSERT_EQ(3u, mesh.points.size()) << name;
        EXPECT_EQ(Vec3d(5400000.3, 0, 0), mesh.points[0]) << name;
        EXPECT_EQ(Vec3d(5400001.6, 0, 0), mesh.points[1]) << name;
        EXPECT_EQ(Vec3d(5400000.3, 0, 1.3), mesh.points[2]) << name;
    }
}

/// Programs that compute in doubles write one corner in several ways.
TEST(MeshFile, JoinsPointsThatDifferByRounding)
{
    const std::pair<std::string, std::string> ways[] = {
        {"0.3 ", "0.30000000000001 "}, {"5400000.3 ", "5400000.3000001 "}};
    for (const auto& [corner, other] : ways) {
        const TriangleMesh mesh = read("near.obj",
            "v " + corner + "0 0\nv " + corner + "1 0\nv " + corner + "0 1\nv " + other + "0 0\nv "
                + other + "1 0\nv " + corner + "0 -1\nv " + corner
                + "0.001 0\nf 1 2 3\nf 5 4 6\nf 1 4 3\nf 1 7 3\n");
        EXPECT_EQ(5u, mesh.points.size()) << corner; // 0.001 is no rounding
        EXPECT_EQ(3u, mesh.triangles.size());        // one with a corner twice is none
        EXPECT_EQ(mesh.triangles[0][0], mesh.triangles[1][1]);
        EXPECT_EQ(mesh.triangles[0][1], mesh.triangles[1][0]);
    }
}

/// A corner that lies far away must not join small ones.
TEST(MeshFile, KeepsSmallTrianglesBesideALongOne)
{
    const TriangleMesh mesh = read(
        "long.obj", "v 0 0 0\nv 0.001 0 0\nv 0 0.001 0\nv 1e6 0 0\nv 0 1e6 0\nf 1 2 3\nf 1 4 5\n");
    EXPECT_EQ(2u, mesh.triangles.size());
    EXPECT_EQ(5u, mesh.points.size());
}

TEST(MeshFile, SaysThatTrianglesHaveNoArea)
{
    EXPECT_TRUE(mentions(
        errorOf("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"), "two corners at one place"));
    EXPECT_TRUE(mentions(errorOf("none.obj", "v 1 1 1\n"), "holds no triangle"));
}

TEST(MeshFile, JoinsPointsAtTheSamePlaceAndDropsUnusedOnes)
{
    const TriangleMesh mesh = read("same.obj",
        "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 0\nv 1 0 0\nv 0 0 1\nf 2 3 4\nf 5 6 7\n");
    EXPECT_EQ(4u, mesh.points.size());
    EXPECT_EQ(mesh.triangles[0][0], mesh.triangles[1][0]);
    EXPECT_EQ(mesh.triangles[0][1], mesh.triangles[1][1]);
}

TEST(MeshFile, KnowsItsFilesByTheirExtensionInAnyCase)
{
    for (const char* name :
        {"a.obj", "b/c.PLY", "d.Stl", "e.off", "f.gltf", "g.GLB", "h.fbx", "i.dae", "j.3ds"}) {
        EXPECT_TRUE(isMeshFileName(name)) << name;
    }
    for (const char* name : {"a.vdb", "a.vol", "a.longvol", "a", "", "obj", "a.obj.gz", "a.csv"}) {
        EXPECT_FALSE(isMeshFileName(name)) << name;
    }
}

TEST(MeshFile, AFileMayBeShownUnderAnotherName)
{
    const TempFile file("nothing", objCube());
    const TriangleMesh mesh = readMeshFile(file.path, "stdin.obj");
    EXPECT_EQ("stdin", mesh.name);
    EXPECT_EQ(8u, mesh.points.size());
    const TempFile damaged("nothing_else", "f 1 2 3\n");
    const TempFile empty("empty", "");
    for (const std::string& path : {damaged.path, empty.path, std::string("/nowhere")}) {
        try {
            readMeshFile(path, "stdin.obj");
            ADD_FAILURE() << path << " was read";
        } catch (const openvdb::IoError& error) {
            EXPECT_NE(std::string(error.what()).find("stdin.obj: "), std::string::npos);
            EXPECT_EQ(std::string(error.what()).find(path), std::string::npos) << error.what();
        }
    }
}

/// Counts questions, and says yes from the @a after-th on.
class Asked : public openvdb::util::NullInterrupter {
public:
    explicit Asked(int after = 1 << 30) : mAfter(after) {}
    bool wasInterrupted(int = -1) override { return mCount++ >= mAfter; }
    int count() const { return mCount; }

private:
    int mAfter, mCount = 0;
};

std::string repeated(int count, const std::string& text)
{
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

TEST(MeshFile, AsksItsInterrupterAsItReads)
{
    const int many = 20000;
    const std::string number = std::to_string(many), point = "1 2 3\n";
    const std::string bytes = repeated(12 * many, std::string(1, '\0'));
    const std::string facet =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 "
        "endloop endfacet\n";
    const auto vertices = [&](const std::string& format) {
        return "ply\nformat " + format + " 1.0\nelement vertex " + number
            + "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    };
    const std::vector<std::pair<std::string, std::string>> files = {
        {".obj", repeated(many, "v " + point)},
        {".obj", repeated(many, "\n")},
        {".obj", "f" + repeated(many, " 1") + "\nv 0 0 0"},
        {".off", "OFF\n" + number + " 0 0\n" + repeated(many, point)},
        {".ply", vertices("ascii") + repeated(many, point)},
        {".ply", vertices("binary_little_endian") + bytes},
        {".stl", "solid\n" + repeated(many / 4, facet) + "endsolid\n"},
        {".stl", std::string(80, '\0') + bytesOf(many) + repeated(many, std::string(50, '\0'))},
    };
    for (const auto& [extension, contents] : files) {
        SCOPED_TRACE(extension + ": " + contents.substr(0, 20));
        Asked asked;
        detail::parseMesh(extension, contents, &asked);
        EXPECT_GE(asked.count(), 4);
        for (const int after : {0, 2}) {
            Asked stop(after);
            EXPECT_THROW(detail::parseMesh(extension, contents, &stop), Interrupted);
        }
    }
}

TEST(MeshFile, AsksItsInterrupterAsItMakesTriangles)
{
    const int many = 20000;
    const std::string bytes = "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + repeated(many, "f 1 2 3\n");
    const TempFile file("many.obj", bytes);
    Asked parsing, asked;
    detail::parseMesh(".obj", bytes, &parsing);
    readMeshFile(file.path, {}, &asked);
    const int corners = 3 * many / 4096, triangles = many / 4096;
    EXPECT_GE(asked.count(), parsing.count() + corners + triangles);
    Asked before(0), late(asked.count() - 1);
    EXPECT_THROW(readMeshFile(file.path, {}, &before), Interrupted);
    EXPECT_THROW(readMeshFile(file.path, {}, &late), Interrupted);
}

TEST(MeshFile, AsksItsInterrupterWithinAPolygon)
{
    const int many = 1000;
    std::string bytes, face = "f";
    for (int i = 0; i < many;
         ++i) { // a zigzag below a parabola: concave, and few of its corners are ears
        bytes +=
            "v " + std::to_string(i) + (i % 2 ? " 0 0\n" : " " + std::to_string(i * i) + " 0\n");
        face += " " + std::to_string(i + 1);
    }
    const TempFile file("zigzag.obj", bytes + face);
    Asked asked;
    EXPECT_EQ(readMeshFile(file.path, {}, &asked).triangles.size(), std::size_t(many - 2));
    EXPECT_GE(asked.count(), 100);
}

TEST(MeshFile, ReadsTheSampleMeshes)
{
    const char* folder = std::getenv("SPHERETREE_DATA");
    if (!folder) GTEST_SKIP() << "needs SPHERETREE_DATA";
    const std::map<std::string, std::pair<std::size_t, std::size_t>> sizes = {{"cow", {2903, 5804}},
        {"fandisk", {6475, 12946}}, {"rocker-arm", {10044, 20088}}, {"spot", {2930, 5856}}};
    for (const auto& [name, size] : sizes) {
        const TriangleMesh mesh = readMeshFile(folder + ("/mesh/" + name + ".obj"));
        EXPECT_EQ(size.first, mesh.points.size()) << name;
        EXPECT_EQ(size.second, mesh.triangles.size()) << name;
        EXPECT_GT(volumeOf(mesh), 0) << name;
    }
}

} // namespace
