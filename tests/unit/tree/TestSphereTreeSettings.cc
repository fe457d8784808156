// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <cmath>
#include <limits>
#include <utility>

using namespace openvdb_spheretree;
using spheretree_test::mentions;
using spheretree_test::messageOf;

namespace {

std::string whyInvalid(const SphereTreeSettings& settings)
{
    return messageOf<openvdb::ValueError>([&] { settings.validate(); });
}

} // namespace

TEST(SphereTreeSettings, DefaultsAreValid) { EXPECT_NO_THROW(SphereTreeSettings().validate()); }

TEST(SphereTreeSettings, ModelsHaveNamesThatReadBack)
{
    PyramidOptions options;
    EXPECT_EQ(modelToString(options), "or");
    for (const int radius : {1, 2, 17, kMaxClosing}) {
        options.closing = radius;
        EXPECT_EQ(modelToString(options), "closing:" + std::to_string(radius));
        EXPECT_EQ(closingFromString(modelToString(options)), radius);
    }
    EXPECT_EQ(closingFromString("or"), 0);
    options.customModel = unknownModel();
    EXPECT_EQ(modelToString(options), "custom");
    for (const char* text : {"", "OR", "closing", "closing:", "closing:0", "closing:-1",
             "closing:65", "closing:2x", "closing: 2", "closing:+2", "custom", "2"}) {
        EXPECT_THROW(closingFromString(text), openvdb::ValueError) << text;
    }
}

TEST(SphereTreeSettings, ALongValueIsClippedInTheMessage)
{
    const std::string value(100000, 'x');
    EXPECT_LT(messageOf<openvdb::ValueError>([&] { paddingFromString(value); }).size(), 200u);
}

TEST(SphereTreeSettings, ThePaddingReadsBackToTheSameDouble)
{
    EXPECT_EQ(paddingToString(SphereTreeSettings::kPadCubes), "cubes");
    EXPECT_EQ(paddingToString(0), "voxels");
    EXPECT_EQ(paddingToString(0.5), "0.5");
    EXPECT_EQ(paddingFromString("cubes"), SphereTreeSettings::kPadCubes);
    EXPECT_EQ(paddingFromString("voxels"), 0);
    EXPECT_EQ(paddingFromString("2"), 2);
    for (double value : {0.1, 1.0 / 3, 1e-300, 1e300, std::nextafter(1.0, 2.0),
             std::numeric_limits<double>::denorm_min()}) {
        EXPECT_EQ(paddingFromString(paddingToString(value)), value);
    }
    EXPECT_FALSE(std::signbit(paddingFromString("-0")));
}

TEST(SphereTreeSettings, APaddingThatIsNotWhollyANumberIsAnError)
{
    for (const char* text : {"", " ", "1 ", " 1", "1x", "x", "0,5", "1e", "-", "--1", "cube", "nan",
             "inf", "-inf", "1e999", "-1", "-0.5"}) {
        const std::string why = messageOf<openvdb::ValueError>([&] { paddingFromString(text); });
        EXPECT_TRUE(mentions(why, "cubes, voxels")) << "for '" << text << "'";
    }
}

TEST(SphereTreeSettings, MemoryIsBytesOrAShare)
{
    EXPECT_EQ(memoryFromString("4000000000"), 4000000000);
    EXPECT_EQ(memoryFromString("4e9"), 4000000000);
    EXPECT_EQ(memoryFromString("1B"), 1);
    EXPECT_EQ(memoryFromString("4GiB"), int64_t(4) << 30);
    EXPECT_EQ(memoryFromString("4G"), int64_t(4) << 30);
    EXPECT_EQ(memoryFromString("0.5gib"), int64_t(1) << 29);
    EXPECT_EQ(memoryFromString("4GB"), 4000000000);
    EXPECT_EQ(memoryFromString("500MiB"), int64_t(500) << 20);
    EXPECT_EQ(memoryFromString("1TB"), 1000000000000);
    EXPECT_EQ(memoryFromString("75%"), 0);
    EXPECT_NEAR(double(memoryFromString("50%")), double(memoryFromString("100%")) / 2, 1);
    EXPECT_GT(memoryFromString("0.1%"), 1 << 20);
}

TEST(SphereTreeSettings, MemoryReadsBack)
{
    EXPECT_EQ(memoryToString(0), "75%");
    EXPECT_EQ(memoryToString(int64_t(4) << 30), "4GiB");
    EXPECT_EQ(memoryToString(1536 << 20), "1536MiB");
    EXPECT_EQ(memoryToString(4000000001), "4000000001");
    for (const int64_t bytes : {int64_t(0), int64_t(1), int64_t(1024), int64_t(3) << 20,
             int64_t(5) << 40, int64_t(1) << 52}) {
        EXPECT_EQ(memoryFromString(memoryToString(bytes)), bytes);
    }
}

