// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/base/Checksum.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <zlib.h>

#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree::detail;

TEST(Checksum, IsTheCrc32OfTheTextbook)
{
    const std::string digits = "123456789"; // of which every description gives the sum
    EXPECT_EQ(extendedCrc32(0, digits.data(), digits.size()), 0xcbf43926u);
    EXPECT_EQ(crc32Of<char>(digits.size(), nullptr, [&](std::size_t i) { return digits[i]; }),
        0xcbf43926u);
    EXPECT_EQ(extendedCrc32(0, nullptr, 0), 0u);
    EXPECT_EQ(crc32Of<int32_t>(0, nullptr, [](std::size_t) { return 0; }), 0u);
}

TEST(Checksum, IsThatOfZlibForAnyLengthAndPlaceInMemory)
{
    std::vector<unsigned char> bytes(5000);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = (unsigned char)(i * i * 7 + i / 256);
    std::vector<std::size_t> lengths{1000, 1023, 1024, 1025, 4096, 4900};
    for (std::size_t length = 0; length < 300; ++length) lengths.push_back(length);
    for (std::size_t length : lengths) {
        for (std::size_t begin : {0, 1, 3, 8, 31, 64}) {
            for (uint32_t before : {0u, 0xcbf43926u, 0xffffffffu}) {
                EXPECT_EQ(extendedCrc32(before, bytes.data() + begin, length),
                    uint32_t(crc32(before, bytes.data() + begin, uInt(length))))
                    << length << " bytes from " << begin;
            }
        }
    }
}

TEST(Checksum, IsThatOfOneRunForAnyNumberOfValuesAndThreads)
{
    constexpr std::size_t kBlock = 8192;
    std::vector<uint64_t> values(3 * kBlock + 5);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = uint64_t(i * i) << (i % 40);
    for (std::size_t threads : {1, 2, 7}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        for (std::size_t count : {std::size_t(1), std::size_t(511), std::size_t(512),
                 std::size_t(513), kBlock - 1, kBlock, kBlock + 1, 2 * kBlock, values.size()}) {
            EXPECT_EQ(crc32Of<uint64_t>(count, nullptr, [&](std::size_t i) { return values[i]; }),
                extendedCrc32(0, values.data(), count * sizeof(uint64_t)))
                << count << " values, " << threads << " threads";
        }
    }
}

} // namespace
