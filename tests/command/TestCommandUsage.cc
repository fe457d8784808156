// SPDX-License-Identifier: Apache-2.0
// What is wrong with a command line itself is found before any work: exit code 2, a message that
// names the action or option, and an existing target keeps its bytes.

#include "CommandRunner.h"

namespace {

using command_test::CommandTest;
using command_test::Result;

struct BadLine {
    const char* name;
    const char* line;
    const char* message; ///< a part of it
};

void PrintTo(const BadLine& bad, std::ostream* out) { *out << bad.line; }

class CommandUsageLine : public CommandTest, public testing::WithParamInterface<BadLine> {};

TEST_P(CommandUsageLine, IsRejectedBeforeAnythingIsWritten)
{
    writeBlock("a.vol");
    command_test::writeText(path("t.vdb"), "precious");
    const auto before = files();
    const Result result = run(GetParam().line);
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find(GetParam().message), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("completed"), std::string::npos) << "work was done: " << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before);
    EXPECT_EQ(command_test::readText(path("t.vdb")), "precious");
}

const BadLine kBadLines[] = {
    {"UnknownAction", "-read a.vol -spheretre -write t.vdb", "did you mean -spheretree"},
    {"AmbiguousAction", "-read a.vol -spheres2 -write t.vdb", "-spheres2mask, -spheres2ls"},
    {"AnOptionAsAnAction", "-read a.vol -spheres 64 -write t.vdb",
        "options have no dash: -spheretree spheres=64"},
    {"AnOptionAsAnActionWithoutValue", "-read a.vol -spheres -write t.vdb", "spheres=..."},
    {"AnOptionAsLongOption", "-read a.vol --spheres=64 -write t.vdb",
        "options have no dash: -spheretree spheres=64"},
    {"AnActionAsLongOption", "--read=a.vol -write t.vdb", "goes after it: -read a.vol"},
    {"ANumberOfSpheres", "-read a.vol -spheretree 64 -write t.vdb", "did you mean spheres=64?"},
    {"NumbersOfSpheres", "-read a.vol -spheretree 64,8 -write t.vdb", "did you mean spheres=64,8?"},
    {"NOfSpheres", "-read a.vol -spheretree n=8 -write t.vdb",
        "unknown option n (did you mean spheres=?)"},
    {"AQualityAsATree", "-read a.vol -spheretree fast -write t.vdb",
        "'fast' is no tree (did you mean quality=fast?)"},
    {"AnErrorWithItsUnit", "-read a.vol -spheretree error=20% -write t.vdb",
        "it is in percent as it is (did you mean error=20?)"},
    {"AChoiceOfTwoOptions", "-read a.vol -spheretree medial -write t.vdb",
        "(did you mean center=medial or leaves=medial?)"},
    {"AFractionInPercent", "-read a.vol -spheretree -distance relerr=1% -write t.vdb",
        "relerr=1% is out of range or not understood"},
    {"NOfNothing", "-generate ball n=8 -write t.vdb", "unknown option n;"},
    {"AnOptionWithoutValue", "-read a.vol -spheretree spheres -write t.vdb",
        "'spheres' is an option: give it a value"},
    {"AChoiceThatIsNone", "-read a.vol -spheretree quality=good -write t.vdb",
        "quality=good is unknown: it takes normal, fast, best"},
    {"AChoiceWithACapital", "-read a.vol -spheretree quality=Best -write t.vdb",
        "it takes normal, fast, best (did you mean best?)"},
    {"AQualityOfFit", "-read a.vol -spheretree side=fit quality=best -write t.vdb",
        "quality=best is for spheres that cover the object, not for side=fit"},
    {"AnActionWithoutDash", "read a.vol -write t.vdb", "actions begin with a dash: -read"},
    {"AFormatOfOthers", "-read a.vol -spheretree -write t.vdb t.off",
        ".off files are not written; it writes .vdb (grids and sphere-trees), .vol (an object)"},
    {"AFormatWithAnotherOfItsKind", "-read a.vol -spheretree -write t.vdb shot.usdc",
        ".usdc files are not written; of USD it writes the text, .usda"},
    {"AnExtensionOfSeveral", "-read a.vol -spheretree -write t.vdb clump.txt",
        ".txt does not say what to write: format=liggghts or format=yade or format=lammps does"},
    {"ANameWithoutExtension", "-read a.vol -spheretree -write t.vdb tree", "without an extension"},
    {"StatsOfOtherKind", "-read a.vol -spheretree -stats lev.txt -write t.vdb",
        "lev.txt: -stats writes .json or .csv"},
    {"StatsNamedFalsely", "-read a.vol -spheretree -stats json=lev.csv -write t.vdb",
        "json=lev.csv: files of this name are something else"},
    {"CollideOfOtherFiles", "-read a.vol -spheretree -collide poses=p.yml -write t.vdb",
        "poses are read from a .csv"},
    {"CollideWrittenAsText", "-read a.vol -spheretree -collide out.txt -write t.vdb",
        "out.txt: -collide writes .json or .csv"},
    {"CollideExpectsSomething", "-read a.vol -spheretree -collide expect=near -write t.vdb",
        "it takes apart, touching"},
    {"CollideWithAMarginBelowNothing", "-read a.vol -spheretree -collide margin=-1 -write t.vdb",
        "margin=-1"},
    {"CollideWithoutBlocks", "-read a.vol -spheretree -collide blocks=0 -write t.vdb", "blocks=0"},
    {"CollideOfOneOfTwo", "-read a.vol -spheretree -collide vdb=0 -write t.vdb",
        "name two trees, such as vdb=1,0"},
    {"CollideOnThreeLevels", "-read a.vol -spheretree -collide level=0,1,2 -write t.vdb",
        "names more levels than there are trees"},
    {"CollideOnNoLevel", "-read a.vol -spheretree -collide level=x -write t.vdb",
        "a level is a whole number"},
    {"CollideTurnedByWords", "-read a.vol -spheretree -collide rotate=0,0,ninety -write t.vdb",
        "three angles about x, y and z"},
    {"CollideTurnedByAnAxisName", "-read a.vol -spheretree -collide rotate=z -write t.vdb",
        "three angles about x, y and z"},
    {"CollideTurnedAboutNothing",
        "-read a.vol -spheretree -collide axis=0,0,0 angle=1 -write t.vdb",
        "axis=0,0,0 has no length"},
    {"CollideTurnedWithoutAngle", "-read a.vol -spheretree -collide axis=z -write t.vdb",
        "axis and angle turn together"},
    {"CollideTurnedByNoAngle", "-read a.vol -spheretree -collide axis=z angle=1grad -write t.vdb",
        "radians, or degrees as 90deg"},
    {"CollideTurnedTwice",
        "-read a.vol -spheretree -collide rotate=0,0,1 axis=z angle=1 -write t.vdb",
        "rotate and angle exclude"},
    {"CollideWithAShortMatrix", "-read a.vol -spheretree -collide matrix=1,0,0,0 -write t.vdb",
        "it takes 16 numbers"},
    {"CollideWithAMatrixThatScales",
        "-read a.vol -spheretree -collide matrix=2,0,0,0,0,2,0,0,0,0,2,0 -write t.vdb",
        "the transform is not rigid"},
    {"CollideWithAMatrixThatMirrors",
        "-read a.vol -spheretree -collide matrix=-1,0,0,0,0,1,0,0,0,0,1,0 -write t.vdb", "mirrors"},
    {"CollideWithAMatrixOfNoNumber",
        "-read a.vol -spheretree -collide matrix=nan,0,0,0,0,1,0,0,0,0,1,0 -write t.vdb",
        "must be finite"},
    {"CollideMovedTwice",
        "-read a.vol -spheretree -collide matrix=1,0,0,0,0,1,0,0,0,0,1,0 translate=1,0,0 -write "
        "t.vdb",
        "matrix and translate exclude"},
    {"CollideScaledToNothing", "-read a.vol -spheretree -collide scale=0 -write t.vdb", "scale=0"},
    {"CollideInAnUnknownUnit", "-read a.vol -spheretree -collide units=mile -write t.vdb",
        "units=mile"},
    {"DistanceBelowNothing", "-read a.vol -spheretree -distance upto=-1 -write t.vdb", "upto=-1"},
    {"DistanceWithAnErrorBelowNothing",
        "-read a.vol -spheretree -distance relerr=-0.1 -write t.vdb", "relerr=-0.1"},
    {"RaycastOfNothing", "-read a.vol -spheretree -raycast -write t.vdb", "origin= is missing"},
    {"RaycastNowhere", "-read a.vol -spheretree -raycast origin=0,0,0 -write t.vdb",
        "direction= is missing"},
    {"RaycastWithoutLength",
        "-read a.vol -spheretree -raycast origin=0,0,0 direction=0,0,0 -write t.vdb",
        "direction=0,0,0 has no length"},
    {"ContainsNothing", "-read a.vol -spheretree -contains -write t.vdb", "point= is missing"},
    {"ContainsNoNumber", "-read a.vol -spheretree -contains point=1,nan,2 -write t.vdb",
        "point=1,nan,2"},
    {"StdoutTwiceAsText", "-read a.vol -spheretree -write stdout.csv stdout.json",
        "two outputs go to stdout"},
    {"StdoutForStatsAndTree", "-read a.vol -spheretree -stats stdout.csv -write stdout.vdb",
        "two outputs go to stdout"},
    {"StdinTwice", "-read stdin.vol -read stdin.obj -write t.vdb", "can be read only once"},
    {"NoAction", "-read a.vol -- -write t.vdb", "'--' names no action"},
    {"TokenBeforeAction", "a.vol -write t.vdb", "'a.vol' stands before any action"},
    {"RepeatedQuiet", "-quiet -quiet -read a.vol -write t.vdb", "-quiet is given more than once"},
    {"RepeatedThreads", "-threads 1 -threads 2 -read a.vol -write t.vdb", "-threads is given more"},
    {"UnknownOption", "-read a.vol -spheretree facto=2 facter=3 -write t.vdb",
        "did you mean factor"},
    {"AmbiguousOption", "-read a.vol -spheretree d=3 -write t.vdb", "option d is ambiguous"},
    {"AmbiguousBetweenTwo", "-read a.vol -spheretree f=2 -write t.vdb",
        "option f is ambiguous: it could be factor, final_fit"},
    {"RepeatedOption", "-read a.vol -spheretree factor=2 factor=3 -write t.vdb",
        "option factor is given more than once"},
    {"RepeatedByPrefix", "-read a.vol -spheretree factor=2 fac=3 -write t.vdb",
        "option factor is given more than once"},
    {"RepeatedMain", "-read a.vol -spheretree extended tree=extended -write t.vdb",
        "option tree is given more than once"},
    {"EmptyOptionName", "-read a.vol -spheretree =2 -write t.vdb", "name is missing before '='"},
    {"EmptyOptionValue", "-read a.vol -spheretree factor= -write t.vdb", "factor has no value"},
    {"EmptyListItem", "-read a.vol,,a.vol -write t.vdb", "is empty"},
    {"ArgumentNobodyTakes", "-read a.vol -clear all -write t.vdb", "-clear does not take 'all'"},
    {"FactorOne", "-read a.vol -spheretree factor=1 -write t.vdb", "factor=1"},
    {"FactorNegative", "-read a.vol -spheretree factor=-2 -write t.vdb", "factor=-2"},
    {"FactorNoNumber", "-read a.vol -spheretree factor=2x -write t.vdb", "factor=2x"},
    {"FactorHuge", "-read a.vol -spheretree factor=99999999999999999999 -write t.vdb", "factor=9"},
    {"EdgesOfNoDag", "-read a.vol -spheretree tree=extended edges=shared -write t.vdb",
        "add dag=1"},
    {"ModelUnknown", "-read a.vol -spheretree tree=extended model=foo -write t.vdb",
        "model='foo' is unknown: choose or, or closing:R"},
    {"ModelCustom", "-read a.vol -spheretree tree=extended model=custom -write t.vdb",
        "model='custom'"},
    {"ModelClosingOfNothing", "-read a.vol -spheretree tree=extended model=closing -write t.vdb",
        "closing:R"},
    {"ModelClosingZero", "-read a.vol -spheretree tree=extended model=closing:0 -write t.vdb",
        "closing:0"},
    {"ModelClosingNegative", "-read a.vol -spheretree tree=extended model=closing:-1 -write t.vdb",
        "closing:-1"},
    {"ModelClosingNoNumber", "-read a.vol -spheretree tree=extended model=closing:x -write t.vdb",
        "closing:x"},
    {"ModelClosingHalf", "-read a.vol -spheretree tree=extended model=closing:1.5 -write t.vdb",
        "closing:1.5"},
    {"ModelClosingHuge", "-read a.vol -spheretree tree=extended model=closing:65 -write t.vdb",
        "closing:65"},
    {"DimFour", "-read a.vol -spheretree dim=4 -write t.vdb", "dim=4"},
    {"UnknownTree", "-read a.vol -spheretree tree=oak -write t.vdb", "tree=oak"},
    {"MemoryZero", "-read a.vol -spheretree memory=0 -write t.vdb", "memory='0' is too little"},
    {"MemoryNegative", "-read a.vol -spheretree memory=-1GiB -write t.vdb",
        "memory='-1GiB' is too little"},
    {"MemoryNoNumber", "-read a.vol -spheretree memory=abc -write t.vdb",
        "memory='abc' is unknown: choose a number of bytes such as 4GiB"},
    {"MemoryShareOfNothing", "-read a.vol -spheretree memory=0% -write t.vdb",
        "memory='0%' is too little"},
    {"MemoryMoreThanAll", "-read a.vol -spheretree tree=extended memory=101% -write t.vdb",
        "memory='101%' is unknown"},
    {"MemoryUnknownUnit", "-read a.vol -spheretree memory=4GiBi -write t.vdb", "memory='4GiBi'"},
    {"MemoryHuge", "-read a.vol -spheretree memory=1e30 -write t.vdb", "memory='1e30' is too much"},
    {"SpheresZero", "-read a.vol -spheretree tree=tight spheres=0 -write t.vdb",
        "spheres=0 is out of range"},
    {"SpheresNegative", "-read a.vol -spheretree tree=tight spheres=8,-1 -write t.vdb",
        "spheres=-1 is out of range"},
    {"SpheresNoNumber", "-read a.vol -spheretree tree=tight spheres=abc -write t.vdb",
        "spheres='abc' is no list of counts"},
    {"SpheresWithAGap", "-read a.vol -spheretree tree=tight spheres=8,,64 -write t.vdb",
        "spheres='8,,64' is no list of counts"},
    {"SpheresHuge", "-read a.vol -spheretree tree=tight spheres=99999999999 -write t.vdb",
        "spheres=99999999999 is out of range"},
    {"SpheresAndBranching", "-read a.vol -spheretree tree=tight spheres=8 branching=4 -write t.vdb",
        "contradict each other"},
    {"SpheresOfManyLevelsAndABound",
        "-read a.vol -spheretree tree=tight spheres=8,64 error=1 -write t.vdb", "give one count"},
    {"BranchingOne", "-read a.vol -spheretree tree=tight branching=1 -write t.vdb", "branching=1"},
    {"BranchingNoNumber", "-read a.vol -spheretree tree=tight branching=x -write t.vdb",
        "branching=x"},
    {"ErrorNegative", "-read a.vol -spheretree tree=tight error=-1 -write t.vdb", "error=-1"},
    {"ErrorNoNumber", "-read a.vol -spheretree tree=tight error=nan -write t.vdb", "error=nan"},
    {"ErrorInfinite", "-read a.vol -spheretree tree=tight error=inf -write t.vdb", "error=inf"},
    {"DistanceNegative", "-read a.vol -spheretree tree=tight distance=-0.5 -write t.vdb",
        "distance=-0.5"},
    {"DistanceNoNumber", "-read a.vol -spheretree tree=tight distance=nan -write t.vdb",
        "distance=nan"},
    {"QualityUnknown", "-read a.vol -spheretree tree=tight quality=good -write t.vdb",
        "normal, fast, best"},
    {"CoverUnknown", "-read a.vol -spheretree tree=tight cover=cubes -write t.vdb", "cover=cubes"},
    {"LeavesUnknown", "-read a.vol -spheretree tree=tight leaves=all -write t.vdb", "leaves=all"},
    {"SideUnknown", "-read a.vol -spheretree tree=tight side=both -write t.vdb", "side=both"},
    {"CenterUnknown", "-read a.vol -spheretree tree=extended center=centre -write t.vdb",
        "medial, miniball"},
    {"NormOfTightTree", "-read a.vol -spheretree tree=tight dist=l1 -write t.vdb",
        "tree=tight is for dist=l2"},
    {"NormOfMiniballs",
        "-read a.vol -spheretree tree=extended center=miniball dist=linf -write t.vdb",
        "center=miniball is for dist=l2"},
    {"MiniballsNotFitted",
        "-read a.vol -spheretree tree=extended center=miniball final_fit=0 -write t.vdb",
        "center=miniball and final_fit=0"},
    {"FactorOfTightTree", "-read a.vol -spheretree tree=tight factor=2 -write t.vdb",
        "factor=2 is for tree=extended and tree=reversible, not for tree=tight"},
    {"FactorOfTheUsualTree", "-read a.vol -spheretree factor=3 -write t.vdb", "not for tree=tight"},
    {"BestCuts", "-read a.vol -spheretree quality=best cuts=1 -write t.vdb", "use quality=normal"},
    {"ModelOfTightTree", "-read a.vol -spheretree tree=tight model=or -write t.vdb",
        "model=or is for tree=extended"},
    {"CenterOfTightTree", "-read a.vol -spheretree tree=tight center=medial -write t.vdb",
        "center=medial is for tree=extended"},
    {"DagOfTightTree", "-read a.vol -spheretree tree=tight dag=1 -write t.vdb", "dag=1 is for"},
    {"SpheresOfExtendedTree", "-read a.vol -spheretree tree=extended spheres=8 -write t.vdb",
        "spheres=8 is for tree=tight, not for tree=extended"},
    {"CutsOfReversibleTree", "-read a.vol -spheretree reversible cuts=1 -write t.vdb",
        "cuts=1 is for tree=tight, not for tree=reversible"},
    {"QualityOfExtendedTree", "-read a.vol -spheretree tree=extended quality=best -write t.vdb",
        "quality=best is for tree=tight"},
    {"SideOfExtendedTree", "-read a.vol -spheretree tree=extended side=inner -write t.vdb",
        "side=inner is for tree=tight"},
    {"ErrorOfInnerTree", "-read a.vol -spheretree tree=tight side=inner error=1 -write t.vdb",
        "error=1 is for spheres that cover the object"},
    {"QualityOfInnerTree",
        "-read a.vol -spheretree tree=tight side=inner quality=best -write t.vdb",
        "not for side=inner"},
    {"PaddingOfInnerTree",
        "-read a.vol -spheretree tree=tight side=inner padding=cubes -write t.vdb",
        "padding=cubes would make spheres stick out"},
    {"PaddingOfNearestSpheres", "-read a.vol -spheretree side=fit padding=voxels -write t.vdb",
        "padding=voxels would make spheres larger"},
    {"CoverOfNearestSpheres", "-read a.vol -spheretree side=fit cover=voxels -write t.vdb",
        "cover=voxels is for spheres that cover the object, not for side=fit"},
    {"StrictNearestSpheres", "-read a.vol -spheretree side=fit strict=1 -write t.vdb",
        "strict=1 is for side=inner, not for side=fit"},
    {"CutsOfNearestSpheres", "-read a.vol -spheretree side=fit cuts=1 -write t.vdb",
        "not for side=fit"},
    {"LeavesOfNearestSpheres", "-read a.vol -spheretree side=fit leaves=medial -write t.vdb",
        "not for side=fit"},
    {"QualityOfNearestSpheres", "-read a.vol -spheretree side=fit quality=best -write t.vdb",
        "not for side=fit"},
    {"DistanceOfNearestSpheres", "-read a.vol -spheretree side=fit distance=2vox -write t.vdb",
        "not for side=fit"},
    {"FitOfExtendedTree", "-read a.vol -spheretree tree=extended side=fit -write t.vdb",
        "side=fit is for tree=tight"},
    {"UnknownSide", "-read a.vol -spheretree side=near -write t.vdb", "outer, inner, fit"},
    {"LevelOfNoSpheres", "-read a.vol -spheretree -level spheres=0 -write t.vdb", "spheres=0"},
    {"PaddingNegative", "-read a.vol -spheretree padding=-3 -write t.vdb", "padding"},
    {"PaddingNoNumber", "-read a.vol -spheretree padding=nan -write t.vdb", "padding"},
    {"ThreadsZero", "-threads 0 -read a.vol -write t.vdb", "threads=0"},
    {"ThreadsNegative", "-threads threads=-1 -read a.vol -write t.vdb", "threads=-1"},
    {"ThreadsMissing", "-threads -read a.vol -write t.vdb", "number of threads is missing"},
    {"WidthZero", "-read a.vol -spheretree -spheres2ls width=0 -write t.vdb", "width=0"},
    {"VoxelZero", "-read a.vol -spheretree -spheres2ls voxel=0 -write t.vdb", "voxel=0"},
    {"VoxelAndDim", "-read a.vol -mesh2ls voxel=1 dim=9 -write t.vdb", "exclude each other"},
    {"GenerateUnknownShape", "-generate cube -write t.vdb", "shape=cube"},
    {"GenerateNoVoxels", "-generate shape=ball voxels=0 -write t.vdb", "voxels=0"},
    {"GenerateTooFewVoxels", "-generate shape=ball voxels=999 -write t.vdb", "voxels=999"},
    {"GenerateNegativeVoxels", "-generate shape=ball voxels=-1000 -write t.vdb", "voxels=-1000"},
    {"GenerateHalfAVoxel", "-generate voxels=1000.5 -write t.vdb", "is no whole number"},
    {"GenerateVoxelsNoNumber", "-generate voxels=many -write t.vdb", "voxels=many"},
    {"GenerateMoreVoxelsThanNumbers", "-generate ball voxels=1e19 -write t.vdb", "voxels=1e19"},
    {"GenerateTooManyLeaves", "-generate gyroid voxels=1e12 -write t.vdb",
        "more than 2^31 leaf nodes: ask for fewer voxels"},
    {"GenerateAfterWork", "-read a.vol -write t.vdb -generate noise voxels=1e18 -write u.vdb",
        "-generate: voxels=1000000000000000000 of shape=noise"},
    {"GenerateSeedNegative", "-generate noise seed=-1 -write t.vdb", "seed=-1"},
    {"GenerateVoxelZero", "-generate noise voxel=0 -write t.vdb", "voxel=0"},
    {"LevelNegative", "-read a.vol -spheretree -level level=-1 -write t.vdb", "level=-1"},
    {"LevelMissing", "-read a.vol -spheretree -level -write t.vdb", "names no level"},
    {"LevelTwice", "-read a.vol -spheretree -level 1 spheres=3 -write t.vdb", "exclude each other"},
    {"UnknownCodec", "-read a.vol -spheretree -write t.vdb codec=lzma", "codec=lzma"},
    {"UnknownExtension", "-read a.vol -spheretree -write t.vdb t.xyzw", "t.xyzw"},
    {"FormatNeedsAName", "-read a.vol -spheretree -write t.vdb t.txt", "t.txt"},
    {"FormatOfOtherFiles", "-read a.vol -spheretree -write t.vdb format=lula",
        "format=lula is for files that end in .yml, .yaml"},
    {"FormatUnknown", "-read a.vol -spheretree -write t.vdb t.yml format=yaml", "format=yaml"},
    {"LinkOfNoRobot", "-read a.vol -spheretree -write t.vdb link=arm", "option link is for"},
    {"ExportLevelTwice", "-read a.vol -spheretree -write t.vdb t.ply level=0 spheres=1",
        "exclude each other"},
    {"ExportUpSideways", "-read a.vol -spheretree -write t.vdb t.usda up=x", "y or z is up"},
    {"ExportNoScale", "-read a.vol -spheretree -write t.vdb t.ply scale=0", "scale=0"},
    {"CameraOfNoPicture", "-read a.vol -spheretree -write t.vdb eye=1,2,3", "option eye is for"},
    {"SizeOfNoPicture", "-read a.vol -spheretree -write t.vdb width=9", "option width is for"},
    {"PictureTooWide", "-read a.vol -write t.vdb t.png width=16385", "width=16385"},
    {"PictureWithoutRows", "-read a.vol -write t.vdb t.png height=0", "height=0"},
    {"FovFlat", "-read a.vol -write t.vdb t.png fov=180", "fov=180"},
    {"FovNegative", "-read a.vol -write t.vdb t.png fov=-1", "fov=-1"},
    {"EyeHalfEnclosed", "-read a.vol -write t.vdb t.png eye=(1,2,3", "three numbers"},
    {"EyeOfTwoNumbers", "-read a.vol -write t.vdb t.png eye=1,2", "eye=1,2"},
    {"EyeOfFourNumbers", "-read a.vol -write t.vdb t.png eye=1,2,3,4", "three numbers"},
    {"EyeNoNumber", "-read a.vol -write t.vdb t.png eye=1,2,nan", "eye=1,2,nan"},
    {"EyeIsLookat", "-read a.vol -write t.vdb t.png eye=1,2,3 lookat=1,2,3", "eye and lookat"},
    {"UpAlongView", "-read a.vol -write t.vdb t.png eye=1,9,3 lookat=1,2,3", "up="},
    {"UpTooShort", "-read a.vol -write t.vdb t.png up=1e-320,0,0", "1e-100 to 1e+100"},
    {"UpTooLong", "-read a.vol -write t.vdb t.png up=1e300,0,0", "up=1e+300,0,0 is no direction"},
    {"FovTooNarrow", "-read a.vol -write t.vdb t.png fov=1e-300", "fov=1e-300 is out of range"},
    {"EyeTooFar", "-read a.vol -write t.vdb t.png eye=1e308,0,0", "eye=1e+308,0,0 is out of range"},
    {"LookatTooFar", "-read a.vol -write t.vdb t.png lookat=1e300,0,0",
        "lookat=1e+300,0,0 is out of range"},
    {"UpNowhere", "-read a.vol -write t.vdb t.png up=0,0,0", "up=0,0,0"},
    {"UnknownColor", "-read a.vol -write t.vdb t.png color=blue", "color=blue"},
    {"ColorTooBright", "-read a.vol -write t.vdb t.png color=0,2,0", "color="},
    {"WrittenTwice", "-read a.vol -spheretree -write t.vdb -write ./t.vdb", "more than once"},
    {"StdoutTwice", "-read a.vol -spheretree -stats json=- -write stdout.vdb", "stdout"},
    {"NothingToWorkOn", "-spheretree -write t.vdb", "put -read before it"},
    {"NoFileToRead", "-read grids=a -write t.vdb", "-read: names no file"},
    {"NoFileToWrite", "-read a.vol -spheretree -write codec=zip", "-write: names no file"},
    {"ConfigMissing", "-config -read a.vol -write t.vdb", "-config: names no file"},
    {"HelpOnNothing", "-help spheretrees", "did you mean spheretree"},
};

