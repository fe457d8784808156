// SPDX-License-Identifier: Apache-2.0
/// @file StatsMass.h
/// @brief Volume, center of mass and inertia as -stats has them: of the object, and if asked for of
/// each level.

#pragma once

#include "session/Session.h"

#include <openvdb_spheretree/measure/MassProperties.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace command {

struct LevelMass {
    std::optional<openvdb_spheretree::MassProperties> mass; ///< of the spheres as stored
    std::string unknown;                                    ///< why there is none
};

struct StatsMass {
    std::optional<openvdb_spheretree::MassProperties> object; ///< where the object is known
    std::vector<LevelMass> levels; ///< one a level of the tree; none if not asked for
};

/// Takes the time as that of errors. @param levels  whether those of levels are asked for
StatsMass massOf(const StackItem& item, bool levels, Session& session);

/// The line of the object; nothing where it is not known.
void printMass(std::ostream& out, const StatsMass& mass);

/// The table of levels, and why some have none; nothing if not asked for.
void printLevelMass(std::ostream& out, const openvdb_spheretree::SphereTree& tree,
    const StatsMass& mass, std::size_t limit);

} // namespace command
