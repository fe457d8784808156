// SPDX-License-Identifier: Apache-2.0
#include "MotionKernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/query/MotionKernels.cc"
#include <hwy/foreach_target.h>

#include "PairLanes-inl.h"
#include <hwy/highway.h>

#include <openvdb_spheretree/base/Rounding.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A time after all others.
constexpr float kNever = 2.0f;
/// Steps of a pair that is not two leaves, and of one that is, before doubles go on.
constexpr int kSteps = 2, kLeafSteps = 6;

/// A sphere on its helix.
struct Moving {
    FloatSphere start;
    float v[3], k[3], slide[3];
    float turn, speed, acceleration;
};

HWY_INLINE Moving MovingOf(const Screw<float>& screw, const FloatSphere& start)
{
    Moving m;
    m.start = start;
    m.turn = screw.turn;
    const auto& n = screw.axis;
    const float q[3] = {
        start.x - screw.point[0], start.y - screw.point[1], start.z - screw.point[2]};
    const float along = (n[0] * q[0] + n[1] * q[1]) + n[2] * q[2];
    float radiusSq = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        m.v[i] = n[j] * q[l] - n[l] * q[j];
        m.k[i] = n[i] * along - q[i];
        m.slide[i] = screw.slide * n[i];
        radiusSq += m.v[i] * m.v[i];
    }
    // Whatever rounding did, the acceleration is no less than the true one, and the speed no more: on the same line
    // at a speed that is too small, a sphere enters too soon (its speed is divided by), never too late.
    m.acceleration = 1.00001f * m.turn * m.turn * std::sqrt(radiusSq);
    m.speed = 0.99999f * std::sqrt(m.turn * m.turn * radiusSq + screw.slide * screw.slide);
    return m;
}

struct SineCosine {
    V sine, cosine;
};

/// Of angles up to half a turn, to some 2^-23: Taylor's series of half of it, whose last terms are below
/// that, doubled once.
HWY_INLINE SineCosine SineCosineOf(const V& angle)
{
    const D d;
    const V x = hn::Mul(angle, hn::Set(d, 0.5f)), xx = hn::Mul(x, x);
    const auto horner = [&](std::initializer_list<float> terms) {
        V sum = hn::Zero(d);
        for (const float term : terms) sum = hn::Add(hn::Mul(sum, xx), hn::Set(d, term));
        return sum;
    };
    const V s =
        hn::Mul(x, horner({-1.f / 39916800, 1.f / 362880, -1.f / 5040, 1.f / 120, -1.f / 6, 1.f}));
    const V c =
        horner({1.f / 479001600, -1.f / 3628800, 1.f / 40320, -1.f / 720, 1.f / 24, -0.5f, 1.f});
    const V twice = hn::Add(s, s);
    return {hn::Mul(twice, c), hn::Sub(hn::Set(d, 1.0f), hn::Mul(twice, s))};
}

/// Some lanes of a block, and a sphere that comes towards them.
class Approach {
public:
    HWY_INLINE Approach(
        const SphereBlock& block, int lane, const Moving& moving, float from, float pad)
        : mMoving(moving), mX(hn::Load(D(), block.x + lane)), mY(hn::Load(D(), block.y + lane)),
          mZ(hn::Load(D(), block.z + lane)),
          mRadii(hn::Add(hn::Load(D(), block.r + lane), hn::Set(D(), moving.start.r + pad))),
          mTime(hn::Set(D(), from))
    {}

