// SPDX-License-Identifier: Apache-2.0
// What all formats have in common. What each holds is seen by readers of others (tests/readers).

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/export/ExportTree.h>
#include <openvdb_spheretree/export/ExportWriters.h>
#include <openvdb_spheretree/export/GlbFile.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"
#include "support/StreamFaults.h"

#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <locale>
#include <set>
#include <sstream>

using namespace openvdb_spheretree;
using namespace spheretree_test;

namespace {

SphereTree someTree(int32_t leaves = 300)
{
    SphereTree tree = randomTree(leaves, 11);
    tree.transform = openvdb::math::Transform::createLinearTransform(0.25);
    return tree;
}

std::string written(
    const SphereTree& tree, const ExportFormat& format, const ExportSettings& settings = {})
{
    std::ostringstream out;
    exportTree(tree, format, settings, out);
    return out.str();
}

/// All but those whose files would be too large for a tree of this shape.
std::vector<ExportFormat> formats()
{
    std::vector<ExportFormat> all;
    for (const ExportFormat& format : exportFormats()) {
        if (format.name != "sph") all.push_back(format);
    }
    return all;
}

TEST(ExportFormats, EachIsFoundByItsNameAndOneByItsExtension)
{
    std::set<std::string> byExtension;
    for (const ExportFormat& format : exportFormats()) {
        ASSERT_NE(format.write, nullptr) << format.name;
        EXPECT_FALSE(format.readers.empty() || format.keeps.empty()) << format.name;
        for (const std::string& extension : format.extensions) {
            EXPECT_EQ(findExportFormat(extension, format.name), &format) << format.name;
            if (!format.byExtension) continue;
            EXPECT_TRUE(byExtension.insert(extension).second) << extension << " means two formats";
            EXPECT_EQ(findExportFormat(extension), &format);
        }
    }
    EXPECT_EQ(findExportFormat(".urdf", "usd"), nullptr);
    EXPECT_EQ(findExportFormat(".csv"), nullptr) << "it is a table of ours";
    EXPECT_EQ(findExportFormat(""), nullptr);
}

TEST(ExportFormats, BytesDoNotDependOnThreadsOrLocales)
{
    const SphereTree tree = someTree(5000);
    for (const ExportFormat& format : formats()) {
        const std::string bytes = written(tree, format);
        EXPECT_FALSE(bytes.empty());
        for (const std::size_t threads : {1, 3}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            EXPECT_TRUE(written(tree, format) == bytes)
                << format.name << ", " << threads << " threads";
        }
        std::ostringstream german;
        german.imbue(std::locale(std::locale::classic(), new GermanNumbers));
        exportTree(tree, format, {}, german);
        EXPECT_TRUE(german.str() == bytes) << format.name;
    }
}

TEST(ExportFormats, AFullDiskIsAnError)
{
    const SphereTree tree = someTree();
    for (const ExportFormat& format : formats()) {
        const auto size = std::streamsize(written(tree, format).size());
        for (const std::streamsize room : {std::streamsize(0), size / 2, size - 1}) {
            FullDisk disk(room);
            std::ostream out(&disk);
            EXPECT_THROW(exportTree(tree, format, {}, out), openvdb::IoError) << format.name;
        }
    }
}

/// Says yes once the file has been begun.
class StopsWithin : public openvdb::util::NullInterrupter {
public:
    explicit StopsWithin(std::ostream& out) : mOut(out) {}
    bool wasInterrupted(int = -1) override { return mOut.tellp() > 0; }

private:
    std::ostream& mOut;
};

TEST(ExportFormats, WritingIsInterrupted)
{
    const SphereTree tree = someTree(20000);
    for (const ExportFormat& format : formats()) {
        if (format.name == "nanovdb") continue; // in one piece: it is asked before
        std::ostringstream out;
        StopsWithin interrupter(out);
        EXPECT_THROW(exportTree(tree, format, {}, out, &interrupter), Interrupted) << format.name;
        EXPECT_LT(out.str().size(), std::size_t(1) << 17) << format.name;
    }
}

TEST(ExportFormats, NamesCannotBreakOutOfTheirPlace)
{
    const std::string evil = "a\"'<&>\n]}) # b";
    ExportSettings settings;
    settings.name = evil;
    settings.links = {evil};
    const SphereTree tree = someTree(3);
    for (const ExportFormat& format : formats()) {
        const std::string text = written(tree, format, settings);
        EXPECT_EQ(text.find(evil), std::string::npos) << format.name;
        EXPECT_EQ(text.find("<&>\n"), std::string::npos) << format.name;
    }
}

TEST(ExportFormats, NamesInYamlHoldWhatYamlMayHold)
{
    const SphereTree tree = someTree(3);
    ExportSettings settings;
    settings.links = {"a\x7f\xc2\x85\xe2\x80\xa8z\xc3\xa9"};
    ExportSettings tooLong;
    tooLong.links = {std::string(2000, 'x')};
    for (const ExportFormat& format : exportFormats()) {
        if (std::set<std::string>{"curobo", "xrdf", "lula"}.count(format.name) == 0) continue;
        EXPECT_TRUE(
            mentions(written(tree, format, settings), "\"a\\u007f\\u0085\\u2028z\xc3\xa9\""))
            << format.name;
        EXPECT_TRUE(
            mentions(messageOf<openvdb::ValueError>([&] { written(tree, format, tooLong); }),
                "a shorter one"));
    }
}

TEST(ExportFormats, SettingsOutOfRangeAreRefused)
{
    const SphereTree tree = someTree();
    const auto why = [&](const ExportSettings& settings) {
        return messageOf<openvdb::ValueError>(
            [&] { written(tree, *findExportFormat(".urdf"), settings); });
    };
    ExportSettings settings;
    settings.scale = 0;
    EXPECT_TRUE(mentions(why(settings), "scale=0"));
    settings = {};
    settings.density = -1;
    EXPECT_TRUE(mentions(why(settings), "density=-1"));
    settings = {};
    settings.links = {""};
    EXPECT_TRUE(mentions(why(settings), "link="));
    settings = {};
    settings.level = 0;
    settings.spheres = 5;
    EXPECT_TRUE(mentions(why(settings), "exclude each other"));
    settings = {};
    settings.level = 99;
    EXPECT_TRUE(mentions(why(settings), "level 99"));
}

TEST(ExportFormats, SeveralTreesAreSamplesOverTimeWhereThereIsTime)
{
    const SphereTree a = someTree(30), b = someTree(40);
    ExportSettings settings;
    settings.sampleTimes = {101, 104};
    std::ostringstream out;
    exportTrees({&a, &b}, *findExportFormat(".usda"), settings, out);
    const std::string text = out.str();
    EXPECT_TRUE(mentions(text, "startTimeCode = 101\n"));
    EXPECT_TRUE(mentions(text, "endTimeCode = 104\n"));
    EXPECT_TRUE(mentions(text, "point3f[] points.timeSamples = {\n            101: [("));
    EXPECT_TRUE(mentions(text, "\n            104: [("));
    for (const std::vector<double>& times : {std::vector<double>{1}, {2, 2}, {2, 1}, {1, NAN}}) {
        settings.sampleTimes = times;
        EXPECT_THROW(
            exportTrees({&a, &b}, *findExportFormat(".usda"), settings, out), openvdb::ValueError);
    }
    std::ostringstream none;
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] {
        exportTrees({&a, &b}, *findExportFormat(".ply"), {}, none);
    }),
        "ply holds one sphere-tree, and there are 2"));
    EXPECT_TRUE(none.str().empty());
    EXPECT_THROW(exportTrees({}, *findExportFormat(".usda"), {}, none), openvdb::ValueError);
}

