// SPDX-License-Identifier: Apache-2.0
// Input that is missing, damaged or of the wrong kind: exit code 3, a message that names the file,
// and nothing written.

#include "CommandRunner.h"

#include "support/PointGrids.h"

#include <openvdb/io/File.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>

#include <limits>
#include <set>

namespace {

using command_test::CommandTest;
using command_test::Result;
using openvdb::points::PointDataGrid;

class CommandInput : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        command_test::writeText(path("t.vdb"), "precious");
    }

    void expectInputError(const std::string& arguments, const std::string& message) const
    {
        const auto before = files();
        const Result result = run(arguments);
        EXPECT_EQ(result.exitCode, 3) << arguments << "\n" << result.err;
        EXPECT_NE(result.err.find(message), std::string::npos) << arguments << "\n" << result.err;
        EXPECT_LT(result.err.size(), 3000u);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(files(), before) << arguments;
        EXPECT_EQ(command_test::readText(path("t.vdb")), "precious");
    }

    /// A vol file with this header in place of the right one; 240 values follow.
    void writeVolWith(const std::string& name, const std::string& header) const
    {
        command_test::writeText(path(name), header + ".\n" + std::string(240, '\1'));
    }

    openvdb::points::PointDataGrid::Ptr makeTree() const
    {
        writeBlock("source.vol");
        EXPECT_EQ(run("-read source.vol -spheretree -write source.vdb").exitCode, 0);
        return openvdb::gridPtrCast<PointDataGrid>(readGrids("source.vdb").at(0));
    }

    /// Sets one attribute of every point.
    template <typename Value>
    void damage(PointDataGrid& points, const std::string& attribute, Value value) const
    {
        for (auto leaf = points.tree().beginLeaf(); leaf; ++leaf) {
            auto handle = openvdb::points::AttributeWriteHandle<Value>::create(
                leaf->attributeArray(attribute));
            for (openvdb::Index i = 0; i < handle->size(); ++i) handle->set(i, value);
        }
    }
};

TEST_F(CommandInput, MissingFile)
{
    expectInputError("-read nowhere.vdb -spheretree -write t.vdb", "nowhere.vdb");
    expectInputError("-read nowhere.vol -spheretree -write t.vdb", "nowhere.vol");
    expectInputError("-read nowhere.obj -mesh2ls -spheretree -write t.vdb", "nowhere.obj");
}

TEST_F(CommandInput, AFileWithoutGrids)
{
    openvdb::io::File(path("none.vdb").string()).write(openvdb::GridPtrVec());
    expectInputError("-read none.vdb", "none.vdb: the file holds no grid");
}

TEST_F(CommandInput, AMissingFileIsFoundBeforeAnyWork)
{
    writeBlock("a.vol");
    const Result result = run("-read a.vol -spheretree -write b.vdb -read nowhere.vol");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_FALSE(exists("b.vdb"));
}

TEST_F(CommandInput, AFolderOrAnUnknownExtension)
{
    std::filesystem::create_directory(path("folder.vdb"));
    command_test::writeText(path("a.txt"), "text");
    expectInputError("-read folder.vdb -spheretree -write t.vdb", "folder.vdb");
    expectInputError("-read a.txt -spheretree -write t.vdb", "a.txt");
}

TEST_F(CommandInput, AVdbThatIsNone)
{
    command_test::writeText(path("empty.vdb"), "");
    command_test::writeText(path("text.vdb"), std::string(5000, 'x'));
    expectInputError("-read empty.vdb -spheretree -write t.vdb", "empty.vdb");
    expectInputError("-read text.vdb -spheretree -write t.vdb", "text.vdb");
}

