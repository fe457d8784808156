// SPDX-License-Identifier: Apache-2.0
// Prints the spheres that NanoVDB finds in a file: x y z radius level id parent, voxel by voxel as its points are. With
// the word `transform` behind the file: where voxel 5, 6, 7 is.

#include <nanovdb/util/IO.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace {

/// The values of an attribute, by its name.
template <typename T>
const T* attribute(const nanovdb::UInt32Grid& grid, const std::string& name)
{
    for (uint32_t i = 0; i < grid.blindDataCount(); ++i) {
        if (name == grid.blindMetaData(i).mName) {
            return static_cast<const T*>(grid.blindData(i));
        }
    }
    throw std::runtime_error("no attribute " + name);
}

void printSpheres(const nanovdb::UInt32Grid& grid)
{
    const nanovdb::PointAccessor<nanovdb::Vec3f> points(grid);
    const nanovdb::Vec3f *first = nullptr, *end = nullptr;
    points.gridPoints(first, end);
    const auto* const radii = attribute<float>(grid, "pscale");
    const auto* const levels = attribute<int32_t>(grid, "level");
    const auto* const ids = attribute<int32_t>(grid, "id");
    const auto* const parents = attribute<int32_t>(grid, "parent");
    const auto& leaves = grid.tree();
    for (uint32_t n = 0; n < leaves.nodeCount(0); ++n) {
        const auto& leaf = leaves.getFirstNode<0>()[n];
        for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
            const nanovdb::Vec3f *begin = nullptr, *last = nullptr;
            points.voxelPoints(voxel.getCoord(), begin, last);
            for (; begin != last; ++begin) {
                const nanovdb::Vec3d index = nanovdb::Vec3d(*begin)
                    + nanovdb::Vec3d(voxel.getCoord()[0], voxel.getCoord()[1], voxel.getCoord()[2]);
                const nanovdb::Vec3d at = grid.indexToWorld(index);
                const auto i = begin - first;
                std::printf("%.17g %.17g %.17g %.17g %d %d %d\n", at[0], at[1], at[2],
                    double(radii[i]), levels[i], ids[i], parents[i]);
            }
        }
    }
}

} // namespace

int main(int count, char** arguments)
{
    if (count < 2) return 2;
    try {
        const auto handle = nanovdb::io::readGrid(std::string(arguments[1]));
        if (count > 2) {
            const auto at = handle.gridMetaData()->map().applyMap(nanovdb::Vec3d(5, 6, 7));
            std::printf("%.17g %.17g %.17g\n", at[0], at[1], at[2]);
            return 0;
        }
        const auto* const grid = handle.grid<uint32_t>();
        if (!grid || !grid->isPointData()) throw std::runtime_error("no points");
        printSpheres(*grid);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
