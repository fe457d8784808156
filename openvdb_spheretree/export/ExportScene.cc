// SPDX-License-Identifier: Apache-2.0
#include "ExportScene.h"

#include "ExportNames.h"
#include "ExportRounding.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::detail {

namespace {

/// A file of spheres would say of other balls what is not so.
void requireSpheres(const SphereTree& tree)
{
    tree.validate();
    if (tree.settings.dist().isEuclidean()) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the balls of this tree are those of a norm, and no spheres: only .vdb, .csv and .json "
        "hold them");
}

KeepSphere keepOf(const SphereTreeSettings& settings)
{
    if (settings.isInner()) return KeepSphere::Inside;
    return settings.isFit() || settings.isGiven() ? KeepSphere::Nearest : KeepSphere::Covered;
}

std::string spheresOf(const SphereTreeLevel& level)
{
    return std::to_string(level.size()) + (level.size() == 1 ? " sphere" : " spheres");
}

/// @return the tree of what is to be written, if that is not all of it.
std::optional<SphereTree> chosenPart(const SphereTree& tree, const ExportFormat& format,
    const ExportSettings& settings, std::vector<std::string>& notes)
{
    if (settings.level) return keepLevel(tree, *settings.level);
    if (settings.spheres) return keepSpheres(tree, *settings.spheres);
    if (format.allLevels || tree.levels.size() == 1) return std::nullopt;
    const SphereTreeLevel& finest = tree.levels.front();
    const bool areLinks = format.links && settings.links.size() > 1;
    notes.push_back(format.name
        + (areLinks ? " holds one level of each link, and gets the finest"
                    : " holds one level, and gets the finest: level " + std::to_string(finest.level)
                    + " of " + spheresOf(finest))
        + "; level= or spheres= chooses another");
    return keepLevel(tree, finest.level);
}

void noteWhatIsLost(
    const SphereTree& tree, const ExportFormat& format, std::vector<std::string>& notes)
{
    if (!tree.dag.empty())
        notes.push_back(format.name + " has no room for the edges of the Sphere-DAG");
    if (!tree.cuts.empty())
        notes.push_back(format.name + " has no room for the cuts: spheres= writes one of them");
    if (format.allLevels && !format.ids && !format.ordersIds && tree.levels.size() > 1)
        notes.push_back(
            format.name + " has the spheres of each level, but not which is whose child");
    if (!tree.track.empty() && (!format.ids || format.ordersIds)) {
        notes.push_back(
            format.name + " has no room for the ids that spheres keep from frame to frame");
    }
    if (tree.settings.dim == 2) {
        notes.push_back("readers of " + format.name
            + " take the discs of a tree with dim=2 for whole spheres, which reach out of its "
              "plane by their radii");
    }
    if (format.errors)
        notes.push_back(
            format.name + " has errors of another kind than those of trees: they are 0");
}

/// @return the spheres of a level in the file's frame, not yet rounded.
ExportLevel placed(const SphereTree& tree, const SphereTreeLevel& level, const FileFrame& frame,
    openvdb::util::NullInterrupter* interrupter)
{
    ExportLevel result;
    result.number = level.level;
    const auto count = std::size_t(level.size());
    result.centers.resize(count);
    result.radii.resize(count);
    result.ids.resize(count);
    result.parents.resize(count);
    const bool isTop = level.begin == tree.root().begin;
    parallelFor(count, interrupter, [&](std::size_t i) {
        const int32_t id = level.begin + int32_t(i);
        result.ids[i] = id;
        result.parents[i] = isTop ? -1 : tree.spheres.parent[std::size_t(id)];
        result.centers[i] = frame.toFile(tree.centerWorld(id));
        result.radii[i] = double(tree.spheres.radiusWorld[std::size_t(id)]) * frame.scale();
    });
    return result;
}

struct LengthRange {
    double smallestRadius; ///< of those that are not 0; where all are, a voxel
    double largestNumber = 0;
};

