// SPDX-License-Identifier: Apache-2.0
/// @file GivenSpheres.h
/// @brief Spheres that were read meet the object that they are held against.

#pragma once

#include "session/Session.h"

#include <string>

namespace command {

/// @brief Put spheres that were read into the frame of an object: their voxels are its voxels then, and
/// its errors can be counted. Of other items, and of spheres that have an object, nothing changes.
/// @param ageOrName  the object, as for Stack::select(); empty: the grid of the newest action that
///                   made just one that suits, if there is any
/// @throw CommandError (input) if @a ageOrName is given and suits no grid
void placeInObject(StackItem& item, Session& session, const std::string& ageOrName = {});

/// @brief Warns of what is so much larger or smaller than an object that the two have nothing to say of each other: one in
/// millimetres and one in metres.
/// @param what  as the sentence begins: "mesh 'hand' is"
/// @param size, object  of both, from corner to corner, in world units
void warnOfUnits(const std::string& what, double size, double object, Session& session);

} // namespace command
