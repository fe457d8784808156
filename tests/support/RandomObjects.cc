// SPDX-License-Identifier: Apache-2.0
#include "RandomObjects.h"

#include <array>
#include <cmath>

namespace spheretree_test {

Coord Random::coord(int low, int high)
{
    const int x = between(low, high), y = between(low, high), z = between(low, high);
    return Coord(x, y, z);
}

namespace shapes {

Voxels box(const Coord& size)
{
    return voxelsOfBox(CoordBBox(Coord(0, 0, 0), size - Coord(1, 1, 1)));
}

Voxels ball(int radiusSq, int holeSq)
{
    const int r = int(std::sqrt(double(radiusSq))) + 1;
    Voxels voxels;
    for (const Coord& v : voxelsOfBox(CoordBBox(Coord(-r, -r, -r), Coord(r, r, r)))) {
        const int64_t d = squaredDistance(v, Coord(0, 0, 0));
        if (d < radiusSq && d >= holeSq) voxels.push_back(v);
    }
    return voxels;
}

Voxels noise(const Coord& size, double rate, Random& random)
{
    Voxels voxels;
    for (const Coord& v : box(size)) {
        if (random.chance(rate)) voxels.push_back(v);
    }
    return voxels;
}

namespace {

Voxels checkerboard(const Coord& size)
{
    Voxels voxels;
    for (const Coord& v : box(size)) {
        if ((v[0] + v[1] + v[2]) % 2 == 0) voxels.push_back(v);
    }
    return voxels;
}

/// One to four straight or slanted lines.
Voxels lines(Random& random)
{
    Voxels voxels;
    for (int count = random.between(1, 4); count > 0; --count) {
        Coord at = random.coord(0, 12);
        const Coord step = random.coord(-1, 1);
        for (int n = random.between(1, 40); n > 0; --n, at += step) voxels.push_back(at);
    }
    return voxels;
}

/// Boxes that shrink along the branches of a random walk.
Voxels boxTree(Random& random)
{
    Voxels voxels;
    Coord at(0, 0, 0);
    for (int side = random.between(5, 9); side > 0; side -= random.between(0, 2)) {
        for (const Coord& v : box(random.coord(1, side))) voxels.push_back(at + v);
        at += random.coord(-side, side);
        if (voxels.size() > 2500) break;
    }
    return voxels;
}

Voxels plate(Random& random)
{
    Coord size = random.coord(6, 26);
    size[random.between(0, 2)] = random.between(1, 2);
    return box(size);
}

Voxels twoBalls(Random& random)
{
    Voxels voxels = ball(random.between(2, 50));
    const Coord offset = random.coord(-7, 7);
    for (const Coord& v : ball(random.between(2, 40))) voxels.push_back(v + offset);
    return voxels;
}

Voxels boxShell(Random& random)
{
    const Coord size = random.coord(4, 13);
    const int wall = random.between(1, 2);
    Voxels voxels;
    for (const Coord& v : box(size)) {
        bool inWall = false;
        for (int axis = 0; axis < 3; ++axis) {
            inWall = inWall || v[axis] < wall || v[axis] >= size[axis] - wall;
        }
        if (inWall) voxels.push_back(v);
    }
    return voxels;
}

} // namespace

Voxels pricked(const Voxels& solid, double rate, Random& random)
{
    Voxels voxels;
    for (const Coord& v : solid) {
        if (!random.chance(rate)) voxels.push_back(v);
    }
    return voxels;
}

} // namespace shapes

void placeOnBorder(Voxels& voxels, Random& random)
{
    constexpr std::array<int, 12> kBorders{
        0, 0, 8, -8, 16, 128, -128, 256, 4096, -4096, 8192, 1234567};
    const CoordBBox box = boxOf(voxels);
    Coord by;
    for (int axis = 0; axis < 3; ++axis) {
        const int border = kBorders[random.between(0, int(kBorders.size()) - 1)];
        by[axis] = border - random.between(box.min()[axis], box.max()[axis] + 1);
    }
    for (Coord& voxel : voxels) voxel += by;
}

RandomObject randomObject(uint32_t seed)
{
    constexpr std::array<double, 11> kRates{
        0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.98};
    Random random(seed);
    const double rate = kRates[random.between(0, int(kRates.size()) - 1)];
    std::string shape;
    Voxels voxels;
    switch (seed % 11) {
    case 0:
    case 1: shape = "noise", voxels = shapes::noise(random.coord(3, 15), rate, random); break;
    case 2: shape = "ball", voxels = shapes::ball(random.between(1, 72)); break;
    case 3: shape = "box", voxels = shapes::box(random.coord(1, 13)); break;
    case 4: {
        const int radiusSq = random.between(4, 90);
        shape = "shell", voxels = shapes::ball(radiusSq, random.between(1, radiusSq - 1));
        break;
    }
    case 5: shape = "plate", voxels = shapes::plate(random); break;
    case 6: shape = "lines", voxels = shapes::lines(random); break;
    case 7: shape = "checkerboard", voxels = shapes::checkerboard(random.coord(2, 14)); break;
    case 8: shape = "tree of boxes", voxels = shapes::boxTree(random); break;
    case 9: shape = "two balls", voxels = shapes::twoBalls(random); break;
    default:
        shape = "pricked",
        voxels = seed % 2 ? shapes::box(random.coord(5, 13)) : shapes::boxShell(random);
        voxels = shapes::pricked(voxels, (1 - rate) / 4, random);
    }
    if (voxels.empty()) voxels.emplace_back(0, 0, 0);
    placeOnBorder(voxels, random);
    sortVoxels(voxels);
    return {shape + ", seed " + std::to_string(seed), voxels};
}

} // namespace spheretree_test