TEST_F(CommandInput, AVdbTruncatedAnywhere)
{
    writeGrids("whole.vdb", {sphereGrid("ball", 2)});
    ASSERT_EQ(run("-read whole.vdb -spheretree").exitCode, 0);
    const std::string whole = command_test::readText(path("whole.vdb"));
    // Each length of the headers, then in steps that are no multiple of anything.
    for (size_t length = 0; length < whole.size();
         length += length < 700 ? 23 : 1 + whole.size() / 41) {
        command_test::writeText(path("cut.vdb"), whole.substr(0, length));
        SCOPED_TRACE(length);
        expectInputError("-read cut.vdb -spheretree -write t.vdb", "cut.vdb");
        expectInputError("-read cut.vdb delayed=1 -spheretree -write t.vdb", "cut.vdb");
    }
    command_test::writeText(path("cut.vdb"), whole.substr(0, whole.size() - 1));
    expectInputError("-read cut.vdb -spheretree -write t.vdb", "cut.vdb");
    expectInputError("-read cut.vdb delayed=1 -spheretree -write t.vdb", "cut.vdb");
}

TEST_F(CommandInput, ValuesThatAreDamagedAndStillInTheFile)
{
    writeGrids("damaged.vdb", {sphereGrid("ball")});
    std::string bytes = command_test::readText(path("damaged.vdb"));
    for (size_t i = bytes.size() / 2; i < bytes.size(); ++i) bytes[i] = '\x55';
    command_test::writeText(path("damaged.vdb"), bytes);
    for (const char* action : {"-spheretree -write t.vdb", "-mask -write t.vdb", "-write t.png"}) {
        expectInputError(std::string("-read damaged.vdb delayed=1 ") + action, "damaged.vdb");
    }
}

TEST_F(CommandInput, ATruncatedPipe)
{
    writeGrids("whole.vdb", {sphereGrid("ball", 2)});
    const Result result =
        shell("head -c 9000 whole.vdb | $VDB_SPHERETREE -read stdin.vdb -spheretree -write t.vdb");
    EXPECT_EQ(result.exitCode, 3) << result.err;
    EXPECT_NE(result.err.find("stdin.vdb"), std::string::npos);
    EXPECT_EQ(command_test::readText(path("t.vdb")), "precious");
}

TEST_F(CommandInput, AGridWithAnotherNumberOfVoxelsThanTheFileSays)
{
    auto grid = sphereGrid("ball");
    grid->insertMeta("file_voxel_count", openvdb::Int64Metadata(7));
    openvdb::io::File file(path("lies.vdb").string());
    file.setGridStatsMetadataEnabled(false);
    file.write(openvdb::GridPtrVec{grid});
    file.close();
    expectInputError("-read lies.vdb -spheretree -write t.vdb", "lies.vdb: grid 'ball'");
}

TEST_F(CommandInput, AVolWhoseHeaderLies)
{
    const std::string tail = "\nVersion: 2\n";
    const std::vector<std::pair<std::string, std::string>> headers = {
        {"negative", "X: -8\nY: 6\nZ: 5"}, {"zero", "X: 8\nY: 0\nZ: 5"},
        {"overflowing", "X: 4294967296\nY: 4294967296\nZ: 4294967296"},
        {"more", "X: 8\nY: 6\nZ: 6"}, {"muchmore", "X: 2000\nY: 2000\nZ: 2000"},
        {"missing", "X: 8\nY: 6"}, {"noNumber", "X: 8\nY: six\nZ: 5"}};
    for (const auto& [name, header] : headers) {
        writeVolWith(name + ".vol", header + tail);
        expectInputError("-read " + name + ".vol -spheretree -write t.vdb", name + ".vol");
    }
}

TEST_F(CommandInput, ATruncatedVolOrLongvol)
{
    writeBlock("a.vol");
    const std::string whole = command_test::readText(path("a.vol"));
    for (const size_t length : {size_t(0), size_t(5), size_t(40), whole.size() - 1}) {
        command_test::writeText(path("cut.vol"), whole.substr(0, length));
        expectInputError("-read cut.vol -spheretree -write t.vdb", "cut.vol");
    }
    command_test::writeText(path("cut.longvol"), whole);
    expectInputError("-read cut.longvol -spheretree -write t.vdb", "cut.longvol");
}

