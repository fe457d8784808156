// SPDX-License-Identifier: Apache-2.0
// Names beyond ASCII in the formats of other tools: kept, refused, or changed with a note.

#include <support/Messages.h>
#include <support/SampleTrees.h>

#include <openvdb_spheretree/export/ExportTree.h>

#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <set>
#include <sstream>

using namespace openvdb_spheretree;
using namespace spheretree_test;

namespace {

const std::string kGrip = "gr\xc3\xbc\xc3\x9f \xe6\x89\x8b \xf0\x9f\xa4\x96";
const std::string kLatin1 = "gr\xfc\xdf";
const std::set<std::string> kXml = {"urdf", "mjcf", "srdf"};
const std::set<std::string> kYaml = {"curobo", "xrdf", "lula"};

struct Written {
    std::string text;
    std::vector<std::string> notes;
};

Written written(const ExportFormat& format, const std::string& name, const std::string& link)
{
    ExportSettings settings;
    settings.name = name;
    settings.links = {link};
    SphereTree tree = randomTree(3, 11);
    tree.transform = openvdb::math::Transform::createLinearTransform(0.25);
    std::ostringstream out;
    const auto notes = exportTree(tree, format, settings, out);
    return {out.str(), notes};
}

std::string why(const ExportFormat& format, const std::string& name, const std::string& link)
{
    return messageOf<openvdb::ValueError>([&] { written(format, name, link); });
}

TEST(ExportNames, NamesInUtf8StayAsTheyAreInXmlAndYaml)
{
    for (const ExportFormat& format : exportFormats()) {
        const bool isXml = kXml.count(format.name) > 0;
        if (!isXml && kYaml.count(format.name) == 0) continue;
        const Written file = written(format, kGrip, kGrip);
        EXPECT_TRUE(mentions(file.text, "\"" + kGrip + "\"")) << format.name << file.text;
        EXPECT_EQ(file.text.find('?', 30), std::string::npos) << format.name;
        for (const std::string& note : file.notes) EXPECT_FALSE(mentions(note, "ASCII")) << note;
    }
}

TEST(ExportNames, NamesInOtherBytesAreRefusedWhereReadersLookForThem)
{
    for (const ExportFormat& format : exportFormats()) {
        if (kXml.count(format.name) + kYaml.count(format.name) == 0) continue;
        if (format.named) {
            EXPECT_TRUE(mentions(why(format, kLatin1, "a"), "UTF-8")) << format.name;
            EXPECT_TRUE(mentions(why(format, kLatin1, "a"), "name=")) << format.name;
        } else {
            EXPECT_NO_THROW(written(format, kLatin1, "a")) << format.name;
        }
        EXPECT_TRUE(mentions(why(format, "a", kLatin1), "UTF-8")) << format.name;
        EXPECT_TRUE(mentions(why(format, "a", kLatin1), "link=")) << format.name;
    }
}

TEST(ExportNames, XmlHoldsEndsOfLinesAndRefusesOtherControls)
{
    for (const ExportFormat& format : exportFormats()) {
        if (kXml.count(format.name) == 0) continue;
        EXPECT_TRUE(
            mentions(written(format, "a\tb\nc\rd\x7f", "a").text, "a&#9;b&#10;c&#13;d\x7f"));
        for (const char* const control :
            {"a\x01", "\x1f", "\xef\xbf\xbe", "\xef\xbf\xbd\xef\xbf\xbf"}) {
            EXPECT_TRUE(mentions(why(format, "a", control), "control characters")) << control;
            EXPECT_TRUE(mentions(why(format, control, "a"), "name=")) << control;
        }
        EXPECT_TRUE(mentions(written(format, "\xef\xbf\xbd", "a").text, "\xef\xbf\xbd"));
    }
}

TEST(ExportNames, ANoteSaysWhatBecomesOfANameWhereAsciiIsAll)
{
    const auto noted = [](const std::vector<std::string>& notes, const std::string& text) {
        for (const std::string& note : notes) {
            if (mentions(note, text)) return true;
        }
        return false;
    };
    const ExportFormat& usd = *findExportFormat(".usda");
    const Written file = written(usd, "gr\xc3\xbcn", "a");
    EXPECT_TRUE(mentions(file.text, "def Xform \"gr__n\""));
    EXPECT_TRUE(noted(file.notes, "'gr__n' for 'gr\xc3\xbcn'"));
    EXPECT_TRUE(noted(written(usd, kLatin1, "a").notes, "'gr__'"));
    EXPECT_TRUE(noted(written(*findExportFormat(".ply"), kLatin1, "a").notes, "'gr__'"));
    EXPECT_FALSE(noted(written(usd, "green one", kLatin1).notes, "ASCII"));
    EXPECT_FALSE(noted(written(*findExportFormat(".vtp"), kLatin1, kLatin1).notes, "ASCII"));
}

TEST(ExportNames, ARobotIsNamedAfterItsFileWhereTheTreeHasNoNameOfItsOwn)
{
    const ExportFormat &urdf = *findExportFormat(".urdf"), &usd = *findExportFormat(".usda");
    SphereTree tree = randomTree(3, 11);
    tree.settings.name = SphereTreeSettings().name;
    EXPECT_EQ(exportNameFor({&tree}, urdf, "a/b.c/" + kGrip + ".urdf"), kGrip);
    EXPECT_EQ(exportNameFor({&tree}, urdf, kLatin1 + ".urdf"), tree.settings.name);
    EXPECT_EQ(exportNameFor({&tree}, urdf, "a\x01.urdf"), tree.settings.name);
    EXPECT_EQ(exportNameFor({&tree}, *findExportFormat(".yml"), "upper arm.yml"), "upper arm");
    EXPECT_EQ(exportNameFor({&tree}, usd, "a.usda"), tree.settings.name);
    tree.settings.name = "arm";
    EXPECT_EQ(exportNameFor({&tree}, urdf, "a.urdf"), "arm");
}

TEST(ExportNames, NamesInGlbAreUtf8)
{
    const ExportFormat& glb = *findExportFormat(".glb");
    EXPECT_TRUE(mentions(written(glb, kGrip, "a").text, kGrip));
    EXPECT_TRUE(mentions(why(glb, kLatin1, "a"), "UTF-8"));
    EXPECT_NO_THROW(written(glb, "a", kLatin1)) << "it has no link";
}

} // namespace
