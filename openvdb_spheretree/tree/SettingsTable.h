// SPDX-License-Identifier: Apache-2.0
/// @file SettingsTable.h
/// @brief Every setting of a sphere-tree, one row each. Files, JSON, the options of the command,
/// its help and its refusals all go by this table, so a setting that has a row is forgotten
/// nowhere. (Only the first line of -stats names its settings itself.) TestSettingsTable.cc sends each row through text and files.

#pragma once

#include "SphereTree.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// What a value is, in metadata, in JSON and on a command line.
enum class SettingType {
    Text,
    Choice,  ///< text, one of `choices`
    Counts,  ///< text in metadata; an array in JSON
    Flag,    ///< "1" or "0"
    Integer, ///< within [lowest, highest]
    Real,    ///< the same; "" for a bound that is not set: no metadata, and null in JSON
    Length   ///< the same; a text, such as 2vox, until files have it in world units
};

struct Setting {
    using Getter = std::function<std::string(const SphereTreeSettings&)>;
    using Setter = std::function<void(SphereTreeSettings&, const std::string&)>;

    std::string name; ///< of the option and of the member in JSON
    std::string key;  ///< of the metadata; empty: no file records it
    int jsonPlace;    ///< in the order of JSON, which never changes: a new row comes last; or -1
    SettingType type;
    std::string help; ///< a line for -help
    /// @return the value as text; the default, if the kind of tree has no such setting.
    Getter get;
    /// Sets the value where the kind of tree has it.
    /// @throw openvdb::ValueError naming the setting, the value and the values there are
    Setter set;
    std::string fallback; ///< the default as it would be typed
    /// @name Which kinds of trees have it
    /// @{
    bool tight = true, inner = true, fit = true, extended = true, reversible = true, given = true;
    /// @}
    std::vector<std::string> choices = {}; ///< the default first
    bool isBound = false;    ///< on the error or on the distance: inner trees have none
    bool isOptional = false; ///< in files: some were written before there was such a setting
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();

    bool isFor(const SphereTreeSettings& settings) const;
    bool isForPyramids() const { return extended || reversible; }
};

/// All settings, in the order of -help. `tree` and then `side` come before all others that are set,
/// since they choose the kind.
const std::vector<Setting>& settingsTable();
/// @throw openvdb::LookupError if there is none of that name
const Setting& settingNamed(const std::string& name);
/// @return the settings in the order of JSON.
std::vector<const Setting*> settingsInJson();

/// @return default settings of the kind that these two name.
/// @throw openvdb::ValueError if a tree of another type than tight is to have a side
SphereTreeSettings settingsOfKind(const std::string& tree, const std::string& side);

/// @return the shortest text that reads back to the same double, and back.
std::string textOf(double value);
double realOf(const std::string& text);

/// @return what files say of @a tree: what was asked for, but edges and cuts only where it has
///         them.
SphereTreeSettings recordedSettings(const SphereTree& tree);

} // namespace openvdb_spheretree::detail
