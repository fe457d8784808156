// SPDX-License-Identifier: Apache-2.0
/// One kernel serves every grid type: copy the topology into a mask, then decide every leaf and
/// tile by the grid's criterion, both in parallel. tools::sdfInteriorMask is not used for level
/// sets: it looks for the interior only near leaf nodes, and leaves out an interior root tile
/// (4096^3 voxels) and interior tiles of internal nodes that have no leaf.
/// Values that OpenVDB has left in the file are read leaf by leaf, and not kept (LeafValues.h); of
/// a grid whose active states are asked for, none are.
/// Voxels by their cubes, in place of their centers: TrilinearCover.h adds to that mask, or takes away.
#include "Object.h"

#include "LeafValues.h"
#include "MeanOrder.h"
#include "TrilinearCover.h"
#include <openvdb_spheretree/base/EmptyObject.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/voxel/GridTemplates.h> // compiles in half the time
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/NodeBytes.h>
#include <openvdb_spheretree/voxel/TopologyCopy.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/PointIndexGrid.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace openvdb_spheretree {

namespace {

constexpr const char* kCoverages[] = {"centers", "cubes", "whole"};

using detail::HalfSpace;
using detail::toText;
using openvdb::Index;
using openvdb::MaskTree;
using openvdb::points::PointDataGrid;
using openvdb::tools::PointIndexGrid;

using LeafBits = MaskTree::LeafNodeType::NodeMaskType;
using ObjectGridTypes = openvdb::NumericGridTypes::Append<openvdb::BoolGrid, openvdb::MaskGrid,
    PointIndexGrid, PointDataGrid>;

// ---- Criteria: what makes a voxel or a tile part of the object

/// Values that are in both half-spaces.
struct Range {
    HalfSpace above, below;

    template <typename ValueT>
    bool contains(ValueT value) const
    {
        return above.contains(value) && below.contains(value);
    }
};

/// Values that are one of some integers.
struct Labels {
    const std::vector<int64_t>& labels;

    template <typename ValueT>
    bool contains(ValueT value) const
    {
        return std::any_of(labels.begin(), labels.end(), [&](int64_t label) {
            // Two comparisons: a double may be next to an integer that it is not.
            if constexpr (std::is_integral_v<ValueT>) return int64_t(value) == label;
            else return double(value) == double(label) && ValueBound::of(label).rest == 0;
        });
    }
};

template <typename ValueT>
bool isNotANumber(ValueT value)
{
    return value != value;
}

/// Every value counts, active or not.
template <typename Inside>
struct ValueCriterion {
    Inside inside;
    std::atomic<int64_t>* notNumbers = nullptr; ///< counted there, unless it is null

    template <typename ValueT>
    bool tile(ValueT value, bool) const
    {
        if (notNumbers && isNotANumber(value)) ++*notNumbers;
        return inside.contains(value);
    }
    template <typename LeafT>
    void leaf(const LeafT& source, LeafBits& bits) const
    {
        const detail::LeafValues<LeafT> values(source);
        for (Index w = 0; w < LeafBits::WORD_COUNT; ++w) {
            uint64_t word = 0;
            for (Index n = 0; n < 64; ++n) {
                word |= uint64_t(inside.contains(values[64 * w + n])) << n;
            }
            bits.getWord<uint64_t>(w) = word;
        }
        if (!notNumbers) return;
        int count = 0;
        for (Index n = 0; n < LeafT::SIZE; ++n) count += isNotANumber(values[n]);
        if (count) *notNumbers += count;
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
    if (!(background > 0)) { // or NaN
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " is of the class of level sets, and its background is " << background
                << ", where those of level sets are above 0: if inside and outside have changed "
                   "places, change the sign of its values; if it is no level set, change the "
                   "grid's class");
    }
    OPENVDB_THROW(openvdb::ValueError,
        detail::describe(grid) << " is a level set whose narrow band holds "
                                  "values between "
                               << -background << " and " << background << ", so iso=" << iso
                               << " is out of range: choose an iso within the band");
}

[[noreturn]] void throwUnbounded(const openvdb::GridBase& grid, const std::string& background,
    const std::string& solid, const char* remedy)
{
    OPENVDB_THROW(openvdb::ValueError,
        detail::describe(grid) << " has the background value " << background << ", " << solid
                               << ", so its object has no bounds: " << remedy
                               << ", or give the grid the class 'level set' if it is one");
}

/// Steps from a voxel to its neighbours, and from node to node, must not wrap around. Trees of such
/// objects are refused much further from the ends.
void requireRoomAround(const openvdb::GridBase& grid, const MaskTree& mask)
{
    constexpr int kReach = 8192;
    constexpr int kFirst = std::numeric_limits<int>::min(), kLast = std::numeric_limits<int>::max();
    openvdb::CoordBBox box;
    if (!mask.evalActiveVoxelBoundingBox(box)) return;
    if (openvdb::Coord::lessThan(box.min(), openvdb::Coord(kFirst + kReach))
        || openvdb::Coord::lessThan(openvdb::Coord(kLast - kReach), box.max())) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " has an object from voxel " << box.min() << " to " << box.max()
                << ", too near the end of 32-bit coordinates: move it towards voxel [0, 0, 0], and "
                   "its transform the other way");
    }
}

