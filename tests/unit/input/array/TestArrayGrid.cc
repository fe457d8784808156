// SPDX-License-Identifier: Apache-2.0
/// @file TestArrayGrid.cc
/// @brief Arrays of every order and type as grids, against one number after the other.

#include <openvdb_spheretree/input/array/ArrayGrid.h>

#include <openvdb_spheretree/input/array/HalfFloat.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::detail;
using openvdb::Coord;
using openvdb::GridBase;

GridBase::Ptr gridOfBytes(
    const std::string& bytes, const ArrayLayout& layout, const ArrayGridSettings& settings = {})
{
    std::istringstream stream(bytes);
    RawBytes source(stream);
    return gridOf(source, layout, settings, nullptr);
}

template <typename Number>
std::string bytesOfNumbers(const std::vector<Number>& numbers)
{
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

ArrayLayout layoutOf(std::array<uint64_t, 3> dim, NumberType type)
{
    ArrayLayout layout;
    layout.dim = dim;
    layout.type = type;
    layout.bigEndian = isBigEndianMachine();
    return layout;
}

template <typename GridT>
typename GridT::ValueType valueAt(const GridBase::Ptr& grid, const Coord& ijk)
{
    return openvdb::gridPtrCast<GridT>(grid)->tree().getValue(ijk);
}

TEST(ArrayGrid, EveryOrderOfAxesIsTheSameGrid)
{
    const std::array<uint64_t, 3> dim = {9, 17, 10};
    std::array<int, 3> order = {0, 1, 2};
    do {
        ArrayLayout layout = layoutOf(dim, NumberType::Int32);
        layout.order = order;
        std::vector<int32_t> numbers(9 * 17 * 10);
        const uint64_t fast = dim[order[0]], middle = dim[order[1]];
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            Coord ijk;
            ijk[order[0]] = int(i % fast);
            ijk[order[1]] = int(i / fast % middle);
            ijk[order[2]] = int(i / fast / middle);
            numbers[i] = ijk[0] % 5 == 0 ? 0 : ijk[0] + 100 * ijk[1] + 10000 * ijk[2];
        }
        const GridBase::Ptr grid = gridOfBytes(bytesOfNumbers(numbers), layout);
        for (auto at = openvdb::CoordBBox(Coord(0), Coord(8, 16, 9)).begin(); at; ++at) {
            const int x = (*at)[0];
            const int expected = x % 5 == 0 ? 0 : x + 100 * (*at)[1] + 10000 * (*at)[2];
            ASSERT_EQ(valueAt<openvdb::Int32Grid>(grid, *at), expected)
                << *at << " of order " << order[0] << order[1] << order[2];
        }
        EXPECT_EQ(grid->activeVoxelCount(), 7u * 17 * 10);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ArrayGrid, LeavesOfOneValueAreTiles)
{
    std::vector<uint8_t> numbers(16 * 8 * 12, 3);
    const ArrayLayout layout = layoutOf({16, 8, 12}, NumberType::UInt8);
    const auto of = [&](const ArrayGridSettings& settings) {
        return openvdb::gridPtrCast<openvdb::Int32Grid>(
            gridOfBytes({numbers.begin(), numbers.end()}, layout, settings));
    };
    ArrayGridSettings settings;
    EXPECT_EQ(of(settings)->tree().leafCount(), 2u); // those that reach out of the array
    EXPECT_EQ(of(settings)->tree().activeTileCount(), 2u);
    EXPECT_EQ(of(settings)->activeVoxelCount(), 16u * 8 * 12);
    numbers[0] = 4;
    EXPECT_EQ(of(settings)->tree().activeTileCount(), 1u);
    settings.tiles = false;
    EXPECT_EQ(of(settings)->tree().leafCount(), 4u);
    settings.background = 3;
    EXPECT_EQ(of(settings)->activeVoxelCount(), 1u);
}

TEST(ArrayGrid, NotANumberIsBackground)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    ArrayGridSettings settings;
    settings.background = -7;
    const GridBase::Ptr grid = gridOfBytes(bytesOfNumbers(std::vector<float>{nan, 1, -infinity, 0}),
        layoutOf({4, 1, 1}, NumberType::Float32), settings);
    EXPECT_EQ(valueAt<openvdb::FloatGrid>(grid, Coord(0)), -7);
    EXPECT_EQ(valueAt<openvdb::FloatGrid>(grid, Coord(2, 0, 0)), -infinity);
    EXPECT_EQ(grid->activeVoxelCount(), 3u);
}

