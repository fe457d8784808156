// SPDX-License-Identifier: Apache-2.0
#include "SphereSet.h"

#include "GainWindow.h"
#include "SphereClimb.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace openvdb_spheretree::nearest {

using tight::FineBox;
using tight::kFine;

SphereSet::SphereSet(const tight::SampledObject& object, bool flat,
    std::vector<ExactSphere> spheres, openvdb::util::NullInterrupter* interrupter)
    : mObject(&object), mFlat(flat), mInterrupter(interrupter), mSpheres(std::move(spheres)),
      mWaits(mSpheres.size(), 1), mGrid(mSpheres)
{}

int SphereSet::levelOf(const ExactSphere& sphere, int samples) const
{
    int level = 0;
    while (sphere.radius() > double((kFine * samples) << level)) ++level;
    return level;
}

double SphereSet::slackOf(const ExactSphere& sphere) const
{
    return double((kFine * kMargin) << levelOf(sphere, mSamples));
}

void SphereSet::touchAround(const ExactSphere& sphere)
{
    for (const int32_t other : mGrid.near(sphere, slackOf(sphere))) mWaits[other] = 1;
}

void SphereSet::add(const ExactSphere& sphere)
{
    touchAround(sphere);
    mGrid.add(int32_t(mSpheres.size()), sphere);
    mSpheres.push_back(sphere);
    mWaits.push_back(1);
}

void SphereSet::fill(std::size_t i, GainWindow& window, int level) const
{
    const ExactSphere& sphere = mSpheres[i];
    const double margin = double((kFine * kMargin) << level);
    const FineBox box(sphere, margin);
    window.reset(*mObject, box, level, mFlat);
    for (const int32_t other : mGrid.meeting(box)) {
        if (other != int32_t(i)) window.cover(mSpheres[other]);
    }
    window.sum();
}

void SphereSet::visit(std::size_t i, GainWindow& window, ExactSphere& found) const
{
    fill(i, window, levelOf(mSpheres[i], mSamples));
    const LocalSphere from = window.toLocal(mSpheres[i]);
    LocalSphere to = from;
    climb(window, to, mFlat);
    found = window.moved(mSpheres[i], from, to);
}

int64_t SphereSet::worth(std::size_t i, GainWindow& window) const
{
    const int level = levelOf(mSpheres[i], mSamples);
    fill(i, window, level);
    const int64_t gain = window.gain(window.toLocal(mSpheres[i]));
    return gain << std::min(3 * level, 30);
}

/// @return some of those that wait, the first first, none in reach of another; the rest waits on.
std::vector<int32_t> SphereSet::takeBatch(std::vector<int32_t>& waiting) const
{
    tight::BallGrid taken;
    std::vector<int32_t> batch, rest;
    for (const int32_t i : waiting) {
        // Both stay in their windows, the corners of which are the margin's diagonal away.
        ExactSphere reach = mSpheres[i];
        const double radius = reach.radius() + std::sqrt(3.0) * slackOf(reach);
        reach.radiusSq = int64_t(radius * radius) + 1;
        if (!taken.near(reach, 1).empty()) {
            rest.push_back(i);
            continue;
        }
        taken.add(i, reach);
        batch.push_back(i);
    }
    waiting = std::move(rest);
    return batch;
}

void SphereSet::descend(int rounds, int samples)
{
    for (std::size_t i = 0; i < mSpheres.size(); ++i) {
        const int before = levelOf(mSpheres[i], mSamples);
        if (levelOf(mSpheres[i], samples) != before) mWaits[i] = 1;
    }
    mSamples = samples;
    for (int round = 0; round < rounds; ++round) {
        std::vector<int32_t> waiting;
        for (std::size_t i = 0; i < mSpheres.size(); ++i) {
            if (mWaits[i]) waiting.push_back(int32_t(i));
        }
        if (waiting.empty()) return;
        while (!waiting.empty()) {
            const std::vector<int32_t> batch = takeBatch(waiting);
            std::vector<ExactSphere> found(batch.size());
            detail::parallelForWithScratch<GainWindow>(
                batch.size(), mInterrupter, [&](std::size_t k, GainWindow& window) {
                    visit(std::size_t(batch[k]), window, found[k]);
                });
            for (std::size_t k = 0; k < batch.size(); ++k) {
                const int32_t i = batch[k];
                mWaits[i] = 0;
                if (found[k] == mSpheres[i]) continue;
                touchAround(mSpheres[i]);
                mGrid.remove(i, mSpheres[i]);
                mSpheres[i] = found[k];
                mGrid.add(i, mSpheres[i]);
                touchAround(mSpheres[i]);
                mWaits[i] = 0; // it has climbed already
            }
        }
    }
}

void SphereSet::dropLeast(std::size_t count)
{
    std::vector<int64_t> worths(mSpheres.size());
    detail::parallelForWithScratch<GainWindow>(mSpheres.size(), mInterrupter,
        [&](std::size_t i, GainWindow& window) { worths[i] = worth(i, window); });
    using Entry = std::pair<int64_t, int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (std::size_t i = 0; i < worths.size(); ++i) queue.push({worths[i], int32_t(i)});
    GainWindow window;
    std::vector<char> dropped(mSpheres.size(), 0);
    for (std::size_t left = mSpheres.size(); left > count;) {
        detail::checkInterrupt(mInterrupter);
        const Entry top = queue.top();
        queue.pop();
        const int64_t now = worth(std::size_t(top.second), window);
        if (now != top.first) { // others went, and it is worth more
            queue.push({now, top.second});
            continue;
        }
        mGrid.remove(top.second, mSpheres[top.second]);
        touchAround(mSpheres[top.second]);
        dropped[top.second] = 1;
        --left;
    }
    std::vector<ExactSphere> kept;
    std::vector<char> waits;
    for (std::size_t i = 0; i < mSpheres.size(); ++i) {
        if (dropped[i]) continue;
        kept.push_back(mSpheres[i]);
        waits.push_back(mWaits[i]);
    }
    mSpheres = std::move(kept);
    mWaits = std::move(waits);
    mGrid = tight::BallGrid(mSpheres);
}

} // namespace openvdb_spheretree::nearest
