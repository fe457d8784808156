// SPDX-License-Identifier: Apache-2.0
/// @file ExportFormat.h
/// @brief The formats that other tools read: which extension means which, and what each keeps of a tree.

#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace openvdb_spheretree {

namespace detail {
struct ExportScene;
struct ExportSink;
} // namespace detail

/// What the numbers of a format are. Spheres are rounded to them before they are written.
enum class ExportNumbers {
    Decimal, ///< text, with as many decimals as a millionth of the smallest radius has (of a voxel where all are 0)
    Float,   ///< 4 bytes
    Double   ///< 8 bytes
};

/// Which letters the names in a format may have. What a name has besides is refused where the file's readers look
/// for that name, and is said in a note where it is for people.
enum class ExportNames {
    Bytes,      ///< any, or the format holds no names
    Utf8,       ///< those of Unicode
    Xml,        ///< those of Unicode that XML 1.0 can hold: but few control letters
    Word,       ///< those of ASCII but blanks; others become `_`
    Identifier, ///< letters of ASCII, digits and `_`; others become `_`
};

struct ExportFormat {
    std::string name;                    ///< as it is asked for by name
    std::vector<std::string> extensions; ///< with their dots, in lower case
    bool byExtension = true;             ///< whether its extensions mean it when no name is given
    std::string readers;                 ///< tools that read it
    std::string keeps;                   ///< of a tree
    ExportNumbers numbers = ExportNumbers::Decimal;
    ExportNames names = ExportNames::Bytes;
    bool link = false;      ///< holds the name of a link
    bool links = false;     ///< holds several trees, each the spheres of a link of one robot
    bool empty = false;     ///< can be a file without spheres
    bool allLevels = false; ///< holds more than one level
    bool samples = false;   ///< holds several trees, as samples over time
    bool mass = false;      ///< has a mass and inertia
    bool up = false;        ///< says which axis is up
    bool metres = false;    ///< its readers take its numbers for metres
    bool floatIds = false;  ///< its ids are floats, which are whole up to 2^24: beyond, it has none
    bool ordersIds = false; ///< its ids count from the top level on: tracks have no place
    bool positiveRadii = false; ///< its readers refuse a radius of 0
    bool ids = false;           ///< holds which sphere is which, and whose child
    bool named = true;          ///< holds the name of what is in it
    bool errors = false;        ///< has errors of another kind than those of trees, which are 0
    bool principal = false;     ///< wants the frame of the body, and is told its mass by hand
    /// Why this build does not write it: what it lacks. Empty if it does.
    std::string missing;
    void (*write)(
        const std::vector<detail::ExportScene>& scenes, const detail::ExportSink& out) = nullptr;
};

/// An option of export that means something to formats of one kind alone.
struct ExportOption {
    const char* name;
    bool ExportFormat::*takes; ///< whether a format heeds it
    const char* lacks;         ///< why others do not: ".ply files hold no links"
};

/// @return all of them; what other options say holds for any format.
const std::vector<ExportOption>& exportOptionsOfSome();

/// @return a sentence: that an option which was given changes nothing in a file, as its format lacks what it is about.
std::string idleOptionNote(
    const ExportOption& option, const ExportFormat& format, const std::string& path);

/// @return all of them, in the order in which they are listed.
const std::vector<ExportFormat>& exportFormats();

/// @param extension  with its dot, in lower case
/// @param name       of the format; if empty, the one that the extension means
/// @return null if there is none: no format of that name has this extension
const ExportFormat* findExportFormat(const std::string& extension, const std::string& name = {});

} // namespace openvdb_spheretree
