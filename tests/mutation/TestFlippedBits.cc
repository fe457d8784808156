// SPDX-License-Identifier: Apache-2.0
/// @file TestFlippedBits.cc
/// @brief Any bit that flips in a file of the command's own is found, in masks and unused groups too:
/// its identifier is a digest of the rest.

#include "inputs/InputReader.h"
#include "inputs/VdbSamples.h"
#include "support/TemporaryFolder.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <base/Errors.h>
#include <files/VdbStream.h>
#include <files/VdbTag.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <set>
#include <streambuf>
#include <string>
#include <vector>

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

TEST(FlippedBits, NothingMayFollowBehindTheLastGrid)
{
    const std::string bytes = fileOf(sampleObject());
    InputReader reader(".vdb");
    EXPECT_TRUE(reader.read(bytes));
    EXPECT_FALSE(reader.read(bytes + "x"));
    EXPECT_FALSE(reader.read(bytes + "x", /*delayed=*/true));
}

/// @return what readVdb() says of each file with a flipped bit in one of its bytes, each once. Zeros are left out: most of
///         them are masks of upper nodes.
std::set<std::string> wordsOnFlips(const std::string& bytes)
{
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/flipped.vdb";
    std::mt19937 random(5);
    std::set<std::string> words;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] == 0) continue;
        std::string flipped = bytes;
        flipped[i] = char(flipped[i] ^ 1 << random() % 8);
        std::ofstream(path, std::ios::binary) << flipped;
        try {
            command::readVdb(path);
            ADD_FAILURE() << "byte " << i;
        } catch (const command::CommandError& error) {
            words.insert(error.what());
        }
    }
    return words;
}

/// What is only known when the grids are read, and by the tree's own checksums.
void expectPartsNamed(const std::set<std::string>& words, const std::vector<std::string>& parts)
{
    for (const std::string& part : parts) {
        EXPECT_TRUE(std::any_of(words.begin(), words.end(), [&](const std::string& word) {
            return word.find("by the digest in its header: " + part) != std::string::npos;
        })) << part;
    }
}

TEST(FlippedBits, AreToldByThePartOfTheTreeThatTheyAreIn)
{
    const std::string bySum = ": by its checksum it is not as it was written: ";
    const std::string elsewhere = "its trees are whole by their own checksums";
    const auto object = openvdb_spheretree::objectOf(*sampleObject());
    openvdb_spheretree::SphereTreeSettings settings = openvdb_spheretree::ExtendedOptions();
    settings.topology = false;
    settings.name = "t";
    settings.pyramid().dag = true;
    const auto extended = openvdb_spheretree::buildSphereTree(*object, settings);
    const auto nodes = openvdb_spheretree::toPoints(extended);
    const std::string node = "point grid 't' is a damaged sphere-tree" + bySum;
    const std::string edge = "point grid 't_dag' is a damaged Sphere-DAG" + bySum;
    expectPartsNamed(
        wordsOnFlips(vdbBytes({nodes, openvdb_spheretree::dagToPoints(extended)}, kBlosc,
            /*seekable=*/true, Saver::Command)),
        {node + "'", node + "its metadata", edge + "'edges' changed", edge + "its metadata",
            elsewhere});
    openvdb_spheretree::TightOptions tight;
    tight.cuts = true;
    settings.kind = tight;
    const auto cut = openvdb_spheretree::buildSphereTree(*object, settings);
    const std::string cuts = "point grid 't_cuts' is a damaged list of cuts" + bySum;
    expectPartsNamed(wordsOnFlips(vdbBytes(
                         {openvdb_spheretree::toPoints(cut), openvdb_spheretree::cutsToPoints(cut)},
                         kBlosc, /*seekable=*/true, Saver::Command)),
        {node + "'", node + "its metadata", cuts + "'", cuts + "its metadata", elsewhere});
}

/// A source that has its bytes at hand piece by piece, as a pipe has.
class Pieces : public std::streambuf {
public:
    explicit Pieces(std::vector<std::string> pieces) : mPieces(std::move(pieces)) {}

protected:
    int_type underflow() override
    {
        if (mNext == mPieces.size()) return traits_type::eof();
        std::string& piece = mPieces[mNext++];
        setg(piece.data(), piece.data(), piece.data() + piece.size());
        return traits_type::to_int_type(*gptr());
    }

private:
    std::vector<std::string> mPieces;
    std::size_t mNext = 0;
};

TEST(FlippedBits, NorWhatComesWhenAllGridsAreRead)
{
    std::string bytes = std::string(command::kTagOffset, 'h') + std::string(command::kTagSize, '0')
        + "nodes and values";
    command::FileDigest digest;
    digest.add(bytes.data(), bytes.size());
    bytes.replace(command::kTagOffset, command::kTagSize, digest.tag());
    const auto isUnchanged = [&](const std::vector<std::string>& pieces) {
        Pieces source(pieces);
        command::TagReader reader(source);
        std::string read(bytes.size(), '\0');
        reader.sgetn(read.data(), std::streamsize(read.size()));
        EXPECT_EQ(read, bytes);
        return reader.isUnchanged();
    };
    EXPECT_TRUE(isUnchanged({bytes}));
    EXPECT_TRUE(isUnchanged({bytes.substr(0, 30), bytes.substr(30)}));
    EXPECT_FALSE(isUnchanged({bytes, "more"}));
}

TEST(FlippedBits, InAFileThatOpenVdbHasSavedAreItsOwnAffair)
{
    // What nobody reads: no digest, and no value that would be wrong.
    std::string bytes = vdbBytes({sampleObject()}, kBlosc);
    bytes[command::kTagOffset] = bytes[command::kTagOffset] == '1' ? '2' : '1';
    EXPECT_TRUE(InputReader(".vdb").read(bytes));
}

TEST(FlippedBits, ADigestIsTheSameInAnyPiecesAndOfEveryByte)
{
    std::string bytes(1003, '\0'); // the last word is not complete
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
    std::string longer = bytes + '\0', other = bytes;
    other.back() = char(other.back() ^ 1);
    for (const std::string& changed : {longer, other}) {
        command::FileDigest digest;
        digest.add(changed.data(), changed.size());
        EXPECT_NE(digest.tag(), whole.tag());
    }
}

} // namespace
