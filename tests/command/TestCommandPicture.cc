// SPDX-License-Identifier: Apache-2.0
// -write picture.png: what is drawn, how large, and from where.

#include "CommandRunner.h"

#include <set>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;

class CommandPicture : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
        ASSERT_EQ(run("-read a.vol -mask -spheretree tree=extended keep=1 name=tree -write t.vdb")
                      .exitCode,
            0);
    }

    /// The bytes of the picture that a line of actions writes, small unless it says otherwise.
    std::string draw(const std::string& actions, const std::string& size = "width=80 height=60")
    {
        const Result result = run(actions + " " + size);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const std::string picture = readText(path("p.png"));
        std::filesystem::remove(path("p.png"));
        EXPECT_EQ(picture.substr(0, 8), "\x89PNG\r\n\x1a\n");
        return picture;
    }

    /// A number of the header, from the byte at which it stands.
    static int number(const std::string& picture, size_t at)
    {
        int value = 0;
        for (size_t i = at; i < at + 4; ++i) value = 256 * value + uint8_t(picture.at(i));
        return value;
    }
};

TEST_F(CommandPicture, HasTheSizeAskedFor)
{
    const std::string picture = draw("-read a.vol -write p.png", "width=90 height=7");
    EXPECT_EQ(number(picture, 16), 90);
    EXPECT_EQ(number(picture, 20), 7);
    const std::string usual = draw("-read a.vol -write p.png", "");
    EXPECT_EQ(number(usual, 16), 1280);
    EXPECT_EQ(number(usual, 20), 960);
}

TEST_F(CommandPicture, ShowsTheTreeRatherThanGridsAndWhatVdbChooses)
{
    const std::string tree = draw("-read t.vdb grids=tree -write p.png");
    const std::string object = draw("-read a.vol -write p.png");
    EXPECT_NE(tree, object);
    EXPECT_EQ(draw("-read t.vdb -write p.png"), tree);
    EXPECT_EQ(draw("-read t.vdb -write p.png vdb=1"), object) << "the mask is the older one";
    EXPECT_EQ(draw("-read t.vdb -write p.png vdb=tree"), tree);
}

TEST_F(CommandPicture, EveryOptionMakesADifference)
{
    const std::string tree = "-read t.vdb -write p.png vdb=tree ";
    const std::string usual = draw(tree);
    EXPECT_EQ(draw(tree + "level=0 color=parent fov=30 up=0,1,0"), usual);
    for (const char* option : {"level=1", "color=id", "color=1,0.5,0", "color=level", "fov=50",
             "eye=30,20,9", "lookat=0,0,0", "up=0,0,1"}) {
        EXPECT_NE(draw(tree + option), usual) << option;
    }
}

TEST_F(CommandPicture, ShowsTheBallsOfEveryDistance)
{
    std::set<std::string> pictures;
    for (const char* dist : {"l2", "l1", "linf", "chamfer:3,4,5"}) {
        pictures.insert(draw("-read a.vol -spheretree tree=extended dist=" + std::string(dist)
            + " errors=0 topology=0 -write p.png"));
    }
    EXPECT_EQ(pictures.size(), 4u);
}

TEST_F(CommandPicture, FlatObjectsAreSeenByAnOrthographicCamera)
{
    writeVol("f.vol", openvdb::Coord(9, 7, 1), std::string(63, '\1'));
    const std::string tree = "-read f.vol -spheretree dim=2 spheres=3 q=fast -write p.png ";
    const std::string usual = draw(tree);
    EXPECT_EQ(draw(tree + "fov=0"), usual);
    EXPECT_NE(draw(tree + "fov=30"), usual);
    EXPECT_EQ(draw("-read f.vol -write p.png fov=0"), draw("-read f.vol -write p.png"));
}

TEST_F(CommandPicture, AJpegIsWrittenByItsName)
{
    const std::string line = "-read t.vdb -write p.JPG p.jpeg width=80 height=60 vdb=tree";
    const Result result = run(line);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readText(path("p.JPG")).substr(0, 3), "\xFF\xD8\xFF");
    EXPECT_EQ(readText(path("p.JPG")), readText(path("p.jpeg")));
}

TEST_F(CommandPicture, IsTheSameForAnyNumberOfThreads)
{
    const std::string one = draw("-threads 1 -read t.vdb -write p.png vdb=tree");
    EXPECT_EQ(draw("-threads 4 -read t.vdb -write p.png vdb=tree"), one);
}

TEST_F(CommandPicture, ACameraThatOnlyTheObjectProvesWrongWritesNothing)
{
    const auto before = files();
    // The block's voxels are (0,0,0) to (7,5,4).
    const Result same = run("-read a.vol -write u.vdb p.png eye=3.5,2.5,2");
    EXPECT_EQ(same.exitCode, 2) << same.err;
    EXPECT_NE(same.err.find("eye and lookat are the same point"), std::string::npos) << same.err;
    const Result along = run("-read a.vol -write u.vdb p.png eye=3.5,99,2");
    EXPECT_EQ(along.exitCode, 2) << along.err;
    EXPECT_NE(along.err.find("up="), std::string::npos) << along.err;
    // The camera would move with it, and be rounded to the very point.
    const Result far = run("-read a.vol -write u.vdb p.png lookat=1e30,0,1e30");
    EXPECT_EQ(far.exitCode, 2) << far.err;
    EXPECT_NE(far.err.find("lookat=1e30,0,1e30 is too far"), std::string::npos) << far.err;
    EXPECT_EQ(files(), before);
}

TEST_F(CommandPicture, IsDrawnFromAsFarAsACameraMayStand)
{
    for (const char* camera : {"eye=1e100,0,0", "eye=1e100,0,0 lookat=-1e100,0,9 up=0,1e-100,0",
             "lookat=1e6,0,0", "fov=0.001", "fov=179.999"}) {
        draw("-read t.vdb -write p.png vdb=tree " + std::string(camera));
        draw("-read a.vol -write p.png " + std::string(camera));
    }
}

} // namespace