INSTANTIATE_TEST_SUITE_P(Each, CommandUsageLine, testing::ValuesIn(kBadLines),
    [](const auto& info) { return info.param.name; });

class CommandUsage : public CommandTest {};

TEST_F(CommandUsage, NothingTypedGivesAShortUsageOnStderr)
{
    const Result result = run("");
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("Usage:"), std::string::npos);
    EXPECT_EQ(result.out, "");
}

TEST_F(CommandUsage, AnEmptyArgumentIsAnError)
{
    EXPECT_EQ(runWords({"-read", ""}).exitCode, 2);
    EXPECT_EQ(runWords({""}).exitCode, 2);
}

TEST_F(CommandUsage, DashesAndPrefixesAreFree)
{
    writeBlock("a.vol");
    const Result result = run("---i a.vol --spheretree tree=rev fact=3 -o t.vdb");
    EXPECT_EQ(result.exitCode, 2) << "a value is not an option: it may not be shortened";
    EXPECT_EQ(run("---i fil=a.vol --spheretree reversible fact=3 -o t.vdb").exitCode, 0);
    EXPECT_TRUE(exists("t.vdb"));
}

TEST_F(CommandUsage, AConfigFileIsALineOfItsOwn)
{
    writeBlock("a b.vol");
    command_test::writeText(path("c.txt"),
        "vdb_spheretree 0.1.0\n# a comment\nread 'a b.vol'\n\n"
        "  -spheretree tree=extended factor=3 # and another\r\n");
    const Result result = run("-config c.txt -stats json=- -write t.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("\"factor\": 3"), std::string::npos);
    command_test::writeText(path("self.txt"), "config self.txt\n");
    const Result self = run("-config self.txt");
    EXPECT_EQ(self.exitCode, 2);
    EXPECT_NE(self.err.find("-config self.txt, line 1: -config self.txt: this file comes to name "
                            "itself, without end"),
        std::string::npos)
        << self.err;
    command_test::writeText(path("other.txt"), "config twice.txt\n");
    command_test::writeText(path("twice.txt"), "quiet\nconfig other.txt\n");
    const Result each = run("-config twice.txt");
    EXPECT_EQ(each.exitCode, 2);
    EXPECT_NE(
        each.err.find("twice.txt, line 2: -config other.txt, line 1: -config twice.txt: this"),
        std::string::npos)
        << each.err;
    for (int i = 0; i < 9; ++i) {
        command_test::writeText(path("deep" + std::to_string(i) + ".txt"),
            i == 0 ? "generate ball voxels=2000\n"
                   : "config deep" + std::to_string(i - 1) + ".txt\n");
    }
    EXPECT_EQ(run("-config deep7.txt deep7.txt").exitCode, 0) << "twice, one after the other";
    const Result deep = run("-config deep8.txt");
    EXPECT_EQ(deep.exitCode, 2);
    EXPECT_NE(deep.err.find("more than 8 deep"), std::string::npos) << deep.err;
    command_test::writeText(path("bad.txt"), "read 'a b.vol\n");
    const Result bad = run("-config bad.txt");
    EXPECT_EQ(bad.exitCode, 2);
    EXPECT_NE(bad.err.find("bad.txt, line 1"), std::string::npos) << bad.err;
    command_test::writeText(path("binary.txt"), std::string("read 'a b.vol'\n\0\n", 17));
    const Result binary = run("-config binary.txt");
    EXPECT_EQ(binary.exitCode, 3);
    EXPECT_NE(binary.err.find("binary.txt: this is no text file"), std::string::npos) << binary.err;
    const Result missing = run("-config nowhere.txt");
    EXPECT_EQ(missing.exitCode, 3);
    EXPECT_NE(missing.err.find("nowhere.txt"), std::string::npos);
}

