// SPDX-License-Identifier: Apache-2.0
/// @file EnumNames.h
/// @brief The names of an enumeration's values, as options and files spell them, and back.

#pragma once

#include "Text.h"

#include <openvdb/Exceptions.h>

#include <array>
#include <cstddef>
#include <string>

namespace openvdb_spheretree::detail {

template <typename Enum>
struct Named {
    Enum value;
    const char* name;
};

template <typename Enum, std::size_t N>
const char* nameOf(const std::array<Named<Enum>, N>& names, Enum value)
{
    for (const auto& entry : names) {
        if (entry.value == value) return entry.name;
    }
    return "?";
}

/// "a, b or c"
template <typename Enum, std::size_t N>
std::string listOf(const std::array<Named<Enum>, N>& names)
{
    std::string text;
    for (std::size_t i = 0; i < N; ++i) {
        if (i > 0) text += i + 1 < N ? ", " : " or ";
        text += names[i].name;
    }
    return text;
}

/// @param setting  what is being read, for the message
/// @throw openvdb::ValueError that lists the names, if @a text is none of them
template <typename Enum, std::size_t N>
Enum fromName(const std::array<Named<Enum>, N>& names, const char* setting, const std::string& text)
{
    for (const auto& entry : names) {
        if (text == entry.name) return entry.value;
    }
    OPENVDB_THROW(openvdb::ValueError,
        setting << "=" << inQuotes(text) << " is unknown: choose " << listOf(names));
}

} // namespace openvdb_spheretree::detail
