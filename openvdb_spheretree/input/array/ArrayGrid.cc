// SPDX-License-Identifier: Apache-2.0
#include "ArrayGrid.h"

#include "NumberDecoder.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;
using openvdb::GridBase;
using openvdb::IoError;

constexpr uint64_t kSide = kLeafDim; // as wide as what it is compared with

bool anyBit(const uint8_t* bytes, std::size_t count)
{
    uint64_t any = 0;
    for (; count >= 8; bytes += 8, count -= 8) {
        uint64_t word;
        std::memcpy(&word, bytes, 8);
        any |= word;
    }
    uint64_t rest = 0;
    std::memcpy(&rest, bytes, count);
    return (any | rest) != 0;
}

/// Up to eight slices as leaves. Fast, middle and slow are the axes of the layout, in that order.
template <typename TreeT>
class SlabToLeaves {
public:
    using Leaf = typename TreeT::LeafNodeType;
    using Value = typename TreeT::ValueType;

    SlabToLeaves(const ArrayLayout& layout, Value background, bool tiles)
        : mLayout(layout), mDecode(layout, background), mBackground(background), mTiles(tiles),
          mZerosAreEmpty(background == Value(0) && layout.intercept == 0),
          mFast(layout.dim[layout.order[0]]), mMiddle(layout.dim[layout.order[1]])
    {}

    /// Leaves are built in parallel, a row of leaves a task, and added in a fixed order.
    /// @param slab   the bytes of the slices
    /// @param start  of the first one, along the slow axis
    void addTo(TreeT& tree, const uint8_t* slab, uint64_t start) const
    {
        std::vector<std::vector<Built>> rows((mMiddle + kSide - 1) / kSide);
        parallelFor(rows.size(), nullptr, [&](std::size_t row) {
            for (uint64_t fast = 0; fast < mFast; fast += kSide) {
                Built built = build(slab, {fast, row * kSide, start});
                if (built.leaf || built.isTile) rows[row].push_back(std::move(built));
            }
        });
        openvdb::tree::ValueAccessor<TreeT> accessor(tree);
        for (auto& row : rows) {
            for (Built& built : row) {
                if (built.isTile) accessor.addTile(1, built.origin, built.value, true);
                else accessor.addLeaf(built.leaf.release());
            }
        }
    }

    /// @return how many numbers so far were NaN.
    int64_t notNumbers() const { return mNotNumbers; }

private:
    struct Built {
        Coord origin;
        std::unique_ptr<Leaf> leaf; ///< null for a tile, and where all is background
        bool isTile = false;
        Value value = {};
    };

    /// The values of a leaf, in the order of a leaf.
    struct Values {
        std::array<Value, kLeafVoxels> of;
        bool any = false; ///< that is not the background
    };

    /// @param at  of the leaf's first voxel along fast, middle, slow
    Built build(const uint8_t* slab, const std::array<uint64_t, 3>& at) const
    {
        Built built;
        for (int i = 0; i < 3; ++i) built.origin[mLayout.order[i]] = int(at[i]);
        Values values;
        std::array<uint64_t, 3> count;
        for (int i = 0; i < 3; ++i) {
            count[i] = std::min(kSide, mLayout.dim[mLayout.order[i]] - at[i]);
        }
        gather(slab, at, count, values);
        if (!values.any) return built;
        built.value =
            values.of[0]; // beyond the array it is the background, so no tile reaches there
        built.isTile = mTiles
            && std::all_of(values.of.begin(), values.of.end(),
                [&](const Value& value) { return value == built.value; });
        if (!built.isTile) built.leaf = leafOf(built.origin, values);
        return built;
    }

    void gather(const uint8_t* slab, const std::array<uint64_t, 3>& at,
        const std::array<uint64_t, 3>& count, Values& values) const
    {
        constexpr std::array<int, 3> kSteps = {64, 8, 1}; // of x, y, z in a leaf
        const auto step = [&](int i) { return kSteps[mLayout.order[i]]; };
        const auto bytes = uint64_t(bytesOf(mLayout.type));
        std::array<Value, kLeafDim> row;
        for (uint64_t slow = 0; slow < count[2]; ++slow) {
            for (uint64_t middle = 0; middle < count[1]; ++middle) {
                const uint64_t place = (slow * mMiddle + at[1] + middle) * mFast + at[0];
                const uint8_t* in = slab + place * bytes;
                if (mZerosAreEmpty && !anyBit(in, count[0] * bytes)) continue;
                const std::size_t nans = mDecode(in, count[0], row.data());
                if (nans > 0) mNotNumbers += int64_t(nans);
                for (uint64_t fast = 0; fast < count[0]; ++fast) {
                    if (row[fast] == mBackground) continue;
                    if (!values.any) values.of.fill(mBackground);
                    values.any = true;
                    values.of[int(slow) * step(2) + int(middle) * step(1) + int(fast) * step(0)] =
                        row[fast];
                }
            }
        }
    }

