// SPDX-License-Identifier: Apache-2.0
#include "DenseTopology.h"

#include <cstdlib>
#include <ostream>

namespace openvdb_spheretree {

std::ostream& operator<<(std::ostream& out, const LevelTopology& t)
{
    return out << t.components << " components, " << t.tunnels << " tunnels, " << t.cavities
               << " cavities";
}

} // namespace openvdb_spheretree

namespace spheretree_test {

DenseTopology::DenseTopology(const Voxels& voxels) : mBox(boxOf(voxels))
{
    mBox.expand(1); // a margin of background, connected
    mOn.assign(std::size_t(mBox.volume()), 0);
    for (const Coord& voxel : voxels) mOn[index(voxel)] = 1;
}

openvdb_spheretree::LevelTopology DenseTopology::numbers() const
{
    const int64_t components = count(1, 3), cavities = count(0, 1) - 1;
    return {components, components + cavities - eulerNumber(), cavities};
}

openvdb_spheretree::LevelTopology DenseTopology::numbersInPlane(int axis) const
{
    DenseTopology plane = *this;
    plane.mFlat = axis;
    return {plane.count(1, 2), plane.count(0, 1) - 1, 0};
}

std::size_t DenseTopology::index(const Coord& v) const
{
    const Coord n = mBox.dim(), d = v - mBox.min();
    return (std::size_t(d[0]) * std::size_t(n[1]) + std::size_t(d[1])) * std::size_t(n[2])
        + std::size_t(d[2]);
}

int64_t DenseTopology::count(char on, int steps) const
{
    CoordBBox box = mBox;
    if (mFlat >= 0) { // without the margin
        box.min()[mFlat] += 1;
        box.max()[mFlat] -= 1;
    }
    std::vector<char> seen(mOn.size(), 0);
    int64_t components = 0;
    for (const Coord& start : voxelsOfBox(box)) {
        if (mOn[index(start)] != on || seen[index(start)]) continue;
        ++components;
        std::vector<Coord> todo{start};
        seen[index(start)] = 1;
        while (!todo.empty()) {
            const Coord at = todo.back();
            todo.pop_back();
            for (const Coord& step : voxelsOfBox(CoordBBox(Coord(-1), Coord(1)))) {
                const Coord next = at + step;
                const int length = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
                if (length > steps || !box.isInside(next)) continue;
                if (mOn[index(next)] != on || seen[index(next)]) continue;
                seen[index(next)] = 1;
                todo.push_back(next);
            }
        }
    }
    return components;
}

int64_t DenseTopology::eulerNumber() const
{
    const Coord n = mBox.dim();
    const std::size_t rows = std::size_t(2 * n[1] + 1), row = std::size_t(2 * n[2] + 1);
    std::vector<char> seen(std::size_t(2 * n[0] + 1) * rows * row, 0);
    int64_t sum = 0;
    for (const Coord& voxel : voxelsOfBox(mBox)) {
        if (!mOn[index(voxel)]) continue;
        for (const Coord& d : voxelsOfBox(CoordBBox(Coord(-1), Coord(1)))) {
            const Coord v = voxel - mBox.min();
            const std::size_t x = std::size_t(2 * v[0] + 1 + d[0]),
                              y = std::size_t(2 * v[1] + 1 + d[1]),
                              z = std::size_t(2 * v[2] + 1 + d[2]);
            char& cell = seen[(x * rows + y) * row + z];
            if (cell) continue;
            cell = 1;
            sum += (d[0] + d[1] + d[2]) % 2 == 0 ? -1 : 1; // 0 zeros: vertex; 3 zeros: cube
        }
    }
    return sum;
}

} // namespace spheretree_test
