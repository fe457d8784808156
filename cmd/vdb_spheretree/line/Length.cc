// SPDX-License-Identifier: Apache-2.0
#include "Length.h"

#include <charconv>

namespace command {

const std::vector<std::pair<std::string, double>>& unitsOfLength()
{
    static const std::vector<std::pair<std::string, double>> units = {{"mm", 1e-3}, {"cm", 1e-2},
        {"m", 1}, {"in", 0.0254}, {"ft", 0.3048}, {"um", 1e-6}, {"km", 1e3}};
    return units;
}

std::optional<double> metresOfUnit(const std::string& unit)
{
    for (const auto& [name, metres] : unitsOfLength()) {
        if (unit == name) return metres;
    }
    return std::nullopt;
}

std::optional<Length> parseLength(const std::string& typed)
{
    double number = 0;
    const char* const end = typed.data() + typed.size();
    const auto parsed = std::from_chars(typed.data(), end, number);
    if (parsed.ec != std::errc()) return std::nullopt;
    const std::string unit(parsed.ptr, end);
    const auto metres = metresOfUnit(unit);
    if (!metres) return std::nullopt;
    return Length{number * *metres, unit};
}

} // namespace command
