// SPDX-License-Identifier: Apache-2.0
/// @file Terminal.h
/// @brief Whether a stream is a terminal, colours for terminals, and numbers for people.

#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace command {

/// @return what tables and JSON are written to. Nothing else gets there: see below.
std::ostream& standardOutput();

/// @brief Open what is closed of standard input, output and error: a file that is opened later would get its number,
/// and with it what is meant for a person. Input is empty then, and writing to output fails. Call it before anything
/// is opened.
void holdStandardStreams();

/// @brief Have whatever libraries print to std::cout go to stderr: OpenVDB's warnings would get into
/// the middle of a `.vdb` on stdout.
void divertLibraries();

/// @return how many columns the terminal has that is standardOutput() or std::cerr; 0 if that is no
///         terminal, or one that does not say.
std::size_t terminalColumns(const std::ostream& stream);

/// @return the columns that UTF-8 takes on a terminal at most: two for what is not ASCII.
size_t columnsOf(const std::string& text);

/// @return @a text, or its start and "..." where it takes more columns.
std::string cutToColumns(const std::string& text, size_t columns);

/// @return @a text with its lines broken at blanks where they take more columns, and what goes on moved in by
///         four; 0 columns: as it is.
std::string brokenAt(const std::string& text, size_t columns);

enum class Colour { Red, Green, Yellow, Bold };

/// @return whether standardOutput() or std::cerr (no other stream) is a terminal.
bool isTerminal(const std::ostream& stream);

/// @return @a text, coloured if @a stream is a terminal and NO_COLOR is not set.
std::string coloured(const std::ostream& stream, Colour colour, const std::string& text);

/// @return a duration such as `3.1 ms` or `12.60 s`.
std::string prettySeconds(double seconds);

/// @return a whole number with commas between thousands.
std::string withCommas(long long number);

/// @return "1 sphere", "2,000 spheres".
std::string counted(long long number, const std::string& noun);

} // namespace command
