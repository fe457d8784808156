// SPDX-License-Identifier: Apache-2.0
/// @file RandomObjects.h
/// @brief Objects for tests, each given by its seed: many shapes and fill rates, small enough for
/// NaiveReference.h, and lying across the borders where sparse code goes wrong: of leaves (8), of
/// internal nodes (128, 4096), of the sign of coordinates.

#pragma once

#include "NaiveReference.h"

#include <cstdint>
#include <random>
#include <string>

namespace spheretree_test {

struct RandomObject {
    std::string name; ///< seed and shape, for messages
    Voxels voxels;    ///< never empty
};

/// The same numbers everywhere, which the distributions of <random> do not promise.
class Random {
public:
    explicit Random(uint32_t seed) : mEngine(seed) {}

    /// @return a number in [low, high].
    int between(int low, int high) { return low + int(mEngine() % uint32_t(high - low + 1)); }
    bool chance(double rate) { return double(mEngine()) < rate * 4294967296.0; }
    Coord coord(int low, int high);

private:
    std::mt19937 mEngine;
};

namespace shapes {

Voxels box(const Coord& size);

/// Voxels nearer to the centre than the root of @a radiusSq, and not nearer than that of @a holeSq.
Voxels ball(int radiusSq, int holeSq = 0);

Voxels noise(const Coord& size, double rate, Random& random);

/// A solid with a few voxels missing.
Voxels pricked(const Voxels& solid, double rate, Random& random);

} // namespace shapes

/// Moves the voxels so that a random one of their box comes to lie on a border of nodes.
void placeOnBorder(Voxels& voxels, Random& random);

RandomObject randomObject(uint32_t seed);

} // namespace spheretree_test