    std::unique_ptr<Leaf> leafOf(const Coord& origin, const Values& values) const
    {
        auto leaf = std::make_unique<Leaf>(origin, mBackground);
        for (openvdb::Index n = 0; n < kLeafVoxels; ++n) {
            if (values.of[n] != mBackground) leaf->setValueOn(n, values.of[n]);
        }
        return leaf;
    }

    const ArrayLayout& mLayout;
    const NumberDecoder<Value> mDecode;
    const Value mBackground;
    const bool mTiles, mZerosAreEmpty;
    const uint64_t mFast, mMiddle;
    mutable std::atomic<int64_t> mNotNumbers{0};
};

template <typename Value>
Value backgroundOf(double wanted, const ArrayLayout& layout)
{
    using Limits = std::numeric_limits<Value>;
    constexpr double kLowest = double(Limits::lowest()), kLargest = double(Limits::max());
    const bool fits = Limits::is_integer ? wanted >= kLowest && wanted < kLargest + 1
                                         : wanted >= kLowest && wanted <= kLargest;
    if (fits) { // as an integer exactly, as a float the nearest one
        const auto background = static_cast<Value>(wanted);
        if (!Limits::is_integer || double(background) == wanted) return background;
    }
    throw IoError(
        "background=" + shortNumber(wanted) + " is no value of its type, " + toString(layout.type));
}

template <typename GridT>
GridBase::Ptr readGrid(ByteSource& source, const ArrayLayout& layout,
    const ArrayGridSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    using Tree = typename GridT::TreeType;
    using Value = typename Tree::ValueType;
    const auto background = backgroundOf<Value>(settings.background, layout);
    const SlabToLeaves<Tree> leaves(layout, background, settings.tiles);
    auto grid = makeGrid<GridT>();
    grid->tree().root().setBackground(background, /*updateChildNodes=*/false);

    const uint64_t slices = layout.dim[layout.slow()];
    const uint64_t slabBytes = layout.sliceBytes() * std::min(kSide, slices);
    requireMemory(double(slabBytes) * (slices > kSide ? 2 : 1), "its slices", "make them smaller");
    // Not value-initialised: pages are first touched by what the file really holds.
    std::unique_ptr<uint8_t[]> slab(new uint8_t[slabBytes]);
    std::unique_ptr<uint8_t[]> next(new uint8_t[slices > kSide ? slabBytes : 0]);
    const auto readSlab = [&](uint8_t* out, uint64_t at) {
        if (at < slices) source.read(out, layout.sliceBytes() * std::min(kSide, slices - at));
    };
    const Stage stage("Reading volume", interrupter, nullptr);
    readSlab(slab.get(), 0);
    for (uint64_t at = 0; at < slices; at += kSide) {
        checkInterrupt(interrupter, int(100 * at / slices));
        tbb::parallel_invoke([&] { readSlab(next.get(), at + kSide); },
            [&] { leaves.addTo(grid->tree(), slab.get(), at); });
        slab.swap(next);
    }
    source.finish();
    if (leaves.notNumbers() > 0)
        grid->insertMeta(kNotNumbersMeta, openvdb::Int64Metadata(leaves.notNumbers()));
    return grid;
}

} // namespace

GridBase::Ptr gridOf(ByteSource& source, const ArrayLayout& layout,
    const ArrayGridSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    if (layout.isScaled())
        return readGrid<openvdb::FloatGrid>(source, layout, settings, interrupter);
    switch (layout.type) {
    case NumberType::Bool:
        return readGrid<openvdb::BoolGrid>(source, layout, settings, interrupter);
    case NumberType::UInt32:
    case NumberType::Int64:
    case NumberType::UInt64:
        return readGrid<openvdb::Int64Grid>(source, layout, settings, interrupter);
    case NumberType::Float16:
    case NumberType::Float32:
        return readGrid<openvdb::FloatGrid>(source, layout, settings, interrupter);
    case NumberType::Float64:
        return readGrid<openvdb::DoubleGrid>(source, layout, settings, interrupter);
    default: return readGrid<openvdb::Int32Grid>(source, layout, settings, interrupter);
    }
}

} // namespace openvdb_spheretree::detail
