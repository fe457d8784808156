// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/store/SphereTreeCsv.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"
#include "support/StreamFaults.h"

#include <gtest/gtest.h>
#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <vector>

using namespace openvdb_spheretree;
using namespace spheretree_test;

namespace {

std::string csvOf(const SphereTree& tree)
{
    std::ostringstream out;
    writeCsv(tree, out);
    return out.str();
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

/// Takes everything and loses it when it is to be kept.
class LateFailure : public std::stringbuf {
protected:
    int sync() override { return -1; }
};

} // namespace

TEST(SphereTreeCsv, WritesAHeaderAndARowANodeFromTheTopDown)
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(0.5);
    openvdb_spheretree::ReversibleOptions options;
    options.factor = 3;
    tree.settings = options;
    tree.origin = {-8, 0, 0};
    addLevel(tree, 1, 1);
    addLevel(tree, 2, 2);
    addNode(tree, {-3.5, 4.5, 0.5}, {2, 2, 0}, 3, -1);
    addNode(tree, {-4, 4, 0}, {4, 4, 0}, 1, 0);
    addNode(tree, {-3, 1000, 1}, {5, 1000, 1}, -1, 0);
    tree.spheres.radiusWorld = {2.5f, 0.0f, 1024.0f};
    EXPECT_EQ(csvOf(tree),
        "level,id,parent,x,y,z,radius,i,j,k,radius_sq,scale,origin_i,origin_j,origin_k\n"
        "1,0,-1,-1.75,2.25,0.25,2.5,2,2,0,3,3,-8,0,0\n"
        "0,1,0,-2,2,0,0,-4,4,0,1,1,0,0,0\n"
        "0,2,0,-1.5,500,0.5,1024,-3,1000,1,-1,1,0,0,0\n");
}

TEST(SphereTreeCsv, NumbersReadBackToTheSameDouble)
{
    for (const SphereTree& tree : {sampleTree(), randomTree(3000, 7)}) {
        const std::vector<std::string> lines = split(csvOf(tree), '\n');
        ASSERT_EQ(lines.size(), std::size_t(tree.size()) + 1);
        for (int32_t id = 0; id < tree.size(); ++id) {
            const std::vector<std::string> row = split(lines[id + 1], ',');
            ASSERT_EQ(row.size(), 15u);
            const openvdb::Vec3d center = tree.centerWorld(id);
            EXPECT_EQ(row[1], std::to_string(id));
            EXPECT_EQ(row[2], std::to_string(tree.spheres.parent[id]));
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(std::strtod(row[3 + axis].c_str(), nullptr), center[axis]);
            }
            EXPECT_EQ(std::strtod(row[6].c_str(), nullptr), double(tree.spheres.radiusWorld[id]));
            EXPECT_EQ(row[10], std::to_string(tree.radiusSq[id]));
        }
    }
}

TEST(SphereTreeCsv, TheRadiusIsNeverBelowTheStoredFloat)
{
    // The shortest text that tells 0.1f from other floats is 0.1, as a double less than it.
    SphereTree tree = oneVoxelTree();
    tree.spheres.radiusWorld[0] = 0.1f;
    const std::vector<std::string> row = split(split(csvOf(tree), '\n').at(1), ',');
    EXPECT_EQ(std::strtod(row.at(6).c_str(), nullptr), double(0.1f));
}

TEST(SphereTreeCsv, VoxelsOfLevelZeroAreInTheIndexSpaceOfTheSource)
{
    const std::vector<std::string> row = split(split(csvOf(oneVoxelTree()), '\n').at(1), ',');
    EXPECT_EQ(row.at(7) + ' ' + row.at(8) + ' ' + row.at(9), "-3 4 5");
}

TEST(SphereTreeCsv, TheLocaleOfTheStreamMakesNoDifference)
{
    const SphereTree tree = sampleTree();
    std::ostringstream out;
    out.imbue(std::locale(std::locale::classic(), new GermanNumbers));
    writeCsv(tree, out);
    EXPECT_EQ(out.str(), csvOf(tree));

    const std::locale before =
        std::locale::global(std::locale(std::locale::classic(), new GermanNumbers));
    const std::string text = csvOf(tree);
    std::locale::global(before);
    EXPECT_EQ(text, csvOf(tree));
}

TEST(SphereTreeCsv, KeepsTheNumberOfALevelThatStandsAlone)
{
    const std::vector<std::string> lines = split(csvOf(oneLevelOf(sampleTree(), 1)), '\n');
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[1].substr(0, 7), "1,0,-1,");
    EXPECT_EQ(lines[2].substr(0, 7), "1,1,-1,");
}

TEST(SphereTreeCsv, AFullDiskIsAnError)
{
    const SphereTree tree = randomTree(5000, 8);
    const auto size = std::streamsize(csvOf(tree).size());
    for (std::streamsize room : {std::streamsize(0), std::streamsize(10), size / 2, size - 1}) {
        FullDisk disk(room);
        std::ostream out(&disk);
        messageOf<openvdb::IoError>([&] { writeCsv(tree, out); });
    }
    FullDisk disk(size);
    std::ostream out(&disk);
    EXPECT_NO_THROW(writeCsv(tree, out));
}

TEST(SphereTreeCsv, ADiskThatFailsOnlyAtTheEndIsAnError)
{
    LateFailure disk;
    std::ostream out(&disk);
    const std::string why = messageOf<openvdb::IoError>([&] { writeCsv(oneVoxelTree(), out); });
    EXPECT_TRUE(mentions(why, "is the disk full?"));
}