/// @param voxel  its width in the file
LengthRange rangeOf(const std::vector<ExportLevel>& levels, double voxel)
{
    LengthRange range{std::numeric_limits<double>::infinity()};
    for (const ExportLevel& level : levels) {
        for (std::size_t i = 0; i < level.size(); ++i) {
            const double radius = level.radii[i];
            if (radius > 0) range.smallestRadius = std::min(range.smallestRadius, radius);
            range.largestNumber = std::max(range.largestNumber, radius);
            for (int axis = 0; axis < 3; ++axis) {
                range.largestNumber =
                    std::max(range.largestNumber, std::abs(level.centers[i][axis]));
            }
        }
    }
    // Spheres of no size are as exact as others, or all were put to whole numbers.
    if (!std::isfinite(range.smallestRadius)) range.smallestRadius = voxel;
    return range;
}

/// @return by how much of its radius a sphere has grown or shrunk at most.
double roundLevel(const SphereTree& tree, const FileFrame& frame, const SphereRounding& round,
    openvdb::util::NullInterrupter* interrupter, ExportLevel& level)
{
    const std::vector<double> before = level.radii;
    parallelFor(level.size(), interrupter, [&](std::size_t i) {
        const double slack = frame.slack(tree.centerWorld(level.ids[i]));
        const RoundedSphere sphere = round(level.centers[i], level.radii[i], slack);
        level.centers[i] = sphere.center;
        level.radii[i] = sphere.radius;
    });
    double worst = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] > 0)
            worst = std::max(worst, std::abs(level.radii[i] - before[i]) / before[i]);
    }
    return worst;
}

void noteGrowth(double worst, const ExportFormat& format, std::vector<std::string>& notes)
{
    constexpr double kWorthSaying = 0.01;
    if (worst <= kWorthSaying) return;
    notes.push_back("the numbers of " + format.name
        + " are coarse so far from the origin: radii give way by up to " + shortNumber(100 * worst)
        + " %; frame=centroid puts the spheres around the origin");
}

/// A robot of 200 metres was one of 200 millimetres.
void noteUnits(
    const ExportScene& scene, const ExportFormat& format, std::vector<std::string>& notes)
{
    constexpr double kSmallest = 0.002, kLargest = 20; // metres
    if (!format.metres) return;
    if (scene.metersPerUnit != 1) {
        notes.push_back("readers of " + format.name
            + " take its numbers for metres, and units= makes them others");
        return;
    }
    const double span = ExportScene::boxOf(scene.finest()).extents().length();
    if (span > kSmallest && span < kLargest) return;
    const std::string remedy = span >= kLargest
        ? "if the tree is in millimetres, read what it is made of with units=mm, or write it with "
          "scale=0.001"
        : "if that is too small, scale= of -write makes it larger";
    notes.push_back(
        format.name + " is in metres, and these spheres span " + shortNumber(span) + ": " + remedy);
}

/// Planners and physics ask all spheres of a link against all of others, many times a second.
void noteMany(const ExportScene& scene, const ExportFormat& format, std::vector<std::string>& notes)
{
    constexpr std::size_t kMany = 1000;
    if (!format.link || scene.sphereCount() <= kMany) return;
    notes.push_back(std::to_string(scene.sphereCount()) + " spheres are many for readers of "
        + format.name + ": spheres= writes fewer");
}

/// Programs of discrete elements are told by hand what a clump weighs.
/// @param body  in the frame and the units of the file, of a density of 1; known if the frame is the body's
void noteBody(const MassProperties& body, const ExportSettings& settings,
    const ExportFormat& format, std::vector<std::string>& notes)
{
    if (settings.frame != ExportFrame::Principal) {
        notes.push_back("readers of " + format.name
            + " take spheres around the center of mass, along the principal axes: "
              "frame=principal, which tells their mass as well");
        return;
    }
    std::string moments;
    for (int axis = 0; axis < 3; ++axis) {
        moments += (axis > 0 ? ", " : "") + shortNumber(body.principalMoments[axis]);
    }
    notes.push_back("with a density of 1 this body has the mass " + shortNumber(body.volume)
        + " and the principal moments of inertia " + moments + ", which readers of " + format.name
        + " want to be told");
}

