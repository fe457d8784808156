// SPDX-License-Identifier: Apache-2.0
#include "TreeMetadata.h"

#include "PointLeaves.h"
#include "SphereTreePoints.h"
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/tree/SettingsTable.h>

#include <algorithm>
#include <initializer_list>
#include <limits>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::GridBase;
using openvdb::Mat4d;
using openvdb::Vec3i;
using openvdb::math::Transform;

constexpr char kTransformKey[] = "spheretree_transform";
constexpr char kTransformTypeKey[] = "spheretree_transform_type";
constexpr char kSubdivisionKey[] = "spheretree_subdivision"; // in files without, it was 2
constexpr char kQualityKey[] = "spheretree_quality"; // came with all settings of tight trees
constexpr char kFlatAxisKey[] = "spheretree_flat_axis";
constexpr char kNextTrackKey[] = "spheretree_next_track"; // of trees of a sequence alone
constexpr int kMaxLevels = 1024; // far more than 32 bits of coordinates can be halved

std::string levelKey(int level, const char* what)
{
    return "spheretree_level_" + std::to_string(level) + "_" + what;
}

// ---- The transform

Mat4d matrixOf(const Transform& transform)
{
    return transform.baseMap()->getAffineMap()->getMat4();
}

/// Transform::operator== has a tolerance. Here every bit counts.
bool identical(const Transform& a, const Transform& b)
{
    return a.mapType() == b.mapType() && matrixOf(a) == matrixOf(b);
}

/// @return the transform of a grid whose voxels are @a scale times as wide.
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
    math::MapBase::Ptr map;
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

/// Scaling to the point grid and back may end in another type of map: a translation comes back as a
/// scale of 1 and a translation. Then the map itself is recorded.
void writeTransform(GridBase& grid, const Transform& source, int scale)
{
    if (identical(*scaled(grid.transform(), 1.0 / scale), source)) return;
    setMeta(grid, kTransformTypeKey, source.mapType());
    setMeta(grid, kTransformKey, matrixOf(source));
}

/// A recorded map counts only while it fits the grid's transform: who moves the points moves the
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

const char kBoundsName[] = "bounds"; // a setting that only trees within a bound record

bool hasBound(const SphereTreeSettings& settings)
{
    const auto* options = settings.find<BudgetOptions>();
    return options && options->budget.hasBound();
}

std::string readSetting(const GridBase& grid, const Setting& setting)
{
    switch (setting.type) {
    case SettingType::Flag: return getMeta<bool>(grid, setting.key) ? "1" : "0";
    case SettingType::Integer: return std::to_string(getMeta<int32_t>(grid, setting.key));
    case SettingType::Real:
    case SettingType::Length: return textOf(getMeta<double>(grid, setting.key));
    default: return getMeta<std::string>(grid, setting.key);
    }
}

void writeSettings(GridBase& grid, const SphereTree& tree)
{
    const SphereTreeSettings settings = recordedSettings(tree);
    for (const Setting& setting : settingsTable()) {
        if (setting.key.empty()) continue;
        if (setting.name == kBoundsName && !hasBound(settings)) continue;
        const std::string text = setting.get(settings);
        switch (setting.type) {
        case SettingType::Flag: setMeta<bool>(grid, setting.key, text == "1"); break;
        case SettingType::Integer: setMeta<int32_t>(grid, setting.key, std::stoi(text)); break;
        case SettingType::Real:
        case SettingType::Length:
            if (!text.empty()) setMeta<double>(grid, setting.key, realOf(text));
            break;
        default:
            if (!text.empty() || !setting.isOptional) setMeta<std::string>(grid, setting.key, text);
        }
    }
    if (settings.dim == 2) setMeta<int32_t>(grid, kFlatAxisKey, tree.flatAxis);
}

/// Files were first written without the settings of tight trees, and without some others.
bool mayLack(const Setting& setting, bool beforeTight)
{
    if (setting.isOptional) return true;
    return beforeTight && (!setting.isForPyramids() || setting.name == "center");
}

/// Files record the settings of all kinds of trees: one that this kind has not is at its default.
/// But version 0.1 recorded any final_fit and reconstruct of reversible trees, which use neither.
void requireDefault(
    const Setting& setting, const SphereTreeSettings& settings, const std::string& text)
{
    if (setting.isFor(settings) || text == setting.get(settings)) return;
    if (setting.isForPyramids() && settings.find<PyramidOptions>()) return;
    OPENVDB_THROW(openvdb::ValueError,
        setting.name << "=" << onOneLine(text, 60)
                     << " is not for tree=" << toString(settings.type())
                     << (settings.isInner()        ? " side=inner"
                                : settings.isFit() ? " side=fit"
                                                   : ""));
}

