// SPDX-License-Identifier: Apache-2.0
// like= of -spheretree: spheres keep their tracks from frame to frame.

#include "CommandRunner.h"

#include "support/Messages.h"

#include <openvdb/openvdb.h>

#include <map>
#include <set>
#include <sstream>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using spheretree_test::mentions;

class CommandTracks : public CommandTest {
protected:
    /// Three balls in a row, the third of which moves away and grows.
    void writeFrame(int frame, double away) const
    {
        const auto grid = openvdb::FloatGrid::create(0);
        grid->setName("body");
        const openvdb::Vec3d centers[] = {{0, 0, 0}, {30, 0, 0}, {60 + away, away / 2, 0}};
        const double radii[] = {14, 11, 9 + away / 8};
        for (int i = 0; i < 3; ++i) {
            const openvdb::Coord middle = openvdb::Coord::round(centers[i]);
            for (int x = -20; x <= 20; ++x) {
                for (int y = -20; y <= 20; ++y) {
                    for (int z = -20; z <= 20; ++z) {
                        const openvdb::Coord ijk = middle.offsetBy(x, y, z);
                        const double distance = (ijk.asVec3d() - centers[i]).length();
                        if (distance <= radii[i]) grid->tree().setValue(ijk, 1.0f);
                    }
                }
            }
        }
        writeGrids("body_" + std::to_string(1000 + frame) + ".vdb", {grid});
    }

    Result runFine(const std::string& line) const
    {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result;
    }

    /// Rows of a .csv as column -> text.
    std::vector<std::map<std::string, std::string>> rowsOf(const std::string& name) const
    {
        return command_test::rowsOfCsv(readText(path(name)));
    }

    std::map<std::string, openvdb::Vec3d> centersByTrack(const std::string& name) const
    {
        std::map<std::string, openvdb::Vec3d> centers;
        for (const auto& row : rowsOf(name)) {
            centers[row.at("track")] = {
                std::stod(row.at("x")), std::stod(row.at("y")), std::stod(row.at("z"))};
        }
        return centers;
    }
};

TEST_F(CommandTracks, SpheresOfASequenceKeepThem)
{
    for (int frame = 0; frame < 6; ++frame) writeFrame(frame, 2.0 * frame);
    runFine("-read body_####.vdb -spheretree spheres=12,3,1 like=previous -check -write t_####.csv "
            "t_####.vdb");
    const auto first = rowsOf("t_1000.csv");
    for (const auto& row : first) EXPECT_EQ(row.at("track"), row.at("id"));
    for (int frame = 1; frame < 6; ++frame) {
        const std::string number = std::to_string(1000 + frame);
        const auto last = centersByTrack("t_" + std::to_string(999 + frame) + ".csv");
        const auto now = centersByTrack("t_" + number + ".csv");
        std::size_t kept = 0;
        for (const auto& [track, center] : now) {
            const auto before = last.find(track);
            if (before == last.end()) continue;
            ++kept;
            EXPECT_LT((center - before->second).length(), 12)
                << "frame " << number << ", track " << track;
        }
        EXPECT_GE(kept + 2, std::min(last.size(), now.size())) << number;
    }
}

TEST_F(CommandTracks, AnObjectThatStaysHasTheSameTreeAndTracks)
{
    for (int frame = 0; frame < 3; ++frame) writeFrame(frame, 3);
    for (const char* const kind :
        {"spheres=12,3,1", "tree=extended", "side=inner spheres=8,2", "spheres=9,2 cuts=1"}) {
        runFine(std::string("-read body_####.vdb -spheretree like=previous ") + kind
            + " -write t_####.csv");
        const std::string first = readText(path("t_1000.csv"));
        EXPECT_TRUE(mentions(first, ",track\n"));
        EXPECT_EQ(readText(path("t_1001.csv")), first) << kind;
        EXPECT_EQ(readText(path("t_1002.csv")), first) << kind;
    }
}

TEST_F(CommandTracks, TheFirstFrameIsTheTreeThatItIsAlone)
{
    writeFrame(0, 3);
    runFine("-read body_1000.vdb -spheretree spheres=12,3,1 like=previous -write a.csv");
    runFine("-read body_1000.vdb -spheretree spheres=12,3,1 -write b.csv");
    const auto with = rowsOf("a.csv"), without = rowsOf("b.csv");
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
        for (const auto& [column, text] : without[i]) EXPECT_EQ(with[i].at(column), text);
    }
    EXPECT_EQ(without.front().count("track"), 0u);
}

TEST_F(CommandTracks, ATreeOfAFileIsFollowed)
{
    writeFrame(0, 0);
    writeFrame(1, 4);
    runFine("-read body_####.vdb -spheretree spheres=12,3,1 like=previous -write t_####.vdb "
            "t_####.csv");
    runFine(
        "-read t_1000.vdb -read body_1001.vdb -spheretree spheres=12,3,1 like=1 -write alone.csv");
    EXPECT_EQ(readText(path("alone.csv")), readText(path("t_1001.csv")));
    runFine("-read t_1000.vdb -read body_1001.vdb -spheretree spheres=12,3,1 like=spheretree "
            "-write named.csv");
    EXPECT_EQ(readText(path("named.csv")), readText(path("t_1001.csv")));
}

TEST_F(CommandTracks, TheyDoNotDependOnThreads)
{
    for (int frame = 0; frame < 3; ++frame) writeFrame(frame, 4.0 * frame);
    const std::string line =
        "-read body_####.vdb -spheretree spheres=40,8,1 quality=fast like=previous -write ";
    runFine("-threads 1 " + line + "a_####.csv");
    runFine("-threads 3 " + line + "b_####.csv");
    for (int frame = 1000; frame < 1003; ++frame) {
        EXPECT_EQ(readText(path("a_" + std::to_string(frame) + ".csv")),
            readText(path("b_" + std::to_string(frame) + ".csv")));
    }
}

TEST_F(CommandTracks, FilesHaveThemForIds)
{
    writeFrame(0, 0);
    writeFrame(1, 9);
    runFine("-read body_####.vdb -spheretree spheres=6,2 like=previous -write t_####.vdb "
            "t_####.csv t_####.ply t_####.swc "
            "t_####.json format=ply-ascii");
    std::set<std::string> tracks, ids;
    for (const auto& row : rowsOf("t_1001.csv")) tracks.insert(row.at("track"));
    std::istringstream ply(readText(path("t_1001.ply")));
    for (std::string line; std::getline(ply, line) && line != "end_header";) {}
    for (std::string x, y, z, radius, level, id, parent;
         ply >> x >> y >> z >> radius >> level >> id >> parent;) {
        ids.insert(id);
    }
    EXPECT_EQ(ids, tracks);
    EXPECT_TRUE(mentions(readText(path("t_1001.json")), "\"cover_sq\", \"track\""));
    EXPECT_TRUE(mentions(readText(path("t_1001.swc")), "\n1 0 ")) << "its ids are places";
    runFine("-read t_1001.vdb -write again.csv");
    EXPECT_EQ(readText(path("again.csv")), readText(path("t_1001.csv")));
}

TEST_F(CommandTracks, ATreeThatIsNotThereIsAnError)
{
    writeFrame(0, 0);
    const Result result = run("-read body_1000.vdb -spheretree spheres=6 like=nobody -write t.csv");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(mentions(result.err, "nobody"));
}

} // namespace
