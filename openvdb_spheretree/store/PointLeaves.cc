// SPDX-License-Identifier: Apache-2.0
#include "PointLeaves.h"

#include <openvdb_spheretree/base/AtomicExtremes.h>
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/ParallelSort.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>

#include <openvdb/points/PointGroup.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::Index;
using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::util::NullInterrupter;
namespace points = openvdb::points;

Coord leafOrigin(const Coord& voxel) { return voxel & ~int32_t(PointLeaf::DIM - 1); }

/// @return the lowest index that is wrong, or @a count: of several it is always the same one.
template <typename Wrong>
std::size_t firstWrong(std::size_t count, NullInterrupter* interrupter, const Wrong& wrong)
{
    std::atomic<std::size_t> first{count};
    parallelFor(count, interrupter, [&](std::size_t i) {
        if (i < first.load(std::memory_order_relaxed) && wrong(i)) lowerTo(first, i);
    });
    return first;
}

/// Whether a voxel holds too few points on average. On fine scales some of the points have more
/// voxels than all of them should, and need no others to be counted.
bool isTooFine(const std::vector<Vec3d>& positions, int scale, NullInterrupter* interrupter)
{
    constexpr std::size_t kPointsPerVoxel = 4;
    const auto tooMany = [&](std::size_t count) { // voxels that the first points are in
        const LargeArray<Coord> voxels = makeLargeArray<Coord>(count);
        Coord *const begin = voxels.get(), *const end = begin + count;
        parallelFor(count, interrupter,
            [&](std::size_t i) { begin[i] = Coord::round(positions[i] / double(scale)); });
        parallelSort(begin, end, interrupter);
        return std::size_t(std::unique(begin, end) - begin) * kPointsPerVoxel > positions.size();
    };
    return tooMany(positions.size() / 3) || tooMany(positions.size());
}

void checkRange(const std::vector<Vec3d>& positions, NullInterrupter* interrupter)
{
    if (positions.size() > std::size_t(std::numeric_limits<int32_t>::max())) {
        OPENVDB_THROW(openvdb::ValueError,
            positions.size() << " points are more than a file can hold (2^31 - 1): use a larger "
                                "voxel, or split the object");
    }
    const double limit = double(std::numeric_limits<int32_t>::max()); // of voxel coordinates
    const std::size_t wrong = firstWrong(positions.size(), interrupter, [&](std::size_t i) {
        const Vec3d& p = positions[i];
        return !(std::abs(p[0]) < limit && std::abs(p[1]) < limit && std::abs(p[2]) < limit);
    });
    if (wrong == positions.size()) return;
    OPENVDB_THROW(openvdb::ValueError,
        "point " << wrong << " at " << positions[wrong]
                 << " is out of the range of voxel coordinates (2^31)");
}

/// A group of a leaf: a bit of each byte of an array.
struct GroupBit {
    std::size_t array;
    points::GroupType mask;
};

/// @return the groups' bits in a leaf; nothing if one is missing, or two share one.
std::vector<GroupBit> groupBits(const PointLeaf& leaf, const std::vector<std::string>& names)
{
    const points::AttributeSet& attributes = leaf.attributeSet();
    std::vector<GroupBit> bits;
    for (const std::string& name : names) {
        if (!attributes.descriptor().hasGroup(name)) return {};
        const auto index = attributes.groupIndex(name);
        if (!points::isGroup(*attributes.getConst(index.first))) return {};
        const GroupBit bit = {index.first, points::GroupType(1 << index.second)};
        for (const GroupBit& other : bits) {
            if (other.array == bit.array && other.mask == bit.mask) return {};
        }
        bits.push_back(bit);
    }
    return bits;
}

/// Whether each point of a leaf is in the group of its level alone. Groups of others may have bits
/// of the same bytes.
bool holdsGroups(const PointLeaf& leaf, const std::vector<GroupBit>& bits, const int32_t* levels)
{
    std::map<std::size_t, points::GroupType> ours; // bits of each array
    for (const GroupBit& bit : bits) ours[bit.array] |= bit.mask;
    for (const auto& [array, mask] : ours) {
        const ArrayValues<points::GroupType> bytes(leaf.constAttributeArray(array));
        for (Index n = 0; n < leaf.getLastValue(); ++n) {
            const GroupBit& own = bits[std::size_t(levels[n])];
            const int expected = own.array == array ? own.mask : 0;
            if ((bytes[n] & mask) != expected) return false;
        }
    }
    return true;
}

} // namespace