TEST_F(CommandUsage, AnErrorInAConfigFileNamesItsLine)
{
    writeBlock("a.vol");
    const std::pair<const char*, const char*> files[] = {
        {"read a.vol\n\nwrtie t.vdb\n", "-config c.txt, line 3: unknown action -wrtie"},
        {"read a.vol\nspheretree\\\n  branching=4 \\\n qualty=best\nwrite t.vdb\n",
            "-config c.txt, line 2: -spheretree: unknown option qualty"},
        {"read a.vol\nspheretree branching=1\n", "-config c.txt, line 2: -spheretree: branching=1"},
        {"read a.vol\nspheretree tree=extended quality=fast\n",
            "-config c.txt, line 2: -spheretree: quality=fast is for tree=tight"},
        {"spheretree\n", "-config c.txt, line 1: -spheretree has nothing to work on"},
        {"# one\n\nread a.vol\nmask\nread 'b.vol\n", "-config c.txt, line 5: a quote"},
        {"read a.vol\nquiet\nquiet\n", "-config c.txt, line 3: -quiet is given more than once"},
        {"config c2.txt\n", "-config c.txt, line 1: -config c2.txt, line 2: unknown action -oops"}};
    command_test::writeText(path("c2.txt"), "read a.vol\noops\n");
    for (const auto& [text, message] : files) {
        command_test::writeText(path("c.txt"), text);
        const Result result = run("-config c.txt");
        EXPECT_EQ(result.exitCode, 2) << text;
        EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    }
    command_test::writeText(path("c.txt"), "read a.vol\nread b.vol\n");
    EXPECT_NE(run("-config c.txt").err.find("-config c.txt, line 2: -read: cannot read b.vol"),
        std::string::npos);
}

