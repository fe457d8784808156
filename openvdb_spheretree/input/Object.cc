// SPDX-License-Identifier: Apache-2.0
/// One kernel serves every grid type: copy the topology into a mask, then decide every leaf and
/// tile by the grid's criterion, both in parallel. tools::sdfInteriorMask is not used for level
/// sets: it looks for the interior only near leaf nodes, and leaves out an interior root tile
/// (4096^3 voxels) and interior tiles of internal nodes that have no leaf.
/// Values that OpenVDB has left in the file are read leaf by leaf, and not kept (LeafValues.h); of
/// a grid whose active states are asked for, none are.
#include "Object.h"

#include "LeafValues.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/NodeBytes.h>
#include <openvdb_spheretree/voxel/TopologyCopy.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/PointIndexGrid.h>
#include <openvdb/tools/Prune.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::Index;
using openvdb::MaskTree;
using openvdb::points::PointDataGrid;
using openvdb::tools::PointIndexGrid;

using LeafBits = MaskTree::LeafNodeType::NodeMaskType;
using ObjectGridTypes = openvdb::NumericGridTypes::Append<openvdb::BoolGrid, openvdb::MaskGrid,
    PointIndexGrid, PointDataGrid>;

// ---- Criteria: what makes a voxel or a tile part of the object

/// value > bound, or value < bound; floats are compared as doubles, which is exact. NaN is outside.
template <typename ValueT, typename = void>
class Beyond {
public:
    static Beyond above(double bound) { return {bound, false}; }
    static Beyond below(double bound) { return {bound, true}; }
    bool operator()(ValueT value) const
    {
        return mBelow ? double(value) < mBound : double(value) > mBound;
    }

private:
    Beyond(double bound, bool below) : mBound(bound), mBelow(below) {}
    double mBound;
    bool mBelow;
};

/// The same for integers, whose values a double may not hold: the bound is turned into an integer
/// instead. value > bound is value > floor(bound), value < bound is value < ceil(bound).
template <typename ValueT>
class Beyond<ValueT, std::enable_if_t<std::is_integral<ValueT>::value>> {
public:
    static Beyond above(double bound) { return {std::floor(bound), false}; }
    static Beyond below(double bound) { return {std::ceil(bound), true}; }
    bool operator()(ValueT value) const
    {
        if (mConstant) return mAnswer;
        return mBelow ? value < mBound : value > mBound;
    }

private:
    Beyond(double bound, bool below) : mBelow(below)
    {
        // Both limits are powers of two (up to sign), so doubles hold them.
        const double lowest = double(std::numeric_limits<ValueT>::lowest());
        const bool tooLow = bound < lowest, tooHigh = bound >= -lowest;
        mConstant = tooLow || tooHigh;
        mAnswer = below ? tooHigh : tooLow;
        if (!mConstant) mBound = ValueT(bound);
    }
    ValueT mBound = 0;
    bool mBelow, mConstant, mAnswer;
};

/// Every value counts, active or not.
template <typename ValueT>
struct ValueCriterion {
    Beyond<ValueT> inside;

    bool tile(ValueT value, bool) const { return inside(value); }
    template <typename LeafT>
    void leaf(const LeafT& source, LeafBits& bits) const
    {
        const detail::LeafValues<LeafT> values(source);
        for (Index w = 0; w < LeafBits::WORD_COUNT; ++w) {
            uint64_t word = 0;
            for (Index n = 0; n < 64; ++n) word |= uint64_t(inside(values[64 * w + n])) << n;
            bits.getWord<uint64_t>(w) = word;
        }
    }
};

struct ActiveCriterion {
    template <typename ValueT>
    bool tile(const ValueT&, bool active) const
    {
        return active;
    }
    template <typename LeafT>
    void leaf(const LeafT& source, LeafBits& bits) const
    {
        bits = source.getValueMask();
    }
};

struct ActiveAndTrueCriterion {
    bool tile(bool value, bool active) const { return active && value; }
    template <typename LeafT>
    void leaf(const LeafT& source, LeafBits& bits) const
    {
        for (Index n = 0; n < LeafT::SIZE; ++n) {
            bits.set(n, source.isValueOn(n) && source.getValue(n));
        }
    }
};