TEST_F(CommandInput, AMeshThatIsNone)
{
    command_test::writeText(path("bad.obj"), "v 0 0 0\nf 1 2 3\n");
    command_test::writeText(path("bad.ply"), "ply\nformat ascii 1.0\nelement vertex 9\n");
    command_test::writeText(path("empty.obj"), "");
    expectInputError("-read bad.obj -mesh2ls -spheretree -write t.vdb", "bad.obj");
    expectInputError("-read bad.ply -mesh2ls -spheretree -write t.vdb", "bad.ply");
    expectInputError("-read empty.obj -mesh2ls -spheretree -write t.vdb", "empty.obj");
}

TEST_F(CommandInput, AMeshNeedsALevelSetFirst)
{
    command_test::writeText(
        path("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    expectInputError("-read a.obj -spheretree -write t.vdb", "put -mesh2ls before");
    EXPECT_EQ(run("-read a.obj -mesh2ls dim=20 -spheretree -write u.vdb").exitCode, 0);
}

TEST_F(CommandInput, AnEmptyObject)
{
    writeVol("none.vol", {4, 4, 4}, std::string(64, '\0'));
    auto grid = openvdb_spheretree::detail::makeGrid<openvdb::FloatGrid>();
    grid->setName("hollow");
    writeGrids("none.vdb", {grid});
    expectInputError("-read none.vol -spheretree -write t.vdb", "none");
    expectInputError("-read none.vdb -spheretree -write t.vdb", "hollow");
    writeBlock("a.vol");
    expectInputError("-read a.vol -mask threshold=9 -spheretree -write t.vdb", "-mask");
}

TEST_F(CommandInput, VoxelsThatAreNotUniform)
{
    auto grid = sphereGrid("flat");
    auto transform = openvdb::math::Transform::createLinearTransform(1);
    transform->preScale(openvdb::Vec3d(1, 1, 2));
    grid->setTransform(transform);
    writeGrids("flat.vdb", {grid});
    expectInputError("-read flat.vdb -spheretree -write t.vdb", "flat");
}

TEST_F(CommandInput, AGridOfTheWrongKind)
{
    auto grid = openvdb_spheretree::detail::makeGrid<openvdb::Vec3SGrid>();
    grid->tree().setValue(openvdb::Coord(0), openvdb::Vec3s(1));
    grid->setName("velocity");
    writeGrids("v.vdb", {grid});
    expectInputError("-read v.vdb -spheretree -write t.vdb", "'velocity'");
    expectInputError("-read v.vdb -stats", "needs a sphere-tree");
}

TEST_F(CommandInput, OneGridOfSeveralHasToBeChosen)
{
    writeGrids("two.vdb", {sphereGrid("one"), sphereGrid("other")});
    expectInputError("-read two.vdb -spheretree -write t.vdb", "'one'");
    expectInputError("-read two.vdb -spheretree -write t.vdb", "'other'");
    expectInputError(
        "-read two.vdb grids=third -spheretree -write t.vdb", "no grid is named 'third'");
    expectInputError("-read two.vdb -spheretree vdb=third -write t.vdb", "no 'third'");
    expectInputError("-read two.vdb -spheretree vdb=2 -write t.vdb", "no '2'");
    EXPECT_EQ(run("-read two.vdb grids=other -spheretree -write a.vdb").exitCode, 0);
    EXPECT_EQ(run("-read two.vdb -spheretree vdb=other -write b.vdb vdb=0").exitCode, 0);
    EXPECT_EQ(run("-read two.vdb -spheretree vdb=0 -write c.vdb vdb=spheretree").exitCode, 0);
    EXPECT_EQ(command_test::readText(path("a.vdb")), command_test::readText(path("b.vdb")));
    EXPECT_EQ(command_test::readText(path("a.vdb")), command_test::readText(path("c.vdb")));
}

TEST_F(CommandInput, TheOnlyGridThatSuitsIsTaken)
{
    auto vectors = openvdb_spheretree::detail::makeGrid<openvdb::Vec3SGrid>();
    vectors->tree().setValue(openvdb::Coord(0), openvdb::Vec3s(1));
    vectors->setName("velocity");
    writeGrids("mixed.vdb", {vectors, sphereGrid("ball")});
    EXPECT_EQ(run("-read mixed.vdb -spheretree -write a.vdb vdb=spheretree").exitCode, 0);
}

TEST_F(CommandInput, PointsThatAreNoSphereTree)
{
    const auto points = spheretree_test::pointsAt({{0, 0, 0}, {3, 1, 2}});
    points->setName("dust");
    writeGrids("points.vdb", {points});
    expectInputError("-read points.vdb -stats", "'dust'");
    expectInputError("-read points.vdb -check", "'dust'");
    expectInputError("-read points.vdb -level 0 -write t.vdb", "'dust'");
}

TEST_F(CommandInput, ASphereTreeWithADamagedAttribute)
{
    const auto expectRejected = [&](const std::string& message, const auto& damageIt) {
        auto points = makeTree()->deepCopy();
        damageIt(*points);
        writeGrids("damaged.vdb", {points});
        expectInputError("-read damaged.vdb -write t.vdb", "damaged.vdb");
        expectInputError("-read damaged.vdb -write t.vdb", message);
    };
    expectRejected("parent", [&](auto& p) { damage(p, "parent", int32_t(1000000)); });
    expectRejected("parent", [&](auto& p) { damage(p, "parent", int32_t(0)); });
    expectRejected("level", [&](auto& p) { damage(p, "level", int32_t(5)); });
    expectRejected("pscale", [&](auto& p) { damage(p, "pscale", std::nanf("")); });
    expectRejected("id", [&](auto& p) { damage(p, "id", int32_t(3)); });
}

TEST_F(CommandInput, ALevelThatTheTreeDoesNotHave)
{
    writeBlock("a.vol");
    expectInputError("-read a.vol -spheretree -level 77 -write t.vdb", "77");
    expectInputError("-read a.vol -spheretree -spheres2mask 77 -write t.vdb", "77");
}

TEST_F(CommandInput, APictureOfALevelThatTheTreeDoesNotHave)
{
    writeBlock("a.vol");
    expectInputError("-read a.vol -spheretree -write t.vdb t.png level=77", "no level 77");
}

TEST_F(CommandInput, APictureIsOfOneTreeOrGrid)
{
    writeGrids("two.vdb", {sphereGrid("a"), sphereGrid("b")});
    expectInputError("-read two.vdb -write t.vdb t.png", "choose with vdb=");
    expectInputError("-read two.vdb -spheretree vdb=a name=c -spheretree vdb=b name=d "
                     "-write t.vdb t.png",
        "choose with vdb=");
}

TEST_F(CommandInput, APictureOptionThatSaysNothingAboutAGrid)
{
    writeBlock("a.vol");
    expectInputError("-read a.vol -write t.vdb t.png level=1", "level is for sphere-trees");
    expectInputError("-read a.vol -write t.vdb t.png color=id", "is for sphere-trees");
}

TEST_F(CommandInput, AMaskOptionThatSaysNothingAboutTheGrid)
{
    writeGrids("ls.vdb", {sphereGrid("ball")});
    writeBlock("a.vol");
    expectInputError("-read a.vol -mask iso=0.5 -write t.vdb", "use threshold=");
    expectInputError("-read ls.vdb -mask threshold=0.5 -write t.vdb", "use iso=");
    expectInputError("-read ls.vdb -mask values=1 -write t.vdb", "values is for bool grids");
}

TEST_F(CommandInput, SpheresTooLargeToDraw)
{
    auto far = openvdb::BoolGrid::create();
    far->tree().setValueOn(openvdb::Coord(0, 0, 0));
    far->tree().setValueOn(openvdb::Coord(60000, 0, 0));
    writeGrids("far.vdb", {far});
    expectInputError(
        "-read far.vdb -spheretree tree=extended errors=0 -spheres2mask level=16 -write t.vdb",
        "choose a finer level");
}

TEST_F(CommandInput, ATreeOfAnObjectElsewhereFailsItsCheck)
{
    auto ball = sphereGrid("ball");
    writeGrids("here.vdb", {ball});
    ball->transform().postTranslate(openvdb::Vec3d(1000, 0, 0));
    writeGrids("there.vdb", {ball});
    ASSERT_EQ(run("-read there.vdb -spheretree -write tree.vdb").exitCode, 0);
    EXPECT_EQ(run("-read there.vdb -read tree.vdb -check").exitCode, 0);
    const Result result = run("-read here.vdb -read tree.vdb -check");
    EXPECT_EQ(result.exitCode, 6);
    EXPECT_NE(result.out.find("transform"), std::string::npos) << result.out;
}

TEST_F(CommandInput, GridsThatShareATreeOrANameAreReadAlikeWithAndWithoutDelay)
{
    const auto first = sphereGrid("b"), other = sphereGrid("a", 4);
    const auto copy = first->copy(); // shares the tree
    copy->setName("c");
    const auto namesake = sphereGrid("b", 3);
    writeGrids("many.vdb", {first, other, copy, namesake});
    const auto whole = run("-read many.vdb delayed=0 -print -write whole.vdb");
    const auto delayed = run("-read many.vdb delayed=1 -print -write delayed.vdb");
    EXPECT_EQ(whole.exitCode, 0) << whole.err;
    EXPECT_EQ(delayed.exitCode, 0) << delayed.err;
    for (const Result& result : {whole, delayed}) {
        std::vector<std::string> names;
        for (size_t at = 0; (at = result.out.find("grid '", at)) != std::string::npos; at += 6) {
            names.push_back(result.out.substr(at + 6, 1));
        }
        EXPECT_EQ(names, (std::vector<std::string>{"b", "c", "a", "b"})) << result.out;
    }
    const auto expected = readGrids("whole.vdb"), grids = readGrids("delayed.vdb");
    ASSERT_EQ(grids.size(), 4u);
    std::set<const openvdb::TreeBase*> trees;
    for (size_t i = 0; i < grids.size(); ++i) {
        EXPECT_EQ(grids[i]->getName(), expected[i]->getName());
        EXPECT_EQ(grids[i]->activeVoxelCount(), expected[i]->activeVoxelCount());
        trees.insert(&grids[i]->constBaseTree());
    }
    EXPECT_EQ(trees.size(), 3u) << "one of four is shared";
}

/// OpenVDB warns of such a file, and does so on std::cout.
TEST_F(CommandInput, WarningsOfOpenVdbStayOutOfAFileOnStdout)
{
    writeGrids("later.vdb", {sphereGrid("ball")});
    std::string bytes = command_test::readText(path("later.vdb"));
    bytes[8] = char(openvdb::OPENVDB_FILE_VERSION + 1);
    command_test::writeText(path("later.vdb"), bytes);
    for (const std::string delayed : {"0", "1"}) {
        const Result result =
            run("-quiet -read later.vdb delayed=" + delayed + " -write stdout.vdb");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.out.substr(0, 8), bytes.substr(0, 8)); // the file's magic number
    }
}

TEST_F(CommandInput, StatisticsDoNotReplaceWhatTheyAreOf)
{
    makeTree();
    const std::string tree = command_test::readText(path("source.vdb"));
    for (const std::string line : {"-stats source.vdb", "-stats json=source.vol", "-stats x.ply",
             "-stats csv=source.vdb", "-stats json=x.csv"}) {
        const Result result = run("-read source.vdb " + line);
        EXPECT_EQ(result.exitCode, 2);
        EXPECT_NE(result.err.find("-stats writes .json or .csv"), std::string::npos) << result.err;
    }
    EXPECT_EQ(command_test::readText(path("source.vdb")), tree);
    EXPECT_FALSE(exists("x.ply"));
}

} // namespace