PointWriter::PointWriter(const std::vector<Vec3d>& positions, NullInterrupter* interrupter)
    : mInterrupter(interrupter), mGrid(makeGrid<points::PointDataGrid>())
{
    checkRange(positions, interrupter);
    while (mScale < kMaxPointScale && isTooFine(positions, mScale, interrupter)) mScale *= 2;
    const std::vector<Place> sorted = places(positions);
    openvdb::tree::ValueAccessor<points::PointDataTree> accessor(mGrid->tree());
    mOrder.reserve(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (i % (1 << 18) == 0) checkInterrupt(interrupter);
        const Coord origin = leafOrigin(sorted[i].voxel);
        if (i == 0 || leafOrigin(sorted[i - 1].voxel) != origin) {
            mLeaves.push_back(accessor.touchLeaf(origin));
            mBegin.push_back(uint32_t(i));
        }
        mOrder.push_back(sorted[i].point);
    }
    mBegin.push_back(uint32_t(sorted.size()));

    const auto descriptor = points::AttributeSet::Descriptor::create(
        points::TypedAttributeArray<Vec3f>::attributeType());
    {
        const points::AttributeArray::ScopedRegistryLock lock;
        parallelFor(mLeaves.size(), mInterrupter, [&](std::size_t i) {
            mLeaves[i]->initializeAttributes(descriptor, countOf(i), &lock);
        });
    }
    parallelFor(
        mLeaves.size(), mInterrupter, [&](std::size_t i) { writeLeaf(i, sorted, positions); });
}

std::vector<PointWriter::Place> PointWriter::places(const std::vector<Vec3d>& positions) const
{
    std::vector<Place> places(positions.size());
    const std::size_t wrong = firstWrong(positions.size(), mInterrupter, [&](std::size_t i) {
        const Vec3d position = positions[i] / double(mScale); // exact: a power of two
        const Coord voxel = Coord::round(position);
        const Vec3f offset(position - voxel.asVec3d());
        places[i] = {voxel, uint32_t(i)};
        return (voxel.asVec3d() + Vec3d(offset)) * double(mScale) != positions[i];
    });
    if (wrong != positions.size()) {
        OPENVDB_THROW(openvdb::ValueError,
            "point " << wrong << " at " << positions[wrong]
                     << " cannot be stored exactly: positions must be multiples of 1/1024 voxel");
    }
    parallelSort(places.begin(), places.end(), mInterrupter, [](const Place& a, const Place& b) {
        const Coord leafA = leafOrigin(a.voxel), leafB = leafOrigin(b.voxel);
        if (leafA != leafB) return leafA < leafB;
        if (a.voxel != b.voxel) return a.voxel < b.voxel; // the order of voxels in a leaf, too
        return a.point < b.point;
    });
    return places;
}

void PointWriter::writeLeaf(
    std::size_t leaf, const std::vector<Place>& places, const std::vector<Vec3d>& positions)
{
    points::AttributeWriteHandle<Vec3f> handle(mLeaves[leaf]->attributeArray("P"));
    std::vector<PointLeaf::ValueType> ends(PointLeaf::SIZE, PointLeaf::ValueType(0));
    for (uint32_t n = 0; n < countOf(leaf); ++n) {
        const Place& place = places[mBegin[leaf] + n];
        const Vec3d position = positions[place.point] / double(mScale);
        handle.set(n, Vec3f(position - place.voxel.asVec3d()));
        ends[PointLeaf::coordToOffset(place.voxel)] = PointLeaf::ValueType(n + 1);
    }
    for (Index v = 1; v < PointLeaf::SIZE; ++v) ends[v] = std::max(ends[v - 1], ends[v]);
    handle.compact();
    mLeaves[leaf]->setOffsets(ends);
}