/// A point leaf stores where each voxel's points end in its arrays; tiles hold no points.
struct HoldsPointCriterion {
    template <typename ValueT>
    bool tile(const ValueT&, bool) const
    {
        return false;
    }
    template <typename LeafT>
    void leaf(const LeafT& source, LeafBits& bits) const
    {
        const detail::LeafValues<LeafT> ends(source);
        uint64_t begin = 0;
        for (Index n = 0; n < LeafT::SIZE; ++n) {
            const uint64_t end = uint32_t(ends[n]);
            bits.set(n, source.isValueOn(n) && end > begin);
            begin = end;
        }
    }
};

// ---- The kernel

/// Nodes of two trees of one topology, pairwise in the same order.
template <typename SourceNodeT, typename MaskNodeT, typename SourceTreeT, typename Body>
void forEachNodePair(const SourceTreeT& source, MaskTree& mask,
    openvdb::util::NullInterrupter* interrupter, const Body& body)
{
    std::vector<const SourceNodeT*> from;
    std::vector<MaskNodeT*> to;
    source.getNodes(from);
    mask.getNodes(to);
    detail::parallelFor(from.size(), interrupter, [&](std::size_t i) { body(*from[i], *to[i]); });
}

template <typename SourceNodeT, typename MaskNodeT, typename Criterion>
void decideTiles(const SourceNodeT& source, MaskNodeT& mask, const Criterion& criterion)
{
    auto to = mask.beginValueAll();
    for (auto from = source.cbeginValueAll(); from; ++from, ++to) {
        const bool inside = criterion.tile(*from, from.isValueOn());
        to.setValue(inside);
        to.setValueOn(inside);
    }
}

/// Nodes take memory whatever they hold: a voxel alone in its 4096^3 takes 300 KB.
template <typename SourceTreeT>
void requireRoomForNodes(const SourceTreeT& source)
{
    const double bytes = detail::nodeBytes(source);
    detail::requireMemory(double(source.memUsage()) + 2 * bytes, // the mask and the object
        "the voxels of the object lie so far apart that its "
            + std::to_string(source.nonLeafCount() + source.leafCount()) + " nodes",
        detail::kNodeRemedy);
}

template <typename SourceTreeT, typename Criterion>
MaskTree::Ptr decide(const SourceTreeT& source, const Criterion& criterion,
    openvdb::util::NullInterrupter* interrupter)
{
    using SourceNodes = typename SourceTreeT::RootNodeType::NodeChainType;
    using MaskNodes = MaskTree::RootNodeType::NodeChainType;
    using SourceLower = typename SourceNodes::template Get<1>;
    using SourceUpper = typename SourceNodes::template Get<2>;
    using MaskLower = MaskNodes::Get<1>;
    using MaskUpper = MaskNodes::Get<2>;

    requireRoomForNodes(source);
    const auto mask = detail::copyTopology<MaskTree>(source, interrupter);
    forEachNodePair<typename SourceTreeT::LeafNodeType, MaskTree::LeafNodeType>(
        source, *mask, interrupter, [&](const auto& from, auto& to) {
            LeafBits bits;
            criterion.leaf(from, bits);
            to.setValueMask(bits);
        });
    const auto tiles = [&](const auto& from, auto& to) { decideTiles(from, to, criterion); };
    forEachNodePair<SourceLower, MaskLower>(source, *mask, interrupter, tiles);
    forEachNodePair<SourceUpper, MaskUpper>(source, *mask, interrupter, tiles);
    decideTiles(source.root(), mask->root(), criterion);
    return mask;
}

// ---- What is asked of a grid before its voxels are looked at

void checkFinite(double value, const char* name)
{
    if (std::isfinite(value)) return;
    OPENVDB_THROW(openvdb::ValueError, name << "=" << value << " is not a finite number");
}

