// SPDX-License-Identifier: Apache-2.0
#include "ExportNames.h"

#include "ExportText.h"
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/Utf8.h>

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

namespace {

/// @param option  that gives another name
void requireText(const std::string& name, const char* option, const ExportFormat& format)
{
    if (holdsName(format, name)) return;
    const std::string why = isUtf8(name)
        ? " has control characters, which " + format.name + " cannot hold: give another with "
        : " is not in UTF-8, and " + format.name + " holds no other: give one with ";
    OPENVDB_THROW(openvdb::ValueError, "the name " << inQuotes(name) << why << option);
}

/// Blanks become `_` without a word, as everywhere in names.
bool isPlain(const std::string& name)
{
    return std::all_of(name.begin(), name.end(), [](char c) { return c >= 32 && c < 127; });
}

} // namespace

bool holdsName(const ExportFormat& format, const std::string& name)
{
    return isUtf8(name) && (format.names != ExportNames::Xml || isXmlText(name));
}

void requireNames(
    const ExportScene& scene, const ExportFormat& format, std::vector<std::string>& notes)
{
    switch (format.names) {
    case ExportNames::Bytes: return;
    case ExportNames::Utf8:
    case ExportNames::Xml:
        if (format.named) requireText(scene.name, "name=", format);
        if (format.link) requireText(scene.link, "link=", format);
        return;
    case ExportNames::Word:
    case ExportNames::Identifier: break;
    }
    if (isPlain(scene.name)) return;
    const bool isWord = format.names == ExportNames::Word;
    notes.push_back(format.name + " holds names in ASCII alone, and has "
        + inQuotes(isWord ? oneWord(scene.name) : identifier(scene.name)) + " for "
        + inQuotes(scene.name) + "; name= gives another");
}

} // namespace openvdb_spheretree::detail
