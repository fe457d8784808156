// SPDX-License-Identifier: Apache-2.0
/// @file PointLeaves.h
/// @brief Points into the leaves of a PointDataGrid, and out of them, without rounding a position.
///
/// OpenVDB's createPointDataGrid() takes world positions: index -> world -> index rounds. Here
/// positions are in index space, multiples of 1/1024 of the source's voxel or coarser. A voxel of the point grid
/// is `scale` of these wide, a power of two. So position / scale = voxel + offset, and a float
/// holds the offset.
///
/// Points are ordered by leaf, voxel and input index, so the grid does not depend on threads.

#pragma once

#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointDataGrid.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// Offsets are multiples of 1 / (1024 scale), at most 1/2 in size: 22 bits, where a float has 24.
constexpr int kMaxPointScale = 4096;

using PointLeaf = openvdb::points::PointDataTree::LeafNodeType;

/// The values of an array of type T and without a codec, in half the time of an AttributeHandle's.
template <typename T>
class ArrayValues {
public:
    explicit ArrayValues(const openvdb::points::AttributeArray& array)
    {
        array.loadData(); // which may still be in a file
        mIsUniform = array.isUniform();
        mValues = reinterpret_cast<const T*>(array.constDataAsByteArray());
    }
    const T& operator[](std::size_t i) const { return mValues[mIsUniform ? 0 : i]; }

private:
    bool mIsUniform;
    const T* mValues;
};

/// A point grid under construction; points know the index they came in with.
class PointWriter {
public:
    /// @param positions    index space of the source grid
    /// @param interrupter  may be null, and outlives the writer; each call may throw Interrupted
    /// @throw openvdb::ValueError if a position cannot be stored exactly
    PointWriter(
        const std::vector<openvdb::Vec3d>& positions, openvdb::util::NullInterrupter* interrupter);

    /// Source voxels along a voxel of the point grid: the smallest power of two for which a voxel
    /// holds four points on average, or kMaxPointScale.
    int scale() const { return mScale; }

    /// Adds an attribute whose value is value(i) for the point that came in with index i.
    template <typename T, typename Value>
    void addAttribute(const std::string& name, const Value& value)
    {
        openvdb::points::appendAttribute<T>(mGrid->tree(), name);
        parallelFor(mLeaves.size(), mInterrupter, [&](std::size_t i) {
            openvdb::points::AttributeWriteHandle<T> handle(mLeaves[i]->attributeArray(name));
            const uint32_t begin = mBegin[i];
            for (uint32_t n = 0; n < countOf(i); ++n) handle.set(n, T(value(mOrder[begin + n])));
            handle.compact();
        });
    }

    /// Adds the groups, and puts point i in the group that has index groupOf(i).
    void addGroups(
        const std::vector<std::string>& names, const std::function<int(uint32_t)>& groupOf);

    /// The grid, its transform that of the source, scaled.
    openvdb::points::PointDataGrid::Ptr finish(const openvdb::math::Transform& source) const;

private:
    struct Place {
        openvdb::Coord voxel;
        uint32_t point;
    };
    std::vector<Place> places(const std::vector<openvdb::Vec3d>& positions) const;
    void writeLeaf(std::size_t leaf, const std::vector<Place>& places,
        const std::vector<openvdb::Vec3d>& positions);
    uint32_t countOf(std::size_t leaf) const { return mBegin[leaf + 1] - mBegin[leaf]; }

    openvdb::util::NullInterrupter* mInterrupter;
    int mScale = 1;
    openvdb::points::PointDataGrid::Ptr mGrid;
    std::vector<PointLeaf*> mLeaves;
    std::vector<uint32_t> mBegin; ///< leaf i holds the points mOrder[mBegin[i]...mBegin[i + 1])
    std::vector<uint32_t> mOrder; ///< input indices
};

/// The points of a grid as flat arrays, in an order of its own that all of them share.
class PointReader {
public:
    /// @param interrupter  may be null, and outlives the reader; each call may throw Interrupted
    /// @throw openvdb::ValueError if the leaves contradict themselves
    PointReader(
        const openvdb::points::PointDataGrid& grid, openvdb::util::NullInterrupter* interrupter);

    std::size_t size() const { return mBegin.back(); }

    /// @throw openvdb::ValueError if there is no such attribute, or it is not an uncompressed T
    template <typename T>
    std::vector<T> attribute(const std::string& name) const
    {
        requireAttribute<T>(name);
        std::vector<T> values(size());
        parallelFor(mLeaves.size(), mInterrupter, [&](std::size_t i) {
            const ArrayValues<T> here(*mLeaves[i]->attributeSet().getConst(name));
            const std::size_t begin = mBegin[i], count = mBegin[i + 1] - begin;
            for (std::size_t n = 0; n < count; ++n) values[begin + n] = here[n];
        });
        return values;
    }

    /// @return positions in the index space of the source grid.
    std::vector<openvdb::Vec3d> positions(int scale) const;

    /// @return the first point that is not where it should be, or size(): point i at
    ///         places[indices[i]].
    std::size_t firstAstray(int scale, const std::vector<openvdb::Vec3d>& places,
        const std::vector<int32_t>& indices) const;

    /// @brief Requires that each point is in one of these groups, and in no other of them.
    /// @param groups  index of the group of each point
    /// @throw openvdb::IoError if one is not, or a group is missing
    void requireGroups(
        const std::vector<std::string>& names, const std::vector<int32_t>& groups) const;

private:
    template <typename T>
    void requireAttribute(const std::string& name) const
    {
        const openvdb::NamePair& expected =
            openvdb::points::TypedAttributeArray<T>::attributeType();
        for (const PointLeaf* leaf : mLeaves) {
            const openvdb::points::AttributeArray* array = leaf->attributeSet().getConst(name);
            if (!array) {
                OPENVDB_THROW(openvdb::ValueError, "there is no attribute '" << name << "'");
            }
            const openvdb::NamePair& type = array->type();
            if (type == expected && array->stride() == 1) continue;
            OPENVDB_THROW(openvdb::ValueError,
                "attribute '" << name << "' is of type " << type.first << "/" << type.second
                              << " with " << array->stride() << " values a point, not "
                              << expected.first << "/" << expected.second << " with 1");
        }
    }

    /// Calls body(point, position) for the points of a leaf, whose attribute P has been required.
    template <typename Body>
    void forPositions(std::size_t leaf, int scale, const Body& body) const;

    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<const PointLeaf*> mLeaves;
    std::vector<std::size_t> mBegin; ///< of each leaf's points in the arrays
};

} // namespace openvdb_spheretree::detail