SphereTreeSettings readSettings(const GridBase& grid)
{
    const Setting &tree = settingNamed("tree"), &side = settingNamed("side");
    const std::string type = readSetting(grid, tree);
    const bool beforeTight = type != "tight" && !grid[kQualityKey];
    SphereTreeSettings settings =
        settingsOfKind(type, beforeTight ? "outer" : readSetting(grid, side));
    settings.topology = false; // as of files without
    for (const Setting& setting : settingsTable()) {
        if (setting.key.empty() || &setting == &tree || &setting == &side) continue;
        if (!grid[setting.key] && mayLack(setting, beforeTight)) continue;
        const std::string text = readSetting(grid, setting);
        auto* pyramid = settings.find<PyramidOptions>();
        const bool custom = setting.name == "model" && text == "custom" && pyramid;
        if (custom) {
            pyramid->customModel = unknownModel();
            continue;
        }
        setting.set(settings, text);
        requireDefault(setting, settings, text);
    }
    auto* budgeted = settings.find<BudgetOptions>();
    if (budgeted && hasBound(settings) && !grid[settingNamed(kBoundsName).key]) {
        budgeted->budget.bounds = BoundOf::Unpadded; // what bounds of version 0.1 were of
    }
    settings.name = grid.getName();
    settings.validate();
    return settings;
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
    if (level.stored) {
        setMeta<double>(grid, key("stored_hamming_percent"), level.stored->hammingPercent);
        setMeta<double>(grid, key("stored_reach"), level.stored->reachWorld);
    }
    if (!level.storedUnknown.empty()) setMeta(grid, key("stored_unknown"), level.storedUnknown);
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
    const auto hasAny = [&](std::initializer_list<const char*> ends) {
        return std::any_of(
            ends.begin(), ends.end(), [&](const char* what) { return bool(grid[key(what)]); });
    };
    if (hasAny({"components", "tunnels", "cavities"})) {
        level.topology = LevelTopology{getMeta<int64_t>(grid, key("components")),
            getMeta<int64_t>(grid, key("tunnels")), getMeta<int64_t>(grid, key("cavities"))};
    }
    if (hasAny({"covered", "excess", "missing", "hamming_percent", "hausdorff"})) {
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
    if (hasAny({"stored_hamming_percent", "stored_reach"})) {
        StoredError stored;
        stored.hammingPercent = getMeta<double>(grid, key("stored_hamming_percent"));
        stored.reachWorld = getMeta<double>(grid, key("stored_reach"));
        level.stored = stored;
    }
    if (grid[key("stored_unknown")]) {
        level.storedUnknown = getMeta<std::string>(grid, key("stored_unknown"));
    }
    return level;
}

std::vector<SphereTreeLevel> readLevels(const GridBase& grid)
{
    const int count = getMeta<int32_t>(grid, kLevelsKey);
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

int32_t readNextTrack(const GridBase& grid)
{
    const auto next = getMeta<int32_t>(grid, kNextTrackKey);
    if (next > 0) return next;
    OPENVDB_THROW(openvdb::ValueError,
        "metadata '" << kNextTrackKey << "' is " << next << ": tracks are counted from 0 on");
}

} // namespace

void writeTreeMetadata(GridBase& grid, const SphereTree& tree, int scale)
{
    grid.setName(tree.settings.name);
    setMeta<int32_t>(grid, kFormatKey, kPointsFormat);
    setMeta<int32_t>(grid, kScaleKey, scale);
    writeTransform(grid, *tree.transform, scale);
    setMeta<int32_t>(grid, kSubdivisionKey, tree.subdivision);
    writeSettings(grid, tree);
    setMeta(grid, "spheretree_source", tree.object.name);
    setMeta(grid, "spheretree_object_voxels", tree.object.voxels);
    setMeta(grid, "spheretree_object_leaves", tree.object.leaves);
    setMeta(grid, "spheretree_object_tiles", tree.object.tiles);
    setMeta(grid, "spheretree_object_bbox_min", tree.object.bbox.min().asVec3i());
    setMeta(grid, "spheretree_object_bbox_max", tree.object.bbox.max().asVec3i());
    setMeta(grid, "spheretree_origin", tree.origin.asVec3i());
    setMeta<int32_t>(grid, kLevelsKey, int32_t(tree.levels.size()));
    setMeta<int32_t>(grid, "spheretree_lowest_level", tree.levels.front().level);
    if (tree.nextTrack > 0) setMeta<int32_t>(grid, kNextTrackKey, tree.nextTrack);
    for (const SphereTreeLevel& level : tree.levels) writeLevel(grid, level);
}

SphereTree readTreeMetadata(const GridBase& grid)
{
    SphereTree tree;
    tree.transform = readTransform(grid, readPointScale(grid));
    tree.settings = readSettings(grid);
    if (grid[kFlatAxisKey]) tree.flatAxis = getMeta<int32_t>(grid, kFlatAxisKey);
    if (tree.flatAxis < 0 || tree.flatAxis > 2) {
        OPENVDB_THROW(openvdb::ValueError,
            "the flat axis " << tree.flatAxis << " is out of range: it must be 0, 1 or 2");
    }
    if (const auto* options = tree.settings.find<PyramidOptions>()) tree.hasDag = options->dag;
    if (const auto* options = tree.settings.find<BudgetOptions>()) tree.hasCuts = options->cuts;
    const bool tight = tree.settings.type() == TreeType::Tight;
    if (tight || grid[kSubdivisionKey]) tree.subdivision = getMeta<int32_t>(grid, kSubdivisionKey);
    tree.object.name = getMeta<std::string>(grid, "spheretree_source");
    tree.object.voxels = getMeta<int64_t>(grid, "spheretree_object_voxels");
    tree.object.leaves = getMeta<int64_t>(grid, "spheretree_object_leaves");
    tree.object.tiles = getMeta<int64_t>(grid, "spheretree_object_tiles");
    const auto coord = [&](const char* key) { return openvdb::Coord(getMeta<Vec3i>(grid, key)); };
    const openvdb::Coord least = coord("spheretree_object_bbox_min");
    tree.object.bbox.reset(least, coord("spheretree_object_bbox_max"));
    tree.origin = coord("spheretree_origin");
    if (grid[kNextTrackKey]) tree.nextTrack = readNextTrack(grid);
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

} // namespace openvdb_spheretree::detail
