// SPDX-License-Identifier: Apache-2.0
/// @file SphereSet.h
/// @brief N spheres that change, and what each of them is worth given the others.
///
/// descend(): every sphere climbs (SphereClimb.h) until none gains any more. A sphere is visited again
/// only after one that it may meet has moved. Spheres that cannot reach one another are visited at the same
/// time: which ones, is decided before, by their places in the list, so results do not depend on threads.
/// What all of them gain adds up: excess + missing only falls, where samples are voxels.
///
/// A sphere with more samples in its radius than a limit is visited at a coarser level of them, so a visit takes no
/// longer than that of a sphere of such a radius: cost goes by spheres and not by voxels. At level 0, samples are
/// voxels and gains are exact.
///
/// Memory: a window for each thread (GainWindow.h), and the grid of spheres. Tests: TestNearestSearch.cc.

#pragma once

#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::nearest {

class GainWindow;

class SphereSet {
public:
    /// @param object  has to live longer
    /// @param flat    spheres are discs in the plane z = 0
    SphereSet(const tight::SampledObject& object, bool flat, std::vector<ExactSphere> spheres,
        openvdb::util::NullInterrupter* interrupter);

    const std::vector<ExactSphere>& spheres() const { return mSpheres; }
    /// Adds a sphere, to be visited.
    void add(const ExactSphere& sphere);
    /// Visits spheres until none gains any more, or for so many rounds.
    /// @param samples  in a radius, at most
    /// @throw Interrupted
    void descend(int rounds, int samples);
    /// Takes those away that are worth least, one by one, until @a count are left.
    void dropLeast(std::size_t count);

private:
    void visit(std::size_t i, GainWindow& window, ExactSphere& found) const;
    /// Fills the window of a sphere with what it and the others hold.
    void fill(std::size_t i, GainWindow& window, int level) const;
    /// @return how many voxels more would be wrong without it; an estimate at a coarser level.
    int64_t worth(std::size_t i, GainWindow& window) const;
    std::vector<int32_t> takeBatch(std::vector<int32_t>& waiting) const;
    /// @return the level of samples that a sphere is visited at.
    int levelOf(const ExactSphere& sphere, int samples) const;
    /// @return how far a sphere may reach beyond its place in a visit, 1/16 voxel.
    double slackOf(const ExactSphere& sphere) const;
    /// Those that may gain something from a change of @a sphere are visited again.
    void touchAround(const ExactSphere& sphere);

    const tight::SampledObject* mObject;
    bool mFlat;
    int mSamples = 12; ///< in a radius, at most
    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<ExactSphere> mSpheres;
    std::vector<char> mWaits; ///< by sphere: to be visited
    tight::BallGrid mGrid;
};

} // namespace openvdb_spheretree::nearest
