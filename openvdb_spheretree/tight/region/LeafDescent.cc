// SPDX-License-Identifier: Apache-2.0
#include "LeafDescent.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

using openvdb::CoordBBox;

/// Some leaves, and the balls that may matter there.
struct Branch {
    uint32_t *begin, *end; // leaves
    std::vector<int32_t> balls;

    std::ptrdiff_t size() const { return end - begin; }
};

class Descent {
public:
    Descent(const SampleLevel& object, const BallFilter& filter, const LeafBallsBody& body)
        : mObject(object), mFilter(filter), mBody(body)
    {}

    /// Down to the leaves, whose number halves each time: calls nest 32 deep at most.
    void run(const Branch& branch) const
    {
        const std::vector<int32_t> balls = filtered(branch);
        if (branch.size() == 1) {
            mBody(*branch.begin, balls);
            return;
        }
        uint32_t* const middle = halve(branch);
        run({branch.begin, middle, balls});
        run({middle, branch.end, balls});
    }

    /// @return the two halves of a branch of more than one leaf.
    std::pair<Branch, Branch> split(const Branch& branch) const
    {
        const std::vector<int32_t> balls = filtered(branch);
        uint32_t* const middle = halve(branch);
        return {{branch.begin, middle, balls}, {middle, branch.end, balls}};
    }

private:
    CoordBBox boxOf(const Branch& branch) const
    {
        CoordBBox box;
        for (const uint32_t* leaf = branch.begin; leaf != branch.end; ++leaf) {
            box.expand(mObject.origin(*leaf));
            box.expand(mObject.origin(*leaf).offsetBy(7));
        }
        return box;
    }

    std::vector<int32_t> filtered(const Branch& branch) const
    {
        std::vector<int32_t> balls;
        mFilter(boxOf(branch), branch.balls, balls);
        return balls;
    }

    uint32_t* halve(const Branch& branch) const
    {
        const CoordBBox box = boxOf(branch);
        const auto length = [&](int a) { return int64_t(box.max()[a]) - box.min()[a]; };
        int axis = 0;
        for (int a = 1; a < 3; ++a) axis = length(a) > length(axis) ? a : axis;
        uint32_t* const middle = branch.begin + branch.size() / 2;
        std::nth_element(branch.begin, middle, branch.end, [&](uint32_t a, uint32_t b) {
            return mObject.origin(a)[axis] < mObject.origin(b)[axis];
        });
        return middle;
    }

    const SampleLevel& mObject;
    const BallFilter& mFilter;
    const LeafBallsBody& mBody;
};

} // namespace

void forEachLeafWithBalls(const SampleLevel& object, std::vector<int32_t> balls,
    const BallFilter& filter, const LeafBallsBody& body,
    openvdb::util::NullInterrupter* interrupter)
{
    if (object.leafCount() == 0) return;
    std::vector<uint32_t> leaves(object.leafCount());
    std::iota(leaves.begin(), leaves.end(), 0);
    const Descent descent(object, filter, body);
    std::vector<Branch> branches{{leaves.data(), leaves.data() + leaves.size(), std::move(balls)}};
    constexpr std::size_t kBranches = 256; // enough for any number of threads to share
    while (branches.size() < kBranches && branches.front().size() > 1) {
        std::vector<Branch> halves(2 * branches.size());
        detail::parallelFor(branches.size(), interrupter, [&](std::size_t i) {
            std::tie(halves[2 * i], halves[2 * i + 1]) = descent.split(branches[i]);
        });
        branches = std::move(halves);
    }
    detail::parallelFor(
        branches.size(), interrupter, [&](std::size_t i) { descent.run(branches[i]); });
}

} // namespace tight
} // namespace openvdb_spheretree