TEST_F(CommandUsage, ALineOfAConfigFileGoesOnAfterABackslash)
{
    writeBlock("a.vol");
    command_test::writeText(path("c.txt"),
        "vdb_tool 10.6.1\n"
        "read \\\n"
        "  a.vol\n"
        "spheretree reversible \\\r\n"
        "  # of an option a line \\\n"
        "stats json=-\\"); // and at the end of the file there is nothing to go on with
    const Result result = run("-config c.txt");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("\"tree\": \"reversible\""), std::string::npos) << result.out;
    command_test::writeText(path("c.txt"), "read a.vol\nvdb_tool 10.6.1\n");
    EXPECT_EQ(run("-config c.txt").exitCode, 2) << "it is said in the first line only";
}

TEST_F(CommandUsage, ConfigFilesThatNeverEndAreRefused)
{
    for (const std::string line : {"read a.vol", "", "read"}) {
        const Result result = shell("yes '" + line + "' | $VDB_SPHERETREE -config /dev/stdin");
        EXPECT_EQ(result.exitCode, 3) << line;
        EXPECT_NE(result.err.find("no text file"), std::string::npos) << result.err;
    }
    EXPECT_EQ(run("-config /dev/zero").exitCode, 3);
}

TEST_F(CommandUsage, ConfigFilesThatMultiplyAreRefused)
{
    // 100^7 actions, in files of 1900 bytes.
    for (int i = 1; i <= 7; ++i) {
        std::string text;
        for (int line = 0; line < 100; ++line) {
            text += i < 7 ? "-config chain" + std::to_string(i + 1) + ".txt\n" : "-quiet\n";
        }
        command_test::writeText(path("chain" + std::to_string(i) + ".txt"), text);
    }
    const Result chain = run("-config chain1.txt");
    EXPECT_EQ(chain.exitCode, 2) << chain.err;
    EXPECT_NE(chain.err.find("-config chain7.txt: all files"), std::string::npos) << chain.err;
    EXPECT_NE(chain.err.find("4194304 bytes"), std::string::npos) << chain.err;
    // Files that hold nothing multiply as well.
    std::string list = "-config empty.txt";
    for (int i = 0; i < 100000; ++i) list += ",empty.txt";
    command_test::writeText(path("list.txt"), list);
    command_test::writeText(path("empty.txt"), "");
    const Result empty = run("-config list.txt");
    EXPECT_EQ(empty.exitCode, 2) << empty.err;
    EXPECT_NE(empty.err.find("-config empty.txt: all files"), std::string::npos) << empty.err;
}

