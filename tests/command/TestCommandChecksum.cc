// SPDX-License-Identifier: Apache-2.0
/// @file TestCommandChecksum.cc
/// @brief The command refuses a tree that is not as it was written, and says of one without a checksum
/// that it cannot know.

#include "CommandRunner.h"
#include "support/DataFolder.h"
#include "support/PointsFiles.h"

#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointDataGrid.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace command_test;
using openvdb::points::PointDataGrid;

/// Of the digest in the header of a .vdb (docs/formats.md).
constexpr std::size_t kTagOffset = 21;

class CommandChecksum : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
        ASSERT_EQ(run("-read a.vol -spheretree cuts=1 name=t -write t.vdb").exitCode, 0);
    }

    /// Writes the grids of t.vdb to u.vdb, one of them changed.
    template <typename Change>
    void change(const std::string& name, const Change& change) const
    {
        const Grids grids = readGrids("t.vdb");
        for (const auto& grid : grids) {
            if (grid->getName() == name) change(*openvdb::gridPtrCast<PointDataGrid>(grid));
        }
        writeGrids("u.vdb", grids);
    }

    /// What every action that needs the tree says of u.vdb.
    void expectRefused(const std::string& text) const
    {
        for (const char* rest : {"-print", "-stats", "-read a.vol -check", "-write v.vdb"}) {
            const Result result = run("-read u.vdb " + std::string(rest));
            EXPECT_EQ(result.exitCode, 3) << rest;
            EXPECT_NE(result.err.find("u.vdb: sphere-tree 't'"), std::string::npos) << result.err;
            EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
        }
        EXPECT_FALSE(exists("v.vdb"));
    }
};

TEST_F(CommandChecksum, ATreeThatIsNotAsItWasWrittenIsRefusedWithThePart)
{
    change("t", [](PointDataGrid& grid) {
        spheretree_test::damage<float>(grid, "pscale", 3, 50.f); // still covers what it covered
    });
    expectRefused("damaged sphere-tree: by its checksum it is not as it was written: 'pscale'");
    change("t_cuts",
        [](PointDataGrid& grid) { spheretree_test::damage<double>(grid, "radius", 2, 9.0); });
    expectRefused("damaged list of cuts: by its checksum it is not as it was written: 'radius'");
    change("t", [](PointDataGrid& grid) { grid.removeMeta("spheretree_level_0_covered"); });
    expectRefused("its metadata");
    change("t", [](PointDataGrid& grid) { grid.transform().postTranslate({1, 0, 0}); });
    expectRefused("its transform is not the one it was written with");
}

TEST_F(CommandChecksum, ABitThatFlippedInTheFileIsNamedByThePartItIsIn)
{
    ASSERT_EQ(run("-generate ball voxels=1000 name=blob -read t.vdb -write both.vdb").exitCode, 0);
    const std::string whole = readText(path("both.vdb"));
    const std::string int64 = "int64", int32 = "int32";
    const auto valueOf = [&](const std::string& key, const std::string& type) {
        return whole.find(key) + key.size() + sizeof(uint32_t) + type.size() + sizeof(uint32_t);
    };
    // A digit of the identifier, which is one after that, too.
    const std::size_t digit = whole.find_first_of("0123456789", kTagOffset);
    const std::string elsewhere = "its trees are whole by their own checksums";
    const std::vector<std::pair<std::size_t, std::string>> flips = {
        {valueOf("spheretree_object_voxels", int64),
            "point grid 't' is a damaged sphere-tree: by its checksum it is not as it was written: "
            "its metadata"},
        {valueOf("spheretree_cuts_nodes", int32),
            "point grid 't_cuts' is a damaged list of cuts: by its checksum it is not as it was "
            "written: its metadata"},
        {digit, elsewhere}, {kTagOffset - 9, elsewhere}, {whole.rfind("blob"), elsewhere}};
    for (const auto& [place, part] : flips) {
        ASSERT_LT(place, whole.size()) << part;
        std::string flipped = whole;
        flipped[place] = char(flipped[place] ^ 1);
        writeText(path("u.vdb"), flipped);
        for (const char* rest : {"", " delayed=1", " -read a.vol -check", " -write v.vdb"}) {
            const Result result = run("-read u.vdb" + std::string(rest));
            EXPECT_EQ(result.exitCode, 3) << place << rest;
            EXPECT_TRUE(mentions(result.err,
                "u.vdb: the file is damaged: it is not what vdb_spheretree wrote, by the digest in "
                "its header: "
                    + part))
                << place << rest << '\n'
                << result.err;
        }
    }
    EXPECT_FALSE(exists("v.vdb"));
}

