// SPDX-License-Identifier: Apache-2.0
/// @file Build.cc
/// @brief Trees of volumes, by settings that go through the same table and the same refusals as the
/// options of -spheretree; and their check.

#include "Call.h"
#include "Errors.h"
#include "Tree.h"
#include "Volume.h"

#include "actions/TreeOptions.h"
#include "line/Action.h"
#include "line/Length.h"
#include "line/Plan.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/MeshCheck.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/tree/SettingsTable.h>
#include <openvdb_spheretree/tree/SphereTracks.h>

#include <openvdb/openvdb.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;
using Texts = std::map<std::string, std::string>;

namespace {

/// The options of -spheretree as those of a call in Python.
const command::ActionSpec& buildSpec()
{
    static const command::ActionSpec kSpec = [] {
        command::ActionSpec spec{"build", "", "", ""};
        spec.options = command::spheretreeOptions();
        spec.isLiteral = true;
        return spec;
    }();
    return kSpec;
}

/// Arrays are in no unit, so a length with one means nothing.
void requireNoUnit(const std::string& name, const std::string& text)
{
    const auto length = command::parseLength(text);
    if (!length) return;
    throw InputError(name + "=" + spheretree::detail::inQuotes(text)
        + ": nobody knows what unit the volume is in; give the number alone, in the units of "
          "anisotropy and matrix, or in voxels, such as \"2vox\"");
}

/// @return what @a work returns; the command's word for itself is taken off messages.
template <typename Work>
auto inKeywords(const Work& work)
{
    try {
        return work();
    } catch (const command::CommandError& error) {
        const std::string message = error.what(), start = "-build: ";
        throw InputError(message.rfind(start, 0) == 0 ? message.substr(start.size()) : message);
    }
}

command::ActionCall callOf(const Texts& settings)
{
    command::ActionCall call(buildSpec());
    for (const auto& [name, text] : settings) {
        const command::OptionSpec* option = buildSpec().option(name);
        if (!option) throw InputError("there is no setting '" + name + "'");
        requireNoUnit(name, text);
        call.give(*option, text);
    }
    command::Plan plan;
    command::checkTreeOptions(call, plan);
    return call;
}

/// Centers (n, 3) and radii (n), in world units, of leaves=given.
spheretree::WorldSpheres givenSpheres(const py::array_t<double, py::array::c_style>& centers,
    const py::array_t<double, py::array::c_style>& radii)
{
    if (centers.ndim() != 2 || centers.shape(1) != 3 || radii.ndim() != 1
        || centers.shape(0) != radii.shape(0)) {
        throw InputError("given is a pair of centers, an array (n, 3), and radii, an array (n,)");
    }
    spheretree::WorldSpheres spheres;
    spheres.name = "given";
    for (py::ssize_t i = 0; i < radii.shape(0); ++i) {
        spheres.center.emplace_back(centers.at(i, 0), centers.at(i, 1), centers.at(i, 2));
        spheres.radius.push_back(radii.at(i));
        if (!spheres.center.back().isFinite() || !(radii.at(i) > 0)
            || !std::isfinite(radii.at(i))) {
            throw InputError("given: sphere " + std::to_string(i)
                + " has a center that is not finite, or a radius that is not above 0");
        }
    }
    return spheres;
}

/// A cube of an object by other rules sticks out of the solid.
void requireWholeVoxels(const Volume& volume, const spheretree::SphereTreeSettings& settings)
{
    const auto* inner = settings.find<spheretree::InnerOptions>();
    const auto coverage = spheretree::coverageOf(*volume.object);
    if (!inner || !inner->strict || !coverage || *coverage == spheretree::Coverage::Whole) return;
    throw InputError(
        "strict=True wants voxels that lie wholly in the solid, and those of this volume do "
        "not: make it with coverage=\"whole\"");
}

TreePtr build(const Volume& volume, const Texts& texts, bool errors, const py::object& given,
    const TreePtr& like, CallSettings call)
{
    const auto [settings, work] = inKeywords([&] {
        const command::ActionCall options = callOf(texts);
        return std::pair(command::settingsOf(options), command::longWorkOf(options));
    });
    call.work = work;
    requireWholeVoxels(volume, settings);
    std::optional<spheretree::WorldSpheres> leaves;
    if (!given.is_none()) {
        const auto pair = py::cast<std::pair<py::array, py::array>>(given);
        leaves = givenSpheres(pair.first, pair.second);
    }
    const auto& wanted = settings; // a structured binding is not captured
    return resultOfCall(call, [&](Interrupter* interrupter) {
        const spheretree::TreeStart start{
            leaves ? &*leaves : nullptr, like ? &like->get() : nullptr};
        spheretree::SphereTree tree =
            spheretree::buildSphereTreeFrom(start, *volume.object, wanted, nullptr, interrupter);
        if (errors) spheretree::computeLevelErrors(tree, *volume.object, interrupter);
        return std::make_shared<Tree>(std::move(tree));
    });
}

/// Kinds and sentences.
py::list pairsOf(const std::vector<spheretree::TreeFault>& faults)
{
    py::list pairs;
    for (const auto& fault : faults) {
        pairs.append(py::make_tuple(textOf(toString(fault.kind)), textOf(fault.sentence)));
    }
    return pairs;
}

py::list check(const Tree& tree, const Volume& volume, const CallSettings& call)
{
    return pairsOf(resultOfCall(call, [&](Interrupter* interrupter) {
        return spheretree::checkSphereTree(tree.get(), *volume.object, interrupter);
    }));
}

/// @param volume  null: the object is not known
py::list checkMesh(const Tree& tree, const std::string& path, const std::string& units,
    const Volume* volume, const CallSettings& call)
{
    return pairsOf(resultOfCall(call, [&](Interrupter* interrupter) {
        const auto mesh = meshOfFile(path, units, interrupter);
        const openvdb::BoolGrid* const object = volume ? volume->object.get() : nullptr;
        return spheretree::checkAgainst(tree.get(), object, &mesh, interrupter);
    }));
}

/// The table, for whoever holds the keywords of build() against it.
py::list settingsTable()
{
    py::list rows;
    for (const auto& setting : spheretree::detail::settingsTable()) {
        py::dict row;
        row["name"] = setting.name;
        row["default"] = setting.fallback;
        row["help"] = setting.help;
        row["choices"] = setting.choices;
        rows.append(row);
    }
    return rows;
}

} // namespace

void bindBuild(py::module_& module)
{
    module.def("build",
        [](const Volume& volume, const Texts& settings, bool errors, const py::object& given,
            const TreePtr& like, const py::object& progress, int threads) {
            return build(volume, settings, errors, given, like, {progress, threads});
        });
    module.def("check",
        [](const Tree& tree, const Volume& volume, const py::object& progress, int threads) {
            return check(tree, volume, {progress, threads});
        });
    module.def("check_mesh",
        [](const Tree& tree, const std::string& path, const std::string& units,
            const Volume* volume, const py::object& progress, int threads) {
            return checkMesh(tree, path, units, volume, {progress, threads});
        });
    module.def("settings_table", settingsTable);
}

} // namespace binding