// ---- Grids of numbers

/// The values that are asked for, and how messages call them: "above threshold=0".
struct Wanted {
    std::optional<HalfSpace> above, below; ///< one of them at least, where there are no labels
    const std::vector<int64_t>& labels;
    std::string text;
};

HalfSpace valuesAbove(const ValueBound& bound) { return {bound, false, false}; }
HalfSpace valuesBelow(const ValueBound& bound) { return {bound, true, false}; }

Wanted wantedOfLevelSet(const openvdb::GridBase& grid, const ObjectSettings& settings)
{
    if (settings.above || settings.below || !settings.labels.empty()) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " is a level set, of which above, below and labels say nothing: "
                   "use iso");
    }
    checkFinite(settings.iso, "iso");
    return {{}, valuesBelow(settings.iso), settings.labels, "below iso=" + toText(settings.iso)};
}

Wanted wantedOfLabels(const openvdb::GridBase& grid, const ObjectSettings& settings)
{
    if (settings.above || settings.below || settings.coverage != Coverage::Centers) {
        OPENVDB_THROW(openvdb::ValueError,
            "labels of " << detail::describe(grid)
                         << " are no range, and nothing lies between them: leave out above and "
                            "below, and let coverage be that of centers");
    }
    std::string all;
    for (const int64_t label : settings.labels) {
        all += (all.empty() ? "" : ",") + std::to_string(label);
    }
    return {{}, {}, settings.labels, "of label=" + all};
}

Wanted wantedOf(const openvdb::GridBase& grid, const ObjectSettings& settings)
{
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) return wantedOfLevelSet(grid, settings);
    if (!settings.labels.empty()) return wantedOfLabels(grid, settings);
    Wanted wanted{{}, {}, settings.labels, ""};
    if (settings.above) {
        checkFinite(settings.above->nearest, "above");
        wanted.above = valuesAbove(*settings.above);
        wanted.text = "above " + toText(*settings.above);
    }
    if (settings.below) {
        checkFinite(settings.below->nearest, "below");
        wanted.below = valuesBelow(*settings.below);
        wanted.text += (wanted.text.empty() ? "below " : " and below ") + toText(*settings.below);
    }
    if (wanted.above && wanted.below && !(*settings.above < *settings.below)) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid) << " has no value " << wanted.text << ": nothing lies between");
    }
    if (wanted.above || wanted.below) return wanted;
    checkFinite(settings.threshold, "threshold");
    wanted.above = valuesAbove(settings.threshold);
    wanted.text = "above threshold=" + toText(settings.threshold);
    return wanted;
}

/// The voxels whose center is in the solid.
template <typename GridT>
MaskTree::Ptr centersIn(const GridT& grid, const Wanted& wanted, std::atomic<int64_t>& notNumbers,
    openvdb::util::NullInterrupter* interrupter)
{
    const auto masked = [&](const auto& inside) {
        if (grid.getGridClass() != openvdb::GRID_LEVEL_SET && inside.contains(grid.background())) {
            detail::TextStream background;
            background << grid.background();
            throwUnbounded(grid, background.str(), wanted.text,
                wanted.below || !wanted.labels.empty()
                    ? "choose values without it (a file of an array or a picture may be read with "
                      "another background=)"
                    : "choose a threshold above it");
        }
        using Inside = std::decay_t<decltype(inside)>;
        return decide(grid.tree(), ValueCriterion<Inside>{inside, &notNumbers}, interrupter);
    };
    if (!wanted.labels.empty()) return masked(Labels{wanted.labels});
    if (wanted.above && wanted.below) return masked(Range{*wanted.above, *wanted.below});
    return masked(wanted.above ? *wanted.above : *wanted.below);
}

