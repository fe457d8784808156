// SPDX-License-Identifier: Apache-2.0
/// @file teapot.cc
/// @brief Writes the Utah teapot as a triangle mesh: the sample object of the quickstart.
///
///     teapot OUT.obj [subdivisions]        10 where none is given: 10 x 10 x 2 triangles a patch
///
/// The 32 patches alone bound no solid: the lid floats 0.1 away from the rim, the spout is open at
/// its mouth, and handle and spout are tubes that end open in the body. Voxels of 1/256 of the
/// teapot's length or less get in, and meshToVolume makes a hollow shell of it. So flat faces are
/// added: a ring between lid and rim, and a cap on each of the four open ends. Body, handle and
/// spout are then three closed surfaces that reach into each other; meshToVolume drops the walls
/// inside and makes them one solid at any voxel size.

#include "TeapotPatches.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <vector>

namespace {

using teapot::Point;
using Row = std::vector<Point>;
using Sheet = std::vector<Row>; // points that are neighbours along and across rows

struct Mesh {
    std::map<std::array<float, 3>, int> numbers; // by exact place: patches share their borders
    std::vector<std::array<float, 3>> points;
    std::vector<std::array<int, 3>> triangles; // counted from 1

    int number(const Point& p)
    {
        const std::array<float, 3> key{float(p.x) + 0.0f, float(p.y) + 0.0f, float(p.z) + 0.0f};
        const auto [it, isNew] = numbers.emplace(key, int(points.size()) + 1);
        if (isNew) points.push_back(key);
        return it->second;
    }

    void add(const Point& a, const Point& b, const Point& c)
    {
        const std::array<int, 3> t{number(a), number(b), number(c)};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }

    void add(const Sheet& s)
    {
        for (std::size_t i = 0; i + 1 < s.size(); ++i) {
            for (std::size_t j = 0; j + 1 < s[i].size(); ++j) {
                add(s[i][j], s[i][j + 1], s[i + 1][j + 1]);
                add(s[i][j], s[i + 1][j + 1], s[i + 1][j]);
            }
        }
    }
};

Point bezier(const std::array<Point, 4>& p, double t)
{
    const double s = 1 - t, a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
    return {a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
        a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y,
        a * p[0].z + b * p[1].z + c * p[2].z + d * p[3].z};
}

Sheet tessellated(const teapot::Patch& p, int n)
{
    Sheet sheet(n + 1);
    for (int i = 0; i <= n; ++i) {
        std::array<Point, 4> row;
        for (int k = 0; k < 4; ++k) {
            row[k] = bezier({p[0][k], p[1][k], p[2][k], p[3][k]}, double(i) / n);
        }
        for (int j = 0; j <= n; ++j) sheet[i].push_back(bezier(row, double(j) / n));
    }
    return sheet;
}

Row reversed(const Row& row) { return Row(row.rbegin(), row.rend()); }

Mesh teapotMesh(int n)
{
    Mesh mesh;
    std::vector<Sheet> sheets;
    for (const teapot::Patch& patch : teapot::patches()) sheets.push_back(tessellated(patch, n));
    for (const Sheet& sheet : sheets) mesh.add(sheet);
    for (int quarter = 0; quarter < 4; ++quarter) { // from the lid's edge to the rim's
        mesh.add({sheets[20 + quarter].back(), sheets[quarter].front()});
    }
    for (const int tube : {24, 28}) { // handle and spout: where they begin, and where they end
        mesh.add({reversed(sheets[tube + 1].front()), sheets[tube].front()});
        mesh.add({sheets[tube + 2].back(), reversed(sheets[tube + 3].back())});
    }
    return mesh;
}

} // namespace

int main(int argc, char* argv[])
{
    const int n = argc == 3 ? std::atoi(argv[2]) : 10;
    if (argc < 2 || argc > 3 || n < 2 || n > 1000) {
        std::cerr << "usage: teapot OUT.obj [subdivisions of a patch, 2 to 1000; default 10]\n";
        return 2;
    }
    const Mesh mesh = teapotMesh(n);
    std::ofstream file(argv[1]);
    file.precision(std::numeric_limits<float>::max_digits10);
    file << "# Utah teapot (M. Newell, 1975), open ends closed\n";
    for (const auto& p : mesh.points) file << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const auto& t : mesh.triangles) {
        file << "f " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    }
    if (!file.flush()) {
        std::cerr << "teapot: cannot write " << argv[1] << '\n';
        return 4;
    }
    return 0;
}