    /// Goes on by a safe step. Lanes that have come near `end` never meet; those that meet stay.
    HWY_INLINE void Step(float end)
    {
        const D d;
        const auto set = [&](float x) { return hn::Set(d, x); };
        const V half = hn::Mul(set(0.5f * mMoving.turn), mTime); // up to half a turn
        const SineCosine h = SineCosineOf(half);
        const V sine = hn::Mul(hn::Add(h.sine, h.sine), h.cosine);
        const V versine = hn::Mul(hn::Add(h.sine, h.sine), h.sine); // 1 - cosine
        const V cosine = hn::Sub(set(1.0f), versine);
        V distSq = hn::Zero(d), towards = hn::Zero(d);
        const V lanes[3] = {mX, mY, mZ};
        const float start[3] = {mMoving.start.x, mMoving.start.y, mMoving.start.z};
        const float perSpeed = mMoving.speed > 0 ? 1 / mMoving.speed : 0.0f;
        for (int i = 0; i < 3; ++i) {
            const V v = set(mMoving.v[i]), k = set(mMoving.k[i]), slide = set(mMoving.slide[i]);
            const V turned = hn::Add(hn::Mul(sine, v), hn::Mul(versine, k));
            const V away =
                hn::Add(hn::Sub(set(start[i]), lanes[i]), hn::Add(turned, hn::Mul(mTime, slide)));
            const V velocity = hn::Add(
                hn::Mul(set(mMoving.turn), hn::Add(hn::Mul(cosine, v), hn::Mul(sine, k))), slide);
            distSq = hn::Add(distSq, hn::Mul(away, away));
            towards = hn::Add(towards, hn::Mul(away, hn::Mul(velocity, set(perSpeed))));
        }
        Advance(distSq, towards, end);
    }

    HWY_INLINE const V& Time() const { return mTime; }

private:
    /// @param towards  of the vector between, along the unit velocity: negative while they come nearer
    HWY_INLINE void Advance(const V& distSq, const V& towards, float end)
    {
        const D d;
        const V left = hn::Sub(hn::Set(d, end), mTime);
        const V gap = hn::Sub(hn::Sqrt(distSq), mRadii);
        const V positive = hn::Max(gap, hn::Zero(d));
        const V acceleration = hn::Set(d, std::max(mMoving.acceleration, 1e-30f));
        const V calm = hn::Sqrt(hn::Div(positive, acceleration));
        const V span = hn::Min(calm, left);
        const V bend = hn::Mul(hn::Set(d, 0.500001f * mMoving.acceleration), hn::Mul(span, span));
        const V reach = hn::Add(mRadii, bend);
        const V outside = hn::Max(hn::Sub(distSq, hn::Mul(reach, reach)), hn::Zero(d));
        const V discriminant = hn::Sub(hn::Mul(towards, towards), outside);
        const auto enters =
            hn::And(hn::Ge(discriminant, hn::Zero(d)), hn::Lt(towards, hn::Zero(d)));
        const V root = hn::Sub(hn::Sqrt(hn::Max(discriminant, hn::Zero(d))), towards);
        // A little less than the way to go, for rounding.
        const V way =
            hn::Div(hn::Mul(outside, hn::Set(d, 0.99999f)), hn::Max(root, hn::Set(d, 1e-30f)));
        const V entry = hn::Mul(way, hn::Set(d, mMoving.speed > 0 ? 1 / mMoving.speed : 0.0f));
        const V step = hn::IfThenElse(enters, hn::Min(entry, span), span);
        const auto meets = hn::Le(gap, hn::Zero(d));
        const auto ends = hn::And(hn::Ge(step, left), hn::Gt(gap, hn::Zero(d)));
        const V later =
            hn::IfThenElse(meets, mTime, hn::Add(mTime, hn::Mul(step, hn::Set(d, 0.99999f))));
        mTime = hn::IfThenElse(ends, hn::Set(d, kNever), later);
    }

    const Moving& mMoving;
    V mX, mY, mZ, mRadii, mTime;
};

class FirstContact {
public:
    FirstContact(const MotionFrame& frame, const MotionLimits& limits)
        : mFrame(frame), mLimits(limits)
    {
        SetBest(limits.end);
    }

