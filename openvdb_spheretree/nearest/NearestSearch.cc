// SPDX-License-Identifier: Apache-2.0
#include "NearestSearch.h"

#include "SphereSet.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::nearest {

namespace {

constexpr int kCoarseSamples = 12, kFineSamples = 48; ///< in a radius, at most
constexpr int kManyRounds = 12;                       ///< of visits: nearly always enough
constexpr int kFewRounds = 4;                         ///< before spheres go again

class Search {
public:
    Search(const NearestObject& object, std::vector<ExactSphere> start)
        : mObject(object), mCount(int64_t(start.size())), mBest{start, wrongVoxels(object, start)},
          mSet(object.samples, object.dim == 2, std::move(start), object.interrupter)
    {}

    NearestSpheres run()
    {
        if (mBest.wrong == 0) return mBest;
        turn([&] {
            mSet.descend(kManyRounds, kCoarseSamples);
            keep(mSet);
        });
        relocate();
        turn([&] {
            mSet.descend(kManyRounds, kFineSamples);
            keep(mSet);
        });
        return std::move(mBest);
    }

private:
    /// @return how often some spheres go elsewhere, at most: few spheres are worth more trials.
    int64_t trials() const
    {
        constexpr int64_t kLeast = 3, kMost = 12;
        return std::clamp(1024 / mCount, kLeast, kMost);
    }

    /// One of the descents, told as a part of all of them.
    template <typename Descent>
    void turn(const Descent& descent)
    {
        detail::checkInterrupt(mObject.interrupter, int(100 * mTurns++ / (trials() + 2)));
        const detail::Stage loops("", mObject.interrupter, nullptr); // each is a detail
        descent();
    }

    /// @return how many voxels fewer are wrong than with the best so far, which it then becomes; 0 if none.
    int64_t keep(const SphereSet& set)
    {
        const int64_t wrong = wrongVoxels(mObject, set.spheres());
        const int64_t less = mBest.wrong - wrong;
        if (less <= 0) return 0;
        mBest = {set.spheres(), wrong};
        return less;
    }

    /// More of few spheres are worth a trial.
    void relocate()
    {
        constexpr int64_t kFew = 256, kPays = 300;
        int64_t moved = mCount <= kFew ? (mCount + 1) / 2 : mCount / 8;
        for (int64_t trial = 0; trial < trials() && moved > 0 && mBest.wrong > 0; ++trial) {
            turn([&] {
                SphereSet set = relocated(moved);
                const int64_t less = keep(set);
                if (less > 0) mSet = std::move(set);
                if (less * kPays < mBest.wrong) moved /= 2;
            });
        }
    }

    SphereSet relocated(int64_t count) const
    {
        SphereSet set = mSet;
        for (const ExactSphere& ball : missingBalls(mObject, set.spheres(), count)) set.add(ball);
        set.descend(kFewRounds, kCoarseSamples);
        set.dropLeast(std::size_t(mCount));
        set.descend(kManyRounds, kCoarseSamples);
        return set;
    }

    const NearestObject& mObject;
    int64_t mCount;
    int64_t mTurns = 0; ///< descents so far
    NearestSpheres mBest;
    SphereSet mSet;
};

} // namespace

NearestSpheres nearestFrom(const NearestObject& object, std::vector<ExactSphere> start)
{
    return Search(object, std::move(start)).run();
}

} // namespace openvdb_spheretree::nearest
