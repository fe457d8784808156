// SPDX-License-Identifier: Apache-2.0
/// @file VoxelRegion.h
/// @brief A sparse set of object voxels.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// The voxels of a region in one leaf of the object.
struct RegionLeaf {
    uint32_t leaf;
    const LeafMask& mask; ///< lives as long as the region, and until that changes
};

/// In the order of leaves; no part is empty. Where it has all voxels that the object has in a leaf,
/// it takes 8 bytes, and 72 elsewhere: large balls hold most leaves as a whole.
class VoxelRegion {
    struct Part {
        uint32_t leaf, mask; ///< the number of its mask, or kWhole
    };

public:
    static constexpr std::size_t kBytesOfLeaf = sizeof(Part); ///< without its mask

    VoxelRegion() = default; ///< stays empty
    /// Of an object that outlives it.
    explicit VoxelRegion(const SampleLevel& object) : mObject(&object) {}

    const SampleLevel& object() const { return *mObject; }
    std::size_t size() const { return mParts.size(); } ///< leaves
    bool empty() const { return mParts.empty(); }
    RegionLeaf operator[](std::size_t i) const
    {
        const Part& part = mParts[i];
        return {part.leaf, part.mask == kWhole ? mObject->mask(part.leaf) : mMasks[part.mask]};
    }
    /// @return the place of the first part, from @a from on, of @a leaf or of one behind it.
    std::size_t find(uint32_t leaf, std::size_t from = 0) const
    {
        const auto before = [](const Part& part, uint32_t index) { return part.leaf < index; };
        const auto begin = mParts.begin() + std::ptrdiff_t(from);
        return std::size_t(std::lower_bound(begin, mParts.end(), leaf, before) - mParts.begin());
    }

    /// Gives back what more was reserved than there is.
    void shrink()
    {
        mParts.shrink_to_fit();
        mMasks.shrink_to_fit();
    }
    int64_t bytes() const
    {
        return int64_t(mParts.capacity() * sizeof(Part) + mMasks.capacity() * sizeof(LeafMask));
    }
    /// Appends the voxels of a leaf behind all others.
    /// @param mask  if it is empty, nothing is appended
    void append(uint32_t leaf, const LeafMask& mask)
    {
        if (mask.none()) return;
        const bool isWhole = mask == mObject->mask(leaf);
        mParts.push_back({leaf, isWhole ? kWhole : uint32_t(mMasks.size())});
        if (!isWhole) mMasks.push_back(mask);
    }

    class Iterator {
    public:
        Iterator(const VoxelRegion& region, std::size_t at) : mRegion(&region), mAt(at) {}
        RegionLeaf operator*() const { return (*mRegion)[mAt]; }
        Iterator& operator++()
        {
            ++mAt;
            return *this;
        }
        bool operator!=(const Iterator& other) const { return mAt != other.mAt; }

    private:
        const VoxelRegion* mRegion;
        std::size_t mAt;
    };
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size()}; }

private:
    static constexpr uint32_t kWhole = ~uint32_t(0);

    const SampleLevel* mObject = nullptr;
    std::vector<Part> mParts;
    std::vector<LeafMask> mMasks;
};

/// @return the object voxels in @a ball.
VoxelRegion regionOf(const ExactSphere& ball, const SampleLevel& object);

/// @return the object voxels in each ball.
std::vector<VoxelRegion> regionsOf(const std::vector<ExactSphere>& balls, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter);

/// @return the voxels of the region in one leaf.
const LeafMask& maskIn(const VoxelRegion& region, uint32_t leaf);

/// Calls body(leaf, maskOfA, maskOfB) for the leaves of either region, in order.
template <typename Body>
void forEachLeafOfBoth(const VoxelRegion& a, const VoxelRegion& b, const Body& body)
{
    constexpr LeafMask kNone{};
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
        const bool fromA = i < a.size() && (j == b.size() || a[i].leaf <= b[j].leaf);
        const bool fromB = j < b.size() && (i == a.size() || b[j].leaf <= a[i].leaf);
        body(fromA ? a[i].leaf : b[j].leaf, fromA ? a[i].mask : kNone, fromB ? b[j].mask : kNone);
        i += fromA;
        j += fromB;
    }
}

/// @return the voxels of a region that lie in @a ball.
VoxelRegion clipped(const VoxelRegion& region, const ExactSphere& ball, const SampleLevel& object);

VoxelRegion unionOf(const VoxelRegion& a, const VoxelRegion& b);
VoxelRegion unionOf(const std::vector<const VoxelRegion*>& regions);
VoxelRegion intersectionOf(const VoxelRegion& a, const VoxelRegion& b);
/// @return the voxels of @a a that are not in @a b.
VoxelRegion differenceOf(const VoxelRegion& a, const VoxelRegion& b);

} // namespace openvdb_spheretree::tight
