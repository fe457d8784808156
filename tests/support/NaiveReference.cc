// SPDX-License-Identifier: Apache-2.0
#include "NaiveReference.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace spheretree_test {

void sortVoxels(Voxels& voxels)
{
    std::sort(voxels.begin(), voxels.end());
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
}

CoordBBox boxOf(const Voxels& voxels)
{
    CoordBBox box;
    for (const Coord& voxel : voxels) box.expand(voxel);
    return box;
}

Voxels voxelsOfBox(const CoordBBox& box)
{
    Voxels voxels;
    voxels.reserve(std::size_t(box.volume()));
    for (int x = box.min()[0]; x <= box.max()[0]; ++x) {
        for (int y = box.min()[1]; y <= box.max()[1]; ++y) {
            for (int z = box.min()[2]; z <= box.max()[2]; ++z) voxels.emplace_back(x, y, z);
        }
    }
    return voxels;
}

Voxels translated(Voxels voxels, const Coord& by)
{
    for (Coord& voxel : voxels) voxel += by;
    return voxels;
}

NaiveReference::NaiveReference(Voxels voxels, int dim, const Length& length)
    : mVoxels(std::move(voxels)), mDim(dim), mLength(length)
{
    sortVoxels(mVoxels);
    computeDistances();
    computeLabels();
}

std::vector<NaiveReference::Ball> NaiveReference::balls() const
{
    std::vector<Ball> result;
    for (std::size_t site : std::set<std::size_t>(mLabels.begin(), mLabels.end())) {
        result.push_back({mVoxels[site], mDistSq[site]});
    }
    return result;
}

void NaiveReference::computeDistances()
{
    CoordBBox box = boxOf(mVoxels);
    box.expand(1);
    Voxels background;
    for (const Coord& voxel : voxelsOfBox(box)) {
        const bool on = std::binary_search(mVoxels.begin(), mVoxels.end(), voxel);
        if (!on) background.push_back(voxel);
    }
    for (const Coord& p : mVoxels) {
        int64_t nearest = std::numeric_limits<int64_t>::max();
        for (const Coord& b : background) {
            if (!apart(p, b)) nearest = std::min(nearest, mLength(p, b));
        }
        mDistSq.push_back(nearest);
    }
}

void NaiveReference::computeLabels()
{
    for (const Coord& q : mVoxels) {
        std::size_t best = mVoxels.size();
        int64_t bestValue = 0;
        for (std::size_t p = 0; p < mVoxels.size(); ++p) {
            if (apart(mVoxels[p], q)) continue;
            const int64_t value = mDistSq[p] - mLength(mVoxels[p], q);
            if (best == mVoxels.size() || value > bestValue
                || (value == bestValue && winsTie(p, best))) {
                best = p;
                bestValue = value;
            }
        }
        mLabels.push_back(best);
    }
}

bool NaiveReference::winsTie(std::size_t p, std::size_t best) const
{
    if (mDistSq[p] != mDistSq[best]) return mDistSq[p] > mDistSq[best];
    return mVoxels[p] < mVoxels[best];
}

std::vector<std::set<Coord>> naiveOrPyramid(const Voxels& object, int factor, int dim)
{
    const auto floorDiv = [](int64_t a, int64_t b) {
        int64_t quotient = a / b;
        if (quotient * b > a) --quotient;
        return int(quotient);
    };
    const Coord lowest = boxOf(object).min();
    Coord origin(
        8 * floorDiv(lowest[0], 8), 8 * floorDiv(lowest[1], 8), 8 * floorDiv(lowest[2], 8));
    std::vector<std::set<Coord>> levels;
    levels.emplace_back(object.begin(), object.end());
    while (levels.back().size() > 1) {
        std::set<Coord> next;
        for (const Coord& voxel : levels.back()) {
            const Coord v = voxel - origin;
            next.insert(Coord(floorDiv(v[0], factor), floorDiv(v[1], factor),
                dim == 2 ? v[2] : floorDiv(v[2], factor)));
        }
        levels.push_back(next);
        origin = Coord(0, 0, 0);
    }
    return levels;
}

} // namespace spheretree_test
