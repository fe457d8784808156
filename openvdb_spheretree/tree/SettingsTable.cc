// SPDX-License-Identifier: Apache-2.0
#include "SettingsTable.h"

#include <openvdb_spheretree/base/EnumNames.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <functional>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>

namespace openvdb_spheretree {

namespace {

using detail::Named;
using detail::nameOf;

// The default first, as -help has them.
constexpr std::array<Named<TreeType>, 3> kTreeTypes{{{TreeType::Tight, "tight"},
    {TreeType::Extended, "extended"}, {TreeType::Reversible, "reversible"}}};
constexpr char kGiven[] = "given"; // in files only: nobody can ask for it
enum class Side { Outer, Inner, Fit };
constexpr std::array<Named<Side>, 3> kSides{
    {{Side::Outer, "outer"}, {Side::Inner, "inner"}, {Side::Fit, "fit"}}};
constexpr std::array<Named<Quality>, 3> kQualities{
    {{Quality::Normal, "normal"}, {Quality::Fast, "fast"}, {Quality::Best, "best"}}};
constexpr std::array<Named<Cover>, 2> kCovers{{{Cover::Voxels, "voxels"}, {Cover::Balls, "balls"}}};
constexpr std::array<Named<Center>, 2> kCenters{
    {{Center::Medial, "medial"}, {Center::Miniball, "miniball"}}};
constexpr std::array<Named<Leaves>, 3> kLeaves{
    {{Leaves::Pruned, "pruned"}, {Leaves::Medial, "medial"}, {Leaves::Given, "given"}}};
constexpr std::array<Named<BoundOf>, 2> kBoundsOf{
    {{BoundOf::Stored, "stored"}, {BoundOf::Unpadded, "unpadded"}}};
constexpr std::array<Named<ParentRule>, 2> kParentRules{
    {{ParentRule::Centre, "centre"}, {ParentRule::Dag, "dag"}}};
constexpr std::array<Named<Reconstruction>, 3> kReconstructions{{{Reconstruction::Clip, "clip"},
    {Reconstruction::Free, "free"}, {Reconstruction::None, "none"}}};
constexpr std::array<Named<RadiusScale>, 2> kRadiusScales{
    {{RadiusScale::Tight, "tight"}, {RadiusScale::Paper, "paper"}}};
constexpr std::array<Named<DagEdges>, 2> kDagEdges{
    {{DagEdges::Shared, "shared"}, {DagEdges::Intersecting, "intersecting"}}};

} // namespace

const char* toString(TreeType value)
{
    return value == TreeType::Given ? kGiven : nameOf(kTreeTypes, value);
}
const char* toString(ParentRule value) { return nameOf(kParentRules, value); }
const char* toString(Reconstruction value) { return nameOf(kReconstructions, value); }
const char* toString(RadiusScale value) { return nameOf(kRadiusScales, value); }
const char* toString(DagEdges value) { return nameOf(kDagEdges, value); }
const char* toString(Quality value) { return nameOf(kQualities, value); }
const char* toString(Cover value) { return nameOf(kCovers, value); }
const char* toString(Center value) { return nameOf(kCenters, value); }
const char* toString(Leaves value) { return nameOf(kLeaves, value); }

namespace detail {

namespace {

/// The options of a kind, or what it shares; what all share are the settings themselves.
template <typename Owner, typename Settings>
auto* partOf(Settings& settings)
{
    if constexpr (std::is_same_v<Owner, SphereTreeSettings>) return &settings;
    else return settings.template find<Owner>();
}

template <typename T>
T numberOf(const std::string& name, const std::string& text)
{
    if (const auto value = parseNumber<T>(text)) return *value;
    OPENVDB_THROW(openvdb::ValueError, name << "=" << inQuotes(text) << " is no number");
}

/// @return the key in metadata; empty for what no file records.
std::string keyOf(const std::string& name)
{
    if (name == "name" || name == "memory") return ""; // the grid's own name; of this machine
    return "spheretree_" + (name == "edges" ? "dag_edges" : name);
}

/// @param access  a pointer to a member, or a function from the owner to a reference to its field
template <typename Owner, typename Access, typename Write, typename Read>
Setting row(const char* name, int jsonPlace, SettingType type, Access access, Write write,
    Read read, const char* help)
{
    Setting setting{name, keyOf(name), jsonPlace, type, help,
        [access, write](const SphereTreeSettings& settings) -> std::string {
            const Owner usual;
            const Owner* owner = partOf<Owner>(settings);
            return write(std::invoke(access, owner ? *owner : usual));
        },
        [access, read](SphereTreeSettings& settings, const std::string& text) {
            auto value = read(text); // a mistake is one in any kind of tree
            if (Owner* owner = partOf<Owner>(settings))
                std::invoke(access, *owner) = std::move(value);
        },
        ""};
    setting.fallback = setting.get({});
    const auto has = [](SphereTreeSettings settings) { return bool(partOf<Owner>(settings)); };
    setting.tight = has(TightOptions());
    setting.inner = has(InnerOptions());
    setting.fit = has(FitOptions());
    setting.extended = has(ExtendedOptions());
    setting.reversible = has(ReversibleOptions());
    setting.given = has(GivenOptions());
    return setting;
}

template <typename Names>
void addChoices(Setting& setting, const Names& names)
{
    setting.type = SettingType::Choice;
    for (const auto& entry : names) setting.choices.emplace_back(entry.name);
}

template <typename Owner, typename Names, typename Access>
Setting choice(const char* name, int jsonPlace, const Names& names, Access access, const char* help)
{
    Setting setting = row<Owner>(
        name, jsonPlace, SettingType::Choice, access,
        [&names](auto value) { return nameOf(names, value); },
        [&names, name](const std::string& text) { return fromName(names, name, text); }, help);
    addChoices(setting, names);
    return setting;
}

template <typename Owner, typename Access>
Setting flag(const char* name, int jsonPlace, Access access, const char* help)
{
    return row<Owner>(
        name, jsonPlace, SettingType::Flag, access, [](bool value) { return value ? "1" : "0"; },
        [name](const std::string& text) {
            if (text == "0" || text == "1") return text == "1";
            OPENVDB_THROW(
                openvdb::ValueError, name << "=" << inQuotes(text) << " is neither 0 nor 1");
        },
        help);
}

template <typename Owner, typename Access>
Setting integer(
    const char* name, int jsonPlace, int lowest, int highest, Access access, const char* help)
{
    Setting setting = row<Owner>(
        name, jsonPlace, SettingType::Integer, access,
        [](int value) { return std::to_string(value); },
        [name](const std::string& text) { return numberOf<int>(name, text); }, help);
    setting.lowest = lowest;
    setting.highest = highest;
    return setting;
}

/// A bound that need not be there.
template <typename Owner, typename Access>
Setting bound(const char* name, int jsonPlace, Access access, const char* help)
{
    Setting setting = row<Owner>(
        name, jsonPlace, SettingType::Real, access,
        [](const std::optional<double>& value) { return value ? textOf(*value) : ""; },
        [name](const std::string& text) {
            return text.empty() ? std::nullopt : std::optional(numberOf<double>(name, text));
        },
        help);
    setting.lowest = 0;
    setting.isOptional = setting.isBound = true;
    return setting;
}

/// All other settings, by functions of their own.
Setting special(
    const char* name, int jsonPlace, Setting::Getter get, Setting::Setter set, const char* help)
{
    Setting setting{
        name, keyOf(name), jsonPlace, SettingType::Text, help, std::move(get), std::move(set), ""};
    setting.fallback = setting.get({});
    return setting;
}

// ---- Rows that are more than a field

Setting treeRow()
{
    Setting setting = special(
        "tree", 0, [](const SphereTreeSettings& settings) { return toString(settings.type()); },
        [](SphereTreeSettings& settings, const std::string& text) {
            const bool given = text == kGiven;
            const TreeType type = given ? TreeType::Given : fromName(kTreeTypes, "tree", text);
            if (type == settings.type()) return;
            if (given) settings.kind = GivenOptions();
            else if (type == TreeType::Extended) settings.kind = ExtendedOptions();
            else if (type == TreeType::Reversible) settings.kind = ReversibleOptions();
            else settings.kind = TightOptions();
        },
        "tight: the least error for a number of spheres; the paper's two: extended: spheres "
        "contain the leaf balls below them; reversible: every level rebuilds its own pyramid "
        "level");
    addChoices(setting, kTreeTypes);
    return setting;
}

Side sideOf(const SphereTreeSettings& settings)
{
    if (settings.isFit()) return Side::Fit;
    return settings.isInner() ? Side::Inner : Side::Outer;
}

Setting sideRow()
{
    Setting setting = special(
        "side", 21,
        [](const SphereTreeSettings& settings) { return nameOf(kSides, sideOf(settings)); },
        [](SphereTreeSettings& settings, const std::string& text) {
            const Side side = fromName(kSides, "side", text);
            if (settings.type() != TreeType::Tight || side == sideOf(settings)) return;
            if (side == Side::Inner) settings.kind = InnerOptions();
            else if (side == Side::Fit) settings.kind = FitOptions();
            else settings.kind = TightOptions();
        },
        "outer: spheres cover the object; inner: they lie inside it and cover what they can; fit: "
        "the nearest ones, with the fewest voxels in excess or missing (tight)");
    addChoices(setting, kSides);
    setting.extended = setting.reversible = setting.given = false;
    return setting;
}

Setting distRow()
{
    return special(
        "dist", 4, [](const SphereTreeSettings& settings) { return toString(settings.dist()); },
        [](SphereTreeSettings& settings, const std::string& text) {
            const Distance dist = distanceFromString(text);
            if (auto* options = settings.find<PyramidOptions>()) {
                options->dist = dist;
            } else if (!dist.isEuclidean()) {
                OPENVDB_THROW(openvdb::ValueError,
                    "tree=" << toString(settings.type()) << " is for dist=l2, not for dist="
                            << toString(dist) << ": use tree=extended or tree=reversible");
            }
        },
        "what balls are balls of: l2 (Euclidean), l1, linf, or chamfer:a,b,c with the costs of a "
        "step across a face, an edge and a corner, such as chamfer:3,4,5; with dim=2 also "
        "chamfer:3,4 (tight: l2)");
}

Setting modelRow()
{
    Setting setting = special(
        "model", 3,
        [](const SphereTreeSettings& settings) {
            const auto* options = settings.find<PyramidOptions>();
            return modelToString(options ? *options : PyramidOptions());
        },
        [](SphereTreeSettings& settings, const std::string& text) {
            const int closing = closingFromString(text);
            if (auto* options = settings.find<PyramidOptions>()) options->closing = closing;
        },
        "what becomes of 2x2x2 voxels (or factor per axis): or, one voxel if any is on; or "
        "closing:R, the same after a closing by a ball of radius R, 1 to 64 voxels (extended, "
        "reversible)");
    setting.tight = setting.inner = setting.fit = setting.given = false;
    return setting;
}

/// Empty where the object's box decides, and then no file has it: those of 0.1 have not.
Setting originRow()
{
    Setting setting = row<PyramidOptions>(
        "origin", 25, SettingType::Text, [](auto& options) -> auto& { return options.origin; },
        originToString, originFromString,
        "where the pyramid's voxels are counted from: a voxel with coordinates that are multiples "
        "of 8, such as 0,0,0, and not above the object's first; by default that, rounded down "
        "(extended, reversible)");
    setting.key = "spheretree_pyramid_origin"; // "spheretree_origin" says where it is in the end
    setting.isOptional = true;
    return setting;
}

Setting branchingRow()
{
    Setting setting = integer<BudgetOptions>(
        "branching", 16, 2, SphereBudget::kMaxBranching,
        [](auto& options) -> auto& { return options.budget.branching; },
        "in place of spheres=: levels of 1, B, B^2, ... spheres, and all leaves (tight)");
    setting.fallback = std::to_string(SphereBudget::kDefaultBranching);
    return setting;
}

Setting paddingRow()
{
    return special(
        "padding", 9,
        [](const SphereTreeSettings& settings) {
            const bool none = settings.isInner() || settings.isFit() || settings.isGiven();
            return paddingToString(none ? 0 : settings.padding);
        },
        [](SphereTreeSettings& settings, const std::string& text) {
            const double padding = paddingFromString(text);
            const bool ignored = settings.isInner() || (settings.isFit() && padding <= 0);
            if (!ignored) settings.padding = padding; // more is refused with side=fit
        },
        "added to stored radii: cubes covers whole voxels, voxels their centres; or a number "
        "of voxels; nothing with side=inner and side=fit");
}

Setting spheresRow()
{
    return row<BudgetOptions>(
        "spheres", 15, SettingType::Counts,
        [](auto& options) -> auto& { return options.budget.spheres; }, countsToString,
        [](const std::string& text) {
            return text.empty() ? std::vector<int64_t>() : countsFromString(text);
        },
        "how many spheres levels have, at most, such as 512,64,8; one number with error= or "
        "distance= is the most that these may take (tight)");
}

/// A setting of budgets that spheres with side=fit do not have.
Setting notForFit(Setting setting)
{
    setting.fit = false;
    setting.set = [set = setting.set](SphereTreeSettings& settings, const std::string& text) {
        SphereTreeSettings other; // a mistake is one in any kind of tree
        set(settings.isFit() ? other : settings, text);
    };
    return setting;
}

Setting distanceRow()
{
    Setting setting = special(
        "distance", 18,
        [](const SphereTreeSettings& settings) {
            const auto* options = settings.find<BudgetOptions>();
            return options ? distanceBoundToString(options->budget) : std::string();
        },
        [](SphereTreeSettings& settings, const std::string& text) {
            SphereBudget other; // a mistake is one in any kind of tree
            auto* options = settings.find<BudgetOptions>();
            setDistanceBound(options ? options->budget : other, text);
        },
        "a level of few spheres that reach at most so far out of the object's voxels, as they are "
        "stored: in world units, such as 5, or in voxels, such as 2vox (tight)");
    setting.type = SettingType::Length;
    setting.lowest = 0;
    setting.isOptional = setting.isBound = true;
    setting.extended = setting.reversible = setting.given = false;
    return notForFit(std::move(setting));
}

/// Which spheres a bound is of. Files of trees without a bound do not record it.
Setting boundsRow()
{
    Setting setting = choice<BudgetOptions>(
        "bounds", 24, kBoundsOf, [](auto& options) -> auto& { return options.budget.bounds; },
        "what error= and distance= are bounds of: the spheres as they are stored, with padding; or "
        "unpadded ones, by the columns hamming % and hausdorff of -stats (tight)");
    setting.isOptional = setting.isBound = true;
    return setting;
}

Setting nameRow()
{
    return special(
        "name", 23, [](const SphereTreeSettings& settings) { return settings.name; },
        [](SphereTreeSettings& settings, const std::string& text) { settings.name = text; },
        "name of the tree");
}

Setting memoryRow()
{
    return special(
        "memory", -1,
        [](const SphereTreeSettings& settings) { return memoryToString(settings.memory); },
        [](SphereTreeSettings& settings, const std::string& text) {
            settings.memory = memoryFromString(text);
        },
        "what the labels of voxels may take while they are computed, then the levels of a tight "
        "tree: bytes such as 4GiB or 500MB, or a share of the machine's; more labels are "
        "compressed, and go to a temporary file in $TMPDIR where they must; the tree is the same");
}

Setting cutsRow()
{
    Setting setting = flag<BudgetOptions>("cuts", 22, &BudgetOptions::cuts,
        "also store the spheres of every number of spheres, for -level spheres=N (tight)");
    return notForFit(std::move(setting));
}

/// A setting that files of the first version may lack.
Setting optional(Setting setting)
{
    setting.isOptional = true;
    return setting;
}

std::vector<Setting> makeTable()
{
    return {treeRow(),
        integer<SphereTreeSettings>("dim", 2, 2, 3, &SphereTreeSettings::dim,
            "2 for an object one voxel thick along an axis"),
        optional(distRow()), paddingRow(),
        integer<PyramidOptions>("factor", 1, 2, kMaxFactor, &PyramidOptions::factor,
            "voxels per axis merged from level to level, 2 to 32768 (extended, reversible)"),
        optional(modelRow()), originRow(),
        choice<PyramidOptions>("center", 13, kCenters, &PyramidOptions::center,
            "where spheres are centred: where the medial ball is; or where the smallest sphere "
            "around the leaf balls below is (extended, reversible)"),
        choice<PyramidOptions>("parent", 5, kParentRules, &PyramidOptions::parent,
            "which ball a ball hangs below: by its centre, or by its edges in the Sphere-DAG "
            "(extended, reversible)"),
        flag<ExtendedOptions>("final_fit", 6, &ExtendedOptions::finalFit,
            "store the smallest radius around the leaf balls (extended)"),
        choice<ExtendedOptions>("reconstruct", 7, kReconstructions, &ExtendedOptions::reconstruct,
            "how a level is rebuilt before it is coarsened (extended)"),
        choice<PyramidOptions>("scale", 8, kRadiusScales, &PyramidOptions::scale,
            "how the radii of a level's balls become those of level 0 (reversible)"),
        flag<PyramidOptions>("dag", 10, &PyramidOptions::dag,
            "collect and store the edges of the Sphere-DAG too (extended, reversible)"),
        choice<PyramidOptions>("edges", 11, kDagEdges, &PyramidOptions::edges,
            "with dag=1: edges between balls whose cells share a voxel, or between all spheres "
            "that meet"),
        choice<TightOptions>("quality", 14, kQualities, &TightOptions::quality,
            "how much work goes into placing and searching spheres (tight)"),
        spheresRow(), branchingRow(),
        bound<BudgetOptions>(
            "error", 17, [](auto& options) -> auto& { return options.budget.error; },
            "a level of few spheres whose Hamming error, as they are stored, is at most this, "
            "in % (tight)"),
        distanceRow(), boundsRow(),
        choice<TightOptions>("cover", 19, kCovers, &TightOptions::cover,
            "what spheres contain for certain: together, down the tree, every voxel; or each of "
            "them the leaf balls below it (tight)"),
        choice<TightOptions>("leaves", 20, kLeaves, &TightOptions::leaves,
            "what level 0 is made of: the medial balls that are needed, or all; or given spheres, "
            "such "
            "as those that -read found in a .csv (tight)"),
        optional(flag<InnerOptions>("strict", 26, &InnerOptions::strict,
            "with side=inner: spheres lie inside the solid itself: in the union of the voxel cubes "
            "that are "
            "wholly in it")),
        cutsRow(), sideRow(),
        optional(flag<SphereTreeSettings>("topology", 12, &SphereTreeSettings::topology,
            "count components, tunnels and cavities of every level's voxels")),
        nameRow(), memoryRow()};
}

} // namespace

bool Setting::isFor(const SphereTreeSettings& settings) const
{
    return (tight && settings.find<TightOptions>()) || (inner && settings.isInner())
        || (fit && settings.isFit()) || (extended && settings.find<ExtendedOptions>())
        || (reversible && settings.find<ReversibleOptions>()) || (given && settings.isGiven());
}

const std::vector<Setting>& settingsTable()
{
    static const std::vector<Setting> kTable = makeTable();
    return kTable;
}

const Setting& settingNamed(const std::string& name)
{
    for (const Setting& setting : settingsTable()) {
        if (setting.name == name) return setting;
    }
    OPENVDB_THROW(openvdb::LookupError, "there is no setting '" << name << "'");
}

std::vector<const Setting*> settingsInJson()
{
    std::vector<const Setting*> settings;
    for (const Setting& setting : settingsTable()) {
        if (setting.jsonPlace >= 0) settings.push_back(&setting);
    }
    std::sort(settings.begin(), settings.end(),
        [](const Setting* a, const Setting* b) { return a->jsonPlace < b->jsonPlace; });
    return settings;
}

std::string textOf(double value)
{
    std::array<char, 32> text; // the shortest text of a double is at most 24 characters
    return std::string(
        text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

double realOf(const std::string& text) { return numberOf<double>("a number", text); }

SphereTreeSettings settingsOfKind(const std::string& tree, const std::string& side)
{
    SphereTreeSettings settings;
    settingNamed("tree").set(settings, tree);
    settingNamed("side").set(settings, side);
    if (settingNamed("side").get(settings) == side) return settings;
    OPENVDB_THROW(
        openvdb::ValueError, "side=" << side << " is for tree=tight, not for tree=" << tree);
}

SphereTreeSettings recordedSettings(const SphereTree& tree)
{
    SphereTreeSettings settings = tree.settings;
    if (auto* options = settings.find<PyramidOptions>()) options->dag = tree.hasDag;
    auto* options = settings.find<BudgetOptions>();
    if (!options) return settings;
    options->cuts = tree.hasCuts;
    SphereBudget& budget = options->budget;
    if (!budget.distance || !budget.distanceInVoxels || !tree.transform) return settings;
    budget.distance = budget.distanceWorld(tree.voxelSize());
    budget.distanceInVoxels = false;
    return settings;
}

} // namespace detail
} // namespace openvdb_spheretree