TEST(ArrayGrid, NotNumbersAreCounted)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto counted = [](const GridBase::Ptr& grid) -> int64_t {
        const auto count = grid->getMetadata<openvdb::Int64Metadata>("nan_values");
        return count ? count->value() : 0;
    };
    std::vector<double> numbers(20 * 20 * 20, 1);
    for (const std::size_t i : {0, 17, 450, 7999}) numbers[i] = nan;
    const ArrayLayout layout = layoutOf({20, 20, 20}, NumberType::Float64);
    EXPECT_EQ(counted(gridOfBytes(bytesOfNumbers(numbers), layout)), 4);
    const std::vector<float> floats(numbers.begin(), numbers.end());
    EXPECT_EQ(
        counted(gridOfBytes(bytesOfNumbers(floats), layoutOf({20, 20, 20}, NumberType::Float32))),
        4);
    std::fill(numbers.begin(), numbers.end(), nan);
    EXPECT_EQ(counted(gridOfBytes(bytesOfNumbers(numbers), layout)), 8000) << "and nothing else";
    EXPECT_EQ(
        counted(gridOfBytes(std::string(8, '\0'), layoutOf({1, 1, 1}, NumberType::Float64))), 0);
}

TEST(ArrayGrid, ScaledNumbersAreFloats)
{
    ArrayLayout layout = layoutOf({3, 1, 1}, NumberType::UInt8);
    layout.slope = 0.5;
    layout.intercept = -1;
    const GridBase::Ptr grid = gridOfBytes(std::string("\0\2\5", 3), layout);
    EXPECT_EQ(valueAt<openvdb::FloatGrid>(grid, Coord(0)), -1);
    EXPECT_EQ(valueAt<openvdb::FloatGrid>(grid, Coord(2, 0, 0)), 1.5);
    EXPECT_EQ(grid->activeVoxelCount(), 2u); // -1, 0 (the background), 1.5
    const GridBase::Ptr zeros = gridOfBytes(std::string(3, '\0'), layout);
    EXPECT_EQ(zeros->activeVoxelCount(), 3u); // all of them -1
}

TEST(ArrayGrid, BoolsMayHaveAnyByteForTrue)
{
    const GridBase::Ptr grid =
        gridOfBytes(std::string("\0\1\2\xff", 4), layoutOf({4, 1, 1}, NumberType::Bool));
    EXPECT_TRUE(grid->isType<openvdb::BoolGrid>());
    EXPECT_EQ(grid->activeVoxelCount(), 3u);
}

/// By its definition, in integers: sign, 5 bits of exponent, 10 of fraction.
TEST(ArrayGrid, HalfFloatsAreExact)
{
    for (uint32_t bits = 0; bits < 0x10000; ++bits) {
        const int exponent = int(bits >> 10 & 31), fraction = int(bits & 1023);
        const double sign = bits >> 15 ? -1 : 1;
        const float found = fromHalf(uint16_t(bits));
        if (exponent == 31 && fraction) {
            EXPECT_TRUE(std::isnan(found)) << bits;
        } else if (exponent == 31) {
            EXPECT_EQ(found, sign * std::numeric_limits<double>::infinity()) << bits;
        } else {
            const double whole = exponent ? 1 + fraction / 1024.0 : fraction / 1024.0;
            EXPECT_EQ(found, sign * whole * std::pow(2.0, std::max(exponent, 1) - 15)) << bits;
        }
    }
}

