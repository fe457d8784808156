// SPDX-License-Identifier: Apache-2.0
/// @file FrameName.h
/// @brief Frame numbers in names, as `####` and `%04d`, and sequences of files.
///
/// A placeholder is two or more `#`, or `%d`, `%4d`, `%04d`. Both are as printf has them: a number of
/// more digits takes more, and a minus is one of the characters. A single `#` is a part of the name.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace command {

/// @return whether a name has a place for a frame number.
bool hasFrame(const std::string& name);

/// @return the name with the number in each of its places.
std::string withFrame(const std::string& name, int64_t frame);

/// @return the name with `%d` for its places, which takes numbers of any number of digits.
std::string withAnyDigits(const std::string& name);

/// @return a name with a placeholder that has all of these: that of names that differ by one number alone. Empty if
///         they do not.
std::string patternOf(const std::vector<std::string>& names);

/// @return the frames for which there is a file, in order. Folders are taken as they are.
std::vector<int64_t> framesOnDisk(const std::string& name);

/// @return the frames of a text such as `1-25`, `1-25x2` (every other one) or `1,5,9-12`, in the order
///         in which they stand there.
/// @throw CommandError (usage) if it is none, names a frame twice, or more than kMostFrames
std::vector<int64_t> framesOfRange(const std::string& typed);
constexpr std::size_t kMostFrames = 100000;

/// @return frames in order as such a text, such as `1-6, 9-25`.
std::string rangeOfFrames(const std::vector<int64_t>& frames);

} // namespace command
