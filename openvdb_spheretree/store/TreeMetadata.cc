// SPDX-License-Identifier: Apache-2.0
#include "TreeMetadata.h"

#include "PointLeaves.h"
#include "SphereTreePoints.h"

#include <cmath>
#include <limits>

namespace openvdb_spheretree {
namespace detail {

namespace {

using openvdb::GridBase;
using openvdb::Mat4d;
using openvdb::Vec3i;
using openvdb::math::MapBase;
using openvdb::math::Transform;

constexpr char kTransformKey[] = "spheretree_transform";
constexpr char kTransformTypeKey[] = "spheretree_transform_type";
constexpr char kTopologyKey[] = "spheretree_topology";       // files were first written without
constexpr char kSubdivisionKey[] = "spheretree_subdivision"; // and without this, which was 2
constexpr char kQualityKey[] = "spheretree_quality";         // and all settings of tight trees
constexpr int kMaxLevels = 1024; // far more than 32 bits of coordinates can be halved

std::string levelKey(int level, const char* what)
{
    return "spheretree_level_" + std::to_string(level) + "_" + what;
}

Vec3i toVec(const openvdb::Coord& c) { return {c[0], c[1], c[2]}; }
openvdb::Coord toCoord(const Vec3i& v) { return {v[0], v[1], v[2]}; }

// ---- The transform

Mat4d matrixOf(const Transform& transform)
{
    return transform.baseMap()->getAffineMap()->getMat4();
}

/// Transform::operator== has a tolerance; here every bit counts.
bool identical(const Transform& a, const Transform& b)
{
    return a.mapType() == b.mapType() && matrixOf(a) == matrixOf(b);
}

Transform::Ptr scaled(const Transform& transform, double scale)
{
    const Transform::Ptr result = transform.copy();
    if (scale != 1) result->preScale(scale);
    return result;
}

/// @return the transform that Transform::copy() makes of a map of that type and matrix.
Transform::Ptr makeTransform(const std::string& type, const Mat4d& matrix)
{
    namespace math = openvdb::math;
    const openvdb::Vec3d scale(matrix(0, 0), matrix(1, 1), matrix(2, 2));
    const openvdb::Vec3d translation = matrix.getTranslation();
    MapBase::Ptr map;
    if (type == math::ScaleMap::mapType()) {
        map.reset(new math::ScaleMap(scale));
    } else if (type == math::UniformScaleMap::mapType()) {
        map.reset(new math::UniformScaleMap(scale[0]));
    } else if (type == math::TranslationMap::mapType()) {
        map.reset(new math::TranslationMap(translation));
    } else if (type == math::ScaleTranslateMap::mapType()) {
        map.reset(new math::ScaleTranslateMap(scale, translation));
    } else if (type == math::UniformScaleTranslateMap::mapType()) {
        map.reset(new math::UniformScaleTranslateMap(scale[0], translation));
    } else if (type == math::UnitaryMap::mapType()) {
        map.reset(new math::UnitaryMap(matrix));
    } else {
        map.reset(new math::AffineMap(matrix));
    }
    return std::make_shared<Transform>(map);
}

/// Scaling to the point grid and back may end in another type of map (a translation comes back as a
/// scale of 1 and a translation). Where it does, the map itself is recorded.
void writeTransform(GridBase& grid, const Transform& source, int scale)
{
    if (identical(*scaled(grid.transform(), 1.0 / scale), source)) return;
    setMeta(grid, kTransformTypeKey, source.mapType());
    setMeta(grid, kTransformKey, matrixOf(source));
}

/// The record counts only while it belongs to the grid's transform: who moves the points moves the
/// tree.
Transform::Ptr readTransform(const GridBase& grid, int scale)
{
    if (!grid.transform().isLinear()) {
        OPENVDB_THROW(openvdb::ValueError, "its transform is a frustum");
    }
    if (grid[kTransformKey]) {
        const Transform::Ptr source = makeTransform(
            getMeta<std::string>(grid, kTransformTypeKey), getMeta<Mat4d>(grid, kTransformKey));
        if (identical(*scaled(*source, scale), grid.transform())) return source;
    }
    return scaled(grid.transform(), 1.0 / scale);
}

// ---- Settings, object, levels

void writeBudget(GridBase& grid, const SphereBudget& budget)
{
    setMeta<std::string>(grid, "spheretree_spheres", countsToString(budget.spheres));
    setMeta<int32_t>(grid, "spheretree_branching", budget.branching);
    if (budget.error) setMeta<double>(grid, "spheretree_error", *budget.error);
    if (budget.distance) setMeta<double>(grid, "spheretree_distance", *budget.distance);
}

SphereBudget readBudget(const GridBase& grid)
{
    SphereBudget budget;
    const std::string spheres = getMeta<std::string>(grid, "spheretree_spheres");
    if (!spheres.empty()) budget.spheres = countsFromString(spheres);
    budget.branching = getMeta<int32_t>(grid, "spheretree_branching");
    if (grid["spheretree_error"]) budget.error = getMeta<double>(grid, "spheretree_error");
    if (grid["spheretree_distance"]) budget.distance = getMeta<double>(grid, "spheretree_distance");
    return budget;
}

/// With center=, which came with them.
void writeTightSettings(GridBase& grid, const SphereTreeSettings& settings)
{
    setMeta<std::string>(grid, kQualityKey, toString(settings.quality));
    writeBudget(grid, settings.budget);
    setMeta<std::string>(grid, "spheretree_cover", toString(settings.cover));
    setMeta<std::string>(grid, "spheretree_leaves", toString(settings.leaves));
    setMeta<std::string>(grid, "spheretree_side", toString(settings.side));
    setMeta<bool>(grid, "spheretree_cuts", settings.cuts);
    setMeta<std::string>(grid, "spheretree_center", toString(settings.center));
}

void readTightSettings(const GridBase& grid, SphereTreeSettings& settings)
{
    settings.quality = qualityFromString(getMeta<std::string>(grid, kQualityKey));
    settings.budget = readBudget(grid);
    settings.cover = coverFromString(getMeta<std::string>(grid, "spheretree_cover"));
    settings.leaves = leavesFromString(getMeta<std::string>(grid, "spheretree_leaves"));
    settings.side = sideFromString(getMeta<std::string>(grid, "spheretree_side"));
    settings.cuts = getMeta<bool>(grid, "spheretree_cuts");
    settings.center = centerFromString(getMeta<std::string>(grid, "spheretree_center"));
}

void writeSettings(GridBase& grid, const SphereTreeSettings& settings)
{
    setMeta<std::string>(grid, "spheretree_tree", toString(settings.tree));
    setMeta<int32_t>(grid, "spheretree_factor", settings.factor);
    setMeta<int32_t>(grid, "spheretree_dim", settings.dim);
    if (settings.dim == 2) setMeta<int32_t>(grid, "spheretree_flat_axis", settings.flatAxis);
    setMeta<std::string>(grid, "spheretree_model", modelToString(settings));
    setMeta<std::string>(grid, "spheretree_parent", toString(settings.parent));
    setMeta<bool>(grid, "spheretree_final_fit", settings.finalFit);
    setMeta<std::string>(grid, "spheretree_reconstruct", toString(settings.reconstruct));
    setMeta<std::string>(grid, "spheretree_scale", toString(settings.scale));
    setMeta<std::string>(grid, "spheretree_dist", toString(settings.dist));
    setMeta<std::string>(grid, "spheretree_padding", paddingToString(settings.padding));
    setMeta<bool>(grid, "spheretree_dag", settings.dag);
    setMeta<std::string>(grid, "spheretree_dag_edges", toString(settings.edges));
    setMeta<bool>(grid, kTopologyKey, settings.topology);
    writeTightSettings(grid, settings);
}

SphereTreeSettings readSettings(const GridBase& grid)
{
    SphereTreeSettings settings;
    settings.tree = treeTypeFromString(getMeta<std::string>(grid, "spheretree_tree"));
    settings.factor = getMeta<int32_t>(grid, "spheretree_factor");
    settings.dim = getMeta<int32_t>(grid, "spheretree_dim");
    if (grid["spheretree_flat_axis"]) {
        settings.flatAxis = getMeta<int32_t>(grid, "spheretree_flat_axis");
    }
    settings.parent = parentRuleFromString(getMeta<std::string>(grid, "spheretree_parent"));
    settings.finalFit = getMeta<bool>(grid, "spheretree_final_fit");
    settings.reconstruct =
        reconstructionFromString(getMeta<std::string>(grid, "spheretree_reconstruct"));
    settings.scale = radiusScaleFromString(getMeta<std::string>(grid, "spheretree_scale"));
    if (grid["spheretree_dist"]) { // files of the first version have none
        settings.dist = distanceFromString(getMeta<std::string>(grid, "spheretree_dist"));
    }
    if (grid["spheretree_model"]) { // nor that
        const std::string model = getMeta<std::string>(grid, "spheretree_model");
        settings.hadCustomModel = model == "custom";
        if (!settings.hadCustomModel) settings.closing = closingFromString(model);
    }
    settings.padding = paddingFromString(getMeta<std::string>(grid, "spheretree_padding"));
    settings.dag = getMeta<bool>(grid, "spheretree_dag");
    settings.edges = dagEdgesFromString(getMeta<std::string>(grid, "spheretree_dag_edges"));
    settings.topology = grid[kTopologyKey] && getMeta<bool>(grid, kTopologyKey);
    const bool tight = settings.tree == TreeType::Tight;
    if (tight || grid[kQualityKey]) readTightSettings(grid, settings);
    settings.name = grid.getName();
    settings.validate();
    return settings;
}

void writeObject(GridBase& grid, const ObjectInfo& object)
{
    setMeta(grid, "spheretree_source", object.name);
    setMeta(grid, "spheretree_object_voxels", object.voxels);
    setMeta(grid, "spheretree_object_leaves", object.leaves);
    setMeta(grid, "spheretree_object_tiles", object.tiles);
    setMeta(grid, "spheretree_object_bbox_min", toVec(object.bbox.min()));
    setMeta(grid, "spheretree_object_bbox_max", toVec(object.bbox.max()));
}

ObjectInfo readObject(const GridBase& grid)
{
    ObjectInfo object;
    object.name = getMeta<std::string>(grid, "spheretree_source");
    object.voxels = getMeta<int64_t>(grid, "spheretree_object_voxels");
    object.leaves = getMeta<int64_t>(grid, "spheretree_object_leaves");
    object.tiles = getMeta<int64_t>(grid, "spheretree_object_tiles");
    object.bbox.reset(toCoord(getMeta<Vec3i>(grid, "spheretree_object_bbox_min")),
        toCoord(getMeta<Vec3i>(grid, "spheretree_object_bbox_max")));
    return object;
}

void writeLevel(GridBase& grid, const SphereTreeLevel& level)
{
    const auto key = [&](const char* what) { return levelKey(level.level, what); };
    setMeta<int32_t>(grid, key("spheres"), level.size());
    setMeta<int64_t>(grid, key("pyramid_voxels"), level.pyramidVoxels);
    if (level.topology) {
        setMeta<int64_t>(grid, key("components"), level.topology->components);
        setMeta<int64_t>(grid, key("tunnels"), level.topology->tunnels);
        setMeta<int64_t>(grid, key("cavities"), level.topology->cavities);
    }
    if (level.error) {
        setMeta<int64_t>(grid, key("covered"), level.error->covered);
        setMeta<int64_t>(grid, key("excess"), level.error->excess);
        setMeta<int64_t>(grid, key("missing"), level.error->missing);
        setMeta<double>(grid, key("hamming_percent"), level.error->hammingPercent);
        setMeta<double>(grid, key("hausdorff"), level.error->hausdorff);
    }
    if (!level.errorUnknown.empty()) setMeta(grid, key("error_unknown"), level.errorUnknown);
}

SphereTreeLevel readLevel(const GridBase& grid, int number)
{
    const auto key = [&](const char* what) { return levelKey(number, what); };
    SphereTreeLevel level;
    level.level = number;
    level.end = getMeta<int32_t>(grid, key("spheres"));
    if (level.end < 1) {
        OPENVDB_THROW(openvdb::ValueError,
            "level " << number << " has " << level.end
                     << " spheres by its metadata, every level must have one or more");
    }
    level.pyramidVoxels = getMeta<int64_t>(grid, key("pyramid_voxels"));
    if (grid[key("components")]) {
        level.topology = LevelTopology{getMeta<int64_t>(grid, key("components")),
            getMeta<int64_t>(grid, key("tunnels")), getMeta<int64_t>(grid, key("cavities"))};
    }
    if (grid[key("covered")]) {
        LevelError error;
        error.covered = getMeta<int64_t>(grid, key("covered"));
        error.excess = getMeta<int64_t>(grid, key("excess"));
        error.missing = getMeta<int64_t>(grid, key("missing"));
        error.hammingPercent = getMeta<double>(grid, key("hamming_percent"));
        error.hausdorff = getMeta<double>(grid, key("hausdorff"));
        level.error = error;
    }
    if (grid[key("error_unknown")]) {
        level.errorUnknown = getMeta<std::string>(grid, key("error_unknown"));
    }
    return level;
}

std::vector<SphereTreeLevel> readLevels(const GridBase& grid)
{
    const int count = getMeta<int32_t>(grid, "spheretree_levels");
    const int lowest = getMeta<int32_t>(grid, "spheretree_lowest_level");
    if (count < 1 || count > kMaxLevels || lowest < 0 || lowest > kMaxLevels
        || (count > 1 && lowest > 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            "by its metadata it has " << count << " levels from level " << lowest
                                      << " on: a tree has levels from 0 on, or one level");
    }
    std::vector<SphereTreeLevel> levels;
    for (int k = 0; k < count; ++k) levels.push_back(readLevel(grid, lowest + k));
    int64_t begin = 0;
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) { // ids start at the top
        const int64_t end = begin + level->end;
        if (end > std::numeric_limits<int32_t>::max()) {
            OPENVDB_THROW(openvdb::ValueError, "its metadata asks for more than 2^31 spheres");
        }
        level->begin = int32_t(begin);
        level->end = int32_t(end);
        begin = end;
    }
    return levels;
}

} // namespace

void writeTreeMetadata(GridBase& grid, const SphereTree& tree, int scale)
{
    grid.setName(tree.settings.name);
    setMeta<int32_t>(grid, kFormatKey, kPointsFormat);
    setMeta<int32_t>(grid, kScaleKey, scale);
    writeTransform(grid, *tree.transform, scale);
    setMeta<int32_t>(grid, kSubdivisionKey, tree.subdivision);
    writeSettings(grid, tree.settings);
    writeObject(grid, tree.object);
    setMeta(grid, "spheretree_origin", toVec(tree.origin));
    setMeta<int32_t>(grid, "spheretree_levels", int32_t(tree.levels.size()));
    setMeta<int32_t>(grid, "spheretree_lowest_level", tree.levels.front().level);
    for (const SphereTreeLevel& level : tree.levels) writeLevel(grid, level);
}

SphereTree readTreeMetadata(const GridBase& grid)
{
    SphereTree tree;
    tree.transform = readTransform(grid, readPointScale(grid));
    tree.settings = readSettings(grid);
    const bool tight = tree.settings.tree == TreeType::Tight;
    if (tight || grid[kSubdivisionKey]) tree.subdivision = getMeta<int32_t>(grid, kSubdivisionKey);
    tree.object = readObject(grid);
    tree.origin = toCoord(getMeta<Vec3i>(grid, "spheretree_origin"));
    tree.levels = readLevels(grid);
    return tree;
}

int readPointScale(const GridBase& grid)
{
    const int scale = getMeta<int32_t>(grid, kScaleKey);
    if (scale < 1 || scale > kMaxPointScale || (scale & (scale - 1)) != 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "metadata '" << kScaleKey << "' is " << scale << ", not a power of two from 1 to "
                         << kMaxPointScale);
    }
    return scale;
}

} // namespace detail
} // namespace openvdb_spheretree
