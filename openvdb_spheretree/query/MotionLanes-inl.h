// SPDX-License-Identifier: Apache-2.0
/// @file MotionLanes-inl.h
/// @brief Safe steps of time of a block's lanes and a sphere of the other body: where that alone moves, and where both do.
/// Compiled once for each instruction set.

#if defined(SPHERETREE_MOTION_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHERETREE_MOTION_LANES_INL_H
#undef SPHERETREE_MOTION_LANES_INL_H
#else
#define SPHERETREE_MOTION_LANES_INL_H
#endif

#include "MotionFrame.h"
#include "MutualFrame.h"
#include "PairLanes-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A time after all others.
constexpr float kNever = 2.0f;
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
    // Whatever rounding did, the acceleration is no less than the true one.
    m.acceleration = 1.00001f * m.turn * m.turn * std::sqrt(radiusSq);
    m.speed = std::sqrt(m.turn * m.turn * radiusSq + screw.slide * screw.slide);
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

/// How much of a turn a time is, lane by lane.
struct Turned {
    V sine, cosine, versine; ///< versine: 1 - cosine

    HWY_INLINE Turned(float turn, const V& time)
    {
        const D d;
        const SineCosine h =
            SineCosineOf(hn::Mul(hn::Set(d, 0.5f * turn), time)); // up to half a turn
        sine = hn::Mul(hn::Add(h.sine, h.sine), h.cosine);
        versine = hn::Mul(hn::Add(h.sine, h.sine), h.sine);
        cosine = hn::Sub(hn::Set(d, 1.0f), versine);
    }
};

/// What a step rests on: the vectors between centers, and their velocity.
struct Nearing {
    V away[3], unit[3]; ///< of the velocity: 0 where nothing moves
    V acceleration, perSpeed;
};

/// @return the time after a safe step. Lanes that come near @a end never meet; those that meet stay.
HWY_INLINE V Later(const V& time, const V& radii, const Nearing& nearing, float end)
{
    const D d;
    V distSq = hn::Zero(d), towards = hn::Zero(d), unitSq = hn::Zero(d), besideSq = hn::Zero(d);
    for (int i = 0; i < 3; ++i) {
        const V &away = nearing.away[i], &unit = nearing.unit[i];
        distSq = hn::Add(distSq, hn::Mul(away, away));
        towards = hn::Add(towards, hn::Mul(away, unit));
        unitSq = hn::Add(unitSq, hn::Mul(unit, unit));
    }
    // How far from the other center the way goes by is the length of a vector: as towards^2 - distSq it would be off by more
    // than a small sphere that comes from afar. 2 - x is 1 / x where x is nearly 1.
    const V along = hn::Mul(towards, hn::Sub(hn::Set(d, 2.0f), unitSq));
    for (int i = 0; i < 3; ++i) {
        const V beside = hn::Sub(nearing.away[i], hn::Mul(along, nearing.unit[i]));
        besideSq = hn::Add(besideSq, hn::Mul(beside, beside));
    }
    const V left = hn::Sub(hn::Set(d, end), time);
    const V gap = hn::Sub(hn::Sqrt(distSq), radii);
    const V positive = hn::Max(gap, hn::Zero(d));
    const V acceleration = hn::Max(nearing.acceleration, hn::Set(d, 1e-30f));
    const V calm = hn::Sqrt(hn::Div(positive, acceleration));
    const V span = hn::Min(calm, left);
    const V bend = hn::Mul(hn::Mul(hn::Set(d, 0.500001f), acceleration), hn::Mul(span, span));
    const V reach = hn::Add(radii, bend);
    const V reachSq = hn::Mul(reach, reach);
    const V outside = hn::Max(hn::Sub(distSq, reachSq), hn::Zero(d));
    const V discriminant = hn::Sub(reachSq, besideSq);
    const auto enters = hn::And(hn::Ge(discriminant, hn::Zero(d)), hn::Lt(towards, hn::Zero(d)));
    const V root = hn::Sub(hn::Sqrt(hn::Max(discriminant, hn::Zero(d))), towards);
    // A little less than the way to go, for rounding.
    const V way =
        hn::Div(hn::Mul(outside, hn::Set(d, 0.99999f)), hn::Max(root, hn::Set(d, 1e-30f)));
    const V entry = hn::Mul(way, nearing.perSpeed);
    const V step = hn::IfThenElse(enters, hn::Min(entry, span), span);
    const auto meets = hn::Le(gap, hn::Zero(d));
    const auto ends = hn::And(hn::Ge(step, left), hn::Gt(gap, hn::Zero(d)));
    const V later = hn::IfThenElse(meets, time, hn::Add(time, hn::Mul(step, hn::Set(d, 0.99999f))));
    return hn::IfThenElse(ends, hn::Set(d, kNever), later);
}

