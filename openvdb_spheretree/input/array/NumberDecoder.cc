// SPDX-License-Identifier: Apache-2.0
#include "NumberDecoder.h"

#include "ByteSource.h"
#include "HalfFloat.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace openvdb_spheretree::detail {
namespace {

template <typename Stored, bool Swapped>
Stored load(const uint8_t* in)
{
    uint8_t bytes[sizeof(Stored)];
    std::memcpy(bytes, in, sizeof(Stored));
    if constexpr (Swapped) std::reverse(bytes, bytes + sizeof(Stored));
    Stored number;
    std::memcpy(&number, bytes, sizeof(Stored));
    return number;
}

struct Half {
    uint16_t bits;
};

template <typename Stored>
auto numberOf(Stored stored)
{
    if constexpr (std::is_same_v<Stored, Half>) return fromHalf(stored.bits);
    else return stored;
}

template <typename Value, typename Number>
Value valueOf(Number number)
{
    if constexpr (std::is_same_v<Value, bool>) {
        return number != 0;
    } else if constexpr (std::is_same_v<Number, uint64_t> && std::is_integral_v<Value>) {
        return Value(std::min(number, uint64_t(std::numeric_limits<int64_t>::max())));
    } else {
        return static_cast<Value>(number);
    }
}

template <typename Stored, typename Value, bool Swapped>
std::size_t decode(
    const uint8_t* in, std::size_t count, Value* out, const NumberDecoder<Value>& decoder)
{
    std::size_t notNumbers = 0;
    const auto orBackground = [&](double number) {
        if (!std::isnan(number)) return Value(number);
        ++notNumbers;
        return decoder.background;
    };
    for (std::size_t i = 0; i < count; ++i, in += sizeof(Stored)) {
        const auto number = numberOf(load<Stored, Swapped>(in));
        if constexpr (std::is_same_v<Value, float>) {
            out[i] = orBackground(decoder.slope * double(number) + decoder.intercept);
        } else if constexpr (std::is_same_v<Value, double>) {
            out[i] = orBackground(double(number));
        } else {
            out[i] = valueOf<Value>(number);
        }
    }
    return notNumbers;
}

template <typename Stored, typename Value>
auto decoderOf(bool swapped)
{
    return swapped ? decode<Stored, Value, true> : decode<Stored, Value, false>;
}

/// Every type goes with floats, which are scaled; else those that hold it exactly.
template <typename Value>
auto decoderOf(NumberType type, bool swapped)
{
    constexpr bool isFloat = std::is_same_v<Value, float>;
    constexpr bool isWide = isFloat || std::is_same_v<Value, int64_t>;
    constexpr bool isInt = isFloat || std::is_same_v<Value, int32_t>;
    decltype(decoderOf<uint8_t, Value>(swapped)) found = nullptr;
    if constexpr (std::is_same_v<Value, bool> || isFloat) {
        if (type == NumberType::Bool) found = decoderOf<uint8_t, Value>(false);
    }
    if constexpr (isInt) {
        if (type == NumberType::Int8) found = decoderOf<int8_t, Value>(false);
        if (type == NumberType::UInt8) found = decoderOf<uint8_t, Value>(false);
        if (type == NumberType::Int16) found = decoderOf<int16_t, Value>(swapped);
        if (type == NumberType::UInt16) found = decoderOf<uint16_t, Value>(swapped);
        if (type == NumberType::Int32) found = decoderOf<int32_t, Value>(swapped);
    }
    if constexpr (isWide) {
        if (type == NumberType::UInt32) found = decoderOf<uint32_t, Value>(swapped);
        if (type == NumberType::Int64) found = decoderOf<int64_t, Value>(swapped);
        if (type == NumberType::UInt64) found = decoderOf<uint64_t, Value>(swapped);
    }
    if constexpr (isFloat) {
        if (type == NumberType::Float16) found = decoderOf<Half, Value>(swapped);
        if (type == NumberType::Float32) found = decoderOf<float, Value>(swapped);
    }
    if constexpr (isFloat || std::is_same_v<Value, double>) {
        if (type == NumberType::Float64) found = decoderOf<double, Value>(swapped);
    }
    return found;
}

} // namespace

template <typename Value>
NumberDecoder<Value>::NumberDecoder(const ArrayLayout& layout, Value empty)
    : slope(layout.slope), intercept(layout.intercept), background(empty),
      mDecode(decoderOf<Value>(layout.type, layout.bigEndian != isBigEndianMachine()))
{}

template class NumberDecoder<bool>;
template class NumberDecoder<int32_t>;
template class NumberDecoder<int64_t>;
template class NumberDecoder<float>;
template class NumberDecoder<double>;

} // namespace openvdb_spheretree::detail
