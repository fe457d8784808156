// SPDX-License-Identifier: Apache-2.0
/// @file NotNumbers.h
/// @brief The words for values of a grid, or numbers of a file, that are NaN.

#pragma once

#include "Terminal.h"

#include <cstdint>
#include <string>

namespace command {

/// @param as  what they count as
inline std::string notNumbersText(int64_t count, const std::string& as = "outside")
{
    return withCommas(count)
        + (count == 1 ? " value is no number (NaN), and counts"
                      : " values are no numbers (NaN), and count")
        + " as " + as;
}

} // namespace command