TEST(SphereTreeSettings, AMemoryThatIsNoneIsAnError)
{
    const auto whyNot = [](const char* text) {
        const std::string why = messageOf<openvdb::ValueError>([&] { memoryFromString(text); });
        EXPECT_TRUE(mentions(why, "memory='" + std::string(text) + "' is "));
        EXPECT_TRUE(
            mentions(why, "choose a number of bytes such as 4GiB, 500MB or 4e9, or a share"));
        return why;
    };
    for (const char* text : {"", "abc", "GiB", "4 GiB", "4GiBs", "4,5GiB", "nan", "%", "101%",
             "75%%", "0x10", "1e999", "--1"}) {
        EXPECT_TRUE(mentions(whyNot(text), "' is unknown: "));
    }
    for (const char* text : {"0", "-0", "-1", "0%", "-5%", "0GiB", "0.9", "1e-300%", "-inf"}) {
        EXPECT_TRUE(mentions(whyNot(text), "' is too little: "));
    }
    for (const char* text : {"1e19", "9223372036854775808", "1e8TiB", "inf"}) {
        EXPECT_TRUE(mentions(whyNot(text), "' is too much: "));
    }
    EXPECT_LT(
        messageOf<openvdb::ValueError>([] { memoryFromString(std::string(100000, '9')); }).size(),
        300u);
}

TEST(SphereTreeSettings, ADimensionOtherThan2Or3IsAnError)
{
    SphereTreeSettings settings;
    for (int dim : {1, 4, 0, -3}) {
        settings.dim = dim;
        EXPECT_TRUE(mentions(whyInvalid(settings), "dim=" + std::to_string(dim)));
    }
    settings.dim = 2;
    EXPECT_NO_THROW(settings.validate());
}

