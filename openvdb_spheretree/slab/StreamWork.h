// SPDX-License-Identifier: Apache-2.0
/// @file StreamWork.h
/// @brief What is done to slabs and columns, whichever way they are kept in between.

#pragma once

#include "ColumnPower.h"
#include "LabelQueries.h"
#include "LevelBalls.h"
#include "SlabBalls.h"
#include "SlabEntry.h"
#include "SlabLabels.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>

#include <cassert>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// @tparam Power  of detail/MaxPlus.h
/// @tparam T      of squared distances
template <typename Power, typename T>
class StreamWork {
public:
    using Key = typename Power::Key;
    using Entry = SlabEntry<Power, T>;

    StreamWork(const LeafLayout& layoutOfLevel, int dimension, std::vector<VoxelRef>* asked,
        const KeptSteps<Power>& steps, openvdb::util::NullInterrupter* stop)
        : layout(layoutOfLevel), dim(dimension), kept(steps), interrupter(stop),
          mQuestions(layout, asked), mSteps(std::make_unique<Steps>(layout, stop)),
          mRadii(layout.slabCount())
    {
        mResult.centers.resize(layout.leafCount());
        for (uint32_t i = 0; i < layout.runCount(Axis::X); ++i) {
            mFirstSlab.push_back(layout.slabOf(layout.run(Axis::X, i).leaves[0]));
        }
    }

    /// @return the slab's largest squared distance.
    uint32_t enter(uint32_t slab, const SlabLabels<Power>& labels, Entry& entry) const
    {
        return entry.enter(layout, slab, *mSteps, dim, labels);
    }
    /// What only enter() needs goes.
    void allEntered() { mSteps.reset(); }

    /// The labels of a column along x; its voxels that are asked for move on.
    void labelColumn(const Column<Power>& column, ColumnPower<Power>& power)
    {
        power.run(column, layout, mResult.centers.data(), [&](uint32_t leaf, const auto* steps) {
            constexpr std::size_t kBytes = kLeafVoxels * sizeof(*steps);
            if (kept[0]) std::memcpy(kept[0] + std::size_t(leaf) * kLeafVoxels, steps, kBytes);
            mQuestions.moveAlongX(leaf, steps);
        });
    }

    /// The balls of a slab, and answers that are in it, when all labels that lead to it are known.
    void finish(uint32_t slab, const SlabLabels<Power>& labels, SlabBalls<Power>& balls)
    {
        mQuestions.moveToCenters(slab, labels);
        LeafMask* centers = mResult.centers.data() + layout.slab(slab).begin;
        mRadii[slab] = balls.collect(layout, slab, labels, centers);
    }

    /// @return the balls of all slabs.
    LevelBalls collected()
    {
        detail::timed("medial balls", interrupter, &mResult.seconds.medial, [&] { placeBalls(); });
        return std::move(mResult);
    }

    /// @return whether a label leads to a leaf along x.
    bool hasMarks(uint32_t leaf) const { return detail::hasMarks(mResult.centers[leaf]); }
    /// @return the slab of the first leaf of a run along x.
    uint32_t firstSlab(uint32_t run) const { return mFirstSlab[run]; }
    StreamSeconds& seconds() { return mResult.seconds; }

    /// Distances and power run in turns: they share the time as the threads' times say.
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
    const KeptSteps<Power> kept;
    openvdb::util::NullInterrupter* const interrupter;

private:
    using Steps = XSteps<StepOf<T>>;
    using Radii = std::vector<typename SlabBalls<Power>::RadiusSq>;

    /// Centres and radii of all slabs become balls, one list in the order of slabs: zeros first, by
    /// one thread, for want of a vector that begins without.
    void placeBalls()
    {
        std::vector<std::size_t> first{0}; // of each slab
        for (const Radii& radii : mRadii) first.push_back(first.back() + radii.size());
        detail::resizeLarge(mResult.balls, first.back());
        detail::parallelFor(mRadii.size(), interrupter, [&](std::size_t slab) {
            const Radii radii = std::move(mRadii[slab]);
            const LeafMask* centers = mResult.centers.data() + layout.slab(uint32_t(slab)).begin;
            MedialBall* balls = mResult.balls.data() + first[slab];
            assert(radii.size() == detail::countMarks(centers, layout.slab(uint32_t(slab)).size()));
            detail::visitWithPlaces(layout, uint32_t(slab), centers,
                [&](uint32_t leaf, uint32_t offset, std::size_t place) {
                    balls[place] = {layout.voxel(leaf, offset), int32_t(radii[place])};
                });
        });
    }

    Questions mQuestions;
    std::unique_ptr<Steps> mSteps;
    std::vector<uint32_t> mFirstSlab; ///< of each run along x
    std::vector<Radii> mRadii;        ///< of the balls of each slab, whose centres are in mResult
    LevelBalls mResult; ///< its centres are where labels lead along x, until the slab is finished
};

} // namespace slab
} // namespace openvdb_spheretree
