// SPDX-License-Identifier: Apache-2.0
/// @file TestGoldenTrees.cc
/// @brief Sphere counts and errors of real objects, to the last sphere and the last digit given,
/// from the text files tests/data/<object>.<tree>.txt. Independent dense programs gave the
/// numbers.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/tree/SettingsTable.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include "support/DataFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace {

using namespace openvdb_spheretree;

struct GoldenLevel {
    int level, spheres;
    std::string percent; ///< as printed; "-" if not known
};

struct Golden {
    std::string object;
    SphereTreeSettings settings;
    std::vector<GoldenLevel> levels;
};

void setOption(SphereTreeSettings& settings, const std::string& option)
{
    const auto equals = option.find('=');
    const std::string name = option.substr(0, equals), value = option.substr(equals + 1);
    detail::settingNamed(name).set(settings, value);
}

Golden readGolden(const std::string& name)
{
    std::ifstream file(spheretree_test::dataPath(name + ".txt"));
    EXPECT_TRUE(file) << "no file " << name;
    Golden golden;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        if (line.empty() || line[0] == '#') continue;
        words >> word;
        if (word == "object") {
            words >> golden.object;
        } else if (word == "settings") {
            while (words >> word) setOption(golden.settings, word);
        } else {
            GoldenLevel level{std::stoi(word), 0, ""};
            words >> level.spheres >> level.percent;
            golden.levels.push_back(level);
        }
    }
    return golden;
}

/// Half a unit of the last digit given, and a little for the rounding of halves.
double toleranceOf(const std::string& number)
{
    const auto point = number.find('.');
    const int decimals = point == std::string::npos ? 0 : int(number.size() - point - 1);
    return 0.5 * std::pow(10.0, -decimals) * 1.0001;
}

class GoldenTrees : public testing::TestWithParam<const char*> {};

TEST_P(GoldenTrees, HaveTheSpheresAndErrorsOfTheFile)
{
    const char* folder = std::getenv("SPHERETREE_DATA");
    if (!folder) GTEST_SKIP() << "needs SPHERETREE_DATA";
    openvdb::initialize();
    const Golden golden = readGolden(GetParam());
    const auto object = objectOf(*readVolFile(std::string(folder) + "/vol/" + golden.object));
    SphereTree tree = buildSphereTree(*object, golden.settings);
    computeLevelErrors(tree, *object);
    ASSERT_FALSE(golden.levels.empty());
    ASSERT_EQ(tree.levels.size(), golden.levels.size());
    for (const GoldenLevel& expected : golden.levels) {
        const SphereTreeLevel& level = tree.levels.at(expected.level);
        SCOPED_TRACE("level " + std::to_string(expected.level));
        EXPECT_EQ(level.size(), expected.spheres);
        ASSERT_TRUE(level.error.has_value()) << level.errorUnknown;
        EXPECT_EQ(level.error->missing, 0);
        if (expected.percent == "-") continue;
        EXPECT_NEAR(level.error->hammingPercent, std::stod(expected.percent),
            toleranceOf(expected.percent));
    }
}

std::string testName(const testing::TestParamInfo<const char*>& info)
{
    std::string name = info.param;
    for (char& c : name) {
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    }
    return name;
}

INSTANTIATE_TEST_SUITE_P(Of, GoldenTrees,
    testing::Values("Al.100.extended", "Al.100.reversible", "Al.100.reversible.paper",
        "Al.100.extended.factor3", "Al.100.extended.free", "Al.100.extended.none", "cat10.extended",
        "dragon-128.extended", "fandisk-128.extended"),
    testName);

} // namespace