/// The voxels whose cube meets a range. The interpolation is continuous, so it takes all values from
/// its least to its largest in a cube: the cube meets the range if it meets both half-spaces. One of
/// them has bounds, and what does not meet the other is looked for in the other's complement.
template <typename GridT>
MaskTree::Ptr cubesMeeting(
    const GridT& grid, const Range& range, openvdb::util::NullInterrupter* interrupter)
{
    const bool isAboveBounded = !range.above.contains(grid.background());
    const HalfSpace bounded = isAboveBounded ? range.above : range.below;
    const HalfSpace rest = (isAboveBounded ? range.below : range.above).complement();
    const MaskTree::Ptr mask = decide(grid.tree(), ValueCriterion<HalfSpace>{bounded}, interrupter);
    openvdb::tools::pruneInactive(*mask);
    detail::addMetCubes(grid.tree(), bounded, *mask, interrupter);
    const MaskTree::Ptr missing = decide(grid.tree(), ValueCriterion<HalfSpace>{rest}, interrupter);
    openvdb::tools::pruneInactive(*missing);
    detail::keepWholeCubes(grid.tree(), rest, *missing, interrupter);
    mask->topologyDifference(*missing);
    return mask;
}

template <typename GridT>
MaskTree::Ptr valueMask(const GridT& grid, const Wanted& wanted, Coverage coverage,
    std::atomic<int64_t>& notNumbers, openvdb::util::NullInterrupter* interrupter)
{
    const MaskTree::Ptr mask = centersIn(grid, wanted, notNumbers, interrupter);
    if (coverage == Coverage::Centers) return mask;
    requireRoomAround(grid, *mask);
    if (coverage == Coverage::Cubes && wanted.above && wanted.below) {
        return cubesMeeting(grid, Range{*wanted.above, *wanted.below}, interrupter);
    }
    openvdb::tools::pruneInactive(*mask);
    for (const auto& side : {wanted.above, wanted.below}) {
        if (!side) continue;
        if (coverage == Coverage::Cubes) {
            detail::addMetCubes(grid.tree(), *side, *mask, interrupter);
        } else {
            detail::keepWholeCubes(grid.tree(), *side, *mask, interrupter);
        }
    }
    return mask;
}

/// Finds the criterion by the grid's type; `criterion` is its name for messages.
struct MaskOfGrid {
    const ObjectSettings& settings;
    openvdb::util::NullInterrupter* interrupter;
    MaskTree::Ptr mask;
    std::string criterion;
    bool isInterpolated = false; ///< between centers
    std::atomic<int64_t> notNumbers = 0;

    template <typename GridT>
    void operator()(const GridT& grid)
    {
        const Wanted wanted = wantedOf(grid, settings);
        if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
            checkIso(grid, settings.iso, double(grid.background()));
        }
        const bool isWhole = settings.coverage == Coverage::Whole;
        criterion = (isWhole ? "no voxel whose whole cube is " : "no value ") + wanted.text;
        mask = valueMask(grid, wanted, settings.coverage, notNumbers, interrupter);
        isInterpolated = wanted.labels.empty();
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

void setCoverage(openvdb::BoolGrid& object, Coverage coverage)
{
    object.insertMeta(kCoverageKey, openvdb::StringMetadata(kCoverages[int(coverage)]));
}

std::optional<Coverage> coverageOf(const openvdb::GridBase& grid)
{
    const auto text = grid.getMetadata<openvdb::StringMetadata>(kCoverageKey);
    for (int i = 0; text && i < 3; ++i) {
        if (text->value() == kCoverages[i]) return Coverage(i);
    }
    return std::nullopt;
}

bool isObjectGrid(const openvdb::GridBase& grid)
{
    return grid.apply<ObjectGridTypes>([](const auto&) {});
}

openvdb::BoolGrid::Ptr objectOf(const openvdb::GridBase& grid, const ObjectSettings& settings,
    openvdb::util::NullInterrupter* interrupter, int64_t* notNumbers)
{
    if (!isObjectGrid(grid)) {
        OPENVDB_THROW(openvdb::TypeError,
            detail::describe(grid) << " is of type '" << grid.type()
                                   << "', which bounds no object: give a bool, mask, float, "
                                      "double, int or point grid");
    }
    requireUniformVoxels(grid);

    MaskOfGrid op{settings, interrupter, {}, {}, {}, {}};
    grid.apply<ObjectGridTypes>(op);
    if (notNumbers) *notNumbers = op.notNumbers;
    openvdb::tools::pruneInactive(*op.mask);
    if (op.mask->empty()) {
        const std::string nan = op.notNumbers > 0
            ? ", and of its values " + std::to_string(op.notNumbers) + " are no numbers (NaN)"
            : "";
        OPENVDB_THROW(EmptyObject,
            detail::describe(grid) << " holds no object: it has " << op.criterion << nan);
    }

    openvdb::BoolGrid::Ptr object =
        openvdb::BoolGrid::create(detail::copyTopology<openvdb::BoolTree>(*op.mask, interrupter));
    object->setName(grid.getName());
    object->setTransform(grid.transform().copy());
    const auto coverage =
        op.isInterpolated ? std::optional<Coverage>(settings.coverage) : coverageOf(grid);
    if (coverage) setCoverage(*object, *coverage);
    return object;
}

} // namespace openvdb_spheretree
