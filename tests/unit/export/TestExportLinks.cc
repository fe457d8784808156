// SPDX-License-Identifier: Apache-2.0
/// @file TestExportLinks.cc
/// @brief Several trees as the links of one robot.

#include <openvdb_spheretree/export/ExportTree.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

using namespace openvdb_spheretree;
using namespace spheretree_test;

namespace {

SphereTree linkTree(int32_t leaves, double voxel)
{
    SphereTree tree = randomTree(leaves, 11);
    tree.transform = openvdb::math::Transform::createLinearTransform(voxel);
    return tree;
}

/// One link is ten thousand times as large as the other, so its lengths have other decimals.
class ExportLinks : public testing::Test {
protected:
    std::string write(const ExportFormat& format, const std::vector<const SphereTree*>& trees,
        const std::vector<std::string>& links)
    {
        ExportSettings settings;
        settings.links = links;
        settings.name = "robot";
        std::ostringstream out;
        mNotes = exportTrees(trees, format, settings, out);
        return out.str();
    }

    std::string whyNot(const std::string& extension, const std::vector<const SphereTree*>& trees,
        const std::vector<std::string>& links)
    {
        return messageOf<openvdb::ValueError>(
            [&] { write(*findExportFormat(extension), trees, links); });
    }

    SphereTree mHand = linkTree(30, 2e-5), mArm = linkTree(50, 0.2);
    std::vector<std::string> mNotes;
};

std::vector<ExportFormat> formatsOfLinks()
{
    std::vector<ExportFormat> formats;
    for (const ExportFormat& format : exportFormats()) {
        if (format.links) formats.push_back(format);
    }
    return formats;
}

/// @return the lines with numbers of spheres.
std::string spheresOf(const std::string& text)
{
    std::istringstream lines(text);
    std::string spheres;
    for (std::string line; std::getline(lines, line);) {
        if (mentions(line, "radius") || mentions(line, "center: [")) spheres += line + '\n';
    }
    return spheres;
}

} // namespace

TEST_F(ExportLinks, OfPlannersAreThoseThatHoldSeveral)
{
    std::set<std::string> names;
    for (const ExportFormat& format : formatsOfLinks()) {
        EXPECT_TRUE(format.link) << format.name;
        names.insert(format.name);
    }
    EXPECT_EQ(names, (std::set<std::string>{"srdf", "curobo", "xrdf", "lula"}));
}

TEST_F(ExportLinks, EachHasTheSpheresThatItHasInAFileOfItsOwn)
{
    for (const ExportFormat& format : formatsOfLinks()) {
        const std::string hand = spheresOf(write(format, {&mHand}, {"hand"})),
                          arm = spheresOf(write(format, {&mArm}, {"arm"}));
        ASSERT_NE(hand, arm);
        const std::string both = write(format, {&mHand, &mArm}, {"hand", "arm"});
        EXPECT_TRUE(spheresOf(both) == hand + arm) << format.name;
        EXPECT_TRUE(spheresOf(write(format, {&mArm, &mHand}, {"arm", "hand"})) == arm + hand);
    }
}

TEST_F(ExportLinks, ANoteSaysOfWhichLink)
{
    write(*findExportFormat(".srdf"), {&mHand, &mArm}, {"hand", "arm"});
    const auto noted = [&](const std::string& part) {
        return std::any_of(mNotes.begin(), mNotes.end(),
            [&](const std::string& note) { return mentions(note, part); });
    };
    EXPECT_TRUE(noted("srdf holds one level of each link, and gets the finest"));
    EXPECT_FALSE(noted("': srdf holds one level")) << "what holds of all is said once";
    EXPECT_EQ(mNotes.size(), 2u);
    EXPECT_FALSE(noted("link 'hand': srdf is in metres"));
    EXPECT_TRUE(noted("link 'arm': srdf is in metres")) << "it spans 20 m and more";
    write(*findExportFormat(".srdf"), {&mHand}, {"hand"});
    EXPECT_FALSE(noted("link 'hand'"));
}

TEST_F(ExportLinks, AnErrorSaysOfWhichLink)
{
    SphereTree flat = linkTree(1, 0.2); // of one level
    ExportSettings settings;
    settings.links = {"hand", "flat"};
    settings.level = 1;
    std::ostringstream out;
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] {
        exportTrees({&mHand, &flat}, *findExportFormat(".yml"), settings, out);
    }),
        "link 'flat': the tree has no level 1"));
    EXPECT_TRUE(out.str().empty());
}

TEST_F(ExportLinks, AreCalledAsTheirTreesWhereNothingElseIsSaid)
{
    const ExportFormat &srdf = *findExportFormat(".srdf"), &urdf = *findExportFormat(".urdf");
    using Links = std::vector<std::string>;
    mHand.settings.name = "hand";
    mArm.settings.name = SphereTreeSettings().name;
    EXPECT_EQ(linksOf({&mHand, &mArm}, srdf), (Links{"hand", "spheretree"}));
    EXPECT_EQ(linksOf({&mHand}, srdf), Links{"hand"});
    EXPECT_EQ(linksOf({&mHand}, urdf), Links{"object"});
    EXPECT_EQ(linksOf({&mArm}, srdf), Links{"object"});
    EXPECT_TRUE(mentions(write(srdf, {&mHand}, {}), "link=\"hand\""));
}

TEST_F(ExportLinks, OfOneNameOrWithoutAreRefused)
{
    EXPECT_TRUE(mentions(
        whyNot(".yml", {&mHand, &mArm}, {"arm", "arm"}), "two sphere-trees are of the link 'arm'"));
    EXPECT_TRUE(
        mentions(whyNot(".yml", {&mHand, &mArm}, {"arm"}), "link= has 1 name for 2 sphere-trees"));
    EXPECT_TRUE(mentions(
        whyNot(".yml", {&mHand}, {"arm", "hand"}), "link= has 2 names for 1 sphere-tree:"));
    EXPECT_TRUE(mentions(whyNot(".srdf", {&mHand, &mArm}, {"arm", ""}), "names no link"));
    EXPECT_TRUE(mentions(whyNot(".xrdf", {&mHand, &mArm}, {"arm", "\x80"}), "not in UTF-8"));
    EXPECT_TRUE(mentions(whyNot(".urdf", {&mHand, &mArm}, {"arm", "hand"}),
        "urdf holds one sphere-tree, and there are 2"));
}

TEST_F(ExportLinks, OfSeveralTheRobotIsNamedAfterItsFile)
{
    mHand.settings.name = "hand";
    const ExportFormat& format = *findExportFormat(".yml");
    EXPECT_EQ(exportNameFor({&mHand}, format, "robots/panda.yml"), "hand");
    EXPECT_EQ(exportNameFor({&mHand, &mArm}, format, "robots/panda.yml"), "panda");
}