TEST(ExportFormats, ACompleteTreeThatWouldExplodeIsRefused)
{
    const ExportFormat& sph = *findExportFormat(".sph");
    const SphereTree tree = someTree();
    EXPECT_EQ(tree.root().size(), 1);
    EXPECT_FALSE(written(someTree(3), sph).empty());
    // One sphere has all children below it, so that each has a place for as many.
    SphereTree wide = someTree(10000);
    const SphereTreeLevel& finest = wide.levels[0];
    for (int32_t id = finest.begin; id < finest.end; ++id) {
        wide.spheres.parent[std::size_t(id)] = wide.levels[1].begin;
    }
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { written(wide, sph); }), "places"));
    ExportSettings settings;
    settings.level = 0;
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { written(tree, sph, settings); }),
        "begins with one sphere"));
}

TEST(ExportFormats, WhatABinaryFileCannotCountIsRefusedBeforeItIsBegun)
{
    constexpr uint64_t kMost = 0xffffffffu;
    EXPECT_NO_THROW(detail::requireStlTriangles(kMost));
    const std::string stl =
        messageOf<openvdb::ValueError>([] { detail::requireStlTriangles(kMost + 1); });
    EXPECT_TRUE(mentions(stl, "4294967296: choose a coarser level with level= or spheres=")) << stl;
    EXPECT_NO_THROW(detail::requireGlbSize(kMost));
    const std::string glb =
        messageOf<openvdb::ValueError>([] { detail::requireGlbSize(kMost + 1); });
    EXPECT_TRUE(mentions(glb, "4294967296 bytes: choose a coarser level")) << glb;

    // Arrays are counted before they are written: these two would have 5 GiB.
    detail::GlbFile file;
    bool isWritten = false;
    for (int i = 0; i < 2; ++i) {
        file.addArray("SCALAR", detail::GlbFile::Float, std::size_t(5) << 27,
            [&](detail::ExportBytes&) { isWritten = true; });
    }
    std::ostringstream out;
    EXPECT_THROW(file.write([](JsonWriter&) {}, "", detail::ExportSink(out)), openvdb::ValueError);
    EXPECT_TRUE(out.str().empty());
    EXPECT_FALSE(isWritten);
}

TEST(ExportFormats, IdsThatFloatsCannotHoldAreSaidAndLeftOut)
{
    SphereTree tree = someTree(3);
    const ExportFormat& glb = *findExportFormat(".glb");
    const auto notesOf = [&](int32_t largest, std::string& bytes) {
        tree.track.resize(tree.spheres.parent.size());
        for (std::size_t i = 0; i < tree.track.size(); ++i) tree.track[i] = int32_t(i);
        tree.track.back() = largest;
        tree.nextTrack = largest + 1;
        std::ostringstream out;
        const auto notes = exportTree(tree, glb, {}, out);
        bytes = out.str();
        return notes;
    };
    constexpr int32_t kMost = 1 << 24;
    std::string held, tooLarge;
    EXPECT_TRUE(notesOf(kMost, held).empty());
    const auto notes = notesOf(kMost + 1, tooLarge);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0],
        "glb has its ids as floats, which count to 16777216: ids and parents of level 0 are left "
        "out");
    const auto countOf = [](const std::string& text, const std::string& part) {
        std::size_t count = 0;
        for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1))
            ++count;
        return count;
    };
    EXPECT_EQ(countOf(held, "\"_ID\""), tree.levels.size());
    EXPECT_EQ(countOf(tooLarge, "\"_ID\""), tree.levels.size() - 1) << "other levels have theirs";
}

} // namespace