TEST_F(CommandUsage, AConfigFileMayBeginWithAByteOrderMark)
{
    command_test::writeText(path("marked.txt"),
        "\xEF\xBB\xBF"
        "vdb_spheretree 0.1.0\nversion\n");
    const Result result = run("-config marked.txt");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out.rfind("vdb_spheretree ", 0), 0u);
    command_test::writeText(path("marked.txt"), "\xEF\xBB\xBFversion");
    EXPECT_EQ(run("-config marked.txt").exitCode, 0);
}

TEST_F(CommandUsage, HelpGoesToStdout)
{
    const Result all = run("-help");
    EXPECT_EQ(all.exitCode, 0);
    EXPECT_EQ(all.err, "");
    for (const char* name : {"-read,-i", "-spheretree", "-write,-o", "-threads", "factor="}) {
        EXPECT_NE(all.out.find(name), std::string::npos) << name;
    }
    const Result one = run("-help level stats");
    EXPECT_NE(one.out.find("json="), std::string::npos);
    EXPECT_EQ(one.out.find("factor="), std::string::npos);
    EXPECT_EQ(run("-h").out, all.out);
    EXPECT_EQ(run("help").out, all.out);
    EXPECT_EQ(run("--help").out, all.out);
    EXPECT_EQ(run("help level stats").out, one.out);
    const Result brief = run("-help level brief=1");
    EXPECT_EQ(std::count(brief.out.begin(), brief.out.end(), '\n'), 1) << brief.out;
}

