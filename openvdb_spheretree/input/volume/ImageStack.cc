// SPDX-License-Identifier: Apache-2.0
#include "ImageStack.h"

#include "VolumeFile.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace openvdb_spheretree {
namespace {

using detail::GrayImage;
using openvdb::IoError;

/// A name with a place for a number.
struct StackPattern {
    std::string before, after;
    std::size_t digits = 1; ///< at least so many, filled with zeros
};

/// @return the pattern of a file's name; nothing if it has no place for a number, or two.
std::optional<StackPattern> patternOf(const std::string& name)
{
    std::optional<StackPattern> found;
    for (std::size_t i = 0; i < name.size(); ++i) {
        std::size_t end = i;
        StackPattern pattern;
        if (name[i] == '#') {
            while (end < name.size() && name[end] == '#') ++end;
            pattern.digits = end - i;
        } else if (name[i] == '%') {
            end = std::min(name.find_first_not_of("0123456789", i + 1), name.size());
            const auto width = detail::parseNumber<unsigned>(name.substr(i + 1, end - i - 1));
            const bool isNumber = end < name.size() && name[end] == 'd'
                && (end == i + 1 || (name[i + 1] == '0' && width && *width <= 18));
            if (!isNumber) continue;
            pattern.digits = std::max(1u, width.value_or(1));
            ++end;
        } else {
            continue;
        }
        if (found) return std::nullopt;
        pattern.before = name.substr(0, i);
        pattern.after = name.substr(end);
        found = pattern;
        i = end - 1;
    }
    return found;
}

/// @return the number of a file's name; nothing if it is none of the pattern's.
/// @param stack  the name with the place for a number, for messages
/// @throw IoError if it has more than 64 bits: passed over, its slice would be missing without a word
std::optional<uint64_t> numberOf(
    const std::string& name, const StackPattern& pattern, const std::string& stack)
{
    const std::size_t around = pattern.before.size() + pattern.after.size();
    if (name.size() <= around || name.compare(0, pattern.before.size(), pattern.before) != 0
        || name.compare(name.size() - pattern.after.size(), std::string::npos, pattern.after)
            != 0) {
        return std::nullopt;
    }
    const std::string digits = name.substr(pattern.before.size(), name.size() - around);
    const bool isLonger = digits.size() > pattern.digits;
    if (digits.size() < pattern.digits || (isLonger && digits[0] == '0')) return std::nullopt;
    if (digits.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    const auto number = detail::parseNumber<uint64_t>(digits);
    if (!number) {
        throw IoError(
            stack + ": the number of " + name + " is too large for a slice: rename that file");
    }
    return number;
}

std::string withNumber(const StackPattern& pattern, uint64_t number)
{
    std::string digits = std::to_string(number);
    if (digits.size() < pattern.digits) digits.insert(0, pattern.digits - digits.size(), '0');
    return pattern.before + digits + pattern.after;
}

/// @throw IoError if slices before these have numbers of fewer digits: they would be missing without a word
void requireAllDigits(const std::filesystem::path& folder, const StackPattern& pattern,
    uint64_t first, const std::string& stack)
{
    if (pattern.digits == 1 || first == 0) return;
    StackPattern shorter = pattern;
    shorter.digits = 1;
    const std::string before = withNumber(shorter, first - 1);
    std::error_code error;
    if (before == withNumber(pattern, first - 1)) return;
    if (!std::filesystem::exists(folder / before, error)) return;
    throw IoError(stack + ": there is " + (folder / before).string()
        + " as well, whose number has fewer digits: %d in the name takes all of them");
}

} // namespace

bool isStackName(const std::string& path)
{
    std::error_code error;
    return detail::isImageFileName(path)
        && patternOf(std::filesystem::path(path).filename().string())
        && !std::filesystem::exists(path, error);
}

std::vector<std::string> stackFiles(const std::string& name)
{
    const std::filesystem::path path(name), folder = path.parent_path();
    const auto pattern = patternOf(path.filename().string());
    std::vector<uint64_t> numbers;
    std::error_code error;
    std::filesystem::directory_iterator files(folder.empty() ? "." : folder, error);
    for (; pattern && !error && files != std::filesystem::directory_iterator();
         files.increment(error)) {
        if (const auto number = numberOf(files->path().filename().string(), *pattern, name)) {
            numbers.push_back(*number);
        }
    }
    if (error) throw IoError(name + ": its folder cannot be read: " + error.message());
    if (numbers.empty()) throw IoError(name + ": no file has such a name with a number");
    std::sort(numbers.begin(), numbers.end());
    requireAllDigits(folder, *pattern, numbers.front(), name);
    std::vector<std::string> slices;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto file = [&](uint64_t number) {
            return (folder / withNumber(*pattern, number)).string();
        };
        if (numbers[i] != numbers[0] + i) {
            throw IoError(name + ": there is no " + file(numbers[0] + i) + ", but "
                + file(numbers[i - 1]) + " and " + file(numbers[i]));
        }
        slices.push_back(file(numbers[i]));
    }
    return slices;
}

namespace detail {

std::string stackTitle(const std::string& name)
{
    const auto pattern = patternOf(std::filesystem::path(name).filename().string());
    const std::string before = pattern ? pattern->before : std::string();
    const auto last = before.find_last_not_of("_-. ");
    return last == std::string::npos ? "slices" : before.substr(0, last + 1);
}

StackBytes::StackBytes(std::vector<std::string> files, std::string shownAs)
    : mFiles(std::move(files)), mShownAs(std::move(shownAs))
{
    const GrayImage first = imageOf(mFiles[0]);
    mLayout.dim = {first.width, first.height, mFiles.size()};
    mLayout.type = first.bytesPerPixel == 1 ? NumberType::UInt8 : NumberType::UInt16;
    mLayout.bigEndian = isBigEndianMachine();
    requireSides(mLayout);
}

GrayImage StackBytes::imageOf(const std::string& file) const
{
    if (mFiles.size() == 1) return readGrayImage(file, mShownAs);
    try {
        return readGrayImage(file, file);
    } catch (const IoError& error) {
        throw IoError("slice " + file + ": " + messageOf(error));
    } catch (const openvdb::ValueError& error) { // more pixels than there is memory for
        throw IoError("slice " + file + ": " + messageOf(error));
    }
}

void StackBytes::read(uint8_t* out, uint64_t bytes)
{
    const std::size_t first = mNext, count = bytes / mLayout.sliceBytes();
    mNext += count;
    parallelFor(count, nullptr, [&](std::size_t i) {
        const std::string& file = mFiles[first + i];
        const GrayImage image = imageOf(file);
        if (image.width != mLayout.dim[0] || image.height != mLayout.dim[1]
            || image.bytesPerPixel != bytesOf(mLayout.type)) {
            throw IoError("slice " + file + " is " + std::to_string(image.width) + " x "
                + std::to_string(image.height) + " of " + std::to_string(8 * image.bytesPerPixel)
                + " bits, and the first one " + std::to_string(mLayout.dim[0]) + " x "
                + std::to_string(mLayout.dim[1]) + " of "
                + std::to_string(8 * bytesOf(mLayout.type)));
        }
        std::memcpy(out + i * image.bytes(), image.pixels.data(), image.bytes());
    });
}

} // namespace detail
} // namespace openvdb_spheretree
