// SPDX-License-Identifier: Apache-2.0
/// @file TestFlippedBits.cc
/// @brief Any bit that flips in a file of the command's own is found, in masks and unused groups too:
/// its identifier is a digest of the rest.

#include "inputs/InputReader.h"
#include "inputs/VdbSamples.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <files/VdbTag.h>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace spheretree_test;

std::string fileOf(const openvdb::GridBase::Ptr& grid)
{
    return vdbBytes({grid}, kBlosc, /*seekable=*/true, Saver::Command);
}

std::string treeFile()
{
    openvdb_spheretree::SphereTreeSettings settings;
    settings.topology = false;
    return fileOf(openvdb_spheretree::toPoints(openvdb_spheretree::buildSphereTree(
        *openvdb_spheretree::objectOf(*sampleObject()), settings)));
}

/// Every bit of the header, and one of each further byte.
void expectFlipsFound(const std::string& bytes)
{
    constexpr std::size_t kHeader = command::kTagOffset + command::kTagSize;
    InputReader reader(".vdb");
    ASSERT_TRUE(reader.read(bytes));
    std::mt19937 random(3);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const int bits = i < kHeader ? 8 : 1;
        for (int k = 0; k < bits; ++k) {
            const unsigned bit = bits == 8 ? unsigned(k) : random() % 8;
            std::string flipped = bytes;
            flipped[i] = char(flipped[i] ^ 1 << bit);
            EXPECT_FALSE(reader.read(flipped, i % 2)) << "bit " << bit << " of byte " << i;
        }
    }
}

TEST(FlippedBits, OfATreeAreFound) { expectFlipsFound(treeFile()); }

TEST(FlippedBits, OfAnObjectAreFound) { expectFlipsFound(fileOf(sampleObject())); }

TEST(FlippedBits, InAFileThatOpenVdbHasSavedAreItsOwnAffair)
{
    // What nobody reads: no digest, and no value that would be wrong.
    std::string bytes = vdbBytes({sampleObject()}, kBlosc);
    bytes[command::kTagOffset] = bytes[command::kTagOffset] == '1' ? '2' : '1';
    EXPECT_TRUE(InputReader(".vdb").read(bytes));
}

TEST(FlippedBits, ADigestIsTheSameInAnyPieces)
{
    std::string bytes(1000, '\0');
    std::mt19937 random(4);
    for (char& byte : bytes) byte = char(random());
    command::FileDigest whole;
    whole.add(bytes.data(), bytes.size());
    for (std::size_t piece : {1u, 7u, 8u, 13u, 64u}) {
        command::FileDigest pieces;
        for (std::size_t i = 0; i < bytes.size(); i += piece) {
            pieces.add(bytes.data() + i, std::min(piece, bytes.size() - i));
        }
        EXPECT_EQ(pieces.tag(), whole.tag()) << piece;
    }
    bytes.push_back('\0');
    command::FileDigest longer;
    longer.add(bytes.data(), bytes.size());
    EXPECT_NE(longer.tag(), whole.tag());
}

} // namespace
