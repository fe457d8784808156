// SPDX-License-Identifier: Apache-2.0
/// @file TestValueBlock.cc
/// @brief Values of nodes above leaves that no value of their type is: bools beside 0 and 1, tiles of points.

#include <openvdb_spheretree/input/vdb/ValueBlock.h>

#include <openvdb/Exceptions.h>
#include <openvdb/io/Compression.h>
#include <openvdb/version.h>

#include <blosc.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <sstream>
#include <string>

namespace {

using namespace openvdb_spheretree::detail;
namespace io = openvdb::io;

constexpr uint32_t kNodeValues = 4096;
constexpr uint32_t kMaskBytes = kNodeValues / 8;
const char kDamage[] = "has a value that it cannot have";

BlockFormat formatOf(const char* type, uint32_t compression)
{
    BlockFormat format;
    format.fileVersion = openvdb::OPENVDB_FILE_VERSION;
    format.compression = compression;
    format.type = valueTypeOf(type).value();
    return format;
}

/// A length and bytes, as OpenVDB's writer has them.
std::string packed(const std::string& values, uint32_t compression)
{
    std::string bytes(values.size() + 4096, '\0');
    int64_t length = 0;
    if (compression & io::COMPRESS_BLOSC) {
        length = blosc_compress_ctx(
            9, 1, 1, values.size(), values.data(), bytes.data(), bytes.size(), "lz4", 0, 1);
    } else if (compression & io::COMPRESS_ZIP) {
        uLongf count = bytes.size();
        EXPECT_EQ(compress(reinterpret_cast<Bytef*>(bytes.data()), &count,
                      reinterpret_cast<const Bytef*>(values.data()), values.size()),
            Z_OK);
        length = int64_t(count);
    } else {
        return values;
    }
    EXPECT_GT(length, 0);
    return std::string(reinterpret_cast<const char*>(&length), sizeof(length))
        + bytes.substr(0, std::size_t(length));
}

/// @return what is said of a node; empty if it is taken to its end.
std::string saidOf(
    const std::string& bytes, const BlockFormat& format, ValueCare care = ValueCare::Unpacked)
{
    std::stringbuf source(bytes);
    ByteWindow window(source);
    try {
        takeValues(window, format, kNodeValues, /*activeValues=*/0, kMaskBytes, care);
    } catch (const openvdb::IoError& error) {
        return error.what();
    }
    EXPECT_EQ(window.position(), bytes.size());
    return {};
}

struct Case {
    const char* type;
    char good, bad;
};

const Case kCases[] = {{"Tree_bool_5_4_3", 1, 2}, {"Tree_bool_5_4_3", 0, '\xff'},
    {"Tree_mask_5_4_3", 1, 102}, {"Tree_ptdataidx32_5_4_3", 0, 1}};
const uint32_t kCodecs[] = {io::COMPRESS_NONE, io::COMPRESS_ZIP, io::COMPRESS_BLOSC};

} // namespace

TEST(ValueBlock, ValuesThatNoneAreAreFoundInEveryCodec)
{
    for (const Case& one : kCases) {
        for (const uint32_t codec : kCodecs) {
            SCOPED_TRACE(std::string(one.type) + " " + std::to_string(codec));
            const BlockFormat format = formatOf(one.type, codec | io::COMPRESS_ACTIVE_MASK);
            std::string values(kNodeValues * format.type.bytes, one.good);
            const auto block = [&] {
                return char(io::NO_MASK_AND_ALL_VALS) + packed(values, codec);
            };
            EXPECT_EQ(saidOf(block(), format), "");
            for (const std::size_t at : {std::size_t(0), values.size() / 3, values.size() - 1}) {
                values[at] = one.bad;
                EXPECT_NE(saidOf(block(), format).find(kDamage), std::string::npos) << at;
                values[at] = one.good;
            }
        }
    }
}

TEST(ValueBlock, InactiveValuesAreLookedAtToo)
{
    for (const Case& one : kCases) {
        const BlockFormat format =
            formatOf(one.type, io::COMPRESS_BLOSC | io::COMPRESS_ACTIVE_MASK);
        const std::string mask(kMaskBytes, '\x55'), none(sizeof(int64_t), '\0');
        const auto inactive = [&](char value) { return std::string(format.type.bytes, value); };
        for (const char value : {one.good, one.bad}) {
            const std::string blocks[] = {
                char(io::NO_MASK_AND_ONE_INACTIVE_VAL) + inactive(value) + none,
                char(io::MASK_AND_ONE_INACTIVE_VAL) + inactive(value) + mask + none,
                char(io::MASK_AND_TWO_INACTIVE_VALS) + inactive(one.good) + inactive(value) + mask
                    + none};
            for (const std::string& block : blocks) {
                const std::string said = saidOf(block, format);
                EXPECT_EQ(said.empty(), value == one.good) << one.type << " " << int(block[0]);
                EXPECT_EQ(said.find(kDamage) == said.npos, value == one.good) << said;
            }
        }
    }
}

TEST(ValueBlock, OfOtherTypesAnyBytesAreAValue)
{
    for (const char* type : {"Tree_float_5_4_3", "Tree_int32_5_4_3", "Tree_vec3d_5_4_3"}) {
        for (const uint32_t codec : kCodecs) {
            const BlockFormat format = formatOf(type, codec);
            const std::string values(kNodeValues * format.type.bytes, '\xff');
            const std::string block = char(io::NO_MASK_AND_ALL_VALS) + packed(values, codec);
            EXPECT_EQ(saidOf(block, format), "") << type << " " << codec;
        }
    }
}

/// Lengths are right, and what is packed is no such values.
TEST(ValueBlock, WhatCannotBeUnpackedIsDamaged)
{
    for (const uint32_t codec : {io::COMPRESS_ZIP, io::COMPRESS_BLOSC}) {
        const BlockFormat format = formatOf("Tree_bool_5_4_3", codec);
        std::string values;
        for (uint32_t i = 0; i < kNodeValues; ++i) values += char((i * i >> 3) & 1);
        std::string block = char(io::NO_MASK_AND_ALL_VALS) + packed(values, codec);
        EXPECT_EQ(saidOf(block, format), "");
        for (std::size_t i = block.size() - 8; i < block.size(); ++i) block[i] = '\xff';
        EXPECT_NE(saidOf(block, format).find("cannot be unpacked"), std::string::npos) << codec;
        EXPECT_EQ(saidOf(block, format, ValueCare::Length), "") << codec;
    }
}