/// Planners take spheres in the frame of their link.
void noteFrame(
    const ExportSettings& settings, const ExportFormat& format, std::vector<std::string>& notes)
{
    if (!format.links || settings.frame == ExportFrame::World) return;
    notes.push_back("readers of " + format.name
        + " take its spheres in the frame of the link, and frame= puts them into another");
}

/// Of a file in millimetres, the density of water in metres is a thousand million times too large.
void noteDensity(const ExportSettings& settings, std::vector<std::string>& notes)
{
    const double water = 1000 * std::pow(settings.metersPerUnit, 3);
    notes.push_back("its mass is of density=" + shortNumber(settings.density)
        + " a cubed unit of the file, where water has " + shortNumber(water));
}

/// Of the finest level.
MassProperties massOf(const SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    const auto mass = massProperties(tree, tree.levels.front(), interrupter);
    if (mass) return *mass;
    OPENVDB_THROW(openvdb::ValueError,
        "the spheres hold no voxel center, so their mass and its center are unknown: build the "
        "tree in finer "
        "voxels");
}

/// A body of spheres weighs more, or less, than what they were made of.
void noteMass(const SphereTreeLevel& level, std::vector<std::string>& notes)
{
    constexpr double kWorthSaying = 5; // percent
    if (!level.stored || level.stored->hammingPercent < kWorthSaying) return;
    notes.push_back(
        "mass and inertia are those of the spheres together, which differ from the object by "
        + shortNumber(level.stored->hammingPercent) + " % of its volume");
}

/// In a sequence a sphere goes by its track, which it keeps from frame to frame.
void showTracks(const SphereTree& tree, ExportLevel& level)
{
    for (std::vector<int32_t>* const ids : {&level.ids, &level.parents}) {
        for (int32_t& id : *ids) id = id < 0 ? id : tree.track[std::size_t(id)];
    }
}

/// Readers that go from sample to sample by the place in the list find a sphere where its track was.
void sortByTrack(ExportLevel& level)
{
    std::vector<std::size_t> order(level.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
        [&](std::size_t a, std::size_t b) { return level.ids[a] < level.ids[b]; });
    ExportLevel sorted;
    sorted.number = level.number;
    for (const std::size_t i : order) {
        sorted.centers.push_back(level.centers[i]);
        sorted.radii.push_back(level.radii[i]);
        sorted.ids.push_back(level.ids[i]);
        sorted.parents.push_back(level.parents[i]);
    }
    level = std::move(sorted);
}

/// @return a scene without levels yet.
ExportScene sceneFor(const SphereTree& tree, const ExportFormat& format,
    const ExportSettings& settings, std::size_t place, std::vector<std::string>& notes)
{
    ExportScene scene;
    scene.name = settings.name.empty() ? tree.settings.name : settings.name;
    if (format.link) scene.link = settings.links[place];
    requireNames(scene, format, notes);
    const auto& times = settings.sampleTimes;
    scene.sample = times.empty() ? double(place + 1) : times[place];
    scene.metersPerUnit = settings.metersPerUnit;
    scene.up = settings.up;
    scene.framesPerSecond = settings.framesPerSecond;
    scene.density = settings.density;
    return scene;
}

/// @return the scene of a tree of no object.
ExportScene emptyScene(const SphereTree& tree, const ExportFormat& format,
    const ExportSettings& settings, std::size_t place, std::vector<std::string>& notes)
{
    if (!format.empty) {
        OPENVDB_THROW(openvdb::ValueError,
            "there are no spheres, and " << format.name << " has no room for none");
    }
    ExportScene scene = sceneFor(tree, format, settings, place, notes);
    if (!format.samples) scene.levels.resize(1); // others' samples say which levels there are
    return scene;
}

/// Ids are many, or are tracks of a long sequence.
void noteIds(const ExportScene& scene, const ExportFormat& format, std::vector<std::string>& notes)
{
    if (!format.floatIds) return;
    std::string levels;
    for (const ExportLevel& level : scene.levels) {
        if (level.idsAreFloats()) continue;
        levels += (levels.empty() ? "" : ", ") + std::to_string(level.number);
    }
    if (levels.empty()) return;
    notes.push_back(format.name
        + " has its ids as floats, which count to 16777216: ids and parents of level " + levels
        + " are left out");
}

