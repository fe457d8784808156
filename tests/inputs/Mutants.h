// SPDX-License-Identifier: Apache-2.0
/// @file Mutants.h
/// @brief Damage done to a file: anywhere, or to a field at its place.
///
/// The same numbers from the same generator give the same mutant on every machine.

#pragma once

#include "FileFields.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace spheretree_test {

using Random = std::mt19937_64;

/// @return a number from 0 to @a count - 1. (The standard's distributions differ between libraries.)
inline std::size_t below(std::size_t count, Random& random)
{
    return std::size_t(random() % std::max<uint64_t>(count, 1));
}

/// One to four changes at random places: bytes, bits, words, and parts cut out, doubled or moved.
std::string randomMutant(std::string bytes, Random& random);

/// One or two fields changed: a number to one that is likely to hurt, a flag, bits of a mask, a part
/// of a block; a field left out, doubled, or written over another; a text and its length.
/// @param fields  of @a bytes, by vdbFields()
std::string fieldMutant(std::string bytes, const std::vector<Field>& fields, Random& random);

} // namespace spheretree_test
