// SPDX-License-Identifier: Apache-2.0
/// @file TestGoldenVolumes.cc
/// @brief Real volumes: voxels, squared distances and medial balls, as independent programs counted
/// them. The files are not part of the project: the environment variable SPHERETREE_DATA names the
/// folder that holds `vol/`.

#include "support/CoreStages.h"

#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/vol/VolFile.h>

#include <cctype>
#include <cstdlib>
#include <optional>
#include <ostream>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// What is known of a volume.
struct Volume {
    const char* name;
    std::optional<int64_t> voxels, largestDistSq, sumOfDistSq, balls, leaves;
};

constexpr auto kUnknown = std::nullopt;

const Volume kVolumes[] = {
    {"cat10", 8043, 82, 73346, 1189, kUnknown},
    {"Al.100", 70413, 226, 1897658, 4127, kUnknown},
    {"lobster", 3831352, 629, 599590664, 144491, kUnknown},
    {"dragon-128", 112328, 177, 1968468, 8072, kUnknown},
    {"dragon-512", 7446783, 2978, 1948302587, 138157, 19263},
    {"fandisk-128", kUnknown, kUnknown, kUnknown, 15783, kUnknown},
    {"fandisk-512", kUnknown, 9161, 16046137765, 266591, kUnknown},
    {"hairball-256", kUnknown, 870, 70821170, 898764, kUnknown},
    {"lucy-boundary-512", 381772, 3, 398925, 308428, kUnknown},
};

std::ostream& operator<<(std::ostream& out, const Volume& volume) { return out << volume.name; }

class GoldenVolumes : public testing::TestWithParam<Volume> {
protected:
    void SetUp() override
    {
        const char* folder = std::getenv("SPHERETREE_DATA");
        if (!folder) GTEST_SKIP() << "needs SPHERETREE_DATA";
        const std::string path = std::string(folder) + "/vol/" + GetParam().name + ".vol";
        mObject = objectOf(*readVolFile(path));
    }

    openvdb::BoolGrid::Ptr mObject;
};

void expectKnown(const std::optional<int64_t>& expected, int64_t value, const char* what)
{
    EXPECT_EQ(value, expected.value_or(value)) << what;
}

TEST_P(GoldenVolumes, HaveTheirVoxelsDistancesAndMedialBalls)
{
    const openvdb::MaskTree mask(mObject->tree(), false, openvdb::TopologyCopy());
    const CoreStages stages(mask);
    int64_t sum = 0;
    forEachVoxel(stages.layout,
        [&](uint32_t leaf, uint32_t k, const Coord&) { sum += stages.distances.at(leaf, k); });
    const Volume& volume = GetParam();
    expectKnown(volume.voxels, stages.layout.voxelCount(), "voxels");
    expectKnown(volume.leaves, stages.layout.leafCount(), "leaves");
    expectKnown(volume.largestDistSq, stages.distances.largest(), "largest squared distance");
    expectKnown(volume.sumOfDistSq, sum, "sum of squared distances");
    expectKnown(volume.balls, int64_t(stages.balls.size()), "medial balls");
}

INSTANTIATE_TEST_SUITE_P(Data, GoldenVolumes, testing::ValuesIn(kVolumes),
    [](const testing::TestParamInfo<Volume>& info) {
        std::string name = info.param.name;
        for (char& c : name) {
            if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
        }
        return name;
    });

TEST(GoldenBoxes, Al100HasTheBoxOfThePaper)
{
    const char* folder = std::getenv("SPHERETREE_DATA");
    if (!folder) GTEST_SKIP() << "needs SPHERETREE_DATA";
    const auto object = objectOf(*readVolFile(std::string(folder) + "/vol/Al.100.vol"));
    EXPECT_EQ(object->evalActiveVoxelBoundingBox().extents(), Coord(37, 92, 100));
}

} // namespace