/// Some lanes of a block that stands still, and a sphere that comes towards them.
class Approach {
public:
    HWY_INLINE Approach(
        const SphereBlock& block, int lane, const Moving& moving, float from, float pad)
        : mMoving(moving), mX(hn::Load(D(), block.x + lane)), mY(hn::Load(D(), block.y + lane)),
          mZ(hn::Load(D(), block.z + lane)),
          mRadii(hn::Add(hn::Load(D(), block.r + lane), hn::Set(D(), moving.start.r + pad))),
          mTime(hn::Set(D(), from))
    {}

    /// Goes on by a safe step.
    HWY_INLINE void Step(float end)
    {
        const D d;
        const auto set = [&](float x) { return hn::Set(d, x); };
        const Turned turned(mMoving.turn, mTime);
        const float perSpeed = mMoving.speed > 0 ? 1 / mMoving.speed : 0.0f;
        Nearing nearing;
        nearing.acceleration = set(mMoving.acceleration);
        nearing.perSpeed = set(perSpeed);
        const V lanes[3] = {mX, mY, mZ};
        const float start[3] = {mMoving.start.x, mMoving.start.y, mMoving.start.z};
        for (int i = 0; i < 3; ++i) {
            const V v = set(mMoving.v[i]), k = set(mMoving.k[i]), slide = set(mMoving.slide[i]);
            const V around = hn::Add(hn::Mul(turned.sine, v), hn::Mul(turned.versine, k));
            nearing.away[i] =
                hn::Add(hn::Sub(set(start[i]), lanes[i]), hn::Add(around, hn::Mul(mTime, slide)));
            const V velocity =
                hn::Add(hn::Mul(set(mMoving.turn),
                            hn::Add(hn::Mul(turned.cosine, v), hn::Mul(turned.sine, k))),
                    slide);
            nearing.unit[i] = hn::Mul(velocity, nearing.perSpeed);
        }
        mTime = Later(mTime, mRadii, nearing, end);
    }

    HWY_INLINE const V& Time() const { return mTime; }

private:
    const Moving& mMoving;
    V mX, mY, mZ, mRadii, mTime;
};

/// A sphere on its helix, and how the block moves that it is held against.
struct MovingBoth {
    Moving other;
    const MutualSide& side;
};

