// SPDX-License-Identifier: Apache-2.0
/// @file TreeSettings.h
/// @brief For tests that go through kinds of trees: one kind of settings made another, and the
/// options of an extended tree with their defaults for others.

#pragma once

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

namespace spheretree_test {

/// Makes @a settings those of a tree of @a type; what both kinds have stays.
inline void setType(
    openvdb_spheretree::SphereTreeSettings& settings, openvdb_spheretree::TreeType type)
{
    using namespace openvdb_spheretree;
    const auto* shared = settings.find<PyramidOptions>();
    const PyramidOptions pyramid = shared ? *shared : PyramidOptions();
    if (settings.type() == type) return;
    if (type == TreeType::Tight) settings.kind = TightOptions();
    else if (type == TreeType::Extended) settings.kind = ExtendedOptions();
    else settings.kind = ReversibleOptions();
    if (type != TreeType::Tight) settings.pyramid() = pyramid;
}

/// @return the options, or the defaults of a tree of another kind.
template <typename Options>
Options optionsOr(const openvdb_spheretree::SphereTreeSettings& settings)
{
    const auto* options = settings.find<Options>();
    return options ? *options : Options();
}

} // namespace spheretree_test
