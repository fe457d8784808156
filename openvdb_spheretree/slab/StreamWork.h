// SPDX-License-Identifier: Apache-2.0
/// @file StreamWork.h
/// @brief The work on slabs and columns that both streams share, and its results.

#pragma once

#include "ColumnPower.h"
#include "LabelQueries.h"
#include "LabelStream.h"
#include "SlabBalls.h"
#include "SlabDistance.h"
#include "SlabLabels.h"
#include "SlabPower.h"
#include "XGaps.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace openvdb_spheretree::slab {

/// Memory of one thread for slabs that enter, one after the other, and the time that they took.
template <typename Power, typename T>
struct SlabEntry {
    SlabDistance<T> distance;
    SlabPower<Power> power;
    double seconds = 0, powerSeconds = 0; ///< in all, and in the passes of power labels
};

/// @tparam Power  of MaxPlus.h
/// @tparam T      of squared distances
template <typename Power, typename T>
class StreamWork {
public:
    using Key = typename Power::Key;
    using Entry = SlabEntry<Power, T>;

    StreamWork(const LeafLayout& layoutOfLevel, int dimension, std::vector<VoxelRef>* queried,
        const KeptOffsets<Power>& keptOffsets, openvdb::util::NullInterrupter* stop)
        : layout(layoutOfLevel), dim(dimension), kept(keptOffsets), interrupter(stop),
          mQueries(layout, queried), mGaps(std::make_unique<Gaps>(layout, stop)),
          mRadii(layout.slabCount())
    {
        mResult.centers.resize(layout.leafCount());
        for (uint32_t i = 0; i < layout.runCount(Axis::X); ++i) {
            mFirstSlab.push_back(layout.slabOf(layout.run(Axis::X, i).leaves[0]));
        }
    }

    /// How a slab enters: its distances, and the passes of the power labels within it.
    /// @param labels  receives keys, and offsets along y and z
    /// @return the largest squared distance.
    uint32_t enter(uint32_t slab, const SlabLabels<Power>& labels, Entry& entry) const
    {
        const detail::Stage all("", nullptr, &entry.seconds);
        SlabPower<Power>& power = entry.power;
        uint32_t largest = 0;
        power.open(layout, slab, dim);
        entry.distance.forEachRun(
            layout, slab, *mGaps, dim, [&](const LeafLayout::Run& run, const T* rows) {
                const detail::Stage stage("", nullptr, &entry.powerSeconds);
                largest = std::max(largest,
                    dim == 3 ? power.alongZ(run, rows, labels) : power.fromY(run, rows, labels));
            });
        const detail::Stage stage("", nullptr, &entry.powerSeconds);
        if (dim == 3) power.alongY(layout, slab, labels);
        return largest;
    }
    /// Frees what only enter() needs.
    void allEntered() { mGaps.reset(); }

    /// Finds the labels of a column along x, and moves its queries.
    void labelColumn(ColumnPower<Power>& power)
    {
        power.run(layout, mResult.centers.data(), [&](uint32_t leaf, const auto* offsets) {
            constexpr std::size_t kBytes = kLeafVoxels * sizeof(*offsets);
            if (kept[0]) std::memcpy(kept[0] + std::size_t(leaf) * kLeafVoxels, offsets, kBytes);
            mQueries.moveAlongX(leaf, offsets);
        });
    }

    /// Finds the balls of a slab, and moves its queries. All labels that lead to it must be known.
    void finish(uint32_t slab, const SlabLabels<Power>& labels, SlabBalls<Power>& balls)
    {
        mQueries.moveToCenters(slab, labels);
        LeafMask* centers = mResult.centers.data() + layout.slab(slab).begin;
        mRadii[slab] = balls.collect(layout, slab, labels, centers);
    }

    /// @return the balls of all slabs: one list in the order of slabs.
    LevelBalls collected()
    {
        const auto placeBalls = [&] {
            std::vector<std::size_t> first{0}; // of each slab
            for (const Radii& radii : mRadii) first.push_back(first.back() + radii.size());
            detail::resizeLarge(mResult.balls, first.back());
            detail::parallelFor(mRadii.size(), interrupter, [&](std::size_t i) {
                const auto slab = uint32_t(i);
                const Radii radii = std::move(mRadii[slab]);
                const LeafMask* centers = mResult.centers.data() + layout.slab(slab).begin;
                MedialBall* balls = mResult.balls.data() + first[slab];
                assert(radii.size() == detail::countMarks(centers, layout.slab(slab).size()));
                detail::visitWithPlaces(
                    layout, slab, centers, [&](uint32_t leaf, uint32_t index, std::size_t place) {
                        balls[place] = {layout.voxel(leaf, index), int32_t(radii[place])};
                    });
            });
        };
        detail::timed("medial balls", interrupter, &mResult.seconds.medial, placeBalls);
        return std::move(mResult);
    }

    /// @return whether a label leads to a leaf along x.
    bool hasMarks(uint32_t leaf) const { return !mResult.centers[leaf].none(); }
    /// @return the slab of the first leaf of a run along x.
    uint32_t firstSlab(uint32_t run) const { return mFirstSlab[run]; }
    StageSeconds& seconds() { return mResult.seconds; }

    /// Distances and power labels are made in turns. They share the time that @a passed, in
    /// proportion to what the threads measured.
    template <typename Entries>
    void share(double passed, Entries& entries)
    {
        double all = 0, power = 0;
        for (Entry& entry : entries) {
            all += std::exchange(entry.seconds, 0);
            power += std::exchange(entry.powerSeconds, 0);
        }
        const double part = all > 0 ? passed * power / all : 0;
        mResult.seconds.power += part;
        mResult.seconds.distance += passed - part;
    }

    const LeafLayout& layout;
    const int dim;
    const KeptOffsets<Power> kept;
    openvdb::util::NullInterrupter* const interrupter;

private:
    using Gaps = XGaps<GapOf<T>>;
    using Radii = std::vector<typename SlabBalls<Power>::RadiusSq>;

    LabelQueries mQueries;
    std::unique_ptr<Gaps> mGaps;
    std::vector<uint32_t> mFirstSlab; ///< of each run along x
    std::vector<Radii> mRadii;        ///< of the balls of each slab, whose centers are in mResult
    LevelBalls mResult; ///< its centers are targets along x until the slab is finished
};

} // namespace openvdb_spheretree::slab
