// SPDX-License-Identifier: Apache-2.0
#include "MeanOrder.h"

#include <openvdb_spheretree/base/Text.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <type_traits>

namespace openvdb_spheretree {

namespace {

using detail::MeanOrder;

__extension__ typedef __int128 Wide;

template <typename T>
MeanOrder orderOf(const T& a, const T& b)
{
    if (a < b) return MeanOrder::Less;
    return b < a ? MeanOrder::Greater : MeanOrder::Equal;
}

/// A sum of doubles in fixed point, of digits of 32 bits. Each digit has room for 2^30 terms.
class FixedPointSum {
public:
    /// @param term  finite
    void add(double term)
    {
        int exponent = 0;
        const double fraction = std::frexp(std::abs(term), &exponent);
        const auto mantissa = uint64_t(std::ldexp(fraction, kMantissa));
        const int bit = exponent - kMantissa + kLowest;
        Wide left = Wide(mantissa) << bit % kDigit;
        for (int i = bit / kDigit; left > 0; left >>= kDigit, ++i) {
            const auto digit = int64_t(uint32_t(left));
            mDigits[i] += term < 0 ? -digit : digit;
        }
    }

    /// @return how the sum compares with 0.
    MeanOrder order() const
    {
        int64_t carry = 0;
        bool isZero = true;
        for (const int64_t digit : mDigits) {
            const int64_t sum = digit + carry;
            isZero &= uint32_t(sum) == 0;
            carry = sum >> kDigit; // rounds down: digits are not negative, and the carry is
        }
        if (carry < 0) return MeanOrder::Less;
        return isZero && carry == 0 ? MeanOrder::Equal : MeanOrder::Greater;
    }

private:
    static constexpr int kMantissa = 53, kDigit = 32;
    static constexpr int kLowest = 1152; // of the smallest double, 2^-1074, 2^-1126 is the last bit
    std::array<int64_t, 70> mDigits{};   // up to 2^1088
};

/// Of values that are not all finite; the bound is.
template <typename ValueT>
MeanOrder orderOfInfinite(const ValueT* samples, int count)
{
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(samples[i])) sum += double(samples[i]);
    }
    return std::isnan(sum) ? MeanOrder::None : orderOf(sum, 0.0);
}

template <typename ValueT>
MeanOrder exactOrder(const ValueT* samples, int count, const ValueBound& bound)
{
    FixedPointSum sum;
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(samples[i])) return orderOfInfinite(samples, count);
        sum.add(double(samples[i]));
        sum.add(-bound.nearest);
        sum.add(-bound.rest);
    }
    return sum.order();
}

/// The sum less that of the bounds, if no addition is rounded.
template <typename ValueT>
std::optional<double> unroundedSum(const ValueT* samples, int count, const ValueBound& bound)
{
    double sum = -count * bound.nearest;
    bool isExact = bound.rest == 0;
    for (int i = 0; i < count; ++i) {
        const double term = double(samples[i]), next = sum + term, added = next - sum;
        isExact &= sum - (next - added) == 0 && term - added == 0;
        sum = next;
    }
    if (isExact) return sum;
    return std::nullopt;
}

template <typename ValueT>
MeanOrder orderOfReals(const ValueT* samples, int count, const ValueBound& bound)
{
    double sum = 0, size = 0;
    for (int i = 0; i < count; ++i) {
        sum += double(samples[i]);
        size += std::abs(double(samples[i]));
    }
    const double most = count * bound.nearest;
    const double more = sum - most - count * bound.rest;
    // Ten additions, each off by 2^-53 of at most the size; and the size itself is rounded. What
    // overflows or is no number is not settled here: then neither comparison holds.
    const double off = 0x1p-49 * (size + std::abs(most));
    if (more > off) return MeanOrder::Greater;
    if (more < -off) return MeanOrder::Less;
    if (const auto exact = unroundedSum(samples, count, bound)) return orderOf(*exact, 0.0);
    return exactOrder(samples, count, bound);
}

template <typename ValueT>
MeanOrder orderOfIntegers(const ValueT* samples, int count, const ValueBound& bound)
{
    constexpr double kBeyondSums = 0x1p70;
    Wide sum = 0;
    for (int i = 0; i < count; ++i) sum += samples[i];
    const double most = count * bound.nearest; // exact: a power of two times, or an infinity
    if (most > kBeyondSums) return MeanOrder::Less;
    if (most < -kBeyondSums) return MeanOrder::Greater;
    if (bound.rest != 0) return orderOf(sum, Wide(most) + Wide(count * bound.rest));
    const double whole = std::floor(most);
    const MeanOrder order = orderOf(sum, Wide(whole));
    return order == MeanOrder::Equal && whole < most ? MeanOrder::Less : order;
}

} // namespace

ValueBound ValueBound::of(int64_t integer)
{
    ValueBound bound = double(integer);
    bound.rest = double(Wide(integer) - Wide(bound.nearest)); // at most 2^9
    return bound;
}

std::string detail::toText(const ValueBound& bound)
{
    char buffer[40];
    const auto printed = [&](auto number) {
        return std::string(buffer, std::to_chars(buffer, buffer + sizeof(buffer), number).ptr);
    };
    if (bound.rest == 0) return printed(bound.nearest);
    return printed(int64_t(Wide(bound.nearest) + Wide(bound.rest)));
}

template <typename ValueT>
MeanOrder detail::orderOfMean(const ValueT* samples, int count, const ValueBound& bound)
{
    if constexpr (std::is_integral_v<ValueT>) return orderOfIntegers(samples, count, bound);
    else return orderOfReals(samples, count, bound);
}

template MeanOrder detail::orderOfMean(const float*, int, const ValueBound&);
template MeanOrder detail::orderOfMean(const double*, int, const ValueBound&);
template MeanOrder detail::orderOfMean(const int32_t*, int, const ValueBound&);
template MeanOrder detail::orderOfMean(const int64_t*, int, const ValueBound&);

} // namespace openvdb_spheretree
