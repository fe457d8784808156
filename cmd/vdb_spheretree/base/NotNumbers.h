// SPDX-License-Identifier: Apache-2.0
/// @file NotNumbers.h
/// @brief The words for values of a grid that are NaN.

#pragma once

#include "Terminal.h"

#include <cstdint>
#include <string>

namespace command {

inline std::string notNumbersText(int64_t count)
{
    return withCommas(count)
        + (count == 1 ? " value is no number (NaN), and counts"
                      : " values are no numbers (NaN), and count")
        + " as outside";
}

} // namespace command