TEST_F(CommandUsage, VersionNamesBothVersions)
{
    const Result result = run("-version");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.out.rfind("vdb_spheretree ", 0), 0u);
    for (const char* other : {"-v", "-V", "--version", "version"}) {
        EXPECT_EQ(run(other).out, result.out) << other;
    }
    EXPECT_NE(result.out.find(openvdb::getLibraryVersionString()), std::string::npos);
}

TEST_F(CommandUsage, EveryExampleIsALineThatParses)
{
    const Result examples = run("-examples");
    EXPECT_EQ(examples.exitCode, 0);
    EXPECT_NE(examples.out.find("-spheretree"), std::string::npos);
    // The files are not there, which is found only after the line has been understood.
    std::istringstream lines(examples.out);
    std::string line, whole;
    int count = 0;
    while (std::getline(lines, line)) {
        if (line.find_last_of('\\') == line.size() - 1) {
            whole += line.substr(0, line.size() - 1);
            continue;
        }
        whole += line;
        if (whole.rfind("  vdb_spheretree ", 0) == 0 && whole.find('|') == std::string::npos) {
            EXPECT_EQ(run(whole.substr(17)).exitCode, 3) << whole;
            ++count;
        }
        whole.clear();
    }
    EXPECT_GE(count, 5);
}

} // namespace