    MotionEnd Run()
    {
        mStack[0] = {{kRootPlace, kRootPlace}, 0.0f};
        mCount = 1;
        while (mCount > 0) {
            const Waiting next = mStack[--mCount];
            if (next.time >= mBest) continue;
            if (mEnd.blocks >= mLimits.maxBlocks) {
                mEnd.isDecided = false;
                ++mCount;
                break;
            }
            Descend(next);
        }
        mEnd.free = mEnd.time;
        for (int i = 0; i < mCount; ++i) mEnd.free = std::min(mEnd.free, double(mStack[i].time));
        return mEnd;
    }

private:
    struct Waiting {
        Pair pair;
        float time; ///< before which it cannot meet
    };

    void SetBest(double time)
    {
        mEnd.time = time;
        mBest = toFloatUp(time);
    }

    HWY_INLINE void Descend(const Waiting& next)
    {
        const Opened opened = Open(mFrame.pair, next.pair);
        const Moving moving = MovingOf(opened.isOfA ? mFrame.toA : mFrame.toB, opened.other);
        const uint32_t leaves = opened.otherChild < 0 ? LeafLanes(*opened.block) : 0;
        // As many steps for all lanes of a block, whatever the width of vectors.
        const int most = leaves ? kLeafSteps : kSteps;
        int taken = 0;
        HWY_ALIGN float times[kBlockWidth];
        uint32_t soon = 0;
        for (int lane = 0; lane < kBlockWidth; lane += kWidth) {
            Approach approach(*opened.block, lane, moving, next.time, mFrame.pad);
            uint32_t live = 1;
            for (int step = 1; step <= most && live; ++step) {
                approach.Step(mBest);
                live = Bits(hn::Lt(approach.Time(), hn::Set(D(), mBest)));
                taken = std::max(taken, step);
            }
            soon |= live << lane;
            hn::Store(approach.Time(), D(), times + lane);
        }
        mEnd.blocks += taken;
        const int first = mCount;
        for (; soon; soon &= soon - 1) {
            const int lane = FirstLane(soon);
            if (isEmptyLane(*opened.block, lane) || times[lane] >= mBest) continue;
            if (leaves >> lane & 1) {
                AddLeaves(opened, lane, times[lane]);
                continue;
            }
            Push({opened.below(next.pair, lane), times[lane]}, first);
        }
    }

    /// The soonest of the pairs of a block comes to lie on top.
    HWY_INLINE void Push(const Waiting& waiting, int first)
    {
        int place = mCount++;
        for (; place > first && mStack[place - 1].time < waiting.time; --place) {
            mStack[place] = mStack[place - 1];
        }
        mStack[place] = waiting;
    }

    void AddLeaves(const Opened& opened, int lane, float from)
    {
        const FloatSphere here = opened.block->sphere(lane);
        const FloatSphere& ofA = opened.isOfA ? here : opened.own;
        const FloatSphere& ofB = opened.isOfA ? opened.own : here;
        double gap = 0;
        const double time =
            timeOfContact(mFrame, ofA, ofB, from, mEnd.time, mLimits.tolerance, gap);
        const bool isFirst = mEnd.pair.a < 0 && time <= mEnd.time;
        if (time >= mEnd.time && !isFirst) return;
        mEnd.pair = {opened.leafA(lane), opened.leafB(lane), gap};
        SetBest(time);
    }

    const MotionFrame& mFrame;
    const MotionLimits& mLimits;
    MotionEnd mEnd;
    float mBest = 0;
    int mCount = 0;
    Waiting mStack[kMostPairs];
};

MotionEnd FindFirstContact(const MotionFrame& frame, const MotionLimits& limits)
{
    return FirstContact(frame, limits).Run();
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(FindFirstContact);

MotionEnd findFirstContact(const MotionFrame& frame, const MotionLimits& limits)
{
    return HWY_DYNAMIC_DISPATCH(FindFirstContact)(frame, limits);
}

} // namespace openvdb_spheretree::detail
#endif