/// Some lanes of a block that moves, and a sphere that does. Each lane has a helix of its own.
class MutualApproach {
public:
    HWY_INLINE MutualApproach(
        const SphereBlock& block, int lane, const MovingBoth& moving, float from, float pad)
        : mMoving(moving), mTime(hn::Set(D(), from))
    {
        const D d;
        const auto set = [&](float x) { return hn::Set(d, x); };
        mRadii = hn::Add(hn::Load(d, block.r + lane), set(moving.other.start.r + pad));
        const V center[3] = {
            hn::Load(d, block.x + lane), hn::Load(d, block.y + lane), hn::Load(d, block.z + lane)};
        const auto& n = moving.side.own.axis;
        const float start[3] = {moving.other.start.x, moving.other.start.y, moving.other.start.z};
        V q[3], along = hn::Zero(d), radiusSq = hn::Zero(d);
        for (int i = 0; i < 3; ++i) {
            q[i] = hn::Sub(center[i], set(moving.side.own.point[i]));
            along = hn::Add(along, hn::Mul(set(n[i]), q[i]));
            mBetween[i] = hn::Sub(set(start[i]), center[i]);
        }
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            mV[i] = hn::Sub(hn::Mul(set(n[j]), q[l]), hn::Mul(set(n[l]), q[j]));
            mK[i] = hn::Sub(hn::Mul(set(n[i]), along), q[i]);
            radiusSq = hn::Add(radiusSq, hn::Mul(mV[i], mV[i]));
        }
        // No less than that of the vector between: both add up at most.
        const float turn = moving.side.own.turn;
        mAcceleration = hn::Add(set(moving.other.acceleration),
            hn::Mul(set(1.00001f * turn * turn), hn::Sqrt(radiusSq)));
    }

    /// Goes on by a safe step.
    HWY_INLINE void Step(float end)
    {
        const D d;
        const auto set = [&](float x) { return hn::Set(d, x); };
        const Moving& other = mMoving.other;
        const float ownTurn = mMoving.side.own.turn;
        const Turned their(other.turn, mTime), our(ownTurn, mTime);
        V velocity[3], speedSq = hn::Zero(d);
        Nearing nearing;
        nearing.acceleration = mAcceleration;
        for (int i = 0; i < 3; ++i) {
            const V v = set(other.v[i]), k = set(other.k[i]), drift = set(mMoving.side.drift[i]);
            const V theirs = hn::Add(hn::Mul(their.sine, v), hn::Mul(their.versine, k));
            const V ours = hn::Add(hn::Mul(our.sine, mV[i]), hn::Mul(our.versine, mK[i]));
            nearing.away[i] =
                hn::Add(mBetween[i], hn::Add(hn::Sub(theirs, ours), hn::Mul(mTime, drift)));
            const V theirsPerTurn = hn::Add(hn::Mul(their.cosine, v), hn::Mul(their.sine, k));
            const V oursPerTurn = hn::Add(hn::Mul(our.cosine, mV[i]), hn::Mul(our.sine, mK[i]));
            velocity[i] = hn::Add(hn::Sub(hn::Mul(set(other.turn), theirsPerTurn),
                                      hn::Mul(set(ownTurn), oursPerTurn)),
                drift);
            speedSq = hn::Add(speedSq, hn::Mul(velocity[i], velocity[i]));
        }
        // Slower than 1.5e-19 is no way to speak of beside the pad of the least extent.
        const auto moves = hn::Gt(speedSq, set(2e-38f));
        nearing.perSpeed =
            hn::IfThenElseZero(moves, hn::Div(set(1.0f), hn::Sqrt(hn::Max(speedSq, set(2e-38f)))));
        for (int i = 0; i < 3; ++i) nearing.unit[i] = hn::Mul(velocity[i], nearing.perSpeed);
        mTime = Later(mTime, mRadii, nearing, end);
    }

    HWY_INLINE const V& Time() const { return mTime; }

private:
    const MovingBoth& mMoving;
    V mBetween[3], mV[3], mK[3], mAcceleration, mRadii, mTime;
};

/// @name What comes towards the lanes of an opened block, and they towards it
/// @{
HWY_INLINE Moving ComingOf(const MotionFrame& frame, const Opened& opened)
{
    return MovingOf(opened.isOfA ? frame.toA : frame.toB, opened.other);
}
HWY_INLINE MovingBoth ComingOf(const MutualFrame& frame, const Opened& opened)
{
    const MutualSide& side = opened.isOfA ? frame.inA : frame.inB;
    return {MovingOf(side.other, opened.other), side};
}
HWY_INLINE Approach ApproachOf(
    const SphereBlock& block, int lane, const Moving& moving, float from, float pad)
{
    return Approach(block, lane, moving, from, pad);
}
HWY_INLINE MutualApproach ApproachOf(
    const SphereBlock& block, int lane, const MovingBoth& moving, float from, float pad)
{
    return MutualApproach(block, lane, moving, from, pad);
}
/// @}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif // SPHERETREE_MOTION_LANES_INL_H
