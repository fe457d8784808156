// SPDX-License-Identifier: Apache-2.0
#include "FrameName.h"

#include "base/Errors.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>

namespace command {

namespace {

struct Placeholder {
    std::size_t begin, size;
    int width;
    bool zeros; ///< in front, else blanks
};

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// That begins with the '%' at @a begin; nothing if there is none.
std::optional<Placeholder> percentAt(const std::string& name, std::size_t begin)
{
    std::size_t at = begin + 1;
    const bool zeros = at < name.size() && name[at] == '0';
    if (zeros) ++at;
    const bool wide = at < name.size() && isDigit(name[at]);
    const int width = wide ? name[at++] - '0' : 0;
    if (at >= name.size() || name[at] != 'd') return {};
    return Placeholder{begin, at + 1 - begin, width, zeros};
}

std::optional<Placeholder> nextPlaceholder(const std::string& name, std::size_t from)
{
    for (std::size_t i = from; i < name.size(); ++i) {
        if (name[i] == '%') {
            if (const auto found = percentAt(name, i)) return found;
        }
        if (name[i] != '#') continue;
        const std::size_t end = std::min(name.find_first_not_of('#', i), name.size());
        if (end - i >= 2)
            return Placeholder{i, end - i, int(std::min<std::size_t>(end - i, 20)), true};
    }
    return {};
}

std::string numberText(const Placeholder& place, int64_t frame)
{
    char text[64];
    std::snprintf(
        text, sizeof(text), place.zeros ? "%0*lld" : "%*lld", place.width, (long long)frame);
    return text;
}

/// Reads a whole number that begins there, and moves behind it.
std::optional<int64_t> readNumber(const char*& at, const char* end)
{
    int64_t number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc() || std::abs(double(number)) > 1e15) return {};
    at = stop;
    return number;
}

/// @return the name with other text in each of its places.
template <typename TextOf>
std::string replaced(const std::string& name, const TextOf& textOf)
{
    std::string result;
    std::size_t begin = 0;
    while (const auto place = nextPlaceholder(name, begin)) {
        result += name.substr(begin, place->begin - begin) + textOf(*place);
        begin = place->begin + place->size;
    }
    return result + name.substr(begin);
}

[[noreturn]] void refuseRange(const std::string& typed, const std::string& why)
{
    throwUsage("frames=" + oneLine(typed, 60) + " " + why
        + ": it takes ranges such as 1-25, 1-25x2 or 1,5,9-12");
}

/// Adds the frames of `7`, `1-25` or `1-25x2`.
void addRange(const std::string& part, const std::string& typed, std::vector<int64_t>& frames)
{
    const char *at = part.data(), *const end = at + part.size();
    const auto first = readNumber(at, end);
    if (!first) refuseRange(typed, "is not understood");
    int64_t last = *first, step = 1;
    if (at != end && *at == '-') {
        const auto number = readNumber(++at, end);
        if (!number || *number < *first) refuseRange(typed, "is not understood");
        last = *number;
        if (at != end && *at == 'x') {
            const auto every = readNumber(++at, end);
            if (!every || *every < 1) refuseRange(typed, "is not understood");
            step = *every;
        }
    }
    if (at != end) refuseRange(typed, "is not understood");
    if (uint64_t((last - *first) / step) >= kMostFrames - std::min(kMostFrames, frames.size())) {
        refuseRange(typed, "has more than " + std::to_string(kMostFrames) + " frames");
    }
    for (int64_t frame = *first; frame <= last; frame += step) frames.push_back(frame);
}

/// @return the number that stands in the place of a name, if it is that of a file.
/// @throw CommandError (input) if only its size keeps it from being one: the file would be passed over without a word
std::optional<int64_t> frameOf(
    const std::string& file, const std::string& name, const Placeholder& place)
{
    if (file.compare(0, place.begin, name, 0, place.begin) != 0) return {};
    const std::size_t begin = std::min(file.find_first_not_of(' ', place.begin), file.size());
    const char* at = file.data() + begin;
    const auto number = readNumber(at, file.data() + file.size());
    if (number) return withFrame(name, *number) == file ? number : std::nullopt;
    const std::size_t first = begin + (file.compare(begin, 1, "-") == 0 ? 1 : 0);
    const std::size_t last = std::min(file.find_first_not_of("0123456789", first), file.size());
    const std::string after = withFrame(name.substr(place.begin + place.size), 0);
    if (last - first > 15 && file.compare(last, std::string::npos, after) == 0)
        throwInput(oneLine(file, 200) + ": its number is too large for a frame: rename this file");
    return {};
}

} // namespace