std::string errorOf(const ArrayLayout& layout, uint64_t held, bool deflated)
{
    try {
        requireSides(layout);
        requireHeld(layout, held, deflated);
    } catch (const openvdb::IoError& error) {
        return error.what();
    }
    return {};
}

TEST(ArrayGrid, AFileThatCannotHoldItsArrayIsRefusedBeforeMemoryIsTaken)
{
    const ArrayLayout layout = layoutOf({100, 100, 1000}, NumberType::Float64); // 80 MB
    EXPECT_EQ(errorOf(layout, 80000000, false), "");
    EXPECT_NE(errorOf(layout, 79999999, false), "");
    EXPECT_NE(errorOf(layout, 80000001, false), "");
    EXPECT_EQ(errorOf(layout, 80000000 / 1032, true), "");
    EXPECT_NE(errorOf(layout, 80000000 / 1032 - 65, true), "");
    EXPECT_NE(errorOf(layoutOf({0, 5, 5}, NumberType::Int8), 0, false), "");
    const uint64_t most = ArrayLayout::kMaxSide;
    EXPECT_NE(errorOf(layoutOf({most, most, most + 1}, NumberType::Int8), 0, true), "");
    EXPECT_NE(errorOf(layoutOf({most, most, most}, NumberType::Float64), 1 << 30, false), "");
}

std::string textAs(NumberType type, const std::string& text, std::size_t count)
{
    std::istringstream stream(text);
    TextNumbers source(stream, type);
    std::string bytes(count * std::size_t(bytesOf(type)), '\0');
    source.read(reinterpret_cast<uint8_t*>(bytes.data()), bytes.size());
    source.finish();
    return bytes;
}

TEST(ArrayGrid, TextIsNumbersWithBlanksOrCommasBetween)
{
    EXPECT_EQ(
        textAs(NumberType::Int16, " 1,-2\n\t 300 ", 3), bytesOfNumbers<int16_t>({1, -2, 300}));
    EXPECT_EQ(textAs(NumberType::Float32, "1e-3 -.5 inf", 3),
        bytesOfNumbers<float>({1e-3f, -.5f, std::numeric_limits<float>::infinity()}));
    for (const char* text : {"", "1 2", "1 2 3 4", "1 2 x", "1 2 70000", "1 2 3.5", "1 2 0x3"}) {
        EXPECT_THROW(textAs(NumberType::Int16, text, 3), openvdb::IoError) << text;
    }
    EXPECT_THROW(textAs(NumberType::Int16, std::string(100000, '1'), 1), openvdb::IoError);
}

std::string gzipped(const std::string& bytes)
{
    z_stream zlib{};
    EXPECT_EQ(deflateInit2(&zlib, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string out(deflateBound(&zlib, uLong(bytes.size())), '\0');
    zlib.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    zlib.avail_in = uInt(bytes.size());
    zlib.next_out = reinterpret_cast<Bytef*>(out.data());
    zlib.avail_out = uInt(out.size());
    EXPECT_EQ(deflate(&zlib, Z_FINISH), Z_STREAM_END);
    out.resize(zlib.total_out);
    deflateEnd(&zlib);
    return out;
}

TEST(ArrayGrid, AGzipStreamMayHaveSeveralMembers)
{
    const auto read = [](const std::string& bytes) {
        std::istringstream stream(bytes);
        InflatedBytes source(stream, InflatedBytes::Wrapper::Gzip);
        std::string out(6, '\0');
        source.read(reinterpret_cast<uint8_t*>(out.data()), out.size());
        source.finish();
        return out;
    };
    const std::string two = gzipped("abcd") + gzipped("ef");
    EXPECT_EQ(read(two), "abcdef");
    EXPECT_THROW(read(two + gzipped("g")), openvdb::IoError);
    EXPECT_THROW(read(two + "g"), openvdb::IoError);
    EXPECT_THROW(read(gzipped("abcde")), openvdb::IoError);
    EXPECT_THROW(read(two.substr(0, two.size() - 1)), openvdb::IoError);
}

} // namespace