void PointWriter::addGroups(
    const std::vector<std::string>& names, const std::function<int(uint32_t)>& groupOf)
{
    points::appendGroups(mGrid->tree(), names);
    parallelFor(mLeaves.size(), mInterrupter, [&](std::size_t i) {
        std::vector<int> groups(countOf(i));
        for (uint32_t n = 0; n < countOf(i); ++n) groups[n] = groupOf(mOrder[mBegin[i] + n]);
        for (int group = 0; group < int(names.size()); ++group) {
            if (std::find(groups.begin(), groups.end(), group) == groups.end()) continue;
            points::GroupWriteHandle handle = mLeaves[i]->groupWriteHandle(names[group]);
            for (std::size_t n = 0; n < groups.size(); ++n) {
                if (groups[n] == group) handle.set(Index(n), true);
            }
            handle.compact();
        }
    });
}

points::PointDataGrid::Ptr PointWriter::finish(const openvdb::math::Transform& source) const
{
    // The class stays unknown: tools that take points look for that.
    const openvdb::math::Transform::Ptr transform = source.copy();
    if (mScale != 1) transform->preScale(double(mScale));
    mGrid->setTransform(transform);
    return mGrid;
}

PointReader::PointReader(const points::PointDataGrid& grid, NullInterrupter* interrupter)
    : mInterrupter(interrupter)
{
    grid.tree().getNodes(mLeaves);
    mBegin.push_back(0);
    for (const PointLeaf* leaf : mLeaves) {
        leaf->validateOffsets();
        mBegin.push_back(mBegin.back() + std::size_t(leaf->getLastValue()));
    }
}

void PointReader::requireGroups(
    const std::vector<std::string>& names, const std::vector<int32_t>& groups) const
{
    if (mLeaves.empty()) return;
    // Leaves of a file share their descriptor as a rule: names are looked up once.
    const auto shared = mLeaves.front()->attributeSet().descriptorPtr();
    const std::vector<GroupBit> sharedBits = groupBits(*mLeaves.front(), names);
    const std::size_t wrong = firstWrong(mLeaves.size(), mInterrupter, [&](std::size_t i) {
        const PointLeaf& leaf = *mLeaves[i];
        const bool isShared = leaf.attributeSet().descriptorPtr() == shared;
        const std::vector<GroupBit> bits = isShared ? sharedBits : groupBits(leaf, names);
        return bits.empty() || !holdsGroups(leaf, bits, groups.data() + mBegin[i]);
    });
    if (wrong == mLeaves.size()) return;
    OPENVDB_THROW(openvdb::IoError,
        "its groups are not as they were written: of the points near "
            << mLeaves[wrong]->origin() << ", some are not in the group of their level alone");
}

template <typename Body>
void PointReader::forPositions(std::size_t leaf, int scale, const Body& body) const
{
    const PointLeaf& here = *mLeaves[leaf];
    const ArrayValues<Vec3f> offsets(*here.attributeSet().getConst("P"));
    const PointLeaf::ValueType* const ends = here.buffer().data();
    Index n = 0;
    for (Index row = 0; row < PointLeaf::SIZE; row += PointLeaf::DIM) {
        if (n == ends[row + PointLeaf::DIM - 1]) continue; // most voxels have no point
        for (Index v = row; v < row + PointLeaf::DIM; ++v) {
            if (n == ends[v]) continue;
            const Vec3d voxel = here.offsetToGlobalCoord(v).asVec3d();
            for (; n < ends[v]; ++n) {
                body(mBegin[leaf] + n, (voxel + Vec3d(offsets[n])) * double(scale));
            }
        }
    }
}

std::vector<Vec3d> PointReader::positions(int scale) const
{
    requireAttribute<Vec3f>("P");
    std::vector<Vec3d> positions(size());
    parallelFor(mLeaves.size(), mInterrupter, [&](std::size_t i) {
        forPositions(i, scale, [&](std::size_t n, const Vec3d& at) { positions[n] = at; });
    });
    return positions;
}

std::size_t PointReader::firstAstray(
    int scale, const std::vector<Vec3d>& places, const std::vector<int32_t>& indices) const
{
    requireAttribute<Vec3f>("P");
    std::atomic<std::size_t> first{size()};
    parallelFor(mLeaves.size(), mInterrupter, [&](std::size_t i) {
        forPositions(i, scale, [&](std::size_t n, const Vec3d& at) {
            if (at != places[std::size_t(indices[n])]) lowerTo(first, n);
        });
    });
    return first;
}

} // namespace openvdb_spheretree::detail
