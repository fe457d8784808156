// SPDX-License-Identifier: Apache-2.0
/// @file TreeSettings.h
/// @brief For tests that go through kinds of trees: one kind of settings made another, and the
/// options of an extended tree with their defaults for others.

#pragma once

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

namespace spheretree_test {

/// Makes @a settings those of a tree of @a type; what both kinds have stays.
void setType(openvdb_spheretree::SphereTreeSettings& settings, openvdb_spheretree::TreeType type);

/// @return the options, or the defaults of a tree of another kind.
template <typename Options>
Options optionsOr(const openvdb_spheretree::SphereTreeSettings& settings)
{
    const auto* options = settings.find<Options>();
    return options ? *options : Options();
}

} // namespace spheretree_test
