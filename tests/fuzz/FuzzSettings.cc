// SPDX-License-Identifier: Apache-2.0
/// @file FuzzSettings.cc
/// @brief Fuzz target: settings from text. Lines `name=value` are set one after the other; what was
/// accepted must come back as text that is accepted, and gives the same.

#include "FuzzTarget.h"

#include <openvdb_spheretree/tree/SettingsTable.h>

#include <openvdb/Exceptions.h>

#include <sstream>

namespace {

using namespace openvdb_spheretree;
using spheretree_test::require;

const detail::Setting* settingOf(const std::string& name)
{
    for (const detail::Setting& setting : detail::settingsTable()) {
        if (setting.name == name) return &setting;
    }
    return nullptr;
}

void setAndGet(
    SphereTreeSettings& settings, const detail::Setting& setting, const std::string& text)
{
    setting.set(settings, text);
    const std::string once = setting.get(settings);
    setting.set(settings, once);
    require(setting.get(settings) == once, "a setting that reads back as another one");
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    SphereTreeSettings settings;
    std::istringstream lines(spheretree_test::textOf(data, size));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t equals = std::min(line.find('='), line.size());
        const detail::Setting* const setting = settingOf(line.substr(0, equals));
        if (!setting || equals == line.size()) continue;
        try {
            setAndGet(settings, *setting, line.substr(equals + 1));
            settings.validate();
        } catch (const openvdb::ValueError&) { // as it should be
        }
    }
    return 0;
}