TEST_F(CommandChecksum, AFileWithoutATreeIsDamagedWhereverItIs)
{
    ASSERT_EQ(run("-read a.vol -mask -write m.vdb").exitCode, 0);
    std::string bytes = readText(path("m.vdb"));
    bytes[kTagOffset] = char(bytes[kTagOffset] ^ 1);
    writeText(path("m.vdb"), bytes);
    const Result result = run("-read m.vdb -print");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(mentions(result.err, "no grid in it has a checksum of its own")) << result.err;
}

/// Two trees in a file, of which the last has lost the names of its checksums: with it, the digest contradicts the file.
TEST_F(CommandChecksum, ATreeWithoutAChecksumIsNotSaidToBeWhole)
{
    for (const std::string name : {"one", "two"}) {
        const std::string line = "-read a.vol -spheretree name=" + name + " -write ";
        ASSERT_EQ(run(line + name + ".vdb").exitCode, 0);
    }
    ASSERT_EQ(run("-read one.vdb two.vdb -write both.vdb").exitCode, 0);
    std::string bytes = readText(path("both.vdb"));
    const std::vector<std::string> said = {
        "those of its trees that have checksums are whole by them;",
        "no grid in it has a checksum of its own"};
    for (const std::string& part : said) {
        for (int key = 0; key < 2; ++key) { // of the attributes, and of the transform
            const std::size_t place = bytes.rfind("spheretree_checksum");
            ASSERT_NE(place, bytes.npos);
            bytes[place] = 'S';
        }
        writeText(path("u.vdb"), bytes);
        const Result result = run("-read u.vdb -print");
        EXPECT_EQ(result.exitCode, 3);
        EXPECT_TRUE(mentions(result.err, part)) << result.err;
    }
}

TEST_F(CommandChecksum, ATreeOfALaterFormatIsRefusedWithWhatToDo)
{
    for (const auto& [name, key] :
        {std::pair{"t", "spheretree_format"}, std::pair{"t_cuts", "spheretree_cuts_format"}}) {
        change(name,
            [key = key](PointDataGrid& grid) { grid.insertMeta(key, openvdb::Int32Metadata(2)); });
        expectRefused("is of format 2, newer than this version reads (1): update");
    }
}

TEST_F(CommandChecksum, ATreeThatWasSavedAgainIsRead)
{
    change("t", [](PointDataGrid& grid) {
        grid.insertMeta("artist", openvdb::StringMetadata("somebody"));
        openvdb::points::appendAttribute<float>(grid.tree(), "weight");
    });
    const Result result = run("-read u.vdb -write u.csv -read t.vdb -write t.csv");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readText(path("u.csv")), readText(path("t.csv")));
    EXPECT_EQ(result.err.find("checksum"), std::string::npos) << result.err;
}

TEST_F(CommandChecksum, ATreeOfVersion01IsReadWithANote)
{
    const std::string end = " has no checksum";
    const std::string folder = spheretree_test::dataPath("0.1/");
    std::ofstream(path("tight.vdb"), std::ios::binary)
        << spheretree_test::unpackedData("0.1/tight.vdb");
    for (const char* rest : {" -print", " -stats", " -level 1 -print", " -check"}) {
        const Result result = run("-read " + folder + "ring.vol tight.vdb" + rest);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_NE(result.err.find("vdb_spheretree: note: sphere-tree 'tight'"), std::string::npos)
            << rest << '\n'
            << result.err;
        EXPECT_NE(result.err.find(end), std::string::npos) << rest << '\n' << result.err;
    }
    const Result again = run("-read tight.vdb -write u.vdb -clear -read u.vdb -stats");
    EXPECT_EQ(again.exitCode, 0) << again.err;
    EXPECT_EQ(again.err.find(end), std::string::npos) << "it has one now: " << again.err;
}

} // namespace