/// Beyond the narrow band a level set has only its background, which says nothing of distance.
void checkIso(const openvdb::GridBase& grid, double iso, double background)
{
    if (iso < background && iso > -background) return;
    OPENVDB_THROW(openvdb::ValueError,
        detail::describe(grid) << " is a level set whose narrow band holds "
                                  "values between "
                               << -background << " and " << background << ", so iso=" << iso
                               << " is out of range: choose an iso within the band"
                               << (background > 0
                                          ? ""
                                          : ", or change the grid's class if it is no level set"));
}

template <typename GridT>
MaskTree::Ptr valueMask(
    const GridT& grid, const ObjectSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    using Test = Beyond<typename GridT::ValueType>;
    using Criterion = ValueCriterion<typename GridT::ValueType>;
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
        checkFinite(settings.iso, "iso");
        checkIso(grid, settings.iso, double(grid.background()));
        return decide(grid.tree(), Criterion{Test::below(settings.iso)}, interrupter);
    }
    checkFinite(settings.threshold, "threshold");
    const Test inside = Test::above(settings.threshold);
    if (inside(grid.background())) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid) << " has the background value " << grid.background()
                                   << ", above threshold=" << settings.threshold
                                   << ", so its object "
                                      "has no bounds: choose a threshold above it"
                                      ", or give the grid the class 'level set' if it is one");
    }
    return decide(grid.tree(), Criterion{inside}, interrupter);
}

/// Finds the criterion by the grid's type; `criterion` is its name for messages.
struct MaskOfGrid {
    const ObjectSettings& settings;
    openvdb::util::NullInterrupter* interrupter;
    MaskTree::Ptr mask;
    std::string criterion;

    template <typename GridT>
    void operator()(const GridT& grid)
    {
        std::ostringstream text;
        if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
            text << "no value below iso=" << settings.iso;
        } else {
            text << "no value above threshold=" << settings.threshold;
        }
        criterion = text.str();
        mask = valueMask(grid, settings, interrupter);
    }
    void operator()(const openvdb::MaskGrid& grid)
    {
        criterion = "no active voxel";
        mask = decide(grid.tree(), ActiveCriterion(), interrupter);
    }
    void operator()(const openvdb::BoolGrid& grid)
    {
        criterion = settings.values ? "no active voxel of value true" : "no active voxel";
        mask = settings.values ? decide(grid.tree(), ActiveAndTrueCriterion(), interrupter)
                               : decide(grid.tree(), ActiveCriterion(), interrupter);
    }
    void operator()(const PointIndexGrid& grid) { pointMask(grid); }
    void operator()(const PointDataGrid& grid) { pointMask(grid); }

private:
    template <typename GridT>
    void pointMask(const GridT& grid)
    {
        criterion = "no active voxel that holds a point";
        mask = decide(grid.tree(), HoldsPointCriterion(), interrupter);
    }
};

} // namespace

bool isObjectGrid(const openvdb::GridBase& grid)
{
    return grid.apply<ObjectGridTypes>([](const auto&) {});
}

openvdb::BoolGrid::Ptr objectOf(const openvdb::GridBase& grid, const ObjectSettings& settings,
    openvdb::util::NullInterrupter* interrupter)
{
    if (!isObjectGrid(grid)) {
        OPENVDB_THROW(openvdb::TypeError,
            detail::describe(grid) << " is of type '" << grid.type()
                                   << "', which bounds no object: give a bool, mask, float, "
                                      "double, int or point grid");
    }
    requireUniformVoxels(grid);

    MaskOfGrid op{settings, interrupter, {}, {}};
    grid.apply<ObjectGridTypes>(op);
    openvdb::tools::pruneInactive(*op.mask);
    if (op.mask->empty()) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid) << " holds no object: it has " << op.criterion);
    }

    openvdb::BoolGrid::Ptr object =
        openvdb::BoolGrid::create(detail::copyTopology<openvdb::BoolTree>(*op.mask, interrupter));
    object->setName(grid.getName());
    object->setTransform(grid.transform().copy());
    return object;
}

} // namespace openvdb_spheretree