bool hasFrame(const std::string& name) { return nextPlaceholder(name, 0).has_value(); }

std::string withFrame(const std::string& name, int64_t frame)
{
    return replaced(name, [frame](const Placeholder& place) { return numberText(place, frame); });
}

std::string withAnyDigits(const std::string& name)
{
    return replaced(name, [](const Placeholder&) { return "%d"; });
}

std::string patternOf(const std::vector<std::string>& names)
{
    if (names.size() < 2) return {};
    const std::string& first = names.front();
    std::size_t begin = first.size(),
                end = first.size(); // of the number, the end counted from behind
    for (const std::string& name : names) {
        const std::size_t least = std::min(name.size(), first.size());
        const auto differs = std::mismatch(name.begin(), name.begin() + long(least), first.begin());
        begin = std::min(begin, std::size_t(differs.first - name.begin()));
        const auto fromBehind =
            std::mismatch(name.rbegin(), name.rbegin() + long(least), first.rbegin());
        end = std::min(end, std::size_t(fromBehind.first - name.rbegin()));
    }
    while (begin > 0 && isDigit(first[begin - 1])) --begin;
    while (end > 0 && isDigit(first[first.size() - end])) --end;
    bool sameWidth = true;
    for (const std::string& name : names) {
        if (begin + end >= name.size()) return {};
        const auto number = name.begin() + long(begin), behind = name.end() - long(end);
        if (!std::all_of(number, behind, isDigit)) return {};
        sameWidth &= name.size() == first.size();
    }
    const std::size_t width = first.size() - begin - end;
    return first.substr(0, begin) + (sameWidth && width > 1 ? std::string(width, '#') : "%d")
        + first.substr(first.size() - end);
}

std::vector<int64_t> framesOnDisk(const std::string& path)
{
    namespace fs = std::filesystem;
    const std::string name = fs::path(path).filename().string();
    const fs::path folder = fs::path(path).parent_path();
    const auto place = nextPlaceholder(name, 0);
    if (!place) return {};
    std::set<int64_t> frames;
    std::error_code error;
    fs::directory_iterator entry(folder.empty() ? "." : folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const auto frame = frameOf(entry->path().filename().string(), name, *place);
        if (frame) frames.insert(*frame);
    }
    return {frames.begin(), frames.end()};
}

std::vector<int64_t> framesOfRange(const std::string& typed)
{
    std::vector<int64_t> frames;
    for (std::size_t begin = 0; begin <= typed.size();) {
        const std::size_t end = std::min(typed.find(',', begin), typed.size());
        addRange(typed.substr(begin, end - begin), typed, frames);
        begin = end + 1;
    }
    if (std::set<int64_t>(frames.begin(), frames.end()).size() != frames.size()) {
        refuseRange(typed, "names a frame twice");
    }
    return frames;
}

std::string rangeOfFrames(const std::vector<int64_t>& frames)
{
    std::string text;
    for (std::size_t i = 0; i < frames.size();) {
        std::size_t last = i;
        while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
        text += (text.empty() ? "" : ", ") + std::to_string(frames[i]);
        if (last > i) text += (last == i + 1 ? ", " : "-") + std::to_string(frames[last]);
        i = last + 1;
    }
    return text;
}

} // namespace command