TEST(SphereTreeSettings, APaddingThatIsNegativeOrNoNumberIsAnError)
{
    SphereTreeSettings settings;
    for (double padding : {-0.5, -2.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        settings.padding = padding;
        EXPECT_TRUE(mentions(whyInvalid(settings), "padding="));
    }
    for (double padding : {0.0, 1e6, SphereTreeSettings::kPadCubes}) {
        settings.padding = padding;
        EXPECT_NO_THROW(settings.validate());
    }
}

TEST(SphereTreeSettings, OfATightTreeAreWhatThereIsUnlessAskedOtherwise)
{
    EXPECT_TRUE(SphereTreeSettings().find<TightOptions>());
    EXPECT_EQ(SphereTreeSettings().type(), TreeType::Tight);
    EXPECT_FALSE(SphereTreeSettings().isInner());
}

TEST(SphereTreeSettings, HaveTheOptionsOfTheirKindAndNoOthers)
{
    SphereTreeSettings extended = ExtendedOptions();
    extended.pyramid().factor = 5;
    EXPECT_EQ(extended.extended().factor, 5);
    EXPECT_EQ(extended.type(), TreeType::Extended);
    EXPECT_FALSE(extended.find<TightOptions>());
    EXPECT_FALSE(extended.find<ReversibleOptions>());
    EXPECT_THROW(extended.tight(), openvdb::ValueError);
    EXPECT_THROW(extended.budgeted(), openvdb::ValueError);
    SphereTreeSettings inner = InnerOptions();
    inner.budgeted().budget.spheres = {8};
    EXPECT_TRUE(inner.isInner());
    EXPECT_EQ(inner.type(), TreeType::Tight);
    EXPECT_THROW(inner.tight(), openvdb::ValueError);
    EXPECT_THROW(inner.pyramid(), openvdb::ValueError);
    const SphereTreeSettings reversible = ReversibleOptions();
    EXPECT_EQ(reversible.type(), TreeType::Reversible);
    EXPECT_EQ(reversible.pyramid().factor, 2);
    EXPECT_THROW(reversible.extended(), openvdb::ValueError);
}

TEST(SphereTreeSettings, ATightTreeTakesEverySettingOfItsOwn)
{
    SphereTreeSettings settings;
    TightOptions& options = settings.tight();
    options.quality = Quality::Best;
    options.budget.spheres = {512, 64, 8};
    options.cover = Cover::Balls;
    options.leaves = Leaves::Medial;
    EXPECT_NO_THROW(settings.validate());
    options.cuts = true;
    EXPECT_TRUE(mentions(whyInvalid(settings), "quality=best and cuts=1 contradict"));
    EXPECT_TRUE(mentions(whyInvalid(settings), "use quality=normal"));
    options.quality = Quality::Normal;
    EXPECT_NO_THROW(settings.validate());
    options.budget.branching = 4;
    EXPECT_TRUE(mentions(whyInvalid(settings), "contradict each other"));
}

TEST(SphereTreeSettings, InnerTreesHaveNoBoundOnWhatTheyReachOutside)
{
    InnerOptions options;
    options.budget.spheres = {64};
    EXPECT_NO_THROW(SphereTreeSettings(options).validate());
    options.budget.error = 1;
    EXPECT_TRUE(mentions(whyInvalid(options), "side=inner and a bound"));
    options.budget.error.reset();
    options.budget.distance = 1;
    EXPECT_TRUE(mentions(whyInvalid(options), "side=inner and a bound"));
}

TEST(SphereTreeSettings, NearestSpheresHaveNoPaddingNoCutsAndNoBoundOnTheirReach)
{
    FitOptions options;
    options.budget.error = 1;
    SphereTreeSettings settings = options;
    EXPECT_TRUE(settings.isFit());
    EXPECT_FALSE(settings.isInner());
    EXPECT_EQ(settings.type(), TreeType::Tight);
    EXPECT_NO_THROW(settings.validate());
    EXPECT_EQ(settings.paddingVoxels(), 0);
    settings.padding = 0;
    EXPECT_NO_THROW(settings.validate()) << "none is what there is";
    settings.padding = 0.5;
    EXPECT_TRUE(mentions(whyInvalid(settings), "side=fit and padding=0.5"));
    options.cuts = true;
    EXPECT_TRUE(mentions(whyInvalid(options), "side=fit and cuts=1"));
    options.cuts = false;
    options.budget.distance = 2;
    options.budget.distanceInVoxels = true;
    EXPECT_TRUE(mentions(whyInvalid(options), "side=fit and distance=2vox"));
}

TEST(SphereTreeSettings, CubesPadByHalfADiagonalOfTheDimension)
{
    SphereTreeSettings settings;
    EXPECT_DOUBLE_EQ(settings.paddingVoxels(), std::sqrt(3.0) / 2);
    settings.dim = 2;
    EXPECT_DOUBLE_EQ(settings.paddingVoxels(), std::sqrt(2.0) / 2);
    settings.padding = 0;
    EXPECT_EQ(settings.paddingVoxels(), 0);
    settings.padding = 0.25;
    EXPECT_EQ(settings.paddingVoxels(), 0.25);
    settings.kind = InnerOptions();
    EXPECT_EQ(settings.paddingVoxels(), 0) << "would stick out";
}

TEST(SphereTreeSettings, FactorsAndClosingsHaveALimit)
{
    SphereTreeSettings settings = ExtendedOptions();
    for (int factor : {2, 3, 64}) {
        settings.pyramid().factor = factor;
        EXPECT_NO_THROW(settings.validate());
    }
    for (int factor : {1, 0, -2, 32769, std::numeric_limits<int>::min()}) {
        settings.pyramid().factor = factor;
        EXPECT_TRUE(mentions(whyInvalid(settings), "factor=" + std::to_string(factor)));
        EXPECT_TRUE(mentions(whyInvalid(settings), "2 to 32768"));
    }
    settings = ReversibleOptions();
    for (const int radius : {-1, 65}) {
        settings.pyramid().closing = radius;
        const std::string why = whyInvalid(settings);
        EXPECT_TRUE(mentions(why, "closing=" + std::to_string(radius) + " is out of range"));
    }
}

TEST(SphereTreeSettings, MiniballsAreEuclideanAndFitted)
{
    for (SphereTreeSettings settings :
        {SphereTreeSettings(ReversibleOptions()), SphereTreeSettings(ExtendedOptions())}) {
        settings.pyramid().center = Center::Miniball;
        EXPECT_NO_THROW(settings.validate());
        settings.pyramid().dist = Distance::l1();
        EXPECT_TRUE(mentions(whyInvalid(settings), "center=miniball is for dist=l2"));
        settings.pyramid().dist = Distance();
        if (settings.type() == TreeType::Reversible) continue;
        settings.extended().finalFit = false;
        EXPECT_TRUE(mentions(whyInvalid(settings), "center=miniball and final_fit=0"));
    }
}

TEST(SphereTreeSettings, AModelThatNoFileHoldsSaysSo)
{
    EXPECT_FALSE(isUnknown({}));
    EXPECT_TRUE(isUnknown(unknownModel()));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([] { unknownModel()({}, {}); }), "set customModel"));
}