void requirePositive(const ExportScene& scene, const ExportFormat& format)
{
    int64_t zero = 0;
    for (const ExportLevel& level : scene.levels) {
        zero += std::count(level.radii.begin(), level.radii.end(), 0.0);
    }
    if (zero == 0) return;
    OPENVDB_THROW(openvdb::ValueError,
        zero << " of the spheres have the radius 0, which readers of " << format.name
             << " refuse: build the tree with a padding, or choose a coarser level");
}

} // namespace

bool ExportLevel::idsAreFloats() const
{
    constexpr int32_t kMostExact = 1 << 24;
    return std::all_of(ids.begin(), ids.end(), [](int32_t id) { return id <= kMostExact; });
}

std::size_t ExportScene::sphereCount() const
{
    std::size_t count = 0;
    for (const ExportLevel& level : levels) count += level.size();
    return count;
}

std::array<double, 6> ExportScene::inertia() const
{
    const openvdb::Mat3d& moments = mass.inertia;
    return {
        moments(0, 0), moments(1, 1), moments(2, 2), moments(0, 1), moments(0, 2), moments(1, 2)};
}

openvdb::BBoxd ExportScene::boxOf(const ExportLevel& level)
{
    openvdb::BBoxd box;
    for (std::size_t i = 0; i < level.size(); ++i) {
        const openvdb::Vec3d reach(level.radii[i]);
        box.expand(level.centers[i] - reach);
        box.expand(level.centers[i] + reach);
    }
    return box;
}

ExportScene makeScene(const SphereTree& whole, const ExportFormat& format,
    const ExportSettings& settings, std::size_t place, std::optional<FileFrame>& frameOfSamples,
    std::vector<std::string>& notes, openvdb::util::NullInterrupter* interrupter)
{
    if (whole.levels.empty()) return emptyScene(whole, format, settings, place, notes);
    requireSpheres(whole);
    const std::optional<SphereTree> part = chosenPart(whole, format, settings, notes);
    const SphereTree& tree = part ? *part : whole;
    noteWhatIsLost(tree, format, notes);

    const bool needsUnion = format.mass && !settings.mass;
    const bool needsFrame = settings.frame != ExportFrame::World && !frameOfSamples;
    MassProperties ofUnion;
    if (needsUnion || needsFrame) ofUnion = massOf(tree, interrupter);
    const FileFrame frame = frameOfSamples ? *frameOfSamples : FileFrame(settings, ofUnion);
    if (format.samples) frameOfSamples = frame;
    if (needsUnion) noteMass(tree.levels.front(), notes);
    if (format.mass && settings.metersPerUnit != 1) noteDensity(settings, notes);
    if (format.principal) noteBody(frame.toFile(ofUnion, 1), settings, format, notes);

    ExportScene scene = sceneFor(tree, format, settings, place, notes);
    if (format.mass) {
        scene.mass = frame.toFile(settings.mass.value_or(ofUnion), settings.density);
    }
    for (auto level = tree.levels.rbegin(); level != tree.levels.rend(); ++level) {
        scene.levels.push_back(placed(tree, *level, frame, interrupter));
    }
    const LengthRange range = rangeOf(scene.levels, tree.voxelSize() * frame.scale());
    if (format.numbers == ExportNumbers::Decimal) requireDecimals(range.largestNumber);
    scene.decimals = decimalsFor(range.smallestRadius, range.largestNumber);
    const SphereRounding round(format.numbers, scene.decimals, keepOf(tree.settings));
    double worst = 0;
    for (ExportLevel& level : scene.levels) {
        worst = std::max(worst, roundLevel(tree, frame, round, interrupter, level));
    }
    noteGrowth(worst, format, notes);
    noteUnits(scene, format, notes);
    noteFrame(settings, format, notes);
    noteMany(scene, format, notes);
    if (!tree.track.empty() && !format.ordersIds) {
        for (ExportLevel& level : scene.levels) {
            showTracks(tree, level);
            if (format.samples) sortByTrack(level);
        }
    }
    noteIds(scene, format, notes);
    if (format.positiveRadii) requirePositive(scene, format);
    return scene;
}

} // namespace openvdb_spheretree::detail
