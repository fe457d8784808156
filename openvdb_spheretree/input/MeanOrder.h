// SPDX-License-Identifier: Apache-2.0
/// @file MeanOrder.h
/// @brief Whether the mean of a few values is below or above a bound: exactly, whatever the values.
///
/// The sum is compared with count * bound. Integers are summed in 128 bits. Of floats and doubles:
/// 1. a sum in doubles, and how far it may be off, settle most;
/// 2. else the same sum, where no addition was rounded (T. J. Dekker's test of the error, Numer. Math.
///    18, 1971): values of few bits, such as halves of bytes, end here;
/// 3. else a sum in fixed point, of as many bits as doubles reach over (U. Kulisch's accumulator).

#pragma once

#include "ValueBound.h"

#include <cmath>
#include <type_traits>

namespace openvdb_spheretree::detail {

/// `None`: a NaN is among the values, or infinities of both signs.
enum class MeanOrder { Less, Equal, Greater, None };

/// @param count  of the samples, a power of two, at most 8
/// @param bound  finite
/// @tparam ValueT  float, double, int32_t or int64_t
template <typename ValueT>
MeanOrder orderOfMean(const ValueT* samples, int count, const ValueBound& bound);

/// The values below a bound, or above it; or all others, which then has what is no number in it.
struct HalfSpace {
    ValueBound bound;
    bool isBelow = false;
    bool isComplement = false;

    bool holds(MeanOrder order) const
    {
        return (order == (isBelow ? MeanOrder::Less : MeanOrder::Greater)) != isComplement;
    }
    HalfSpace complement() const { return {bound, isBelow, !isComplement}; }

    /// The same of one value, in the loops over all values of a grid. Rounding an integer to a double
    /// brings it to no other side of a bound below 2^53.
    template <typename ValueT>
    bool contains(ValueT value) const
    {
        const bool fits = sizeof(ValueT) == 4
            || std::is_floating_point_v<ValueT> || std::abs(bound.nearest) < 0x1p53;
        if (!fits || bound.rest != 0) return holds(orderOfMean(&value, 1, bound));
        const double number = double(value);
        return (isBelow ? number < bound.nearest : number > bound.nearest) != isComplement;
    }
};

} // namespace openvdb_spheretree::detail
