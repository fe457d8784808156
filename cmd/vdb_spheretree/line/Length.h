// SPDX-License-Identifier: Apache-2.0
/// @file Length.h
/// @brief Lengths as they are typed, with a unit behind the number.

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace command {

/// @return the names of units of length, and how many metres each is.
const std::vector<std::pair<std::string, double>>& unitsOfLength();

/// @return how many metres a unit is, or nothing if it is none.
std::optional<double> metresOfUnit(const std::string& unit);

/// A number with a unit of length behind it, such as `5mm`.
struct Length {
    double metres = 0;
    std::string unit;
};

/// @return nothing where @a typed is no number, or has no unit of length behind it.
std::optional<Length> parseLength(const std::string& typed);

} // namespace command
